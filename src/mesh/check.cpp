#include "mesh/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "mesh/composite.hpp"
#include "mesh/geometry.hpp"

namespace gneiss {
namespace {

/// Area over the square of the longest edge below which a triangle counts as flat. Coordinates of 1e6 m carry round-off
/// of 1e-10 m; on an edge of 0.1 m that alone makes an area ratio of 1e-9.
constexpr double flat_ratio = 1e-9;

/// Nodes closer than this part of the smallest side coincide.
constexpr double coincidence_ratio = 1e-6;

constexpr std::size_t longest_list = 10;

using Labels = std::vector<std::int64_t>;

/// One side of one element, as its neighbours would know it.
struct Side {
    std::int32_t low, high;  // corners, ascending
    std::int32_t mid;
    std::int32_t element;
    bool ascending;  // the element walks from low to high
};

std::vector<Side> sorted_sides(const MeshDraft& draft) {
    std::vector<Side> sides;
    sides.reserve(3 * draft.elements.size());
    for (std::size_t e = 0; e < draft.elements.size(); ++e)
        for (const auto& [from, mid, to] : composite_sides) {
            const std::int32_t a = draft.elements[e][from], b = draft.elements[e][to];
            sides.push_back(
                {std::min(a, b), std::max(a, b), draft.elements[e][mid], static_cast<std::int32_t>(e), a < b});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) {
        return std::tie(s.low, s.high, s.element) < std::tie(t.low, t.high, t.element);
    });
    return sides;
}

/// Union of disjoint sets of elements with path halving.
class Pieces {
public:
    explicit Pieces(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
    std::int32_t root(std::int32_t e) {
        while (parent_[e] != e) e = parent_[e] = parent_[parent_[e]];
        return e;
    }
    /// The lower root stays, so that a piece is known by its first element.
    void join(std::int32_t e, std::int32_t f) {
        const auto [low, high] = std::minmax({root(e), root(f)});
        parent_[high] = low;
    }

private:
    std::vector<std::int32_t> parent_;
};

class Checker {
public:
    Checker(const MeshDraft& draft, std::vector<std::string>& warnings) : draft_(draft), warnings_(warnings) {}

    std::vector<Problem> run() {
        if (draft_.elements.empty()) {
            error("no triangles: the mesh is empty");
            return problems_;
        }
        check_shapes();
        if (has_bad_coordinates_) return problems_;  // the searches below need an order of coordinates
        check_duplicates();
        const std::vector<Side> sides = sorted_sides(draft_);
        check_sides(sides);
        check_pieces(sides);
        check_roles_of_nodes();
        check_names(sides);
        check_coincident_nodes();
        return problems_;
    }

private:
    void error(std::string message) { problems_.push_back({draft_.where, std::move(message)}); }
    void warn(std::string message) { warnings_.push_back(std::move(message)); }
    void error_about_elements(const char* what, const Labels& labels) {
        if (!labels.empty()) error(fmt::format("{}: {}", what, numbered("element", labels)));
    }
    void error_about_nodes(const char* what, const Labels& labels) {
        if (!labels.empty()) error(fmt::format("{}: {}", what, numbered("node", labels)));
    }

    void check_shapes() {
        Labels not_finite, flat, repeated, folded;
        for (std::size_t n = 0; n < draft_.nodes.size(); ++n)
            if (!(std::isfinite(draft_.nodes[n][0]) && std::isfinite(draft_.nodes[n][1])))
                not_finite.push_back(draft_.node_labels[n]);
        for (std::size_t e = 0; e < draft_.elements.size(); ++e) {
            const auto& element = draft_.elements[e];
            const std::int64_t label = draft_.element_labels[e];
            auto sorted = element;
            std::sort(sorted.begin(), sorted.end());
            if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
                repeated.push_back(label);
                continue;
            }
            const double corners = relative_area(element[0], element[2], element[4]);
            double smallest = std::numeric_limits<double>::max(), flattest = smallest;
            for (const SubTriangle& abc : composite_sub_triangles) {
                const auto [i, j, k] = counter_clockwise(abc);
                const double area = relative_area(element[i], element[j], element[k]);
                smallest = std::min(smallest, area);
                flattest = std::min(flattest, std::abs(area));
            }
            if (std::abs(corners) < flat_ratio || flattest < flat_ratio)
                flat.push_back(label);
            else if (smallest < 0)
                folded.push_back(label);
        }
        has_bad_coordinates_ = !not_finite.empty();
        error_about_nodes("coordinates that are not finite numbers", not_finite);
        error_about_elements("a node used twice", repeated);
        error_about_elements("zero area, of the whole or of one of its four sub-triangles", flat);
        error_about_elements("folded, a mid-side node turns a sub-triangle inside out", folded);
    }

