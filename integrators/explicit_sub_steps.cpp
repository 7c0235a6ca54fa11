#include "integrators/explicit_sub_steps.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "integrators/mass_and_damping.hpp"

namespace gneiss {

void ExplicitSubSteps::allocate(const SemiDiscrete& system) {
    check(system);
    const Layout layout = system.layout();
    const auto mass = system.lumped_mass();
    inverse_mass_.resize(layout.n_dof);
    for (std::size_t i = 0; i < layout.n_dof; ++i) inverse_mass_[i] = 1 / mass[i];
    absorbing_ = absorbing_nodes(system);
    for (auto* values : {&a_, &a_new_, &a_before_, &f_, &right_}) values->assign(layout.n_dof, 0.0);
    for (State* scratch : {&next_, &sub_}) {
        scratch->u.assign(layout.n_dof, 0.0);
        scratch->v.assign(layout.n_dof, 0.0);
        scratch->z.assign(layout.n_internal, 0.0);
        scratch->history.assign(layout.n_history, 0.0);
    }
    for (auto* values : {&reactions_, &reactions_new_, &reactions_before_})
        values->assign(system.constraints().size(), 0.0);
    evaluations_ = system.force_depends_on_velocity() ? evaluations_with_velocity() : 1;
    motion_.bind(system, omega_);
}

double ExplicitSubSteps::damping_rate(const SemiDiscrete& system) const {
    if (!damping_limits()) return 0;
    double of_blocks = 0;
    for (const Damping::Block& block : system.damping().blocks) {
        const double largest = 0.5 * (block.xx + block.yy) + std::hypot(0.5 * (block.xx - block.yy), block.xy);
        of_blocks = std::max(of_blocks, largest / system.lumped_mass()[2 * static_cast<std::size_t>(block.node)]);
    }
    return system.damping().mass_proportional + of_blocks;
}

void ExplicitSubSteps::start(const SemiDiscrete& system, State& state, StartReason why) {
    const double before = LeapfrogEnergy::square(a_, inverse_mass_, partial_);
    step_.start(system, state, why, damping_rate(system));
    if (why == StartReason::fresh) omega_ = step_.omega();
    if (why != StartReason::reinitialise) allocate(system);
    n_starts_ += motion_.hold(system, state, why);
    step_.supports_held(system, state, why);
    system.force(state, Trial::of(state), f_);
    ++n_starts_;
    motion_.reactions(system, state.v, f_, reactions_);
    accelerate(system, state.v);
    a_.swap(a_new_);
    energy_.start(why, before, LeapfrogEnergy::square(a_, inverse_mass_, partial_));
}

StepReport ExplicitSubSteps::advance(const SemiDiscrete& system, State& state, double t_stop) {
    step_.plan(system, state, t_stop);
    motion_.step_from(system, state);
    const double dt = step_.dt();
    n_force_ = 0;
    std::ranges::copy(a_, a_new_.begin());
    std::ranges::copy(reactions_, reactions_new_.begin());
    next_.last_event = sub_.last_event = state.last_event;
    take(system, state, dt, dt == t_stop - state.t ? t_stop : state.t + dt);
    std::swap(state, next_);
    a_.swap(a_new_);
    reactions_.swap(reactions_new_);
    step_.count();
    return {state.t, dt, 0, n_force_};
}

void ExplicitSubSteps::evaluate(const SemiDiscrete& system, const State& from, const Trial& trial, State& to,
                                std::size_t& count) {
    if (to.z.empty() && to.history.empty())
        system.force(from, trial, f_);
    else
        system.force_and_update(from, trial, f_, to.z, to.history);
    ++count;
}

void ExplicitSubSteps::sub_step(const SemiDiscrete& system, const State& from, double h, double t,
                                const Weights& weights) {
    State& to = next_;
    to.t = t;
    {
        const double half = 0.5 * h, before = h * weights.before, now = h * weights.now;
        const double *u = from.u.data(), *v = from.v.data(), *a = a_new_.data(), *a_before = a_before_.data();
        double *u_to = to.u.data(), *v_to = to.v.data(), *right = right_.data();
        parallel_ranges(a_new_.size(), [=](std::size_t first, std::size_t last) {
#pragma omp simd
            for (std::size_t i = first; i < last; ++i) {
                right[i] = v[i] + now * a[i] + before * a_before[i];
                v_to[i] = v[i] + h * a[i];
                u_to[i] = u[i] + h * (v[i] + half * a[i]);
            }
        });
    }
    a_before_.swap(a_new_);
    motion_.evaluate(system, t);
    motion_.put(system, to.u, to.v);
    for (int k = 0; k < evaluations_; ++k) {
        evaluate(system, from, Trial::of(to), to);
        kick(system, h * weights.next, h * weights.next, to);
    }
    accelerate(system, to.v);
    system.add_path_energies(from, to);
    reactions_before_.swap(reactions_new_);
    motion_.reactions(system, to.v, f_, reactions_new_);
    add_support_work(system, reactions_before_, reactions_new_, from, to);
}

void ExplicitSubSteps::subtract_damping_rate(const SemiDiscrete& system, double w, std::span<const double> v,
                                             std::span<double> rate) const {
    const double wc = w * system.damping().mass_proportional;
    if (wc != 0)
        parallel_ranges(rate.size(), [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) rate[i] -= wc * v[i];
        });
    for (const AbsorbingNode& node : absorbing_) {
        const std::size_t x = node.x(), y = node.y();
        rate[x] -= w * inverse_mass_[x] * (node.block.xx * v[x] + node.block.xy * v[y]);
        rate[y] -= w * inverse_mass_[y] * (node.block.xy * v[x] + node.block.yy * v[y]);
    }
}

