#include "mesh/generators.hpp"
#include "mesh/geometry.hpp"

namespace gneiss {
namespace {

bool diagonal_rises_right(MeshOptions::Pattern pattern, int i, int j) {
    switch (pattern) {
        case MeshOptions::Pattern::uniform_right:
            return true;
        case MeshOptions::Pattern::uniform_left:
            return false;
        default:
            return (i + j) % 2 == 0;
    }
}

/// Rows and columns of cells.
/// @param place  of the corner between cells, place(i, j) for i up to the number of columns and j up to that of rows
template <class Place>
MeshDraft grid(const MeshOptions& options, Place place) {
    const auto [nx, ny] = options.cells;
    MeshDraft draft;
    draft.region_names = {"solid"};
    const auto node = [columns = nx + 1](int i, int j) { return static_cast<std::int32_t>(j * columns + i); };
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) {
            const Point2 at = place(i, j);
            draft.add_node(at[0], at[1]);
        }

    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            const std::array corners{node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
            if (options.pattern == MeshOptions::Pattern::crossed) {
                const Point2 middle = midpoint(midpoint(draft.nodes[corners[0]], draft.nodes[corners[2]]),
                                               midpoint(draft.nodes[corners[1]], draft.nodes[corners[3]]));
                const std::int32_t centre = draft.add_node(middle[0], middle[1]);
                for (int k = 0; k < 4; ++k) draft.add_triangle(corners[k], corners[(k + 1) % 4], centre);
            } else {
                const int k = diagonal_rises_right(options.pattern, i, j) ? 0 : 1;
                draft.add_triangle(corners[k], corners[k + 1], corners[k + 2]);
                draft.add_triangle(corners[k], corners[k + 2], corners[(k + 3) % 4]);
            }
        }

    const auto name = [&](const char* side, std::int32_t a, std::int32_t b) {
        for (const char* line : {side, "outer"}) draft.lines[line].push_back({a, MeshDraft::no_node, b});
    };
    for (int i = 0; i < nx; ++i) {
        name("bottom", node(i, 0), node(i + 1, 0));
        name("top", node(i + 1, ny), node(i, ny));
    }
    for (int j = 0; j < ny; ++j) {
        name("right", node(nx, j), node(nx, j + 1));
        name("left", node(0, j + 1), node(0, j));
    }
    draft.points = {{"bottom_left", {node(0, 0)}},
                    {"bottom_right", {node(nx, 0)}},
                    {"top_right", {node(nx, ny)}},
                    {"top_left", {node(0, ny)}}};
    add_mid_sides(draft);
    return draft;
}

}  // namespace

MeshDraft rectangle(const MeshOptions& options) {
    return grid(options, [&](int i, int j) {
        return Point2{options.origin[0] + options.width * i / options.cells[0],
                      options.origin[1] + options.height * j / options.cells[1]};
    });
}

MeshDraft quadrilateral(const MeshOptions& options) {
    const auto between = [](const Point2& from, const Point2& to, double part) {
        return Point2{(1 - part) * from[0] + part * to[0], (1 - part) * from[1] + part * to[1]};
    };
    return grid(options, [&](int i, int j) {
        const auto& [bottom_left, bottom_right, top_right, top_left] = options.corners;
        const double s = static_cast<double>(i) / options.cells[0], t = static_cast<double>(j) / options.cells[1];
        return between(between(bottom_left, bottom_right, s), between(top_left, top_right, s), t);
    });
}

}  // namespace gneiss
