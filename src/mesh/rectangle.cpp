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

}  // namespace

MeshDraft rectangle(const MeshOptions& options) {
    const auto [nx, ny] = options.cells;
    MeshDraft draft;
    draft.region_names = {"solid"};
    const auto node = [columns = nx + 1](int i, int j) { return static_cast<std::int32_t>(j * columns + i); };
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i)
            draft.add_node(options.origin[0] + options.width * i / nx, options.origin[1] + options.height * j / ny);

    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            const std::array corners{node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
            if (options.pattern == MeshOptions::Pattern::crossed) {
                const Point2 middle = midpoint(draft.nodes[corners[0]], draft.nodes[corners[2]]);
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

}  // namespace gneiss
