#include "fracture/element_response.hpp"

namespace gneiss {
namespace {

std::size_t index(std::int32_t number) { return static_cast<std::size_t>(number); }

/// The sub-triangle at a sub-edge of a side, in the order of side_nodes().
std::size_t sub_triangle_at(ElementKind kind, int side, std::size_t part) {
    // a composite's sides run corner, mid-side, corner; its sub-triangles 0 to 2 are those at its corners
    return kind == ElementKind::cst ? 0 : (static_cast<std::size_t>(side) + part) % 3;
}

}  // namespace

void ElementResponse::look_at(const State& state) {
    state_ = &state;
    ++look_;
}

std::size_t ElementResponse::slot_of(std::int32_t element) {
    const std::size_t stresses = static_cast<std::size_t>(elements_.n_sub_triangles()) * 3 * pack_width;
    const std::size_t forces = static_cast<std::size_t>(mesh_.nodes_per_element()) * 2 * pack_width;
    if (first_pack_.empty()) {
        first_pack_.push_back(0);
        for (const auto& block : elements_.blocks()) first_pack_.push_back(first_pack_.back() + block->n_packs());
        seen_.assign(first_pack_.back(), -1);
        stresses_.resize(first_pack_.back() * stresses);
        forces_.resize(first_pack_.back() * forces);
    }
    const ElementForces::Place& place = elements_.place(element);
    const std::size_t pack = index(place.local) / pack_width, slot = first_pack_[index(place.block)] + pack;
    if (seen_[slot] != look_) {
        seen_[slot] = look_;
        elements_.blocks()[index(place.block)]->pack_response(
            pack, elements_.evaluation(index(place.block), *state_, Trial::of(*state_)),
            stresses_.data() + slot * stresses, forces_.data() + slot * forces);
    }
    return slot;
}

std::array<double, 3> ElementResponse::stress(const ElementSide& side, std::size_t part) {
    const std::size_t n_sub = static_cast<std::size_t>(elements_.n_sub_triangles());
    const std::size_t sub = slot_of(side.element) * n_sub + sub_triangle_at(mesh_.kind, side.side, part);
    const double* xx =
        stresses_.data() + 3 * sub * pack_width + index(elements_.place(side.element).local) % pack_width;
    return {xx[0], xx[pack_width], xx[2 * pack_width]};
}

std::array<double, 3> ElementResponse::mean_stress(std::int32_t side, std::size_t part) {
    const InnerSide& inner = inner_.sides()[index(side)];
    const std::size_t n_parts = side_nodes(mesh_.kind, 0).size() - 1;
    const std::array<double, 3> left = stress(inner.left, part), right = stress(inner.right, n_parts - 1 - part);
    return {0.5 * (left[0] + right[0]), 0.5 * (left[1] + right[1]), 0.5 * (left[2] + right[2])};
}

Vec2<double> ElementResponse::force(std::int32_t element, int node) {
    const std::size_t at = slot_of(element) * static_cast<std::size_t>(mesh_.nodes_per_element()) + index(node);
    const double* x = forces_.data() + 2 * at * pack_width + index(elements_.place(element).local) % pack_width;
    return {x[0], x[pack_width]};
}

double ElementResponse::mass(std::int32_t element, int node) {
    const auto n = static_cast<std::size_t>(mesh_.nodes_per_element());
    if (masses_.empty()) {
        masses_.resize(mesh_.n_elements() * n);
        std::vector<double> of_nodes(2 * mesh_.n_nodes(), 0.0);
        for (std::size_t e = 0; e < mesh_.n_elements(); ++e) {
            elements_.add_mass(static_cast<std::int32_t>(e), of_nodes);
            for (std::size_t k = 0; k < n; ++k) {
                const std::size_t x = 2 * index(mesh_.element(e)[k]);
                masses_[n * e + k] = of_nodes[x];
                of_nodes[x] = of_nodes[x + 1] = 0;
            }
        }
    }
    return masses_[n * index(element) + index(node)];
}

}  // namespace gneiss
