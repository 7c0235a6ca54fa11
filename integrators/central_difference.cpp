#include "integrators/central_difference.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "base/prefetch.hpp"
#include "integrators/mass_and_damping.hpp"

namespace gneiss {
CentralDifference::CentralDifference(const Options& options, int levels) : step_(options, {}), levels_(levels) {
    std::vector<Problem> problems;
    options.check(problems);
    if (!(levels >= 1 && levels <= LocalSteps::most_levels))
        problems.push_back(
            {"integrator.levels", fmt::format("given {}, must be in [1, {}]", levels, LocalSteps::most_levels)});
    if (options.lanczos && levels > 1)
        problems.push_back({"integrator.bound",
                            "`lanczos` bounds one step for all elements: with `levels` > 1 every "
                            "element has to tell its own"});
    if (!problems.empty()) throw InputError(problems);
}

void CentralDifference::allocate(const SemiDiscrete& system) {
    const Layout layout = system.layout();
    const auto mass = system.lumped_mass();
    inverse_mass_.resize(layout.n_dof);
    for (std::size_t i = 0; i < layout.n_dof; ++i) inverse_mass_[i] = 1 / mass[i];
    a_.assign(layout.n_dof, 0.0);
    v_half_.assign(system.force_depends_on_velocity() ? layout.n_dof : 0, 0.0);
    next_.u.assign(layout.n_dof, 0.0);
    next_.v.assign(layout.n_dof, 0.0);
    next_.z.assign(layout.n_internal, 0.0);
    next_.history.assign(layout.n_history, 0.0);
    if (local_) n_local_ += local_->n_evaluated();
    auto levels = levels_ > 1 ? system.levels(levels_) : nullptr;
    local_ = levels ? std::make_unique<LocalSteps>(std::move(levels), system) : nullptr;
    step_.take_levels(local_ ? &local_->levels() : nullptr, local_ ? LocalSteps::limit : StabilityLimit{});
    const auto constraints = system.constraints();
    absorbing_.clear();
    for (const AbsorbingNode& node : absorbing_nodes(system)) absorbing_.push_back({node, {}, {}});
    special_.clear();
    for (const Constraint& constraint : constraints) special_.push_back(constraint.dof);
    for (const HalfKicked& node : absorbing_) {
        if (!node.x_prescribed) special_.push_back(node.x());
        if (!node.y_prescribed) special_.push_back(node.y());
    }
    const std::size_t n = constraints.size();
    for (auto* values : {&prescribed_, &middle_, &end_velocity_, &net_, &net_before_, &reactions_})
        values->assign(n, 0.0);
}

void CentralDifference::start(const SemiDiscrete& system, State& state, StartReason why) {
    const bool anew = why != StartReason::reinitialise;
    const double before = LeapfrogEnergy::square(a_, inverse_mass_, partial_);
    if (anew) allocate(system);
    step_.start(system, state, why);
    hold_constraints(system, state, why);
    step_.supports_held(system, state, why);
    if (why == StartReason::fresh && remembers()) {
        // prescribed displacements may have strained the solid
        system.force_and_update(state, Trial::of(state), a_, next_.z, next_.history);
        state.z.swap(next_.z);
        state.history.swap(next_.history);
    } else {
        system.force(state, Trial::of(state), a_);
    }
    ++n_starts_;
    average(system, state, Trial::of(state));
    settle(system, state);
    for (std::size_t k = 0; k < net_.size(); ++k) reactions_[k] = -net_[k];
    energy_.start(why, before, LeapfrogEnergy::square(a_, inverse_mass_, partial_));
}

void CentralDifference::settle(const SemiDiscrete& system, const State& state) {
    const auto constraints = system.constraints();
    for (std::size_t k = 0; k < net_.size(); ++k) net_[k] = a_[constraints[k].dof];
    subtract_damping(system, state.v, net_);
    const double c = system.damping().mass_proportional;
    for (std::size_t i = 0; i < a_.size(); ++i) a_[i] = inverse_mass_[i] * a_[i] - c * state.v[i];
    for (const Damping::Block& block : system.damping().blocks) {
        const auto x = 2 * static_cast<std::size_t>(block.node), y = x + 1;
        a_[x] -= inverse_mass_[x] * (block.xx * state.v[x] + block.xy * state.v[y]);
        a_[y] -= inverse_mass_[y] * (block.xy * state.v[x] + block.yy * state.v[y]);
    }
    for (const Constraint& constraint : constraints) a_[constraint.dof] = 0;
}

void CentralDifference::hold_constraints(const SemiDiscrete& system, State& state, StartReason why) {
    const auto constraints = system.constraints();
    if (constraints.empty() || why == StartReason::recover) return;
    system.constraint_values(state.t, state.last_event, prescribed_);
    system.constraint_values(state.t + 0.5 * step_.dt(), state.last_event, middle_);
    system.constraint_values(state.t + step_.dt(), state.last_event, end_velocity_);
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const std::size_t dof = constraints[k].dof;
        const double before = state.v[dof];
        if (constraints[k].kind == Constraint::Kind::velocity) {
            state.v[dof] = prescribed_[k];
        } else {
            if (why == StartReason::fresh) state.u[dof] = prescribed_[k];
            state.v[dof] =
                (-3 * prescribed_[k] + 4 * middle_[k] - end_velocity_[k]) / step_.dt();  // order 2, from the right
        }
        // a jump of the velocity is work of the support; before the first step it belongs to the initial energy
        if (why != StartReason::fresh)
            state.path.support_work +=
                0.5 * system.lumped_mass()[dof] * (state.v[dof] * state.v[dof] - before * before);
    }
}

