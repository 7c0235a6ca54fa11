#include "fracture/element_response.hpp"

#include <algorithm>

#include "base/index.hpp"
#include "base/parallel.hpp"

namespace gneiss {
namespace {

/// The sub-triangle at a sub-edge of a side, in the order of side_nodes().
std::size_t sub_triangle_at(ElementKind kind, int side, std::size_t part) {
    // a composite's sides run corner, mid-side, corner; its sub-triangles 0 to 2 are those at its corners
    return kind == ElementKind::cst ? 0 : (static_cast<std::size_t>(side) + part) % 3;
}

}  // namespace

void ElementResponse::look_at(const State& state) {
    if (first_pack_.empty()) lay_out();
    state_ = &state;
    ++look_;
}

void ElementResponse::lay_out() {
    n_sub_ = static_cast<std::size_t>(elements_.n_sub_triangles());
    n_nodes_ = static_cast<std::size_t>(mesh_.nodes_per_element());
    first_pack_.push_back(0);
    for (const auto& block : elements_.blocks()) first_pack_.push_back(first_pack_.back() + block->n_packs());
    const std::size_t n_packs = first_pack_.back();
    seen_.assign(n_packs, -1);
    stresses_.resize(n_packs * n_sub_ * 3 * pack_width);
    forces_.resize(n_packs * n_nodes_ * 2 * pack_width);
}

void ElementResponse::find(std::size_t pack) {
    const std::size_t block =
        static_cast<std::size_t>(std::ranges::upper_bound(first_pack_, pack) - first_pack_.begin()) - 1;
    elements_.blocks()[block]->pack_response(
        pack - first_pack_[block], elements_.evaluation(block, *state_, Trial::of(*state_)),
        stresses_.data() + pack * n_sub_ * 3 * pack_width, forces_.data() + pack * n_nodes_ * 2 * pack_width);
    seen_[pack] = look_;
}

void ElementResponse::find_wanted() {
    constexpr std::ptrdiff_t range = 64;  // some microseconds
    parallel_ranges(
        wanted_.size(),
        [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) find(wanted_[i]);
        },
        range);
    wanted_.clear();
}

std::size_t ElementResponse::stress_place(const ElementSide& side, std::size_t part) const {
    const std::size_t sub = pack_of(side.element) * n_sub_ + sub_triangle_at(mesh_.kind, side.side, part);
    return 3 * sub * pack_width + lane_of(side.element);
}

std::size_t ElementResponse::force_place(std::int32_t element, int node) const {
    return 2 * (pack_of(element) * n_nodes_ + index(node)) * pack_width + lane_of(element);
}

std::array<double, 3> ElementResponse::stress(const ElementSide& side, std::size_t part) {
    require(side.element);
    return stress_at(stress_place(side, part));
}

std::array<double, 3> ElementResponse::mean_stress(std::int32_t side, std::size_t part) {
    const InnerSide& inner = inner_.sides()[index(side)];
    const std::size_t n_parts = side_nodes(mesh_.kind, 0).size() - 1;
    require(inner.left.element);
    require(inner.right.element);
    return mean_stress_at(stress_place(inner.left, part), stress_place(inner.right, n_parts - 1 - part));
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
