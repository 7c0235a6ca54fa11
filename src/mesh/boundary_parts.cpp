#include "mesh/boundary_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "base/suggest.hpp"
#include "mesh/boundary.hpp"
#include "mesh/geometry.hpp"

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
    if (mesh.node_sets.contains(part.name) ||
        std::ranges::find(mesh.region_names, part.name) != mesh.region_names.end())
        throw InputError("", "the mesh has something of this name already");
    std::vector<BoundaryEdge> edges = edges_inside(mesh, part);
    mesh.node_sets[part.name] = nodes_of(edges);
    mesh.boundaries[part.name] = std::move(edges);
}

}  // namespace

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
