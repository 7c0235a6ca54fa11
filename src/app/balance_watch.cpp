#include "app/balance_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <string_view>
#include <vector>

#include "base/errors.hpp"

namespace gneiss {
namespace {

/// The loads' part of least_energy() at t, J; forces at rest, weight and stress in situ, are not theirs.
/// @param at_rest  forces in the state as it is, N
double energy_of_loads(const SemiDiscrete& system, const State& state, double t, double omega,
                       std::span<const double> at_rest) {
    std::vector<double> f(at_rest.size()), now(system.constraints().size()), later(now);
    Trial trial = Trial::of(state);
    trial.t = trial.last_event = t;
    trial.z = state.z;
    const double dt = 1e-3 / omega;
    try {
        system.force(state, trial, f);
        system.constraint_values(t, t, now);
        system.constraint_values(t + dt, t, later);
    } catch (const InputError&) {
        return 0;  // a formula that has no value then may never be asked for one
    }
    for (std::size_t i = 0; i < f.size(); ++i) f[i] = (f[i] - at_rest[i]) / (system.lumped_mass()[i] * omega);
    for (std::size_t k = 0; k < now.size(); ++k) {
        const Constraint& support = system.constraints()[k];
        f[support.dof] = support.kind == Constraint::Kind::velocity ? now[k] : (later[k] - now[k]) / dt;
    }
    double energy = 0;
    for (std::size_t i = 0; i < f.size(); ++i) energy += 0.5 * system.lumped_mass()[i] * f[i] * f[i];
    return energy;
}

}  // namespace

double least_energy(const SemiDiscrete& system, const State& at_start, double extent) {
    constexpr double part_of_loads = 1e-4;  // a hundredth of their velocities: what rtol leaves of them is far below
    const double omega = system.frequency_bound(at_start).omega;
    if (!(omega > 0)) return 0;
    std::vector<double> at_rest(at_start.u.size());
    Trial trial = Trial::of(at_start);
    trial.z = at_start.z;
    system.force(at_start, trial, at_rest);
    double largest = 0;
    for (const double t : system.load_peaks())
        largest = std::max(largest, energy_of_loads(system, at_start, t, omega, at_rest));
    const double v = omega * std::numeric_limits<double>::epsilon() * extent;
    double by_round_off = 0;
    for (const double mass : system.lumped_mass()) by_round_off += 0.5 * mass * v * v;
    return by_round_off + part_of_loads * largest;
}

void BalanceWatch::look(double t, const EnergyLedger& ledger, BalanceRecord& record) const {
    const double left_over = ledger.left_over(), relative = ledger.relative_left_over();
    record.largest_entry = ledger.largest_entry();
    record.most_gained = std::max(record.most_gained, left_over);
    record.most_lost = std::max(record.most_lost, -left_over);
    const auto since = [t](bool is_so, double before) {
        return is_so ? std::min(before, t) : std::numeric_limits<double>::infinity();
    };
    // what is no number is no balance either
    record.doubtful_since = since(!(ledger.balance_error() < doubtful), record.doubtful_since);
    const double most = options_->run.most_energy_gained;
    record.gaining_since = since(most > 0 && !(relative <= most), record.gaining_since);
}

bool BalanceWatch::stands(double since, double t) const {
    constexpr double part_of_run = 0.01;
    return since <= t && (t - since >= part_of_run * options_->run.t_end || !(t < options_->run.t_end));
}

double BalanceWatch::largest_error(const BalanceRecord& record) {
    const double largest = std::max(record.most_gained, record.most_lost);
    return record.largest_entry > 0 ? largest / record.largest_entry : 0;
}

std::string BalanceWatch::text(double t, const BalanceRecord& record) const {
    const bool gained = record.most_gained >= record.most_lost;
    return fmt::format("energy balance: by t = {:.6g} s {:.3g} J, {:.3g} % of the largest energy of the run, {}: {}", t,
                       std::max(record.most_gained, record.most_lost), 100 * largest_error(record),
                       gained ? "have come from nothing" : "have got lost", cause(gained));
}

std::string BalanceWatch::cause(bool gained) const {
    const IntegratorOptions& scheme = options_->integrator;
    const auto is = [&](std::initializer_list<std::string_view> types) {
        return std::ranges::find(types, scheme.type) != types.end();
    };
    if (is_static_) return "load steps too long for what the material remembers (`longest`)";
    const bool bdf = scheme.type == "ida" || (scheme.type == "cvode" && !scheme.adams);
    if (bdf)
        return gained ? "bdf of order 3 to 5 amplifies undamped vibration; a smaller `rtol`, `max_order = 2`, or a "
                        "scheme for vibration"
                      : "bdf damps what its steps do not resolve; a smaller `rtol`, or a scheme for vibration";
    if (is({"cvode", "arkode"}) && (scheme.type == "cvode" || scheme.dt == 0))
        return gained ? "steps at the limit of stability, which errors within `rtol` do not show; a smaller `rtol`, or "
                        "a scheme for vibration"
                      : "the scheme damps what its steps do not resolve, or has not yet seen it; a smaller `rtol`";
    if (is({"arkode", "mri"})) return "steps too long; a smaller `dt`";
    if (is({"generalized_alpha", "newmark", "hht_alpha", "bathe"}))
        return gained ? "steps too long for contact, cracks or large rotations; a smaller `dt` or `rtol`"
                      : "the scheme damps what its steps do not resolve; a smaller `dt` or `rtol`, or less damping";
    if (scheme.type == "noh_bathe" && !gained)
        return "the scheme damps waves of the length of elements; `split = 0.5`, or another scheme";
    return "steps too long for how fast forces change; a smaller `safety`";
}

}  // namespace gneiss
