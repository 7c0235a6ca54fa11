#include "fracture/node_rupture.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "fracture/envelope.hpp"

namespace gneiss {
namespace {

using Vector = Vec2<double>;

double length(const Vector& v) { return std::hypot(v.x, v.y); }

/// Of the node, m/s2.
Vector acceleration(std::span<const FanCorner> corners) {
    Vector force{0, 0};
    double mass = 0;
    for (const FanCorner& corner : corners) {
        force += corner.force;
        mass += corner.mass;
    }
    return (1 / mass) * force;
}

/// g squared of an interface, -. @param traction  on the left element, Pa
double squared_utilisation(const FanInterface& at, const Vector& traction) {
    return envelope_index(*at.properties, dot(traction, at.normal), dot(traction, at.along));
}

/// Gradient of g by the traction, 1/Pa; 0 where g = 0.
Vector gradient(const FanInterface& at, const Vector& traction) {
    const double value = std::sqrt(squared_utilisation(at, traction));
    if (!(value > 0)) return {0, 0};
    const CohesionProperties<double>& p = *at.properties;
    const double normal = dot(traction, at.normal), shear = dot(traction, at.along);
    const double tension = std::max(normal, 0.0) / p.tensile_strength;
    const double cohesive = std::max(std::abs(shear) - p.tan_phi_initial * std::max(-normal, 0.0), 0.0) / p.cohesion;
    const double by_normal = normal > 0 ? tension / p.tensile_strength : cohesive * p.tan_phi_initial / p.cohesion;
    const double by_shear = std::copysign(cohesive / p.cohesion, shear);
    return (1 / value) * (by_normal * at.normal + by_shear * at.along);
}

/// A closed fan as a function of c.
class ClosedFan {
public:
    /// @param base  P_j of every interface, N
    ClosedFan(std::span<const FanInterface> interfaces, std::span<const Vector> base)
        : interfaces_(interfaces), base_(base) {}

    Vector traction(std::size_t j, const Vector& c) const { return interfaces_[j].per_area * (c + base_[j]); }
    double utilisation(std::size_t j, const Vector& c) const {
        return std::sqrt(squared_utilisation(interfaces_[j], traction(j, c)));
    }
    /// Of g_j by c, 1/N.
    Vector gradient(std::size_t j, const Vector& c) const {
        return interfaces_[j].per_area * gneiss::gradient(interfaces_[j], traction(j, c));
    }
    struct Largest {
        double value;
        std::size_t interface;
    };
    Largest largest(const Vector& c) const {
        Largest worst{0, 0};
        for (std::size_t j = 0; j < interfaces_.size(); ++j)
            if (const double square = squared_utilisation(interfaces_[j], traction(j, c)); square > worst.value)
                worst = {square, j};
        worst.value = std::sqrt(worst.value);
        return worst;
    }

private:
    std::span<const FanInterface> interfaces_;
    std::span<const Vector> base_;
};

/// A convex polygon that is cut until little is left of it.
class Polygon {
public:
    Polygon(const Vector& centre, double half) {
        for (const auto& [x, y] : {std::pair(-1., -1.), {1., -1.}, {1., 1.}, {-1., 1.}})
            corners_.push_back({centre.x + half * x, centre.y + half * y});
    }
    bool empty() const { return corners_.size() < 3; }
    Vector centroid() const {
        double area = 0;
        Vector sum{0, 0};
        const Vector& o = corners_.front();
        for (std::size_t i = 1; i + 1 < corners_.size(); ++i) {
            const Vector a = corners_[i] - o, b = corners_[i + 1] - o;
            const double part = cross(a, b);
            area += part;
            sum += (part / 3) * (a + b);
        }
        return area > 0 ? o + (1 / area) * sum : o;
    }
    double diameter() const {
        double largest = 0;
        for (const Vector& corner : corners_) largest = std::max(largest, length(corner - corners_.front()));
        return 2 * largest;
    }
    /// Leaves what lies at or before `through` along the direction.
    void cut(const Vector& through, const Vector& direction) {
        cut_.clear();
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            const Vector& a = corners_[i];
            const Vector& b = corners_[(i + 1) % corners_.size()];
            const double at_a = dot(a - through, direction), at_b = dot(b - through, direction);
            if (at_a <= 0) cut_.push_back(a);
            if ((at_a < 0 && at_b > 0) || (at_a > 0 && at_b < 0)) cut_.push_back(a + (at_a / (at_a - at_b)) * (b - a));
        }
        std::swap(corners_, cut_);
    }

private:
    std::vector<Vector> corners_, cut_;
};

/// Relative accuracy of the utilisation at rupture: a tenth of what an explicit step of usual length overshoots.
constexpr double accuracy = 1e-4;
/// Interfaces within this of the largest utilisation count as active: some times the accuracy.
constexpr double active_within = 5e-3;

/// Cutting planes through centres of gravity: each leaves at most 1 - 1/e of the area, whatever the function, as long
/// as it is convex. The envelope is, but for a faint reentrant corner at zero normal traction, where friction begins.
/// @return the minimiser, or the first c at which the fan holds
Vector minimise(const ClosedFan& fan, const Vector& start, double half) {
    constexpr int most_cuts = 80;
    Vector best = start;
    double smallest = fan.largest(start).value;
    Polygon polygon(start, half);
    Vector at = start;
    for (int k = 0; k < most_cuts && !polygon.empty() && !(smallest < 1); ++k) {
        const ClosedFan::Largest worst = fan.largest(at);
        if (worst.value < smallest) {
            smallest = worst.value;
            best = at;
        }
        const Vector gradient = fan.gradient(worst.interface, at);
        const double slope = length(gradient);
        if (!(slope > 0) || slope * polygon.diameter() < accuracy * smallest) break;
        polygon.cut(at, gradient);
        if (!polygon.empty()) at = polygon.centroid();
    }
    return best;
}

/// The interfaces whose openings are compatible with each other: gradients that combine to zero, two of them or three.
std::vector<std::size_t> mechanism(const ClosedFan& fan, const Vector& c, std::size_t n) {
    std::vector<double> values;
    for (std::size_t j = 0; j < n; ++j) values.push_back(fan.utilisation(j, c));
    std::vector<double> sorted = values;
    std::ranges::sort(sorted, std::greater());
    // two at least, should the search have ended before the second one was active
    const double least = std::min(sorted[0] * (1 - active_within), sorted[1]);
    std::vector<std::size_t> active;
    std::vector<Vector> gradients;
    for (std::size_t j = 0; j < n; ++j)
        if (values[j] >= least) {
            active.push_back(j);
            gradients.push_back(fan.gradient(j, c));
        }
    std::vector<std::size_t> pair;
    double closest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < active.size(); ++i)
        for (std::size_t j = i + 1; j < active.size(); ++j) {
            // distance of the line between both gradients from zero
            const Vector a = gradients[i], d = gradients[j] - a;
            const double square = dot(d, d);
            const double s = square > 0 ? std::clamp(-dot(a, d) / square, 0.0, 1.0) : 0.0;
            const double distance = length(a + s * d) / std::max(length(gradients[i]), length(gradients[j]));
            if (distance < closest * (1 - active_within)) {
                closest = distance;
                pair = {active[i], active[j]};
            }
        }
    constexpr double opposite = 0.1;
    if (closest < opposite) return pair;
    for (std::size_t i = 0; i < active.size(); ++i)
        for (std::size_t j = i + 1; j < active.size(); ++j)
            for (std::size_t k = j + 1; k < active.size(); ++k) {
                const double a = cross(gradients[i], gradients[j]), b = cross(gradients[j], gradients[k]),
                             e = cross(gradients[k], gradients[i]);
                if ((a >= 0 && b >= 0 && e >= 0) || (a <= 0 && b <= 0 && e <= 0))
                    return {active[i], active[j], active[k]};
            }
    return pair;
}

}  // namespace

