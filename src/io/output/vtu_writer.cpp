#include "io/output/vtu_writer.hpp"

#include <fmt/format.h>

#include <bit>
#include <limits>
#include <set>
#include <stdexcept>

#include "io/output/atomic_file.hpp"
#include "io/output/base64.hpp"
#include "io/output/zlib_blocks.hpp"

namespace gneiss {
namespace {

static_assert(std::endian::native == std::endian::little, "the header of the files says so");

constexpr std::uint8_t vtk_line = 3, vtk_triangle = 5;

template <std::size_t n>
void check_points(std::span<const std::array<std::int32_t, n>> cells, std::size_t n_points, const char* cell) {
    for (std::size_t e = 0; e < cells.size(); ++e)
        for (const std::int32_t point : cells[e])
            if (!(point >= 0 && static_cast<std::size_t>(point) < n_points))
                throw std::invalid_argument(fmt::format("VtuWriter: {} {} names point {}, allowed: 0 to {}", cell, e,
                                                        point, static_cast<std::ptrdiff_t>(n_points) - 1));
}

bool is_plane_vector(const FieldArray& field) { return field.n_components == 2 && field.component_names.empty(); }

void check(const FieldArray& field, std::size_t n_rows) {
    const auto n_names = field.component_names.size();
    if (field.n_components < 1) throw std::invalid_argument("field " + field.name + ": needs a component");
    if (n_names != 0 && n_names != static_cast<std::size_t>(field.n_components))
        throw std::invalid_argument(
            fmt::format("field {}: {} components, but {} names for them", field.name, field.n_components, n_names));
    if (field.values.size() != n_rows * static_cast<std::size_t>(field.n_components))
        throw std::invalid_argument(fmt::format("field {}: {} numbers for {} rows of {} components", field.name,
                                                field.values.size(), n_rows, field.n_components));
}

void check(const std::vector<FieldArray>& fields, std::size_t n_rows, std::set<std::string> names) {
    for (const FieldArray& field : fields) {
        if (field.name.empty() || !names.insert(field.name).second)
            throw std::invalid_argument("field '" + field.name + "': every array needs a name of its own");
        check(field, n_rows);
    }
}

std::string attributes_of(const FieldArray& field) {
    std::string text = fmt::format("type=\"Float64\" Name=\"{}\"", field.name);
    // meshio gives a column, not a row of numbers, where one component is stated
    if (field.n_components > 1)
        text += fmt::format(" NumberOfComponents=\"{}\"", is_plane_vector(field) ? 3 : field.n_components);
    for (std::size_t k = 0; k < field.component_names.size(); ++k)
        text += fmt::format(" ComponentName{}=\"{}\"", k, field.component_names[k]);
    return text;
}

/// One <DataArray>. Data in it stand in front of its unit: VTK and meshio read what follows the tag.
std::string data_array(const std::string& attributes, const std::string& unit, const std::string& format,
                       std::string_view data = {}) {
    std::string text = fmt::format("<DataArray {} format={}>{}", attributes, format, data);
    if (!unit.empty())
        text += fmt::format("<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{}</InformationKey>", unit);
    return text + "</DataArray>\n";
}

std::string_view text_of(std::span<const std::uint64_t> numbers) {
    return {reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()};
}

/// Arrays as they stand in the file, in memory.
std::vector<std::string> compressed(std::span<const RawArray> arrays, VtuData data) {
    std::vector<std::string> blocks(arrays.size());
    std::vector<std::vector<std::uint64_t>> sizes(arrays.size());
    compress_blocks(arrays, [&](std::size_t array, std::string_view block) {
        blocks[array] += block;
        sizes[array].push_back(block.size());
    });
    for (std::size_t i = 0; i < arrays.size(); ++i) {
        const std::vector<std::uint64_t> header = block_header(arrays[i], sizes[i]);
        if (data == VtuData::base64)  // header and blocks are texts of their own, each filled up
            blocks[i] = base64(text_of(header)) + base64(blocks[i]);
        else
            blocks[i].insert(0, text_of(header));
    }
    return blocks;
}

/// Compresses arrays into a file from byte `begin` on.
/// @return where each begins, counted from `begin`, and where the last one ends
std::vector<std::size_t> write_compressed(int file, std::size_t begin, std::span<const RawArray> arrays,
                                          const std::filesystem::path& path) {
    std::vector<std::size_t> places;
    std::vector<std::vector<std::uint64_t>> sizes(arrays.size());
    std::size_t at = 0;
    const auto begin_arrays = [&](std::size_t n_begun) {
        while (places.size() < n_begun) {
            const RawArray& next = arrays[places.size()];
            places.push_back(at);
            at += text_of(block_header(next, std::vector<std::uint64_t>(next.n_blocks()))).size();
        }
    };
    compress_blocks(arrays, [&](std::size_t array, std::string_view block) {
        begin_arrays(array + 1);
        write_all_at(file, block, begin + at, path);
        at += block.size();
        sizes[array].push_back(block.size());
    });
    begin_arrays(arrays.size());
    places.push_back(at);
    for (std::size_t i = 0; i < arrays.size(); ++i)
        write_all_at(file, text_of(block_header(arrays[i], sizes[i])), begin + places[i], path);
    return places;
}

}  // namespace

VtuWriter::VtuWriter(const FieldMesh& mesh, VtuData data)
    : data_(data),
      n_points_(mesh.points.size()),
      n_cells_(mesh.triangles.empty() ? mesh.lines.size() : mesh.triangles.size()) {
    const bool of_lines = mesh.triangles.empty();
    check_points(mesh.lines, n_points_, "line");
    check_points(mesh.triangles, n_points_, "triangle");
    std::vector<RawArray> arrays;
    const auto add = [&](std::string attributes, std::string unit, RawArray array) {
        mesh_.push_back({std::move(attributes), std::move(unit), {}});
        arrays.push_back(array);
    };
    for (const IntegerArray& integers : mesh.integers) {
        if (integers.values.size() != n_cells_)
            throw std::invalid_argument(fmt::format("field {}: {} numbers for {} {}", integers.name,
                                                    integers.values.size(), n_cells_,
                                                    of_lines ? "lines" : "triangles"));
        integer_names_.push_back(integers.name);
        add(fmt::format("type=\"Int32\" Name=\"{}\"", integers.name), "", {std::as_bytes(integers.values)});
    }
    add("type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", "m", {std::as_bytes(mesh.points), true});
    add("type=\"Int32\" Name=\"connectivity\"", "",
        {of_lines ? std::as_bytes(mesh.lines) : std::as_bytes(mesh.triangles)});
    std::vector<std::int32_t> ends(n_cells_);
    for (std::size_t e = 0; e < n_cells_; ++e) ends[e] = static_cast<std::int32_t>((of_lines ? 2 : 3) * (e + 1));
    add("type=\"Int32\" Name=\"offsets\"", "", {std::as_bytes(std::span(ends))});
    const std::vector<std::uint8_t> types(n_cells_, of_lines ? vtk_line : vtk_triangle);
    add("type=\"UInt8\" Name=\"types\"", "", {std::as_bytes(std::span(types))});

    std::vector<std::string> bytes = compressed(arrays, data);
    for (std::size_t i = 0; i < mesh_.size(); ++i) mesh_[i].bytes = std::move(bytes[i]);
}

void VtuWriter::write(const std::filesystem::path& path, double t, std::int64_t step, const Fields& fields) const {
    check(fields.points, n_points_, {});
    check(fields.cells, n_cells_, {integer_names_.begin(), integer_names_.end()});
    std::vector<RawArray> arrays{{std::as_bytes(std::span(&t, 1))}, {std::as_bytes(std::span(&step, 1))}};
    for (const auto* kind : {&fields.points, &fields.cells})
        for (const FieldArray& field : *kind) arrays.push_back({std::as_bytes(field.values), is_plane_vector(field)});

    if (data_ == VtuData::raw)
        write_raw(path, arrays, fields);
    else
        write_base64(path, arrays, fields);
}

/// Everything in front of the appended data, or of the end of the file. `element` makes the <DataArray> of each array
/// in turn, those of the mesh last.
template <class Element>
std::string VtuWriter::elements(const Fields& fields, const Element& element) const {
    std::string text =
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n<FieldData>\n";
    std::size_t i = 0;
    text += element(i++, "type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\"", "s");
    text += element(i++, "type=\"Int64\" Name=\"step\" NumberOfTuples=\"1\"", "");
    text += fmt::format("</FieldData>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<PointData>\n", n_points_,
                        n_cells_);
    for (const FieldArray& field : fields.points) text += element(i++, attributes_of(field), field.unit);
    text += "</PointData>\n<CellData>\n";
    for (const FieldArray& field : fields.cells) text += element(i++, attributes_of(field), field.unit);
    for (std::size_t k = 0; k < mesh_.size(); ++k) {
        if (k == integer_names_.size()) text += "</CellData>\n<Points>\n";
        if (k == integer_names_.size() + 1) text += "</Points>\n<Cells>\n";
        text += element(i++, mesh_[k].attributes, mesh_[k].unit);
    }
    return text + "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
}

void VtuWriter::write_raw(const std::filesystem::path& path, std::span<const RawArray> arrays,
                          const Fields& fields) const {
    // Offsets are known once everything is compressed, and the head stands in front of it.
    const auto head = [&](std::span<const std::size_t> places) {
        return elements(fields, [&](std::size_t i, const std::string& attributes, const std::string& unit) {
            return data_array(attributes, unit, fmt::format("\"appended\" offset=\"{}\"", places[i]));
        });
    };
    const std::string_view opening = "<AppendedData encoding=\"raw\">\n_", closing = "\n</AppendedData>\n</VTKFile>\n";
    const std::size_t n_arrays = arrays.size() + mesh_.size();
    const std::size_t longest_head =
        head(std::vector<std::size_t>(n_arrays, std::numeric_limits<std::size_t>::max())).size();
    const std::size_t begin = longest_head + opening.size();

    write_atomically(path, [&](int file) {
        std::vector<std::size_t> places = write_compressed(file, begin, arrays, path);
        for (const MeshArray& array : mesh_) {
            write_all_at(file, array.bytes, begin + places.back(), path);
            places.push_back(places.back() + array.bytes.size());
        }
        write_all_at(file, closing, begin + places.back(), path);
        const std::string text = head(places);
        write_all_at(file, text + std::string(longest_head - text.size(), ' ') + std::string(opening), 0, path);
    });
}

void VtuWriter::write_base64(const std::filesystem::path& path, std::span<const RawArray> arrays,
                             const Fields& fields) const {
    const std::vector<std::string> data = compressed(arrays, VtuData::base64);
    const std::string text = elements(fields,
                                      [&](std::size_t i, const std::string& attributes, const std::string& unit) {
                                          return data_array(attributes, unit, "\"binary\"",
                                                            i < data.size() ? data[i] : mesh_[i - data.size()].bytes);
                                      }) +
                             "</VTKFile>\n";
    write_atomically(path, [&](int file) { write_all_at(file, text, 0, path); });
}

}  // namespace gneiss
