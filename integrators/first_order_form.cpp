#include "integrators/first_order_form.hpp"

#include <algorithm>

#include "integrators/mass_and_damping.hpp"

namespace gneiss {

void FirstOrderForm::bind(const SemiDiscrete& system, double omega) {
    const Layout layout = system.layout();
    const auto constraints = system.constraints();
    free_.clear();
    for (std::size_t dof = 0, k = 0; dof < layout.n_dof; ++dof) {
        if (k < constraints.size() && constraints[k].dof == dof)
            ++k;
        else
            free_.push_back(dof);
    }
    n_internal_ = layout.n_internal;
    remembers_ = layout.n_history > 0;
    motion_.bind(system, omega);
    trial_.u.assign(layout.n_dof, 0.0);
    trial_.v.assign(layout.n_dof, 0.0);
    trial_.z.assign(layout.n_internal, 0.0);
    f_.assign(layout.n_dof, 0.0);
    forget_forces();
    part_of_f_.assign(layout.n_dof, 0.0);
}

void FirstOrderForm::pack(const State& state, std::span<double> y) const {
    for (std::size_t i = 0; i < n_free(); ++i) {
        y[i] = state.u[free_[i]];
        y[n_free() + i] = state.v[free_[i]];
    }
    std::ranges::copy(state.z, y.begin() + static_cast<std::ptrdiff_t>(2 * n_free()));
}

bool FirstOrderForm::is_packed(const State& state, std::span<const double> y) const {
    for (std::size_t i = 0; i < n_free(); ++i)
        if (y[i] != state.u[free_[i]] || y[n_free() + i] != state.v[free_[i]]) return false;
    return std::ranges::equal(y.subspan(2 * n_free()), state.z);
}

void FirstOrderForm::unpack(const SemiDiscrete& system, double t, std::span<const double> y, State& to) {
    to.t = t;
    for (std::size_t i = 0; i < n_free(); ++i) {
        to.u[free_[i]] = y[i];
        to.v[free_[i]] = y[n_free() + i];
    }
    std::ranges::copy(y.subspan(2 * n_free()), to.z.begin());
    motion_.evaluate(system, t);
    motion_.put(system, to.u, to.v);
}

void FirstOrderForm::rate(const SemiDiscrete& system, const State& accepted, double t, std::span<const double> y,
                          Part part, std::span<double> dydt, bool keep) {
    unpack(system, t, y, trial_);
    const Trial trial = trial_of(trial_, accepted.last_event);
    std::ranges::fill(dydt, 0.0);
    if (part == Part::external) {
        system.external_force(trial, f_);
    } else if (part == Part::interactions) {
        system.interaction_force(accepted, trial, f_);
    } else {
        if (keep) forget_forces();
        system.force(accepted, trial, f_);
        if (keep) kept_f_ = f_;
        subtract_damping(system, trial_.v, f_);
        if (n_internal_ > 0) system.internal_rate(accepted, trial, dydt.subspan(2 * n_free()));
    }
    if (part == Part::all || part == Part::rest || part == Part::interactions)
        std::copy_n(y.begin() + static_cast<std::ptrdiff_t>(n_free()), n_free(), dydt.begin());
    if (part == Part::rest || part == Part::without_interactions) {
        if (part == Part::rest)
            system.external_force(trial, part_of_f_);
        else
            system.interaction_force(accepted, trial, part_of_f_);
        for (std::size_t i = 0; i < f_.size(); ++i) f_[i] -= part_of_f_[i];
    }
    const auto mass = system.lumped_mass();
    for (std::size_t i = 0; i < n_free(); ++i) dydt[n_free() + i] = f_[free_[i]] / mass[free_[i]];
    if (!keep || part == Part::external || part == Part::interactions) return;
    kept_t_ = t;
    kept_last_event_ = accepted.last_event;
    kept_part_ = part;
    kept_y_.assign(y.begin(), y.end());
    kept_rate_.assign(dydt.begin(), dydt.end());
}

bool FirstOrderForm::repeat(const State& accepted, double t, std::span<const double> y, Part part,
                            std::span<double> dydt) const {
    const bool same = !remembers_ && !kept_rate_.empty() && t == kept_t_ && part == kept_part_ &&
                      accepted.last_event == kept_last_event_ && std::ranges::equal(y, kept_y_);
    if (same) std::ranges::copy(kept_rate_, dydt.begin());
    return same;
}

void FirstOrderForm::forget_forces() {
    kept_y_.clear();
    kept_f_.clear();
    kept_rate_.clear();
}

std::span<const double> FirstOrderForm::forces_at(double t, std::span<const double> y) const {
    if (t == kept_t_ && std::ranges::equal(y, kept_y_)) return kept_f_;
    return {};
}

}  // namespace gneiss