void CentralDifference::plan_step(const SemiDiscrete& system, const State& state, double t_stop) {
    step_.plan(system, state, t_stop);
    next_.t = step_.dt() == t_stop - state.t ? t_stop : state.t + step_.dt();
    next_.last_event = state.last_event;
}

StepReport CentralDifference::advance(const SemiDiscrete& system, State& state, double t_stop) {
    return advance_unseen(system, state, t_stop, state.t);
}

StepReport CentralDifference::advance_unseen(const SemiDiscrete& system, State& state, double t_stop, double t_look) {
    constexpr std::size_t most = 16;  // what every further one saves is the same, and somebody may want to stop the run
    const bool unseen = can_pass_unseen(system);
    plan_step(system, state, t_stop);
    kick_and_drift(system, state);
    std::size_t n_steps = 1;
    for (double dt_before = 0;; ++n_steps) {
        try {
            if (n_steps > 1)
                kick_on_and_evaluate(system, state, dt_before);
            else
                evaluate(system, state);
        } catch (...) {
            if (n_steps == 1) throw;
            synchronise(system, state, dt_before);  // what went wrong will again when it is the first step
            return {state.t, step_.dt(), 0, n_steps + 1, n_steps - 1};
        }
        step_.count();
        const bool seen = n_steps == most || !(next_.t < std::min(t_look, t_stop));
        if (!unseen || seen || step_.look_due() || system.stirred(next_)) break;
        remember_special();
        kick_special(system, state);
        add_path_energies(system, state);
        accept_unseen(state);
        dt_before = step_.dt();
        plan_step(system, state, t_stop);
    }
    kick(system, state);
    add_path_energies(system, state);
    std::swap(state, next_);
    return {state.t, step_.dt(), 0, n_steps, n_steps};
}

void CentralDifference::evaluate(const SemiDiscrete& system, const State& state) {
    if (remembers())
        system.force_and_update(state, trial(), a_, next_.z, next_.history);
    else
        system.force(state, trial(), a_);
    average(system, next_, trial());
}

void CentralDifference::average(const SemiDiscrete& system, const State& accepted, const Trial& at) {
    if (local_) local_->average(system, accepted, at, step_.longest(), a_);
}

void CentralDifference::add_path_energies(const SemiDiscrete& system, const State& state) {
    system.add_path_energies(state, next_);
    for (std::size_t k = 0; k < net_.size(); ++k) {
        // what the support adds: the change of this degree's kinetic energy that the other forces do not explain
        const std::size_t dof = system.constraints()[k].dof;
        const double kinetic =
            0.5 * system.lumped_mass()[dof] * (next_.v[dof] * next_.v[dof] - state.v[dof] * state.v[dof]);
        next_.path.support_work += kinetic - 0.5 * (net_[k] + net_before_[k]) * (next_.u[dof] - state.u[dof]);
    }
}

bool CentralDifference::can_pass_unseen(const SemiDiscrete& system) const {
    // forces that depend on velocity need v(n) everywhere, and so does the energy that damping takes
    return v_half_.empty() && system.damping().mass_proportional == 0;
}

void CentralDifference::accept_unseen(State& state) {
    for (const std::size_t dof : special_) state.v[dof] = next_.v[dof];
    state.v.swap(next_.v);  // stays in next_: v(n+1/2)
    std::swap(state, next_);
}

/// f(n), a(n) and v(n), in the operations of kick() and kick_and_drift().
class CentralDifference::KickAndDrift final : public Arrival {
public:
    KickAndDrift(CentralDifference& scheme, const State& state, double dt_before)
        : scheme_(scheme), state_(state), half_before_(0.5 * dt_before) {}