    /// Signed area of nodes i, j, k over the square of the longest edge.
    double relative_area(std::int32_t i, std::int32_t j, std::int32_t k) const {
        const Point2 &p = draft_.nodes[i], &q = draft_.nodes[j], &r = draft_.nodes[k];
        const double longest = std::max({distance(p, q), distance(q, r), distance(r, p)});
        return longest > 0 ? triangle_area(p, q, r) / (longest * longest) : 0;
    }

    void check_duplicates() {
        std::vector<std::pair<std::array<std::int32_t, 3>, std::int64_t>> corners;
        corners.reserve(draft_.elements.size());
        for (std::size_t e = 0; e < draft_.elements.size(); ++e) {
            const auto& element = draft_.elements[e];
            std::array<std::int32_t, 3> key{element[0], element[2], element[4]};
            std::sort(key.begin(), key.end());
            corners.emplace_back(key, draft_.element_labels[e]);
        }
        std::sort(corners.begin(), corners.end());
        Labels duplicated;
        for (std::size_t i = 1; i < corners.size(); ++i)
            if (corners[i].first == corners[i - 1].first) {
                duplicated.push_back(corners[i - 1].second);
                duplicated.push_back(corners[i].second);
            }
        error_about_elements("duplicated, on the same three corners", duplicated);
    }

    void check_sides(const std::vector<Side>& sides) {
        Labels crowded, overlapping, torn;
        for_each_group(sides, [&](const Side* begin, const Side* end) {
            const auto n = end - begin;
            if (n < 2) return;
            Labels elements;
            for (const Side* side = begin; side != end; ++side)
                elements.push_back(draft_.element_labels[side->element]);
            const auto into = [&](Labels& list) { list.insert(list.end(), elements.begin(), elements.end()); };
            if (n > 2)
                into(crowded);
            else if (begin[0].ascending == begin[1].ascending)
                into(overlapping);
            else if (begin[0].mid != begin[1].mid)
                into(torn);
        });
        error_about_elements("more than two at one side", crowded);
        error_about_elements("overlapping, two on the same side of their common edge", overlapping);
        error_about_elements("the corners of a side shared with a neighbour, but not the mid-side node between them",
                             torn);
    }

    void check_pieces(const std::vector<Side>& sides) {
        Pieces pieces(draft_.elements.size());
        for_each_group(sides, [&](const Side* begin, const Side* end) {
            for (const Side* side = begin + 1; side < end; ++side) pieces.join(begin->element, side->element);
        });
        Labels first_elements, hinges;
        for (std::size_t e = 0; e < draft_.elements.size(); ++e)
            if (pieces.root(static_cast<std::int32_t>(e)) == static_cast<std::int32_t>(e))
                first_elements.push_back(draft_.element_labels[e]);

        piece_of_node_.assign(draft_.nodes.size(), MeshDraft::no_node);
        for (std::size_t e = 0; e < draft_.elements.size(); ++e)
            for (std::int32_t node : draft_.elements[e]) {
                const std::int32_t piece = pieces.root(static_cast<std::int32_t>(e));
                if (piece_of_node_[node] == MeshDraft::no_node)
                    piece_of_node_[node] = piece;
                else if (piece_of_node_[node] != piece)
                    hinges.push_back(draft_.node_labels[node]);
            }
        error_about_nodes("pieces that hang together in a node alone (separate bodies need nodes of their own)",
                          hinges);
        if (first_elements.size() > 1)
            warn(fmt::format("the mesh is in {} separate pieces, one each with {}", first_elements.size(),
                             numbered("element", first_elements)));

        Labels unused;
        for (std::size_t n = 0; n < draft_.nodes.size(); ++n)
            if (piece_of_node_[n] == MeshDraft::no_node) unused.push_back(draft_.node_labels[n]);
        if (draft_.report_unused_nodes && !unused.empty())
            warn(fmt::format("left out, they belong to no element: {}", numbered("node", unused)));
    }

    void check_roles_of_nodes() {
        std::vector<char> is_corner(draft_.nodes.size(), 0);
        for (const auto& element : draft_.elements)
            for (int corner : {0, 2, 4}) is_corner[element[corner]] = 1;
        Labels both;
        for (const auto& element : draft_.elements)
            for (int mid : {1, 3, 5})
                if (is_corner[element[mid]]) both.push_back(draft_.node_labels[element[mid]]);
        error_about_nodes("a corner of one element and a mid-side node of another", both);
    }

