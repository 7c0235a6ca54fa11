#pragma once
// How a mesh is described by the user.

#include <array>
#include <map>
#include <string>
#include <vector>

#include "base/errors.hpp"
#include "mesh/geometry.hpp"

namespace gneiss {

/// A part of a boundary that gets a name of its own: its edges inside a box.
struct BoundaryPart {
    std::string name;
    std::string of;                    ///< name of a boundary
    std::array<double, 2> from{0, 0};  ///< lower left corner of the box, m
    std::array<double, 2> to{0, 0};    ///< upper right corner, m, not below `from`
};

/// A straight line of sides inside the solid that gets a name.
struct InnerLine {
    std::string name;
    std::array<double, 2> from{0, 0}, to{0, 0};  ///< its ends, m, not in one place
};

/// Where the mesh comes from: a file, or one of the built-in generators. SI units.
struct MeshOptions {
    enum class Source { file, rectangle, quadrilateral, plate_with_hole };
    enum class Pattern { uniform_right, uniform_left, alternating, crossed };  ///< diagonals of the cells
    enum class Layout { free, structured };

    Source source = Source::rectangle;
    std::string file;                          ///< .msh (4.1) or .geo; relative to the deck's folder
    std::map<std::string, double> parameters;  ///< numbers defined in the .geo before it is read

    double width = 1, height = 1;        ///< rectangle, m, > 0
    std::array<double, 2> origin{0, 0};  ///< lower left corner, m
    /// Of a quadrilateral, m: bottom left, bottom right, top right, top left, names that need not be taken literally.
    /// Convex, counter-clockwise.
    std::array<std::array<double, 2>, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    std::array<int, 2> cells{1, 1};            ///< of a rectangle or quadrilateral: along bottom and left side, >= 1
    Pattern pattern = Pattern::uniform_right;  ///< uniform_right: diagonals rise to the right

    double side = 0;                   ///< plate with hole: side of the square block, m, > 2 radius
    double radius = 0;                 ///< radius of the hole at the centre, m, > 0
    std::array<double, 2> size{0, 0};  ///< edge length of a composite at the hole and at the outer boundary, m, > 0;
                                       ///< a composite's sub-edges are half of it
    Layout layout = Layout::free;      ///< structured has every symmetry of the square; free has none
    int seed = 0;                      ///< moves the first point of the hole's division, so that free meshes differ

    std::vector<BoundaryPart> parts;
    std::vector<InnerLine> lines;

    bool curved = true;  ///< mid-side nodes on a curved boundary follow it; false: all sides straight
};

/// Everything that is wrong with the options, ranges NaN-safe; empty if nothing is. Options that belong to another
/// source are not looked at. The file itself is checked when it is read.
std::vector<Problem> validate(const MeshOptions& options);

/// The first corner of a quadrilateral at which the way around it does not turn left, -1 if there is none: it is then
/// convex and runs counter-clockwise. NaN-safe.
inline int reflex_corner(const std::array<std::array<double, 2>, 4>& corners) {
    for (std::size_t i = 0; i < 4; ++i)
        if (!(triangle_area(corners[(i + 3) % 4], corners[i], corners[(i + 1) % 4]) > 0)) return static_cast<int>(i);
    return -1;
}

/// Number of composites the generators will make: exact for rectangle, quadrilateral and structured plate, an estimate
/// from the area and the sizes for the free plate, 0 for a file. The options must be valid.
double expected_composites(const MeshOptions& options);

}  // namespace gneiss