    void bring(std::size_t first, std::size_t last) const override {
        const double half_before = half_before_, half = 0.5 * scheme_.step_.dt(), dt = scheme_.step_.dt();
        const double *u = state_.u.data(), *f = scheme_.a_.data(), *inverse_mass = scheme_.inverse_mass_.data();
        double *u_next = scheme_.next_.u.data(), *v_half = scheme_.next_.v.data();
        const std::size_t n = scheme_.a_.size();
        constexpr std::size_t length = 64, ahead = 6 * length;
        for (std::size_t begin = first; begin < last; begin += length) {
            const std::size_t end = std::min(begin + length, last);
            for (const double* values : {u, f, inverse_mass}) prefetch(values, begin + ahead, end + ahead, n);
            for (double* values : {u_next, v_half}) prefetch<Access::write>(values, begin + ahead, end + ahead, n);
#pragma omp simd
            for (std::size_t i = begin; i < end; ++i) {
                const double acceleration = inverse_mass[i] * f[i];
                const double v_next = v_half[i] + half_before * acceleration + half * acceleration;
                v_half[i] = v_next;
                u_next[i] = u[i] + dt * v_next;
            }
        }
        const auto& moved = scheme_.moved_;
        for (auto one = std::ranges::lower_bound(moved, first, {}, &Moved::dof); one != moved.end() && one->dof < last;
             ++one) {
            u_next[one->dof] = one->u;
            v_half[one->dof] = one->v;
        }
    }

private:
    CentralDifference& scheme_;
    const State& state_;
    double half_before_;
};

void CentralDifference::kick_on_and_evaluate(const SemiDiscrete& system, const State& state, double dt_before) {
    for (const std::size_t dof : special_) {
        next_.v[dof] = state.v[dof] + 0.5 * step_.dt() * a_[dof];
        next_.u[dof] = state.u[dof] + step_.dt() * next_.v[dof];
    }
    prescribe(system, state);
    moved_.clear();
    for (const std::size_t dof : special_) moved_.push_back({dof, next_.u[dof], next_.v[dof]});
    std::ranges::sort(moved_, {}, &Moved::dof);
    system.force_on_arrival(state, trial(), KickAndDrift(*this, state, dt_before), a_, next_.z, next_.history);
    average(system, next_, trial());
}

void CentralDifference::synchronise(const SemiDiscrete& system, State& state, double dt_before) {
    system.force(state, Trial::of(state), a_);
    average(system, state, Trial::of(state));
    for (const std::size_t dof : special_) next_.v[dof] = state.v[dof];
    for (std::size_t i = 0; i < a_.size(); ++i) state.v[i] = next_.v[i] - 0.5 * step_.dt() * inverse_mass_[i] * a_[i];
    for (const std::size_t dof : special_) state.v[dof] = next_.v[dof];
    settle(system, state);
    step_.set_dt(dt_before);
}

void CentralDifference::kick_and_drift(const SemiDiscrete& system, const State& state) {
    const double dt = step_.dt(), half = 0.5 * dt;
    const double *u = state.u.data(), *v = state.v.data(), *a = a_.data();
    double *u_next = next_.u.data(), *v_next = next_.v.data();
    parallel_ranges(a_.size(), [=](std::size_t first, std::size_t last) {
#pragma omp simd
        for (std::size_t i = first; i < last; ++i) {
            const double v_half = v[i] + half * a[i];
            v_next[i] = v_half;
            u_next[i] = u[i] + dt * v_half;
        }
    });
    prescribe(system, state);
    if (!v_half_.empty()) {
        // forces that depend on velocity see v(n+1/2) + dt/2 a(n), of order 2 at t(n+1)
        double* v_half = v_half_.data();
        parallel_ranges(a_.size(), [=](std::size_t first, std::size_t last) {
#pragma omp simd
            for (std::size_t i = first; i < last; ++i) {
                v_half[i] = v_next[i];
                v_next[i] += half * a[i];
            }
        });
        for (std::size_t k = 0; k < end_velocity_.size(); ++k) next_.v[system.constraints()[k].dof] = end_velocity_[k];
    }
}

void CentralDifference::prescribe(const SemiDiscrete& system, const State& state) {
    const auto constraints = system.constraints();
    if (constraints.empty()) return;
    const double dt = step_.dt();
    system.constraint_values(state.t + 0.5 * dt, next_.last_event, middle_);
    system.constraint_values(next_.t, next_.last_event, prescribed_);
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const std::size_t dof = constraints[k].dof;
        if (constraints[k].kind == Constraint::Kind::displacement) {
            next_.u[dof] = prescribed_[k];
            next_.v[dof] = (next_.u[dof] - state.u[dof]) / dt;
            end_velocity_[k] =
                (state.u[dof] - 4 * middle_[k] + 3 * prescribed_[k]) / dt;  // order 2, from this step alone
        } else {
            next_.v[dof] = middle_[k];
            next_.u[dof] = state.u[dof] + dt * middle_[k];
            end_velocity_[k] = prescribed_[k];
        }
    }
}

