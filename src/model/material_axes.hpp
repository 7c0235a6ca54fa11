#pragma once
// Direction of the material axis alpha in every element.

#include <array>
#include <span>
#include <vector>

#include "base/errors.hpp"
#include "mesh/mesh.hpp"
#include "model/options.hpp"

namespace gneiss {

/// Bedding planes as polylines; between two of them the direction is interpolated.
class Bedding {
public:
    /// @param lines  m, at least one, at least 2 different points each
    explicit Bedding(std::vector<std::vector<std::array<double, 2>>> lines) : lines_(std::move(lines)) {}

    /// Direction of alpha at a point, rad. Along a line the direction turns linearly from the middle of one segment to
    /// the middle of the next. Between the nearest line (distance d1) and the nearest one on the other side of the
    /// point (d2), the weights are d2/(d1 + d2) and d1/(d1 + d2); beyond the outermost line its own direction holds. An
    /// axis has no sense: directions are averaged with doubled angles, so that a line may be drawn from either end.
    double angle(const std::array<double, 2>& point) const;

private:
    std::vector<std::vector<std::array<double, 2>>> lines_;
};

/// Angle of alpha from x in each of the given elements, rad.
/// @param problems  faulty formulas and missing data are appended
std::vector<double> axis_angles(const Mesh& mesh, std::span<const std::int32_t> elements, const AxesOptions& options,
                                std::vector<Problem>& problems);

}  // namespace gneiss
