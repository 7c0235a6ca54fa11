#include "fracture/fan.hpp"

#include <algorithm>

#include "base/index.hpp"

namespace gneiss {
namespace {

int number_in(const Mesh& mesh, std::int32_t element, std::int32_t node) {
    const std::int32_t* nodes = mesh.element(index(element));
    return static_cast<int>(std::find(nodes, nodes + mesh.nodes_per_element(), node) - nodes);
}

/// Walks around a corner of elements.
class Walk {
public:
    Walk(const Mesh& mesh, const InnerSides& inner, std::int32_t node) : mesh_(mesh), inner_(inner), node_(node) {}

    /// The side of an element that ends at the node (behind it counter-clockwise), or begins there (before it).
    ElementSide behind(std::int32_t element) const { return {element, (corner(element) + 2) % 3}; }
    ElementSide before(std::int32_t element) const { return {element, corner(element)}; }
    /// The element across, bonded to it at the node; -1: none.
    std::int32_t across(const ElementSide& side) const { return inner_.bonded(side, node_); }

private:
    int corner(std::int32_t element) const {
        const int number = number_in(mesh_, element, node_);
        return mesh_.kind == ElementKind::cst ? number : number / 2;
    }

    const Mesh& mesh_;
    const InnerSides& inner_;
    std::int32_t node_;
};

}  // namespace

void find_fan(const Mesh& mesh, const InnerSides& inner, std::int32_t node, Fan& fan) {
    fan.corners.clear();
    fan.interfaces.clear();
    const std::int32_t lowest = inner.elements_at(node).front();
    const auto add = [&](std::int32_t element) { fan.corners.push_back({element, number_in(mesh, element, node)}); };
    if (const int number = number_in(mesh, lowest, node); mesh.kind == ElementKind::compt && number % 2 == 1) {
        add(lowest);
        const ElementSide side{lowest, number / 2};
        const std::int32_t other = inner.bonded(side, node);
        if (other < 0) return;
        add(other);
        const std::int32_t s = inner.number(side);
        const bool left = inner.sides()[index(s)].left.element == lowest;
        fan.interfaces.push_back({{s, 1}, 0, 1, left});
        fan.interfaces.push_back({{s, 1}, 1, 0, !left});
        return;
    }
    const Walk walk(mesh, inner, node);
    std::int32_t first = lowest;
    for (std::int32_t e = walk.across(walk.before(first)); e >= 0 && e != lowest; e = walk.across(walk.before(e)))
        first = e;
    // closed where the walk back has led around: then it may begin anywhere
    const auto last_place = static_cast<std::int32_t>(side_nodes(mesh.kind, 0).size()) - 1;
    std::int32_t e = first;
    do {
        add(e);
        const ElementSide side = walk.behind(e);
        const std::int32_t next = walk.across(side);
        if (next < 0) break;
        const std::int32_t s = inner.number(side);
        if (inner.sides()[index(s)].left.element == e)
            fan.interfaces.push_back({{s, last_place}, static_cast<std::size_t>(last_place) - 1, 1, true});
        else
            fan.interfaces.push_back({{s, 0}, 0, 0, false});
        e = next;
    } while (e != first);
}

}  // namespace gneiss
