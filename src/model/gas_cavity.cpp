#include "model/gas_cavity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/dual.hpp"
#include "base/errors.hpp"
#include "model/edge_pressure.hpp"

namespace gneiss {
namespace {

Vec2<double> at_node(std::span<const double> values, std::int32_t node) {
    const std::size_t x = 2 * static_cast<std::size_t>(node);
    return {values[x], values[x + 1]};
}

}  // namespace

GasCavity::GasCavity(const LumpedOptions& options, const Mesh& mesh, const std::vector<BoundaryEdge>& edges,
                     double thickness)
    : options_(options), thickness_(thickness) {
    const auto place = [&](std::int32_t node) {
        const auto& x = mesh.nodes[static_cast<std::size_t>(node)];
        return Vec2<double>{x[0], x[1]};
    };
    // any point does where the boundary closes; a near one leaves areas their digits
    centre_ = options.about ? Vec2<double>{(*options.about)[0], (*options.about)[1]} : place(edges.front().a);
    for (const BoundaryEdge& edge : edges)
        segments_.push_back({edge.a, edge.b, place(edge.a) - centre_, place(edge.b) - centre_, edge.element});
    const bool closed = close(mesh);
    const std::string where = fmt::format("on = \"{}\": ", options.on);
    if (!closed && !options.about)
        throw InputError("", where +
                                 "is open and encloses no cavity; where planes of symmetry close it, give `about`, "
                                 "the point in which they meet");
    if (closed && options.about) throw InputError("", where + "closes by itself: `about` has no effect, leave it out");
    const std::vector<double> at_rest(2 * mesh.n_nodes(), 0.0);
    initial_volume_ = volume_of(at_rest);
    if (!(initial_volume_ > 0))
        throw InputError("", where + "the solid lies inside of it, a gas needs a cavity in the solid");
    for (const Segment& segment : segments_) nodes_.insert(nodes_.end(), {segment.a, segment.b});
    std::ranges::sort(nodes_);
    nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
}

bool GasCavity::close(const Mesh& mesh) {
    // copies of a node stand where it stood in the reference shape
    struct Ends {
        std::vector<std::int32_t> in, out;
    };
    std::map<std::array<double, 2>, Ends> ends;
    for (const Segment& segment : segments_) {
        ends[mesh.nodes[static_cast<std::size_t>(segment.b)]].in.push_back(segment.b);
        ends[mesh.nodes[static_cast<std::size_t>(segment.a)]].out.push_back(segment.a);
    }
    bool closed = true;
    for (auto& [place, at] : ends) {
        closed = closed && at.in.size() == at.out.size();
        std::erase_if(at.in, [&at = at](std::int32_t node) {  // nothing has parted there
            const auto same = std::ranges::find(at.out, node);
            if (same == at.out.end()) return false;
            at.out.erase(same);
            return true;
        });
        const Vec2<double> x = Vec2<double>{place[0], place[1]} - centre_;
        for (std::size_t k = 0; k < std::min(at.in.size(), at.out.size()); ++k)
            segments_.push_back({at.in[k], at.out[k], x, x, -1});
    }
    return closed;
}

GasCavity::Contents<double> GasCavity::contents(std::span<const double> z) const {
    return {z.empty() ? options_.pressure : z[0], z.size() < 2 ? 0.0 : z[1]};
}

void GasCavity::initial_internal(std::span<double> z) const {
    if (!z.empty()) z[0] = options_.pressure;
    if (burns()) z[1] = options_.burn->energy / initial_volume_;
}

double GasCavity::volume_of(std::span<const double> u) const {
    double twice = 0;
    for (const Segment& s : segments_) twice -= cross(s.x_a + at_node(u, s.a), s.x_b + at_node(u, s.b));
    return 0.5 * thickness_ * twice;
}

double GasCavity::volume(const Trial& at) const {
    const double volume = volume_of(at.u);
    if (!(volume > 0))
        throw RecoverableError(
            fmt::format("gas \"{}\": nothing is left of its cavity at t = {:.9g} s, volume {:.3g} m3", options_.name,
                        at.t, volume));
    return volume;
}

std::vector<LowRank::Entry> GasCavity::volume_gradient(const Trial& at) const {
    std::vector<Vec2<double>> sums(nodes_.size(), {0, 0});
    const auto add = [&](std::int32_t node, const Vec2<double>& value) {
        auto& sum = sums[static_cast<std::size_t>(std::ranges::lower_bound(nodes_, node) - nodes_.begin())];
        sum = sum + value;
    };
    const double half = 0.5 * thickness_;
    for (const Segment& s : segments_) {
        const Vec2<double> a = s.x_a + at_node(at.u, s.a), b = s.x_b + at_node(at.u, s.b);
        add(s.a, {-half * b.y, half * b.x});
        add(s.b, {half * a.y, -half * a.x});
    }
    std::vector<LowRank::Entry> gradient;
    gradient.reserve(2 * nodes_.size());
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
        gradient.push_back({2 * std::int64_t{nodes_[k]}, sums[k].x});
        gradient.push_back({2 * std::int64_t{nodes_[k]} + 1, sums[k].y});
    }
    return gradient;
}

