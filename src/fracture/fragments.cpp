#include "fracture/fragments.hpp"

#include <numeric>

namespace gneiss {
namespace {

/// The first element of each element's fragment.
std::vector<std::int32_t> first_elements(std::size_t n_elements, const InnerSides& inner,
                                         const std::function<bool(std::int32_t)>& broken) {
    // every element points to one of a lower number, up to the first of its fragment, which points to itself
    std::vector<std::int32_t> first(n_elements);
    std::iota(first.begin(), first.end(), 0);
    const auto find = [&](std::int32_t e) {
        while (first[static_cast<std::size_t>(e)] != e) {
            std::int32_t& up = first[static_cast<std::size_t>(e)];
            e = up = first[static_cast<std::size_t>(up)];
        }
        return e;
    };
    for (std::size_t s = 0; s < inner.sides().size(); ++s) {
        if (broken(static_cast<std::int32_t>(s))) continue;
        const std::int32_t a = find(inner.sides()[s].left.element), b = find(inner.sides()[s].right.element);
        first[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
    for (std::int32_t& element : first) element = find(element);
    return first;
}

}  // namespace

std::size_t count_fragments(std::size_t n_elements, const InnerSides& inner,
                            const std::function<bool(std::int32_t)>& broken) {
    const std::vector<std::int32_t> first = first_elements(n_elements, inner, broken);
    std::size_t n = 0;
    for (std::size_t e = 0; e < n_elements; ++e) n += first[e] == static_cast<std::int32_t>(e) ? 1 : 0;
    return n;
}

Fragments find_fragments(const Mesh& mesh, const InnerSides& inner, const std::function<bool(std::int32_t)>& broken,
                         const ElementForces& elements, const State& state) {
    const std::vector<std::int32_t> first = first_elements(mesh.n_elements(), inner, broken);
    Fragments result;
    result.of_element.resize(mesh.n_elements());
    std::vector<double> mass(2 * mesh.n_nodes(), 0.0);  // of one element at a time
    const auto n = static_cast<std::size_t>(mesh.nodes_per_element());
    for (std::size_t e = 0; e < mesh.n_elements(); ++e) {
        if (first[e] == static_cast<std::int32_t>(e)) {
            result.of_element[e] = static_cast<std::int32_t>(result.all.size());
            result.all.emplace_back();
        } else {
            result.of_element[e] = result.of_element[static_cast<std::size_t>(first[e])];
        }
        Fragment& fragment = result.all[static_cast<std::size_t>(result.of_element[e])];
        ++fragment.n_elements;
        elements.add_mass(static_cast<std::int32_t>(e), mass);
        for (const std::int32_t node : std::span(mesh.element(e), n)) {
            const auto i = static_cast<std::size_t>(node);
            const double m = mass[2 * i];
            mass[2 * i] = mass[2 * i + 1] = 0;
            fragment.mass += m;
            fragment.centre.x += m * (mesh.nodes[i][0] + state.u[2 * i]);
            fragment.centre.y += m * (mesh.nodes[i][1] + state.u[2 * i + 1]);
            fragment.velocity.x += m * state.v[2 * i];
            fragment.velocity.y += m * state.v[2 * i + 1];
        }
    }
    for (Fragment& fragment : result.all) {
        fragment.centre = (1 / fragment.mass) * fragment.centre;
        fragment.velocity = (1 / fragment.mass) * fragment.velocity;
    }
    return result;
}

}  // namespace gneiss
