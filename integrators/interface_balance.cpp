#include "integrators/interface_balance.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "integrators/mass_and_damping.hpp"

namespace gneiss {
namespace {

/// Steps over 1/omega that are not judged any more: at rest the largest energy so far is as small as what a first
/// contact makes.
constexpr double resolved_part = 1e-3;

double stored_in(const StoredEnergies& energies) { return energies.joints + energies.contact; }
double dissipated_in(const PathEnergies& path) { return path.friction + path.fracture + path.contact; }

}  // namespace

void InterfaceBalance::check(double tolerance, std::vector<Problem>& problems) {
    if (!(tolerance > 0 && tolerance <= 1))
        problems.push_back({"integrator.interface_tolerance", fmt::format("given {}, must be in (0, 1]", tolerance)});
}

void InterfaceBalance::bind(const SemiDiscrete& system) {
    // both have a history, or are searched for
    active_ =
        tolerance_ < 1 && (system.layout().n_history > 0 ||
                           std::ranges::any_of(system.events(), [](const auto& event) { return event->watches(); }));
}

void InterfaceBalance::start(const SemiDiscrete& system, const State& state, double omega) {
    stored_ = stored_in(system.stored_energies(state));
    resolved_ = resolved_part / std::sqrt(omega * omega + system.bond_omega_squared(state));
}

void InterfaceBalance::force(const SemiDiscrete& system, const State& accepted, const Trial& trial,
                             std::span<double> f) {
    system.interaction_force(accepted, trial, f);
    ++evaluations_;
}

double InterfaceBalance::work(const SemiDiscrete& system, std::span<const double> impulse, const State& from,
                              const State& to) const {
    double sum = ordered_sum(impulse.size(), partial_, [&](std::size_t first, std::size_t last) {
        double part = 0;
        for (std::size_t i = first; i < last; ++i) part += impulse[i] * (from.v[i] + to.v[i]);
        return 0.5 * part;
    });
    for (const Constraint& constraint : system.constraints()) {
        const std::size_t dof = constraint.dof;
        sum += impulse[dof] * ((to.u[dof] - from.u[dof]) / (to.t - from.t) - 0.5 * (from.v[dof] + to.v[dof]));
    }
    return sum;
}

double InterfaceBalance::excess(const SemiDiscrete& system, double work, const State& from, const State& to) {
    stored_next_ = stored_in(system.stored_energies(to));
    const double made = work + stored_next_ - stored_ + dissipated_in(to.path) - dissipated_in(from.path);
    largest_next_ =
        std::max({largest_, synchronised_kinetic_energy(system, to.v, partial_), stored_next_, dissipated_in(from.path),
                  std::abs(from.path.external_work), std::abs(from.path.support_work)});
    if (to.t - from.t <= resolved_) return 0;
    return made == 0 ? 0 : std::abs(made) / (tolerance_ * largest_next_);
}

std::string InterfaceBalance::reason(double excess) const {
    return fmt::format("joints and contact would make or lose {:.2g} of the largest energy", excess * tolerance_);
}

}  // namespace gneiss
