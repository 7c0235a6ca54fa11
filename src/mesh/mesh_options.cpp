#include "mesh/mesh_options.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "mesh/generators.hpp"
#include "mesh/mesh_file_kind.hpp"

namespace gneiss {
namespace {

/// About 100 GB of element data: beyond it a size is a slip of the pen, and meshing would never come back.
constexpr double max_composites = 1e8;

void require_positive(std::vector<Problem>& problems, const char* key, double value) {
    if (!(value > 0 && std::isfinite(value)))
        problems.push_back({"mesh", fmt::format("{} = {} must be a finite length > 0 m", key, value)});
}

void validate_file(std::vector<Problem>& problems, const MeshOptions& options) {
    if (options.file.empty()) {
        problems.push_back({"mesh", "file is missing: name a .msh, .geo or .inp file"});
        return;
    }
    const MeshFileKind kind = mesh_file_kind(options.file);
    if (kind == MeshFileKind::other)
        problems.push_back({"mesh", fmt::format("file = \"{}\" must end in .msh, .geo or .inp", options.file)});
    if ((kind == MeshFileKind::msh || kind == MeshFileKind::abaqus) && !options.parameters.empty())
        problems.push_back({"mesh", "parameters belong to a .geo file; others are read as they are"});
    for (const auto& [name, value] : options.parameters)
        if (!std::isfinite(value))
            problems.push_back({"mesh", fmt::format("parameters.{} = {} must be finite", name, value)});
}

void validate_cells(std::vector<Problem>& problems, const MeshOptions& options) {
    for (int n : options.cells)
        if (n < 1) problems.push_back({"mesh", fmt::format("cells = {} must be >= 1", n)});
}

void validate_rectangle(std::vector<Problem>& problems, const MeshOptions& options) {
    require_positive(problems, "width", options.width);
    require_positive(problems, "height", options.height);
    for (double x : options.origin)
        if (!std::isfinite(x)) problems.push_back({"mesh", fmt::format("origin = {} must be finite", x)});
    validate_cells(problems, options);
}

void validate_quadrilateral(std::vector<Problem>& problems, const MeshOptions& options) {
    if (const int corner = reflex_corner(options.corners); corner >= 0)
        problems.push_back({"mesh", fmt::format("corners[{}] = [{}, {}] does not turn left: the quadrilateral must be "
                                                "convex, its corners counter-clockwise",
                                                corner, options.corners[static_cast<std::size_t>(corner)][0],
                                                options.corners[static_cast<std::size_t>(corner)][1])});
    validate_cells(problems, options);
}

void validate_plate(std::vector<Problem>& problems, const MeshOptions& options) {
    require_positive(problems, "side", options.side);
    require_positive(problems, "radius", options.radius);
    require_positive(problems, "size[0]", options.size[0]);
    require_positive(problems, "size[1]", options.size[1]);
    if (options.side > 0 && options.radius > 0 && !(options.side > 2 * options.radius))
        problems.push_back({"mesh", fmt::format("side = {} m must exceed the diameter of the hole, 2 radius = {} m",
                                                options.side, 2 * options.radius)});
}

/// Equilateral triangles of the local edge length fill the area between circle and square; midpoint rule over the
/// radius.
double composites_of_free_plate(const MeshOptions& options) {
    constexpr int n_rings = 400;
    const double outer = std::sqrt(options.side * options.side / std::numbers::pi);  // circle of the square's area
    double n = 0;
    for (int i = 0; i < n_rings; ++i) {
        const double dr = (outer - options.radius) / n_rings;
        const double r = options.radius + (i + 0.5) * dr;
        const double h = plate_edge_length(options, r);
        n += 2 * std::numbers::pi * r * dr / (std::sqrt(3.0) / 4 * h * h);
    }
    return n;
}

void validate_parts(std::vector<Problem>& problems, const std::vector<BoundaryPart>& parts) {
    for (const BoundaryPart& part : parts) {
        const auto [x, y] = part.from;
        if (!(std::isfinite(x) && std::isfinite(y) && x <= part.to[0] && y <= part.to[1] && std::isfinite(part.to[0]) &&
              std::isfinite(part.to[1])))
            problems.push_back({fmt::format("mesh.parts `{}`", part.name),
                                fmt::format("from = [{}, {}] must lie below and to the left of to = [{}, {}]", x, y,
                                            part.to[0], part.to[1])});
    }
}

void validate_lines(std::vector<Problem>& problems, const std::vector<InnerLine>& lines) {
    for (const InnerLine& line : lines)
        if (const double length = std::hypot(line.to[0] - line.from[0], line.to[1] - line.from[1]);
            !(length > 0 && std::isfinite(length)))
            problems.push_back({fmt::format("mesh.lines `{}`", line.name),
                                fmt::format("from = [{}, {}] to = [{}, {}] must be a line of some length", line.from[0],
                                            line.from[1], line.to[0], line.to[1])});
}

}  // namespace

double expected_composites(const MeshOptions& options) {
    switch (options.source) {
        case MeshOptions::Source::rectangle:
        case MeshOptions::Source::quadrilateral: {
            const double per_cell = options.pattern == MeshOptions::Pattern::crossed ? 4 : 2;
            return per_cell * options.cells[0] * options.cells[1];
        }
        case MeshOptions::Source::plate_with_hole: {
            if (options.layout == MeshOptions::Layout::free) return composites_of_free_plate(options);
            const PlateDivision division = plate_division(options);
            return 2 * division.around * division.rings;
        }
        case MeshOptions::Source::file:
            break;
    }
    return 0;
}

std::vector<Problem> validate(const MeshOptions& options) {
    std::vector<Problem> problems;
    switch (options.source) {
        case MeshOptions::Source::file:
            validate_file(problems, options);
            break;
        case MeshOptions::Source::rectangle:
            validate_rectangle(problems, options);
            break;
        case MeshOptions::Source::quadrilateral:
            validate_quadrilateral(problems, options);
            break;
        case MeshOptions::Source::plate_with_hole:
            validate_plate(problems, options);
            break;
    }
    validate_parts(problems, options.parts);
    validate_lines(problems, options.lines);
    if (problems.empty()) {
        const double n = expected_composites(options);
        if (!(n <= max_composites))
            problems.push_back({"mesh", fmt::format("these sizes ask for about {:.2g} composites; at most {:.0e} are "
                                                    "allowed",
                                                    n, max_composites)});
    }
    return problems;
}

}  // namespace gneiss