double bound_of_closed_fan(std::span<const FanCorner> corners, std::span<const double> per_force_squared) {
    const Vector a = acceleration(corners);
    const auto for_each_base = [&](auto visit) {
        Vector base{0, 0};  // P_j
        for (std::size_t j = 0; j < corners.size(); ++j) visit(j, base += corners[j].mass * a - corners[j].force);
    };
    Vector sum{0, 0};
    for_each_base([&](std::size_t, const Vector& base) { sum += base; });
    const Vector c = (-1 / static_cast<double>(corners.size())) * sum;
    double largest = 0;
    for_each_base([&](std::size_t j, const Vector& base) {
        largest = std::max(largest, dot(c + base, c + base) * per_force_squared[j]);
    });
    return std::sqrt(largest);
}

void find_rupture(std::span<const FanCorner> corners, std::span<const FanInterface> interfaces,
                  std::array<bool, 2> held, NodeRupture& found) {
    const std::size_t n = interfaces.size();
    const bool closed = n == corners.size();
    found.utilisation = 0;
    found.opening.clear();
    found.traction.resize(n);
    if (n == 0) return;

    const Vector a = acceleration(corners);
    std::vector<Vector>& base = found.traction;  // until they are known
    Vector sum{0, 0};
    for (std::size_t j = 0; j < n; ++j) {
        sum += corners[j].mass * a - corners[j].force;
        base[j] = sum;
    }
    // closed: nearest to the stresses in the sense of least squares of the tractions, weighted by area
    Vector c{0, 0};
    if (closed) {
        double weights = 0;
        for (std::size_t j = 0; j < n; ++j) {
            const FanInterface& at = interfaces[j];
            const double inverse = at.sense * at.per_area;  // 1/w
            c += at.sense * at.stress_traction - inverse * base[j];
            weights += inverse;
        }
        c = (1 / weights) * c;
    }
    const bool supported = held[0] || held[1];
    if (supported)
        for (std::size_t j = 0; j < n; ++j) {
            const Vector of_stresses = (interfaces[j].sense * interfaces[j].weight) * interfaces[j].stress_traction;
            if (held[0]) base[j].x = of_stresses.x - c.x;
            if (held[1]) base[j].y = of_stresses.y - c.y;
        }
    const ClosedFan fan(interfaces, base);
    double largest = fan.largest(c).value;
    if (closed && !supported && largest >= 1) {
        double half = 0;
        for (std::size_t j = 0; j < n; ++j) {
            const auto& p = *interfaces[j].properties;
            half = std::max(half, length(c + base[j]));
            if (std::isfinite(p.tensile_strength))  // else it may not open, and bounds nothing
                half = std::max(half, interfaces[j].weight * std::max(p.tensile_strength, p.cohesion));
        }
        c = minimise(fan, c, 2 * half);
        largest = fan.largest(c).value;
        if (largest >= 1) found.opening = mechanism(fan, c, n);
    } else if (largest >= 1) {
        for (std::size_t j = 0; j < n; ++j)
            if (fan.utilisation(j, c) >= 1) found.opening.push_back(j);
    }
    found.utilisation = largest;
    for (std::size_t j = 0; j < n; ++j) found.traction[j] = fan.traction(j, c);
    // one interface alone does not part a closed fan: the others hold it, whatever the support gives
    if (closed && found.opening.size() < 2) {
        found.opening.clear();
        found.utilisation = std::min(found.utilisation, std::nextafter(1.0, 0.0));
    }
}

}  // namespace gneiss