template <class T>
T GasCavity::pressure(const T& a, const T& volume) const {
    using std::pow;
    return a * pow((1 / initial_volume_) * volume, -options_.gamma);
}

double GasCavity::pressure(const Trial& at) const { return pressure(contents(at.z).a, volume(at)); }

template <class T>
T GasCavity::burning_rate(const T& pressure) const {
    using std::pow;
    const BurnOptions& burn = *options_.burn;
    if (burn.exponent == 0) return T(1 / burn.time);
    return (1 / burn.time) * pow((1 / burn.reference_pressure) * pressure, burn.exponent);
}

void GasCavity::add_force(const Trial& at, std::span<double> f) const {
    // as volume_gradient(), without an array of its own
    const double half = 0.5 * thickness_ * pressure(at);
    const auto add = [&](std::int32_t node, double x, double y) {
        f[2 * static_cast<std::size_t>(node)] += x;
        f[2 * static_cast<std::size_t>(node) + 1] += y;
    };
    for (const Segment& s : segments_) {
        const Vec2<double> a = s.x_a + at_node(at.u, s.a), b = s.x_b + at_node(at.u, s.b);
        add(s.a, -half * b.y, half * b.x);
        add(s.b, half * a.y, -half * a.x);
    }
}

void GasCavity::corner_forces(const Trial& at, std::vector<CornerForce>& forces) const {
    const double p = pressure(at);
    for (const Segment& s : segments_) {
        if (s.element < 0) continue;
        const Vec2<double> edge = (s.x_b - s.x_a) + (at_node(at.u, s.b) - at_node(at.u, s.a));
        const auto [force_a, force_b] = edge_pressure_forces(edge, p, p, thickness_);
        forces.push_back({s.element, s.a, force_a});
        forces.push_back({s.element, s.b, force_b});
    }
}

void GasCavity::internal_rate(const Trial& at, std::span<double> rate) const {
    if (rate.empty()) return;
    const auto [a, e] = contents(at.z);
    rate[0] = -options_.gamma * options_.leak * a;
    if (!burns()) return;
    const double v = volume(at), q = e * burning_rate(pressure(a, v));
    rate[0] += (options_.gamma - 1) * std::pow(v / initial_volume_, options_.gamma - 1) * q;
    rate[1] = -q;
}

template <class T>
auto GasCavity::updated(const Contents<double>& from, double volume_from, const T& volume_to, double dt) const
    -> Contents<T> {
    using std::exp;
    using std::pow;
    const double gamma = options_.gamma, kept = std::exp(-gamma * options_.leak * dt);
    if (!burns()) return {T(kept * from.a), T(from.e)};
    const double kept_half = std::exp(-0.5 * gamma * options_.leak * dt);
    const T heat = (0.5 * (gamma - 1)) * (T(std::pow(volume_from / initial_volume_, gamma - 1)) +
                                          pow((1 / initial_volume_) * volume_to, gamma - 1));
    const double before = burning_rate(pressure(from.a, volume_from));
    const auto burn = [&](const T& mean_rate) {
        const T e = from.e * exp(-dt * mean_rate);
        return Contents<T>{T(kept * from.a) + kept_half * (heat * (T(from.e) - e)), e};
    };
    const auto rate_after = [&](const T& guess) {
        return burning_rate(pressure(burn(0.5 * (T(before) + guess)).a, volume_to));
    };
    // To the fixed point: a step back then undoes a step, which compositions of order 4 stand on. In steps so long that
    // it is not found the first correction, of order 2 as well.
    const T once = rate_after(T(before));
    T after = once;
    constexpr int most_iterations = 30;
    constexpr double digits = 1e-15;
    for (int i = 0; i < most_iterations; ++i) {
        const T next = rate_after(after);
        const bool settled = std::abs(plain(next) - plain(after)) <= digits * plain(next);
        after = next;
        if (settled) return burn(0.5 * (T(before) + rate_after(after)));  // once more for derivatives
    }
    return burn(0.5 * (T(before) + once));
}

