#include "fracture/side_criterion.hpp"

#include <algorithm>
#include <cmath>

#include "base/index.hpp"
#include "fracture/envelope.hpp"

namespace gneiss {

double SideCriterion::utilisation_of(const State& state, std::int32_t side) {
    const InnerSide& inner = parts_.inner.sides()[index(side)];
    const auto local = side_nodes(parts_.mesh.kind, inner.left.side);
    const std::int32_t* nodes = parts_.mesh.element(index(inner.left.element));
    const std::size_t n_parts = local.size() - 1;
    Vec2<double> line{0, 0};
    std::array<Vec2<double>, 2> force{};  // traction times length, of the left and the right element
    for (std::size_t part = 0; part < n_parts; ++part) {
        const std::size_t a = index(nodes[local[part]]), b = index(nodes[local[part + 1]]);
        const Vec2<double> along{
            parts_.mesh.nodes[b][0] - parts_.mesh.nodes[a][0] + state.u[2 * b] - state.u[2 * a],
            parts_.mesh.nodes[b][1] - parts_.mesh.nodes[a][1] + state.u[2 * b + 1] - state.u[2 * a + 1]};
        const std::array stresses{response_.stress(inner.left, part),
                                  response_.stress(inner.right, n_parts - 1 - part)};
        for (std::size_t k = 0; k < 2; ++k) {
            const auto& [xx, yy, xy] = stresses[k];
            force[k] += {xx * along.y - xy * along.x, xy * along.y - yy * along.x};
        }
        line += along;
    }
    const double length = std::hypot(line.x, line.y);
    const Vec2<double> t{line.x / length, line.y / length}, n{t.y, -t.x};
    const CohesionProperties<double>& p = parts_.properties[n_parts * index(side)];
    const auto of = [&](const Vec2<double>& f) {
        return std::sqrt(envelope_index(p, dot(f, n) / length, dot(f, t) / length));
    };
    if (of_ == Of::mean) return of(0.5 * (force[0] + force[1]));
    return std::max(of(force[0]), of(force[1]));
}

std::vector<std::pair<std::int32_t, double>> SideCriterion::watched_sides(const State& state) {
    ++look_;
    candidates_.clear();
    looked_at_.resize(parts_.inner.sides().size(), -1);
    for_each_element_beyond(state, [&](std::int32_t element) {
        for (int side = 0; side < 3; ++side) {
            const std::int32_t s = parts_.inner.number({element, side});
            if (s < 0 || parts_.inner.is_open(s) || looked_at_[index(s)] == look_) continue;
            looked_at_[index(s)] = look_;
            candidates_.push_back(s);
        }
    });
    std::vector<std::pair<std::int32_t, double>> found;
    for (const std::int32_t side : candidates_) found.emplace_back(side, utilisation_of(state, side));
    return found;
}

CrackOpenings SideCriterion::find(const State& state) {
    std::vector<std::int32_t> beyond;
    for (const auto& [side, utilisation] : watched_sides(state))
        if (utilisation >= 1) beyond.push_back(side);
    std::ranges::sort(beyond);
    return {parts_.inner.nodes_of(beyond), {}};
}

double SideCriterion::find_utilisation(const State& state) {
    double largest = 0;
    for (const auto& [side, utilisation] : watched_sides(state)) largest = std::max(largest, utilisation);
    return largest;
}

}  // namespace gneiss