void CentralDifference::kick(const SemiDiscrete& system, const State& state) {
    remember_special();
    const double half = 0.5 * step_.dt(), c = system.damping().mass_proportional, inverse_damping = 1 / (1 + half * c);
    const double *v_half = v_half_.empty() ? next_.v.data() : v_half_.data(), *inverse_mass = inverse_mass_.data();
    double *v = next_.v.data(), *a = a_.data();
    parallel_ranges(a_.size(), [=](std::size_t first, std::size_t last) {
#pragma omp simd
        for (std::size_t i = first; i < last; ++i) {
            const double force_per_mass = inverse_mass[i] * a[i];
            v[i] = (v_half[i] + half * force_per_mass) * inverse_damping;
            a[i] = force_per_mass - c * v[i];
        }
    });
    kick_special(system, state);
}

void CentralDifference::remember_special() {
    const double* v_half = v_half_.empty() ? next_.v.data() : v_half_.data();
    net_before_.swap(net_);
    for (std::size_t k = 0; k < net_.size(); ++k) net_[k] = a_[special_[k]];  // f: constraints come first
    for (HalfKicked& node : absorbing_) {
        node.v_half = {v_half[node.x()], v_half[node.y()]};
        node.f = {a_[node.x()], a_[node.y()]};
    }
}

void CentralDifference::kick_special(const SemiDiscrete& system, const State& state) {
    const double dt = step_.dt(), half = 0.5 * dt, c = system.damping().mass_proportional;
    const auto constraints = system.constraints();
    const double* inverse_mass = inverse_mass_.data();
    double *v = next_.v.data(), *a = a_.data();
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        next_.v[constraints[k].dof] = end_velocity_[k];
        a_[constraints[k].dof] = 0;
    }
    for (const HalfKicked& node : absorbing_) {
        const std::size_t x = node.x(), y = node.y();
        const Damping::Block& block = node.block;
        node.solve(
            c, half, inverse_mass_,
            {node.v_half.x + half * inverse_mass[x] * node.f.x, node.v_half.y + half * inverse_mass[y] * node.f.y},
            next_.v);
        if (!node.x_prescribed) a[x] = inverse_mass[x] * (node.f.x - block.xx * v[x] - block.xy * v[y]) - c * v[x];
        if (!node.y_prescribed) a[y] = inverse_mass[y] * (node.f.y - block.xy * v[x] - block.yy * v[y]) - c * v[y];
    }
    subtract_damping(system, next_.v, net_);
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const std::size_t dof = constraints[k].dof;
        reactions_[k] = (next_.v[dof] - state.v[dof]) / (dt * inverse_mass_[dof]) - net_[k];
    }
}

void CentralDifference::subtract_damping(const SemiDiscrete& system, std::span<const double> v,
                                         std::vector<double>& net) const {
    const auto constraints = system.constraints();
    const double c = system.damping().mass_proportional;
    for (std::size_t k = 0; k < constraints.size(); ++k)
        net[k] -= c * system.lumped_mass()[constraints[k].dof] * v[constraints[k].dof];
    for (const AbsorbingNode& node : absorbing_) {
        const std::size_t x = node.x(), y = node.y();
        if (node.x_prescribed) net[node.x_constraint] -= node.block.xx * v[x] + node.block.xy * v[y];
        if (node.y_prescribed) net[node.y_constraint] -= node.block.xy * v[x] + node.block.yy * v[y];
    }
}

double CentralDifference::kinetic_energy(const SemiDiscrete& system, const State& state) const {
    return synchronised_kinetic_energy(system, state.v, partial_) -
           energy_.excess(step_.dt(), a_, inverse_mass_, partial_);
}

IntegratorMemory CentralDifference::save() const {
    IntegratorMemory memory{{"acceleration", a_}, {"net_force", net_}, {"reactions", reactions_}};
    step_.save(memory);
    energy_.save(memory);
    return memory;
}

void CentralDifference::load(const SemiDiscrete& system, State&, const IntegratorMemory& memory) {
    allocate(system);
    const auto take = [&](const char* entry, std::size_t size) -> const std::vector<double>& {
        return remembered(memory, name(), entry, size);
    };
    a_ = take("acceleration", a_.size());
    net_ = take("net_force", net_.size());
    reactions_ = take("reactions", reactions_.size());
    step_.load(name(), memory);
    energy_.load(name(), memory);
}

}  // namespace gneiss