    void check_names(const std::vector<Side>& sides) {
        for (const auto& [name, line] : draft_.lines) {
            Labels dangling;
            for (const auto& [from, mid, to] : line) {
                const auto [low, high] = std::minmax(from, to);
                const auto at =
                    std::lower_bound(sides.begin(), sides.end(), std::pair{low, high},
                                     [](const Side& side, const std::pair<std::int32_t, std::int32_t>& key) {
                                         return std::pair{side.low, side.high} < key;
                                     });
                if (at == sides.end() || at->low != low || at->high != high || at->mid != mid)
                    for (std::int32_t node : {from, to}) dangling.push_back(draft_.node_labels[node]);
            }
            if (!dangling.empty())
                error(fmt::format("curve \"{}\" does not run along sides of elements: {}", name,
                                  numbered("node", dangling)));
        }
        for (const auto& [name, nodes] : draft_.points) {
            Labels lost;
            for (std::int32_t node : nodes)
                if (piece_of_node_[node] == MeshDraft::no_node) lost.push_back(draft_.node_labels[node]);
            if (!lost.empty())
                error(fmt::format("points \"{}\" name what belongs to no element: {}", name, numbered("node", lost)));
        }
    }

    /// Sorted by bands of x and by y within a band, coincident nodes follow each other. A second pass with the bands
    /// moved by half their width finds the pairs that a limit between bands parts.
    void check_coincident_nodes() {
        double shortest = std::numeric_limits<double>::max();
        for (const auto& element : draft_.elements)
            for (const auto& [from, mid, to] : composite_sides) {
                const double d = distance(draft_.nodes[element[from]], draft_.nodes[element[to]]);
                if (d > 0) shortest = std::min(shortest, d);
            }
        const double tolerance = coincidence_ratio * shortest;
        std::vector<std::int32_t> order;
        for (std::size_t n = 0; n < draft_.nodes.size(); ++n)
            if (piece_of_node_[n] != MeshDraft::no_node) order.push_back(static_cast<std::int32_t>(n));
        Labels coincident;
        for (double shift : {0.0, 0.5}) {
            const auto key = [&](std::int32_t n) {
                return std::pair(std::floor(draft_.nodes[n][0] / (2 * tolerance) + shift), draft_.nodes[n][1]);
            };
            std::sort(order.begin(), order.end(), [&](std::int32_t m, std::int32_t n) { return key(m) < key(n); });
            for (std::size_t i = 1; i < order.size(); ++i)
                if (distance(draft_.nodes[order[i - 1]], draft_.nodes[order[i]]) <= tolerance) {
                    coincident.push_back(draft_.node_labels[order[i - 1]]);
                    coincident.push_back(draft_.node_labels[order[i]]);
                }
        }
        if (!coincident.empty())
            warn(fmt::format("in one place but not the same, so that nothing is joined there: {}",
                             numbered("node", coincident)));
    }

    /// Calls visit(begin, end) for every set of sides on the same two corners.
    template <class Visit>
    static void for_each_group(const std::vector<Side>& sides, Visit&& visit) {
        for (const Side* begin = sides.data(); begin != sides.data() + sides.size();) {
            const Side* end = begin;
            while (end != sides.data() + sides.size() && end->low == begin->low && end->high == begin->high) ++end;
            visit(begin, end);
            begin = end;
        }
    }

    const MeshDraft& draft_;
    std::vector<std::string>& warnings_;
    std::vector<Problem> problems_;
    bool has_bad_coordinates_ = false;
    std::vector<std::int32_t> piece_of_node_;  // first element of the piece; no_node: used by no element
};

}  // namespace

std::string numbered(const char* noun, std::vector<std::int64_t> labels) {
    std::sort(labels.begin(), labels.end());
    labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
    if (labels.size() == 1) return fmt::format("{} {}", noun, labels[0]);
    if (labels.size() <= longest_list)
        return fmt::format("{}s {} and {}", noun, fmt::join(labels.begin(), labels.end() - 1, ", "), labels.back());
    return fmt::format("{}s {} and {} more", noun, fmt::join(labels.begin(), labels.begin() + longest_list, ", "),
                       labels.size() - longest_list);
}

std::vector<Problem> check(const MeshDraft& draft, std::vector<std::string>& warnings) {
    return Checker(draft, warnings).run();
}

}  // namespace gneiss
