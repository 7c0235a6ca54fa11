#pragma once
// One picture of the fields on a mesh of triangles or of lines, as a compressed .vtu that ParaView opens.

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace gneiss {

struct RawArray;

/// A named array of numbers at points or in cells, triangles or lines. Nothing is copied: `values` must live until the
/// write is over.
struct FieldArray {
    std::string name;                               ///< "displacement", "cauchy_stress"; unique among its kind
    std::span<const double> values;                 ///< shape (n, n_components), row after row
    std::string unit = {};                          ///< "m", "Pa"; empty: none
    int n_components = 1;                           ///< >= 1; 2 without names is a plane vector, written as (x, y, 0)
    std::vector<std::string> component_names = {};  ///< none, or one for each component: {"v", "alpha", "beta", "psi"}
};

/// A named whole number for each cell that stays the same: composite, region.
struct IntegerArray {
    std::string name;
    std::span<const std::int32_t> values;  ///< shape (n_cells)
};

/// Where the fields live. A composite triangle is given as its four sub-triangles, one after the other, so that what
/// is constant in each of them is shown as such.
struct FieldMesh {
    std::span<const std::array<double, 2>> points;  ///< reference positions, m, shape (n_points, 2)
    std::span<const std::array<std::int32_t, 3>>
        triangles;  ///< point numbers from 0, counter-clockwise, (n_triangles, 3)
    std::vector<IntegerArray> integers = {};
    std::span<const std::array<std::int32_t, 2>> lines = {};  ///< in place of triangles, shape (n_lines, 2)
};

/// All fields at one time.
struct Fields {
    std::vector<FieldArray> points;  ///< arrays with n_points rows
    std::vector<FieldArray> cells;   ///< arrays with n_cells rows
};

/// How the numbers of a .vtu stand in it.
enum class VtuData {
    raw,    ///< bytes behind all elements (format="appended", encoding="raw")
    base64  ///< text in the element of each array (format="binary"): files a third larger that more programs read
};

/// Writes any number of .vtu files on one mesh: VTK's XML format, its data compressed by zlib in blocks, little endian.
/// Units stand where VTK has them, as UNITS_LABEL of an array. The bytes depend on what is written alone. The mesh is
/// compressed once.
class VtuWriter {
public:
    /// @throws std::invalid_argument if a cell names a point that is not there, or an array has the wrong length
    explicit VtuWriter(const FieldMesh& mesh, VtuData data = VtuData::raw);

    /// Writes `path` whole or not at all. Field data: TimeValue = t (s), which readers take as the time, and step.
    /// @throws IoError if the file cannot be written
    /// @throws std::invalid_argument if an array has the wrong length, no name or the name of another
    void write(const std::filesystem::path& path, double t, std::int64_t step, const Fields& fields) const;

    VtuData data() const { return data_; }

private:
    /// An array of the mesh as it stands in every file.
    struct MeshArray {
        std::string attributes, unit, bytes;
    };

    void write_raw(const std::filesystem::path& path, std::span<const RawArray> arrays, const Fields& fields) const;
    void write_base64(const std::filesystem::path& path, std::span<const RawArray> arrays, const Fields& fields) const;
    template <class Element>
    std::string elements(const Fields& fields, const Element& element) const;

    VtuData data_;
    std::size_t n_points_, n_cells_;
    std::vector<std::string> integer_names_;
    std::vector<MeshArray> mesh_;  ///< integers, points, connectivity, offsets, types
};

}  // namespace gneiss
