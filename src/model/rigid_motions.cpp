#include "model/rigid_motions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace gneiss {
namespace {

/// Smallest and largest of the values taken in.
struct Interval {
    double lowest = std::numeric_limits<double>::infinity(), highest = -std::numeric_limits<double>::infinity();

    void take(double value) {
        lowest = std::min(lowest, value);
        highest = std::max(highest, value);
    }
    bool empty() const { return lowest > highest; }
    double length() const { return empty() ? 0 : highest - lowest; }
    double middle() const { return 0.5 * (lowest + highest); }
};

struct Part {
    std::size_t n_elements = 0, n_nodes = 0;
    std::array<double, 2> sum{0, 0};     ///< of positions
    std::array<Interval, 2> extent;      ///< in x and y
    Interval heights_of_x, widths_of_y;  ///< where x and where y is prescribed
};

/// The smallest node of the part that each node belongs to.
std::vector<std::int32_t> part_of_nodes(const Mesh& mesh, std::span<const std::array<std::int32_t, 2>> bonds) {
    std::vector<std::int32_t> parent(mesh.n_nodes());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](std::int32_t node) {
        const auto up = [&](std::int32_t n) -> std::int32_t& { return parent[static_cast<std::size_t>(n)]; };
        while (up(node) != node) node = up(node) = up(up(node));
        return node;
    };
    const auto join = [&](std::int32_t a, std::int32_t b) {
        const auto [low, high] = std::minmax({root(a), root(b)});
        parent[static_cast<std::size_t>(high)] = low;
    };
    for (std::size_t e = 0; e < mesh.n_elements(); ++e) {
        const std::int32_t* nodes = mesh.element(e);
        for (int k = 1; k < mesh.nodes_per_element(); ++k) join(nodes[0], nodes[k]);
    }
    for (const auto& [a, b] : bonds) join(a, b);
    for (std::size_t node = 0; node < parent.size(); ++node) parent[node] = root(static_cast<std::int32_t>(node));
    return parent;
}

std::vector<std::string> free_motions(const Part& part, const std::array<double, 2>& centre) {
    // closer together than this, two supports leave nothing of sixteen digits
    constexpr double same = 1e-9;
    const double tolerance = same * std::max(part.extent[0].length(), part.extent[1].length());
    std::vector<std::string> motions;
    if (part.heights_of_x.empty()) motions.emplace_back("translation in x");
    if (part.widths_of_y.empty()) motions.emplace_back("translation in y");
    if (part.heights_of_x.length() <= tolerance && part.widths_of_y.length() <= tolerance)
        motions.push_back(fmt::format("rotation about ({:.6g}, {:.6g})",
                                      part.widths_of_y.empty() ? centre[0] : part.widths_of_y.middle(),
                                      part.heights_of_x.empty() ? centre[1] : part.heights_of_x.middle()));
    return motions;
}

}  // namespace

std::vector<FreePart> free_parts(const Mesh& mesh, std::span<const Constraint> constraints,
                                 std::span<const std::array<std::int32_t, 2>> bonds) {
    const std::vector<std::int32_t> part_of = part_of_nodes(mesh, bonds);
    std::vector<Part> parts(mesh.n_nodes());  // that of a part's smallest node counts
    const auto of_node = [&](std::size_t node) -> Part& { return parts[static_cast<std::size_t>(part_of[node])]; };
    for (std::size_t node = 0; node < mesh.n_nodes(); ++node) {
        Part& part = of_node(node);
        ++part.n_nodes;
        for (std::size_t c = 0; c < 2; ++c) {
            part.sum[c] += mesh.nodes[node][c];
            part.extent[c].take(mesh.nodes[node][c]);
        }
    }
    for (const Constraint& constraint : constraints) {
        const std::size_t node = constraint.dof / 2;
        const auto& [x, y] = mesh.nodes[node];
        if (constraint.dof % 2 == 0)
            of_node(node).heights_of_x.take(y);
        else
            of_node(node).widths_of_y.take(x);
    }
    std::vector<const Part*> in_order;
    for (std::size_t e = 0; e < mesh.n_elements(); ++e) {
        Part& part = of_node(static_cast<std::size_t>(mesh.element(e)[0]));
        if (part.n_elements++ == 0) in_order.push_back(&part);
    }
    std::vector<FreePart> free;
    for (const Part* part : in_order) {
        const auto n = static_cast<double>(part->n_nodes);
        const std::array<double, 2> centre{part->sum[0] / n, part->sum[1] / n};
        std::vector<std::string> motions = free_motions(*part, centre);
        if (!motions.empty()) free.push_back({part->n_elements, centre, std::move(motions)});
    }
    return free;
}

std::string describe(const std::vector<FreePart>& parts, const Mesh& mesh) {
    constexpr std::size_t few = 5;
    std::vector<std::string> lines;
    for (std::size_t k = 0; k < std::min(few, parts.size()); ++k) {
        const FreePart& part = parts[k];
        const std::string name = part.n_elements == mesh.n_elements()
                                     ? "the solid"
                                     : fmt::format("the part of {} elements around ({:.6g}, {:.6g})", part.n_elements,
                                                   part.centre[0], part.centre[1]);
        lines.push_back(fmt::format("{}: {}", name, fmt::join(part.motions, ", ")));
    }
    if (parts.size() > few) lines.push_back(fmt::format("and {} more parts", parts.size() - few));
    return fmt::format("{}", fmt::join(lines, "; "));
}

}  // namespace gneiss
