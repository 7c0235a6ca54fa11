#include "model/platen.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/errors.hpp"

namespace gneiss {
namespace {

Vec2<double> at_node(std::span<const double> values, std::int32_t node) {
    const std::size_t x = 2 * static_cast<std::size_t>(node);
    return {values[x], values[x + 1]};
}

}  // namespace

Platen::Platen(const LumpedOptions& options, const Mesh& mesh, const std::vector<BoundaryEdge>& edges,
               std::shared_ptr<const AmplitudeCourse> course)
    : options_(options), amplitude_(options.amplitude, std::move(course)) {
    const double length = std::hypot(options.direction[0], options.direction[1]);
    if (!(length > 0)) throw InputError("", "direction = [0, 0]: has no length");
    if (amplitude_.depends_on_position()) throw InputError("", "amplitude: may depend on t alone, not on x and y");
    if (!moves() && amplitude_.has_jump())
        throw InputError("", "amplitude: jumps, and the energy of the spring with it; take a ramp");
    direction_ = {options.direction[0] / length, options.direction[1] / length};
    std::map<std::int32_t, double> lengths;
    double whole = 0;
    for (const BoundaryEdge& edge : edges) {
        const auto &a = mesh.nodes[static_cast<std::size_t>(edge.a)], &b = mesh.nodes[static_cast<std::size_t>(edge.b)];
        const double own = std::hypot(b[0] - a[0], b[1] - a[1]);
        lengths[edge.a] += 0.5 * own;
        lengths[edge.b] += 0.5 * own;
        whole += own;
    }
    for (const auto& [node, own] : lengths) touches_.push_back({node, own / whole});
}

auto Platen::point() const -> std::optional<Point> {
    if (!moves()) return std::nullopt;
    return Point{options_.mass, {options_.velocity, 0}};
}

double Platen::displacement(const Trial& at) const {
    return moves() ? at_node(at.u, point_).x : options_.displacement * amplitude_.value(at.t, at.last_event);
}

double Platen::velocity(const Trial& at) const { return depends_on_velocity() ? at_node(at.v, point_).x : 0; }

double Platen::driving_force(const Trial& at) const {
    return moves() ? options_.force * amplitude_.value(at.t, at.last_event) : 0;
}

template <class Body>
void Platen::for_each_pressed(const Trial& at, Body body) const {
    const double q = displacement(at), q_rate = velocity(at);
    for (std::size_t i = 0; i < touches_.size(); ++i) {
        const Touch& touch = touches_[i];
        const double depth = q - options_.gap - dot(direction_, at_node(at.u, touch.node));
        const double rate = depends_on_velocity() ? q_rate - dot(direction_, at_node(at.v, touch.node)) : 0.0;
        // one that only just touches has its stiffness already
        if (!options_.bonded && depth < 0) continue;
        const double spring = options_.stiffness * depth, damper = options_.damping * rate;
        const bool lets_go = !options_.bonded && spring + damper < 0;  // the damper cannot pull
        body(i, Push{depth, rate, spring, lets_go ? -spring : damper, lets_go});
    }
}

void Platen::add_force(const Trial& at, std::span<double> f) const {
    double sum = 0;
    for_each_pressed(at, [&](std::size_t i, const Push& push) {
        const double force = touches_[i].share * (push.spring + push.damper);
        const auto x = 2 * static_cast<std::size_t>(touches_[i].node);
        f[x] += force * direction_.x;
        f[x + 1] += force * direction_.y;
        sum += force;
    });
    if (!moves()) return;
    const std::size_t own = 2 * static_cast<std::size_t>(point_);
    f[own] += driving_force(at) - sum - options_.ground_stiffness * at.u[own];
    f[own + 1] -= (options_.stiffness + options_.ground_stiffness) * at.u[own + 1];
}

std::vector<std::array<std::int32_t, 2>> Platen::couplings() const {
    std::vector<std::array<std::int32_t, 2>> pairs;
    for (const Touch& touch : touches_) {
        pairs.push_back({touch.node, touch.node});
        if (moves()) pairs.insert(pairs.end(), {{touch.node, point_}, {point_, touch.node}});
    }
    if (moves()) pairs.push_back({point_, point_});
    return pairs;
}

void Platen::derivative(const Trial& at, double between, double ground, std::span<ForceTerm::Stiffness> df) const {
    std::ranges::fill(df, ForceTerm::Stiffness{0, 0, 0, 0});
    const auto [x, y] = direction_;
    const std::size_t per_touch = moves() ? 3 : 1;  // in the order of couplings()
    double sum = ground;
    for_each_pressed(at, [&](std::size_t i, const Push& push) {
        if (push.lets_go) return;
        const double k = touches_[i].share * between;
        sum += k;
        auto* out = &df[per_touch * i];
        out[0] = {-k * x * x, -k * x * y, -k * x * y, -k * y * y};
        if (!moves()) return;
        out[1] = {k * x, 0, k * y, 0};
        out[2] = {k * x, k * y, 0, 0};
    });
    if (moves()) df.back() = {-sum, 0, 0, 0};
}

void Platen::stiffness(const Trial& at, std::span<ForceTerm::Stiffness> df_du) const {
    derivative(at, options_.stiffness, options_.ground_stiffness, df_du);
    if (moves()) df_du.back().yy = -(options_.stiffness + options_.ground_stiffness);
}

void Platen::velocity_stiffness(const Trial& at, std::span<ForceTerm::Stiffness> df_dv) const {
    derivative(at, options_.damping, 0, df_dv);
}

auto Platen::largest_rates(const Trial&, std::span<const double> lumped_mass) const -> Rates {
    // (q - n.u)^2 <= 2 q^2 + 2 (n.u)^2; touched or not: it may be before the next look
    Rates rates;
    for (const Touch& touch : touches_) {
        const double twice = 2 * touch.share / lumped_mass[2 * static_cast<std::size_t>(touch.node)];
        rates.omega_squared = std::max(rates.omega_squared, twice * options_.stiffness);
        rates.damping = std::max(rates.damping, twice * options_.damping);
    }
    if (!moves()) return rates;
    rates.omega_squared =
        std::max(rates.omega_squared, (2 * options_.stiffness + options_.ground_stiffness) / options_.mass);
    rates.damping = std::max(rates.damping, 2 * options_.damping / options_.mass);
    return rates;
}

void Platen::add_stiffness_bound(const Trial&, std::span<double> bound) const {
    for (const Touch& touch : touches_)
        for (std::size_t c = 0; c < 2; ++c)
            bound[2 * static_cast<std::size_t>(touch.node) + c] += 2 * touch.share * options_.stiffness;
    if (!moves()) return;
    for (std::size_t c = 0; c < 2; ++c)
        bound[2 * static_cast<std::size_t>(point_) + c] += 2 * options_.stiffness + options_.ground_stiffness;
}

double Platen::stored_energy(const Trial& at) const {
    const double q = displacement(at);
    double twice = moves() ? options_.ground_stiffness * q * q : 0;
    for_each_pressed(at,
                     [&](std::size_t i, const Push& push) { twice += touches_[i].share * push.spring * push.depth; });
    return 0.5 * twice;
}

double Platen::force(const Trial& at) const {
    double sum = 0;
    for_each_pressed(at,
                     [&](std::size_t i, const Push& push) { sum += touches_[i].share * (push.spring + push.damper); });
    return sum;
}

double Platen::damping_power(const Trial& at) const {
    double sum = 0;
    for_each_pressed(at, [&](std::size_t i, const Push& push) { sum += touches_[i].share * push.damper * push.rate; });
    return sum;
}

void Platen::add_path_energies(const Trial& from, const Trial& to, PathEnergies& energies) const {
    const double way = displacement(to) - displacement(from);
    energies.external_work +=
        moves() ? 0.5 * (driving_force(from) + driving_force(to)) * way : 0.5 * (force(from) + force(to)) * way;
    if (depends_on_velocity()) energies.dampers += 0.5 * (damping_power(from) + damping_power(to)) * (to.t - from.t);
}

auto Platen::quantities(const Trial& at) const -> std::vector<Quantity> {
    std::vector<Quantity> all{{"displacement", "m", displacement(at)}};
    if (moves()) all.push_back({"velocity", "m/s", at_node(at.v, point_).x});
    all.push_back({"force", "N", force(at)});
    return all;
}

}  // namespace gneiss
