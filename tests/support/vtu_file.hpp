#pragma once
// A .vtu read back by code that shares nothing with the writer; strict, for files of gneiss alone.

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

namespace gneiss::test {

/// One <DataArray>; numbers of every type as double.
struct VtuArray {
    std::string name, type, unit;
    std::vector<std::string> component_names;
    std::size_t n_components = 1;
    std::vector<double> values;

    std::size_t n_rows() const { return values.size() / n_components; }
    double operator()(std::size_t row, std::size_t component = 0) const {
        if (component >= n_components) throw std::out_of_range(name + ": no such component");
        return values.at(row * n_components + component);
    }
};

struct VtuFile {
    std::vector<VtuArray> field_data, point_data, cell_data, of_points, of_cells;

    std::size_t n_points() const { return of_points.at(0).n_rows(); }
    std::size_t n_cells() const { return named(of_cells, "types").n_rows(); }
    const VtuArray& field(const std::string& name) const { return named(field_data, name); }
    const VtuArray& of_point(const std::string& name) const { return named(point_data, name); }
    const VtuArray& of_cell(const std::string& name) const { return named(cell_data, name); }
    double position(std::size_t point, std::size_t component) const { return of_points.at(0)(point, component); }
    int cell_type(std::size_t cell) const { return static_cast<int>(named(of_cells, "types")(cell)); }
    std::vector<std::size_t> cell_points(std::size_t cell) const {
        const VtuArray &ends = named(of_cells, "offsets"), &points = named(of_cells, "connectivity");
        std::vector<std::size_t> found;
        for (auto i = static_cast<std::size_t>(cell == 0 ? 0 : ends(cell - 1)); i < ends(cell); ++i)
            found.push_back(static_cast<std::size_t>(points(i)));
        return found;
    }
    static std::vector<std::string> names(const std::vector<VtuArray>& arrays) {
        std::vector<std::string> found;
        for (const VtuArray& array : arrays) found.push_back(array.name);
        return found;
    }

private:
    static const VtuArray& named(const std::vector<VtuArray>& arrays, const std::string& name) {
        for (const VtuArray& array : arrays)
            if (array.name == name) return array;
        throw std::out_of_range("the file has no array " + name);
    }
};

/// The bytes of an array whose blocks begin at `at`; `at` goes behind them.
inline std::string decompressed(const std::string& file, std::size_t& at) {
    const auto number = [&] {
        std::uint64_t value = 0;
        std::memcpy(&value, file.substr(at, sizeof value).data(), sizeof value);
        at += sizeof value;
        return value;
    };
    const std::uint64_t n_blocks = number(), block_size = number(), last_size = number();
    std::vector<std::uint64_t> sizes(n_blocks);
    for (std::uint64_t& size : sizes) size = number();
    std::string bytes;
    for (std::size_t i = 0; i < n_blocks; ++i) {
        std::string block(i + 1 == n_blocks && last_size != 0 ? last_size : block_size, '\0');
        uLongf size = block.size();
        const std::string packed = file.substr(at, sizes[i]);
        if (uncompress(reinterpret_cast<Bytef*>(block.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                       packed.size()) != Z_OK ||
            size != block.size())
            throw std::runtime_error("a block does not have the size that the header says");
        bytes += block;
        at += sizes[i];
    }
    return bytes;
}

inline std::string from_base64(const std::string& text) {
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    std::uint32_t bits = 0;
    int n_bits = 0;
    for (const char letter : text.substr(0, text.find('='))) {
        const std::size_t value = letters.find(letter);
        if (value == letters.npos) throw std::runtime_error("no letter of base64");
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        if ((n_bits += 6) >= 8) bytes += static_cast<char>(bits >> (n_bits -= 8) & 255);
    }
    if (text.size() % 4 != 0 || text.size() != (bytes.size() + 2) / 3 * 4)
        throw std::runtime_error("base64 that is not filled up");
    return bytes;
}

/// The bytes of an array that stands as text in its element: header and blocks are texts of their own.
inline std::string decoded(const std::string& text) {
    std::uint64_t n_blocks = 0;
    std::memcpy(&n_blocks, from_base64(text.substr(0, 12)).data(), sizeof n_blocks);
    const std::size_t header = (8 * (3 + n_blocks) + 2) / 3 * 4;
    return from_base64(text.substr(0, header)) + from_base64(text.substr(header));
}

/// What stands between two texts; empty if either is missing.
inline std::string between(const std::string& text, const std::string& left, const std::string& right) {
    const std::size_t begin = text.find(left), first = begin + left.size(), last = text.find(right, first);
    return begin == text.npos || last == text.npos ? "" : text.substr(first, last - first);
}

template <class T>
std::vector<double> numbers_in(const std::string& bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());  // data() of none may be null
    return {values.begin(), values.end()};
}

/// @throws std::runtime_error if head and data do not fit together, byte by byte
inline VtuFile read_vtu(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    const std::string file{std::istreambuf_iterator<char>(stream), {}};
    const std::string opening = "<AppendedData encoding=\"raw\">\n_", closing = "\n</AppendedData>\n</VTKFile>\n";
    const bool is_raw = file.find(opening) != file.npos;
    const std::size_t begin = is_raw ? file.find(opening) + opening.size() : file.size();
    const std::string head = file.substr(0, is_raw ? file.find(opening) : file.npos);
    for (const char* stated : {"byte_order=\"LittleEndian\"", "header_type=\"UInt64\"",
                               "compressor=\"vtkZLibDataCompressor\"", "type=\"UnstructuredGrid\""})
        if (head.find(stated) == head.npos) throw std::runtime_error(std::string("the file does not state ") + stated);

    VtuFile grid;
    std::vector<std::pair<std::size_t, std::size_t>> extents;  // where arrays begin and end
    const auto section = [&](const std::string& name, std::vector<VtuArray>& arrays) {
        const std::size_t first = head.find("<" + name + ">"), last = head.find("</" + name + ">");
        if (first == head.npos || last == head.npos) throw std::runtime_error("the file has no " + name);
        const std::string text = head.substr(first, last - first);
        for (std::size_t at = text.find("<DataArray "); at != text.npos; at = text.find("<DataArray ", at + 1)) {
            const std::string attributes = between(text.substr(at), "<DataArray ", ">");
            const std::string content = between(text.substr(at), attributes + ">", "</DataArray>");
            VtuArray array;
            array.unit = between(content, "<InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">",
                                 "</InformationKey>");
            std::string format;
            std::size_t offset = 0;
            const std::regex attribute("([A-Za-z]+[0-9]*)=\"([^\"]*)\"");
            for (std::sregex_iterator a(attributes.begin(), attributes.end(), attribute), none; a != none; ++a) {
                const std::string key = (*a)[1], value = (*a)[2];
                if (key == "Name") array.name = value;
                if (key == "type") array.type = value;
                if (key == "NumberOfComponents") array.n_components = std::stoul(value);
                if (key.starts_with("ComponentName")) array.component_names.push_back(value);
                if (key == "format") format = value;
                if (key == "offset") offset = std::stoul(value);
            }
            std::string bytes;
            if (is_raw && format == "appended") {
                std::size_t end = begin + offset;
                bytes = decompressed(file, end);
                extents.emplace_back(offset, end - begin);
            } else if (!is_raw && format == "binary") {
                const std::string data = decoded(content.substr(0, content.find('<')));
                std::size_t end = 0;
                bytes = decompressed(data, end);
                if (end != data.size()) throw std::runtime_error(array.name + ": something follows its blocks");
            } else {
                throw std::runtime_error(array.name + ": unexpected format " + format);
            }
            if (array.type == "Float64") array.values = numbers_in<double>(bytes);
            if (array.type == "Int64") array.values = numbers_in<std::int64_t>(bytes);
            if (array.type == "Int32") array.values = numbers_in<std::int32_t>(bytes);
            if (array.type == "UInt8") array.values = numbers_in<std::uint8_t>(bytes);
            arrays.push_back(std::move(array));
        }
    };
    section("FieldData", grid.field_data);
    section("PointData", grid.point_data);
    section("CellData", grid.cell_data);
    section("Points", grid.of_points);
    section("Cells", grid.of_cells);

    if (!is_raw) {
        if (!file.ends_with("</UnstructuredGrid>\n</VTKFile>\n")) throw std::runtime_error("the file is not closed");
        return grid;
    }
    // meshio walks through the data from array to array: they follow each other without a gap
    std::sort(extents.begin(), extents.end());
    std::size_t at = 0;
    for (const auto& [first, last] : extents) {
        if (first != at) throw std::runtime_error("there is a gap between arrays");
        at = last;
    }
    if (file.substr(begin + at) != closing) throw std::runtime_error("the file does not end behind its last array");
    return grid;
}

}  // namespace gneiss::test
