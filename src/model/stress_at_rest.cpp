#include "model/stress_at_rest.hpp"

#include <algorithm>

namespace gneiss {

std::vector<std::array<double, 3>> stress_at_rest(const SolidSystem& solid) {
    const auto n_sub = static_cast<std::size_t>(solid.elements().n_sub_triangles());
    State start = solid.initial_state();
    std::ranges::fill(start.v, 0.0);  // no viscous stress
    const std::vector<PointFields> points = solid.point_fields(start);
    std::vector<std::array<double, 3>> stress(points.size() / n_sub, {0, 0, 0});
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) stress[i / n_sub][k] += points[i].cauchy[k] / static_cast<double>(n_sub);
    return stress;
}

}  // namespace gneiss