void GasCavity::update_internal(const Trial& from, const Trial& to, std::span<double> z) const {
    const auto [a, e] = updated(contents(from.z), volume(from), volume(to), to.t - from.t);
    z[0] = a;
    if (burns()) z[1] = e;
}

std::vector<std::array<std::int32_t, 2>> GasCavity::couplings() const {
    std::vector<std::array<std::int32_t, 2>> pairs;
    for (const Segment& s : segments_) pairs.insert(pairs.end(), {{s.a, s.b}, {s.b, s.a}});
    return pairs;
}

void GasCavity::stiffness(const Trial& at, std::span<ForceTerm::Stiffness> df_du) const {
    const double half = 0.5 * thickness_ * pressure(at);  // p d2V/du2, constant but for p
    for (std::size_t i = 0; i < df_du.size(); i += 2) {
        df_du[i] = {0, -half, half, 0};
        df_du[i + 1] = {0, half, -half, 0};
    }
}

std::optional<LowRank::Dyad> GasCavity::dyad(const Trial* from, const Trial& at) const {
    using D = Dual<1>;
    const D v = D::variable(volume(at), 0);
    const D a = from == nullptr || n_internal() == 0 ? D(contents(at.z).a)
                                                     : updated(contents(from->z), volume(*from), v, at.t - from->t).a;
    return LowRank::Dyad{-pressure(a, v).derivative[0], volume_gradient(at)};
}

auto GasCavity::largest_rates(const Trial& at, std::span<const double> lumped_mass) const -> Rates {
    const LowRank::Dyad coupling = *dyad(nullptr, at);
    double along = 0, lightest = std::numeric_limits<double>::infinity();
    for (const auto& [row, value] : coupling.column) {
        const double mass = lumped_mass[static_cast<std::size_t>(row)];
        along += value * value / mass;
        lightest = std::min(lightest, mass);
    }
    // a row of p d2V/du2 has two entries for each segment of its node, of 1/2 p h in magnitude
    return {coupling.factor * along + pressure(at) * thickness_ / lightest, 0};
}

void GasCavity::add_stiffness_bound(const Trial& at, std::span<double> bound) const {
    const LowRank::Dyad coupling = *dyad(nullptr, at);
    double sum = 0;
    for (const auto& entry : coupling.column) sum += std::abs(entry.value);
    const double own = pressure(at) * thickness_;
    for (const auto& [row, value] : coupling.column)
        bound[static_cast<std::size_t>(row)] += coupling.factor * std::abs(value) * sum + own;
}

double GasCavity::stored_energy(const Trial& at) const {
    const auto [a, e] = contents(at.z);
    const double v = volume(at);
    return pressure(a, v) * v / (options_.gamma - 1) + e * initial_volume_;
}

void GasCavity::add_path_energies(const Trial& from, const Trial& to, PathEnergies& energies) const {
    if (options_.leak == 0) return;
    const double factor = options_.gamma * options_.leak / (options_.gamma - 1);
    energies.leaked += 0.5 * factor * (pressure(from) * volume(from) + pressure(to) * volume(to)) * (to.t - from.t);
}

auto GasCavity::quantities(const Trial& at) const -> std::vector<Quantity> {
    const double v = volume(at), p = pressure(contents(at.z).a, v);
    std::vector<Quantity> all{
        {"pressure", "Pa", p}, {"volume", "m3", v}, {"energy", "J", p * v / (options_.gamma - 1)}};
    if (burns()) all.push_back({"charge", "J", contents(at.z).e * initial_volume_});
    return all;
}

}  // namespace gneiss
