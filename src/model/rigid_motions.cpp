#include "model/rigid_motions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

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

/// Rows of a matrix in reduced form: each has a pivot, 1, above and below which there is nothing.
class ReducedRows {
public:
    explicit ReducedRows(std::size_t n) : n_(n) {}

    /// @return whether the row is independent of those before
    bool add(std::vector<double> row) {
        for (std::size_t r = 0; r < rows_.size(); ++r) subtract(row, rows_[r], row[pivots_[r]]);
        const auto largest = std::ranges::max_element(row, {}, [](double x) { return std::abs(x); });
        constexpr double nothing = 1e-7;  // of entries of about 1, after some hundred subtractions
        if (row.empty() || std::abs(*largest) < nothing) return false;
        const auto pivot = static_cast<std::size_t>(largest - row.begin());
        const double factor = 1 / row[pivot];
        for (double& x : row) x *= factor;
        for (std::vector<double>& other : rows_) subtract(other, row, other[pivot]);
        rows_.push_back(std::move(row));
        pivots_.push_back(pivot);
        return true;
    }
    /// Vectors that all rows leave at nothing.
    std::vector<std::vector<double>> null_space() const {
        std::vector<std::vector<double>> basis;
        for (std::size_t column = 0; column < n_; ++column) {
            if (std::ranges::find(pivots_, column) != pivots_.end()) continue;
            std::vector<double>& vector = basis.emplace_back(n_, 0.0);
            vector[column] = 1;
            for (std::size_t r = 0; r < rows_.size(); ++r) vector[pivots_[r]] = -rows_[r][column];
        }
        return basis;
    }

private:
    static void subtract(std::vector<double>& from, const std::vector<double>& row, double factor) {
        for (std::size_t i = 0; factor != 0 && i < from.size(); ++i) from[i] -= factor * row[i];
    }

    std::size_t n_;
    std::vector<std::vector<double>> rows_;
    std::vector<std::size_t> pivots_;
};

/// Motions that parts have left where they touch: of each part (v_x, v_y, turn about its centre times its size).
class Touching {
public:
    Touching(std::span<const Part* const> parts, double size) : parts_(parts), size_(size), rows_(3 * parts.size()) {
        for (std::size_t p = 0; p < parts.size(); ++p) {
            for (const double y : {parts[p]->heights_of_x.lowest, parts[p]->heights_of_x.highest})
                if (!parts[p]->heights_of_x.empty()) add({p, none, {centre(p)[0], y}, {1, 0}});
            for (const double x : {parts[p]->widths_of_y.lowest, parts[p]->widths_of_y.highest})
                if (!parts[p]->widths_of_y.empty()) add({p, none, {x, centre(p)[1]}, {0, 1}});
        }
    }
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    std::array<double, 2> centre(std::size_t part) const {
        const auto n = static_cast<double>(parts_[part]->n_nodes);
        return {parts_[part]->sum[0] / n, parts_[part]->sum[1] / n};
    }
    struct Hold {
        std::size_t part, other;  ///< none: what is fixed
        std::array<double, 2> at, along;
    };
    void add(const Hold& hold) {
        // two parts hold each other in three ways at most, however many places they touch at
        const double turn = hold.at[0] * hold.along[1] - hold.at[1] * hold.along[0];
        const auto [pair, first] = between_.try_emplace(std::minmax(hold.part, hold.other), 3);
        if (!pair->second.add({hold.along[0], hold.along[1], turn / size_})) return;
        std::vector<double> row(3 * parts_.size(), 0.0);
        for (const auto& [part, sign] : {std::pair(hold.part, 1.0), std::pair(hold.other, -1.0)}) {
            if (part == none) continue;
            const std::array<double, 2> c = centre(part), arm{hold.at[0] - c[0], hold.at[1] - c[1]};
            row[3 * part] += sign * hold.along[0];
            row[3 * part + 1] += sign * hold.along[1];
            row[3 * part + 2] += sign * (arm[0] * hold.along[1] - arm[1] * hold.along[0]) / size_;
        }
        rows_.add(std::move(row));
    }
    /// What each part can do, by name.
    std::vector<std::vector<std::string>> motions() const {
        const auto free = rows_.null_space();
        std::vector<std::vector<std::string>> names(parts_.size());
        for (std::size_t p = 0; p < parts_.size(); ++p) {
            constexpr double moves = 1e-6;
            const auto can = [&](std::size_t k) {
                return std::ranges::any_of(free, [&](const auto& v) { return std::abs(v[3 * p + k]) > moves; });
            };
            if (can(0)) names[p].emplace_back("translation in x");
            if (can(1)) names[p].emplace_back("translation in y");
            if (can(2)) names[p].push_back(fmt::format("rotation about ({:.6g}, {:.6g})", centre(p)[0], centre(p)[1]));
        }
        return names;
    }

private:
    std::span<const Part* const> parts_;
    double size_;
    ReducedRows rows_;
    std::map<std::pair<std::size_t, std::size_t>, ReducedRows> between_;
};

}  // namespace

std::vector<FreePart> free_parts(const Mesh& mesh, std::span<const Constraint> constraints,
                                 std::span<const std::array<std::int32_t, 2>> bonds, std::span<const Touch> touches) {
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
    std::vector<const Part*> free_ones;
    for (const Part* part : in_order) {
        const auto n = static_cast<double>(part->n_nodes);
        const std::array<double, 2> centre{part->sum[0] / n, part->sum[1] / n};
        std::vector<std::string> motions = free_motions(*part, centre);
        if (motions.empty()) continue;
        free.push_back({part->n_elements, centre, std::move(motions)});
        free_ones.push_back(part);
    }
    if (touches.empty() || free.empty()) return free;

    double size = 0;  // of what is free
    for (const Part* part : free_ones) size = std::max({size, part->extent[0].length(), part->extent[1].length()});
    Touching touching(free_ones, size);
    const auto number = [&](std::int32_t node) {
        if (node < 0) return Touching::none;
        const auto found = std::ranges::find(free_ones, &of_node(static_cast<std::size_t>(node)));
        return found == free_ones.end() ? Touching::none : static_cast<std::size_t>(found - free_ones.begin());
    };
    for (const Touch& touch : touches) {
        const std::size_t part = number(touch.node), other = number(touch.other);
        if (part == other) continue;
        touching.add({part, other, touch.at, touch.normal});
        if (touch.rough) touching.add({part, other, touch.at, {-touch.normal[1], touch.normal[0]}});
    }
    const auto motions = touching.motions();
    std::vector<FreePart> hanging;
    for (std::size_t p = 0; p < free.size(); ++p)
        if (!motions[p].empty()) hanging.push_back({free[p].n_elements, free[p].centre, motions[p]});
    return hanging;
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
