#include "mesh/inner_sides.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "mesh/composite.hpp"

namespace gneiss {

std::span<const int> side_nodes(ElementKind kind, int side) {
    static constexpr std::array<std::array<int, 2>, 3> cst{{{0, 1}, {1, 2}, {2, 0}}};
    const auto k = static_cast<std::size_t>(side);
    if (kind == ElementKind::cst) return cst[k];
    return composite_sides[k];
}

InnerSides::InnerSides(Mesh& mesh) : mesh_(mesh), number_(3 * mesh.n_elements(), -1) {
    // sides by their lower and higher corner; an inner one comes twice
    std::map<std::pair<std::int32_t, std::int32_t>, ElementSide> waiting;
    std::vector<InnerSide> found;
    for (std::int32_t e = 0; e < static_cast<std::int32_t>(mesh.n_elements()); ++e) {
        const std::int32_t* nodes = mesh.element(static_cast<std::size_t>(e));
        for (int side = 0; side < 3; ++side) {
            const auto local = side_nodes(mesh.kind, side);
            const auto key = std::minmax(nodes[local.front()], nodes[local.back()]);
            const auto other = waiting.find(key);
            if (other == waiting.end()) {
                waiting.emplace(key, ElementSide{e, side});
            } else {
                found.push_back({other->second, {e, side}});
                waiting.erase(other);
            }
        }
    }
    std::ranges::sort(found, {}, [](const InnerSide& s) { return std::pair(s.left.element, s.left.side); });
    sides_ = std::move(found);
    open_.assign(sides_.size(), 0);
    for (std::size_t s = 0; s < sides_.size(); ++s)
        for (const ElementSide& side : {sides_[s].left, sides_[s].right})
            number_[index(side)] = static_cast<std::int32_t>(s);

    original_.resize(mesh.n_nodes());
    std::iota(original_.begin(), original_.end(), 0);
    at_node_.assign(mesh.n_nodes(), {0, 0});
    for (const std::int32_t node : mesh.connectivity) ++at_node_[static_cast<std::size_t>(node)].n;
    std::int32_t first = 0;
    for (Range& range : at_node_) {
        range.first = first;
        first += std::exchange(range.n, 0);
    }
    elements_.resize(mesh.connectivity.size());
    const auto n = static_cast<std::size_t>(mesh.nodes_per_element());
    for (std::size_t k = 0; k < mesh.connectivity.size(); ++k) {
        Range& range = at_node_[static_cast<std::size_t>(mesh.connectivity[k])];
        elements_[static_cast<std::size_t>(range.first + range.n++)] = static_cast<std::int32_t>(k / n);
    }
}

std::int32_t InnerSides::bonded(const ElementSide& side, std::int32_t node) const {
    const std::int32_t s = number(side);
    if (s < 0) return -1;
    const InnerSide& inner = sides_[static_cast<std::size_t>(s)];
    const bool is_left = inner.left.element == side.element;
    const auto local = side_nodes(mesh_.kind, side.side);
    const std::int32_t* nodes = mesh_.element(static_cast<std::size_t>(side.element));
    const auto found = std::ranges::find_if(local, [&](int k) { return nodes[k] == node; });
    const auto from_start = static_cast<std::int32_t>(found - local.begin());
    // the right element walks the other way
    const std::int32_t place = is_left ? from_start : static_cast<std::int32_t>(local.size()) - 1 - from_start;
    if (is_open(SideNode{s, place})) return -1;
    return is_left ? inner.right.element : inner.left.element;
}

void InnerSides::rename(std::int32_t element, std::int32_t from, std::int32_t to) {
    const auto n = static_cast<std::size_t>(mesh_.nodes_per_element());
    const std::span nodes(mesh_.connectivity.data() + n * static_cast<std::size_t>(element), n);
    std::ranges::replace(nodes, from, to);
}

std::vector<std::int32_t> InnerSides::take_group(std::int32_t node, std::vector<std::int32_t>& left,
                                                 std::span<const std::int32_t> more) const {
    std::vector<std::int32_t> group(1, left.front());
    left.erase(left.begin());
    for (std::size_t i = 0; i < group.size(); ++i) {
        const std::int32_t e = group[i];
        const std::int32_t* nodes = mesh_.element(static_cast<std::size_t>(e));
        for (int side = 0; side < 3; ++side) {
            const auto local = side_nodes(mesh_.kind, side);
            if (std::ranges::none_of(local, [&](int k) { return nodes[k] == node; })) continue;
            if (std::ranges::binary_search(more, number({e, side}))) continue;
            const auto other = std::ranges::find(left, bonded({e, side}, node));
            if (other == left.end()) continue;
            group.push_back(*other);
            left.erase(other);
        }
    }
    std::ranges::sort(group);
    return group;
}

std::vector<std::int32_t> InnerSides::parted_by(std::span<const std::int32_t> sides) const {
    std::vector<std::int32_t> more(sides.begin(), sides.end());
    std::ranges::sort(more);
    const auto parts_at = [&](const InnerSide& side, std::int32_t node) {
        std::vector<std::int32_t> left(elements_at(node).begin(), elements_at(node).end());
        if (!std::ranges::binary_search(left, side.right.element)) return true;  // it has parted already
        while (true) {
            const std::vector<std::int32_t> group = take_group(node, left, more);
            const bool has_left = std::ranges::binary_search(group, side.left.element);
            const bool has_right = std::ranges::binary_search(group, side.right.element);
            if (has_left || has_right) return has_left != has_right;
        }
    };
    std::vector<std::int32_t> parted;
    for (const std::int32_t s : sides) {
        const InnerSide& side = sides_[static_cast<std::size_t>(s)];
        const std::int32_t* nodes = mesh_.element(static_cast<std::size_t>(side.left.element));
        if (std::ranges::any_of(side_nodes(mesh_.kind, side.left.side),
                                [&](int k) { return parts_at(side, nodes[k]); }))
            parted.push_back(s);
    }
    return parted;
}

void InnerSides::split(std::int32_t node, std::vector<NodeCopy>& copies) {
    std::vector<std::int32_t> left(elements_at(node).begin(), elements_at(node).end());
    std::vector<std::vector<std::int32_t>> groups;
    while (!left.empty()) groups.push_back(take_group(node, left, {}));
    std::int32_t first = at_node_[static_cast<std::size_t>(node)].first;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const Range range{first, static_cast<std::int32_t>(groups[g].size())};
        std::ranges::copy(groups[g], elements_.begin() + first);
        first += range.n;
        if (g == 0) {
            at_node_[static_cast<std::size_t>(node)] = range;
            continue;
        }
        const auto copy = static_cast<std::int32_t>(mesh_.n_nodes());
        const auto original = static_cast<std::size_t>(node);
        mesh_.nodes.push_back(std::array(mesh_.nodes[original]));
        mesh_.node_labels.push_back(std::int64_t{mesh_.node_labels[original]});
        at_node_.push_back(range);
        original_.push_back(std::int32_t{original_[original]});
        for (const std::int32_t e : groups[g]) rename(e, node, copy);
        copies.push_back({node, copy});
    }
}

