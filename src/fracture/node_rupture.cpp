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

/// g of an interface and its gradient by the traction on the left element.
struct Utilisation {
    double value;
    Vector gradient;
};

Utilisation utilisation(const FanInterface& at, const Vector& traction) {
    const CohesionProperties<double>& p = *at.properties;
    const double normal = dot(traction, at.normal), shear = dot(traction, at.along);
    const double tension = std::max(normal, 0.0) / p.tensile_strength;
    const double cohesive = std::max(std::abs(shear) - p.tan_phi_initial * std::max(-normal, 0.0), 0.0) / p.cohesion;
    const double value = std::hypot(tension, cohesive);
    if (!(value > 0)) return {0, {0, 0}};
    const double by_normal = normal > 0 ? tension / p.tensile_strength : cohesive * p.tan_phi_initial / p.cohesion;
    const double by_shear = std::copysign(cohesive / p.cohesion, shear);
    return {value, (1 / value) * (by_normal * at.normal + by_shear * at.along)};
}

/// A closed fan as a function of c.
class ClosedFan {
public:
    /// @param base  P_j of every interface, N
    ClosedFan(std::span<const FanInterface> interfaces, std::span<const Vector> base)
        : interfaces_(interfaces), base_(base) {}

    Vector traction(std::size_t j, const Vector& c) const {
        return (interfaces_[j].sense / interfaces_[j].weight) * (c + base_[j]);
    }
    /// g_j and its gradient by c.
    Utilisation of(std::size_t j, const Vector& c) const {
        const Utilisation u = utilisation(interfaces_[j], traction(j, c));
        return {u.value, (interfaces_[j].sense / interfaces_[j].weight) * u.gradient};
    }
    Utilisation largest(const Vector& c) const {
        Utilisation worst{-1, {0, 0}};
        for (std::size_t j = 0; j < interfaces_.size(); ++j)
            if (const Utilisation u = of(j, c); u.value > worst.value) worst = u;
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
        const Utilisation u = fan.largest(at);
        if (u.value < smallest) {
            smallest = u.value;
            best = at;
        }
        const double slope = length(u.gradient);
        if (!(slope > 0) || slope * polygon.diameter() < accuracy * smallest) break;
        polygon.cut(at, u.gradient);
        if (!polygon.empty()) at = polygon.centroid();
    }
    return best;
}

/// The interfaces whose openings are compatible with each other: gradients that combine to zero, two of them or three.
std::vector<std::size_t> mechanism(const ClosedFan& fan, const Vector& c, std::size_t n) {
    std::vector<double> values;
    for (std::size_t j = 0; j < n; ++j) values.push_back(fan.of(j, c).value);
    std::vector<double> sorted = values;
    std::ranges::sort(sorted, std::greater());
    // two at least, should the search have ended before the second one was active
    const double least = std::min(sorted[0] * (1 - active_within), sorted[1]);
    std::vector<std::size_t> active;
    std::vector<Vector> gradients;
    for (std::size_t j = 0; j < n; ++j)
        if (values[j] >= least) {
            active.push_back(j);
            gradients.push_back(fan.of(j, c).gradient);
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

void find_rupture(std::span<const FanCorner> corners, std::span<const FanInterface> interfaces,
                  std::array<bool, 2> held, NodeRupture& found) {
    const std::size_t n = interfaces.size();
    const bool closed = n == corners.size();
    found.utilisation = 0;
    found.opening.clear();
    found.traction.resize(n);
    if (n == 0) return;

    Vector force{0, 0};
    double mass = 0;
    for (const FanCorner& corner : corners) {
        force += corner.force;
        mass += corner.mass;
    }
    const Vector a = (1 / mass) * force;
    thread_local std::vector<Vector> base;
    base.resize(n);
    Vector sum{0, 0};
    for (std::size_t j = 0; j < n; ++j) {
        sum += corners[j].mass * a - corners[j].force;
        base[j] = sum;
    }
    const auto of_stresses = [&](std::size_t j) {
        return (interfaces[j].sense * interfaces[j].weight) * interfaces[j].stress_traction;
    };
    // closed: nearest to the stresses in the sense of least squares of the tractions, weighted by area
    Vector c{0, 0};
    if (closed) {
        double weights = 0;
        for (std::size_t j = 0; j < n; ++j) {
            c += (1 / interfaces[j].weight) * (of_stresses(j) - base[j]);
            weights += 1 / interfaces[j].weight;
        }
        c = (1 / weights) * c;
    }
    const bool supported = held[0] || held[1];
    if (supported)
        for (std::size_t j = 0; j < n; ++j) {
            if (held[0]) base[j].x = of_stresses(j).x - c.x;
            if (held[1]) base[j].y = of_stresses(j).y - c.y;
        }
    const ClosedFan fan(interfaces, base);
    if (closed && !supported && fan.largest(c).value >= 1) {
        double half = 0;
        for (std::size_t j = 0; j < n; ++j) {
            const auto& p = *interfaces[j].properties;
            half = std::max(half, length(c + base[j]));
            if (std::isfinite(p.tensile_strength))  // else it may not open, and bounds nothing
                half = std::max(half, interfaces[j].weight * std::max(p.tensile_strength, p.cohesion));
        }
        c = minimise(fan, c, 2 * half);
        if (fan.largest(c).value >= 1) found.opening = mechanism(fan, c, n);
    }
    for (std::size_t j = 0; j < n; ++j) {
        found.traction[j] = fan.traction(j, c);
        const double value = fan.of(j, c).value;
        found.utilisation = std::max(found.utilisation, value);
        if ((!closed || supported) && value >= 1) found.opening.push_back(j);
    }
    // one interface alone does not part a closed fan: the others hold it, whatever the support gives
    if (closed && found.opening.size() < 2) {
        found.opening.clear();
        found.utilisation = std::min(found.utilisation, std::nextafter(1.0, 0.0));
    }
}

}  // namespace gneiss
