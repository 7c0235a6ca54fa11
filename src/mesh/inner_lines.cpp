#include "mesh/inner_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "mesh/inner_sides.hpp"
#include "mesh/regions.hpp"

namespace gneiss {
namespace {

/// Of a side's length: how far from the line its nodes may stand.
constexpr double tolerance = 1e-6;

/// A side on a line, from `first` to `last` along it, m.
struct Covered {
    ElementSide side;
    double first, last;
};

/// The sides on a line, by where they begin on it.
std::vector<Covered> sides_on(const Mesh& mesh, std::span<const InnerSide> sides, const InnerLine& line) {
    const std::array<double, 2> way{line.to[0] - line.from[0], line.to[1] - line.from[1]};
    const double length = std::hypot(way[0], way[1]);
    std::vector<Covered> covered;
    for (const auto& [left, right] : sides) {
        const std::int32_t* nodes = mesh.element(static_cast<std::size_t>(left.element));
        const auto local = side_nodes(mesh.kind, left.side);
        const auto place = [&](int k) -> const std::array<double, 2>& {
            return mesh.nodes[static_cast<std::size_t>(nodes[k])];
        };
        const auto &a = place(local.front()), &b = place(local.back());
        const double margin = tolerance * std::hypot(b[0] - a[0], b[1] - a[1]);
        double first = length, last = 0;
        const bool on_line = std::ranges::all_of(local, [&](int k) {
            const std::array<double, 2> d{place(k)[0] - line.from[0], place(k)[1] - line.from[1]};
            const double along = (d[0] * way[0] + d[1] * way[1]) / length;
            const double away = (way[0] * d[1] - way[1] * d[0]) / length;
            first = std::min(first, along);
            last = std::max(last, along);
            return std::abs(away) <= margin && along >= -margin && along <= length + margin;
        });
        if (on_line) covered.push_back({left, first, last});
    }
    std::ranges::sort(covered, {}, &Covered::first);
    return covered;
}

/// @throws InputError if the sides leave a part of the line out
void require_all(const InnerLine& line, const std::vector<Covered>& covered) {
    const double dx = line.to[0] - line.from[0], dy = line.to[1] - line.from[1], length = std::hypot(dx, dy);
    double sum = 0, reached = 0, gap = -1;
    for (const Covered& side : covered) {
        if (gap < 0 && side.first > reached + 2 * tolerance * (side.last - side.first)) gap = reached;
        reached = std::max(reached, side.last);
        sum += side.last - side.first;
    }
    const double margin = covered.empty() ? 0 : 2 * tolerance * (covered.back().last - covered.back().first);
    if (gap < 0 && reached < length - margin) gap = reached;
    if (gap < 0) return;
    throw InputError(
        "", fmt::format("the line is {:.6g} m long, sides between elements cover {:.6g} m of it; the first part that "
                        "they do not cover begins at ({:.6g}, {:.6g}) m",
                        length, sum, line.from[0] + dx * gap / length, line.from[1] + dy * gap / length));
}

void name_line(Mesh& mesh, std::span<const InnerSide> sides, const InnerLine& line) {
    if (mesh.node_sets.contains(line.name) || mesh.inner_lines.contains(line.name) ||
        !regions_named(mesh, line.name).empty())
        throw InputError("", "the mesh has something of this name already");
    const std::vector<Covered> covered = sides_on(mesh, sides, line);
    require_all(line, covered);
    std::vector<ElementSide> found;
    std::vector<std::int32_t> nodes;
    for (const Covered& on_line : covered) {
        found.push_back(on_line.side);
        for (const int k : side_nodes(mesh.kind, on_line.side.side))
            nodes.push_back(mesh.element(static_cast<std::size_t>(on_line.side.element))[k]);
    }
    std::ranges::sort(found, {}, [](const ElementSide& s) { return std::pair(s.element, s.side); });
    std::ranges::sort(nodes);
    nodes.erase(std::ranges::unique(nodes).begin(), nodes.end());
    mesh.inner_lines[line.name] = std::move(found);
    mesh.node_sets[line.name] = std::move(nodes);
}

}  // namespace

void name_lines(Mesh& mesh, const std::vector<InnerLine>& lines) {
    if (lines.empty()) return;
    const InnerSides inner(mesh);
    std::vector<Problem> problems;
    for (const InnerLine& line : lines) {
        try {
            name_line(mesh, inner.sides(), line);
        } catch (const InputError& error) {
            for (const Problem& problem : error.problems())
                problems.push_back({fmt::format("mesh.lines `{}`", line.name), problem.message});
        }
    }
    if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace gneiss