std::vector<SideNode> InnerSides::nodes_of(std::span<const std::int32_t> sides) const {
    const auto n = static_cast<std::int32_t>(side_nodes(mesh_.kind, 0).size());
    std::vector<SideNode> ends;
    for (const std::int32_t side : sides)
        for (std::int32_t place = 0; place < n; ++place) ends.push_back({side, place});
    return ends;
}

std::vector<NodeCopy> InnerSides::open(std::span<const std::int32_t> sides) { return open(nodes_of(sides)); }

std::vector<NodeCopy> InnerSides::open(std::span<const SideNode> ends) {
    std::set<std::int32_t> nodes;
    for (const SideNode& end : ends) {
        if (is_open(end)) continue;
        const auto s = static_cast<std::size_t>(end.side);
        open_[s] = static_cast<std::uint8_t>(open_[s] | 1U << end.place);
        const ElementSide& side = sides_[s].left;
        const auto local = side_nodes(mesh_.kind, side.side);
        nodes.insert(mesh_.element(static_cast<std::size_t>(side.element))[local[static_cast<std::size_t>(end.place)]]);
    }
    std::vector<NodeCopy> copies;
    for (const std::int32_t node : nodes) split(node, copies);
    if (copies.empty()) return copies;

    for (auto& [name, set] : mesh_.node_sets) {
        const std::size_t n = set.size();
        for (const NodeCopy& copy : copies)
            if (std::binary_search(set.begin(), set.begin() + static_cast<std::ptrdiff_t>(n), copy.original))
                set.push_back(copy.copy);  // numbers grow: the set stays ascending
    }
    std::map<std::int32_t, std::vector<std::int32_t>> copies_of;
    for (const NodeCopy& copy : copies) copies_of[copy.original].push_back(copy.copy);
    for (auto& [name, edges] : mesh_.boundaries)
        for (BoundaryEdge& edge : edges)
            for (std::int32_t* end : {&edge.a, &edge.b})
                if (const auto found = copies_of.find(*end); found != copies_of.end()) {
                    const std::span nodes_of_element(mesh_.element(static_cast<std::size_t>(edge.element)),
                                                     static_cast<std::size_t>(mesh_.nodes_per_element()));
                    for (const std::int32_t copy : found->second)
                        if (std::ranges::find(nodes_of_element, copy) != nodes_of_element.end()) *end = copy;
                }
    return copies;
}

void InnerSides::renumber() {
    constexpr std::int32_t none = -1;
    std::vector<std::int32_t> now(mesh_.n_nodes(), none), before;
    for (std::int32_t& node : mesh_.connectivity) {
        std::int32_t& number = now[static_cast<std::size_t>(node)];
        if (number == none) {
            number = static_cast<std::int32_t>(before.size());
            before.push_back(node);
        }
        node = number;
    }
    const auto reorder = [&](auto& values) {
        auto old = values;
        for (std::size_t i = 0; i < before.size(); ++i) values[i] = old[static_cast<std::size_t>(before[i])];
    };
    reorder(mesh_.nodes);
    reorder(mesh_.node_labels);
    reorder(at_node_);
    reorder(original_);
    for (auto& [name, set] : mesh_.node_sets) {
        for (std::int32_t& node : set) node = now[static_cast<std::size_t>(node)];
        std::ranges::sort(set);
    }
    for (auto& [name, edges] : mesh_.boundaries)
        for (BoundaryEdge& edge : edges)
            for (std::int32_t* end : {&edge.a, &edge.b}) *end = now[static_cast<std::size_t>(*end)];
}

}  // namespace gneiss
