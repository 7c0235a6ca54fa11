#include "mesh/boundary_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/errors.hpp"
#include "base/suggest.hpp"
#include "mesh/boundary.hpp"
#include "mesh/geometry.hpp"
#include "mesh/regions.hpp"

namespace gneiss {
namespace {

/// Of an edge's length: coordinates of nodes and of boxes that are meant to be the same differ by round-off.
constexpr double round_off = 1e-9;

/// The share of the edge from a to b that lies in the box, by clipping [Liang and Barsky, ACM Transactions on Graphics
/// 3 (1984)].
double share_inside(const Point2& a, const Point2& b, const BoundaryPart& box) {
    const double margin = round_off * std::hypot(b[0] - a[0], b[1] - a[1]);
    double first = 0, last = 1;
    for (std::size_t k = 0; k < 2; ++k) {
        const double low = box.from[k] - margin - a[k], high = box.to[k] + margin - a[k], way = b[k] - a[k];
        if (way == 0) {
            if (low > 0 || high < 0) return 0;
            continue;
        }
        first = std::max(first, std::min(low / way, high / way));
        last = std::min(last, std::max(low / way, high / way));
    }
    return std::max(0.0, last - first);
}

std::vector<BoundaryEdge> edges_inside(const Mesh& mesh, const BoundaryPart& part) {
    std::vector<BoundaryEdge> inside;
    for (const BoundaryEdge& edge : mesh.boundaries.at(part.of)) {
        const Point2 &a = mesh.nodes[static_cast<std::size_t>(edge.a)],
                     &b = mesh.nodes[static_cast<std::size_t>(edge.b)];
        const double share = share_inside(a, b, part);
        if (share > 1 - 4 * round_off)
            inside.push_back(edge);
        else if (share > 4 * round_off)
            throw InputError("", fmt::format("the edge from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) m is cut by the box: "
                                             "a part ends at nodes",
                                             a[0], a[1], b[0], b[1]));
    }
    if (inside.empty()) throw InputError("", fmt::format("no edge of \"{}\" lies in the box", part.of));
    return in_walking_order(inside);
}

bool is_taken(const Mesh& mesh, const std::string& name) {
    return mesh.node_sets.contains(name) || !regions_named(mesh, name).empty();
}

void name_part(Mesh& mesh, const BoundaryPart& part) {
    if (!mesh.boundaries.contains(part.of)) {
        std::vector<std::string_view> names;
        std::string there;
        for (const auto& [name, unused] : mesh.boundaries) {
            names.push_back(name);
            there += (there.empty() ? "" : ", ") + name;
        }
        throw InputError("", fmt::format("of = \"{}\": the mesh has no boundary of this name; there are: {}{}", part.of,
                                         there, suggestion(part.of, names)));
    }
    if (is_taken(mesh, part.name)) throw InputError("", "the mesh has something of this name already");
    std::vector<BoundaryEdge> edges = edges_inside(mesh, part);
    mesh.node_sets[part.name] = nodes_of(edges);
    mesh.boundaries[part.name] = std::move(edges);
}

}  // namespace

void name_sides_of_rectangle(Mesh& mesh, const std::vector<BoundaryEdge>& contour) {
    Point2 low = mesh.nodes.front(), high = low;
    for (const Point2& x : mesh.nodes)
        for (const std::size_t k : {0, 1}) {
            low[k] = std::min(low[k], x[k]);
            high[k] = std::max(high[k], x[k]);
        }
    struct Side {
        const char* name;
        std::size_t across;  // component that all of its points share
        double at, length;
        std::vector<BoundaryEdge> edges = {};
    };
    std::array<Side, 4> sides{{{"bottom", 1, low[1], high[0] - low[0]},
                               {"right", 0, high[0], high[1] - low[1]},
                               {"top", 1, high[1], high[0] - low[0]},
                               {"left", 0, low[0], high[1] - low[1]}}};
    // A file keeps the digits of its writer, Gmsh's geometry is exact to 1e-8 of the model.
    constexpr double tolerance = 1e-6;
    for (const BoundaryEdge& edge : contour) {
        const Point2 &a = mesh.nodes[static_cast<std::size_t>(edge.a)],
                     &b = mesh.nodes[static_cast<std::size_t>(edge.b)];
        const double length = distance(a, b);
        const auto side = std::ranges::find_if(sides, [&](const Side& s) {
            return std::max(std::abs(a[s.across] - s.at), std::abs(b[s.across] - s.at)) <= tolerance * length;
        });
        if (side == sides.end()) return;
        side->length -= length;
        side->edges.push_back(edge);
    }
    for (const Side& side : sides)  // each covered once: neither a gap nor a second piece on it
        if (side.edges.empty() ||
            std::abs(side.length) > tolerance * distance(mesh.nodes[static_cast<std::size_t>(side.edges[0].a)],
                                                         mesh.nodes[static_cast<std::size_t>(side.edges[0].b)]))
            return;
    for (Side& side : sides) {
        if (is_taken(mesh, side.name)) continue;
        mesh.node_sets[side.name] = nodes_of(side.edges);
        mesh.boundaries[side.name] = in_walking_order(side.edges);
    }
}

void name_parts(Mesh& mesh, const std::vector<BoundaryPart>& parts) {
    std::vector<Problem> problems;
    for (const BoundaryPart& part : parts) {
        try {
            name_part(mesh, part);
        } catch (const InputError& error) {
            for (const Problem& problem : error.problems())
                problems.push_back({fmt::format("mesh.parts `{}`", part.name), problem.message});
        }
    }
    if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace gneiss