void ExplicitSubSteps::kick(const SemiDiscrete& system, double w, double w_force, State& to) {
    const double c = system.damping().mass_proportional, inverse_damping = 1 / (1 + w * c);
    const double *right = right_.data(), *f = f_.data(), *inverse_mass = inverse_mass_.data();
    double* v = to.v.data();
    parallel_ranges(f_.size(), [=](std::size_t first, std::size_t last) {
#pragma omp simd
        for (std::size_t i = first; i < last; ++i)
            v[i] = (right[i] + w_force * (inverse_mass[i] * f[i])) * inverse_damping;
    });
    motion_.put(system, to.u, to.v);
    for (const AbsorbingNode& node : absorbing_) {
        const std::size_t x = node.x(), y = node.y();
        node.solve(c, w, inverse_mass_,
                   {right[x] + w_force * inverse_mass[x] * f[x], right[y] + w_force * inverse_mass[y] * f[y]}, to.v);
    }
}

void ExplicitSubSteps::accelerate(const SemiDiscrete& system, std::span<const double> v) {
    const double *f = f_.data(), *inverse_mass = inverse_mass_.data();
    double* a = a_new_.data();
    parallel_ranges(f_.size(), [=](std::size_t first, std::size_t last) {
#pragma omp simd
        for (std::size_t i = first; i < last; ++i) a[i] = inverse_mass[i] * f[i];
    });
    subtract_damping_rate(system, 1, v, a_new_);
    for (const Constraint& constraint : system.constraints()) a_new_[constraint.dof] = 0;
}

double ExplicitSubSteps::kinetic_energy(const SemiDiscrete& system, const State& state) const {
    const double synchronised = synchronised_kinetic_energy(system, state.v, partial_);
    return has_excess() ? synchronised - energy_.excess(step_.dt(), a_, inverse_mass_, partial_) : synchronised;
}

IntegratorMemory ExplicitSubSteps::save() const {
    IntegratorMemory memory{{"acceleration", a_}, {"reactions", reactions_}, {"omega", {omega_}}};
    step_.save(memory);
    energy_.save(memory);
    return memory;
}

void ExplicitSubSteps::load(const SemiDiscrete& system, State&, const IntegratorMemory& memory) {
    const auto take_entry = [&](const char* entry, std::size_t size) -> const std::vector<double>& {
        return remembered(memory, name(), entry, size);
    };
    omega_ = take_entry("omega", 1)[0];
    allocate(system);
    a_ = take_entry("acceleration", a_.size());
    reactions_ = take_entry("reactions", reactions_.size());
    step_.load(name(), memory, damping_rate(system));
    energy_.load(name(), memory);
}

}  // namespace gneiss
