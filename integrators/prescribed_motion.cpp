#include "integrators/prescribed_motion.hpp"

#include <algorithm>

#include "integrators/mass_and_damping.hpp"

namespace gneiss {
namespace {

/// Part of 1/omega: the truncation error, its fourth power, and round-off over it are both below 1e-9 of what moves at
/// omega, and loads are slower.
constexpr double spacing_of_values = 3e-3;

/// Derivatives at x of the polynomials that are 1 at one of 0, 1, 2, 3, 4 and 0 at the others.
template <std::size_t n>
std::array<double, n> first_derivative(double x) {
    std::array<double, n> weights{};
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t m = 0; m < n; ++m) {
            if (m == j) continue;
            double product = 1 / (static_cast<double>(j) - static_cast<double>(m));
            for (std::size_t l = 0; l < n; ++l)
                if (l != j && l != m)
                    product *= (x - static_cast<double>(l)) / (static_cast<double>(j) - static_cast<double>(l));
            weights[j] += product;
        }
    }
    return weights;
}

/// The second derivatives: the first one is of degree n - 2, and known at the same points.
template <std::size_t n>
std::array<double, n> second_derivative(double x) {
    std::array<double, n> weights{};
    const std::array<double, n> outer = first_derivative<n>(x);
    for (std::size_t k = 0; k < n; ++k) {
        const std::array<double, n> inner = first_derivative<n>(static_cast<double>(k));
        for (std::size_t j = 0; j < n; ++j) weights[j] += outer[k] * inner[j];
    }
    return weights;
}

// Gauss-Legendre, five points on (0, 1): Abramowitz and Stegun (1964), table 25.4
constexpr std::array<double, 5> gauss_points{0.5 - 0.5 * 0.906179845938663993, 0.5 - 0.5 * 0.538469310105683091, 0.5,
                                             0.5 + 0.5 * 0.538469310105683091, 0.5 + 0.5 * 0.906179845938663993};
constexpr std::array<double, 5> gauss_weights{0.5 * 0.236926885056189088, 0.5 * 0.478628670499366468,
                                              0.5 * 0.568888888888888889, 0.5 * 0.478628670499366468,
                                              0.5 * 0.236926885056189088};

}  // namespace

void add_travel(const SemiDiscrete& system, double t0, double t, double last_event, std::span<double> scratch,
                std::span<double> u) {
    const auto constraints = system.constraints();
    const auto is_velocity = [](const Constraint& c) { return c.kind == Constraint::Kind::velocity; };
    if (t == t0 || std::ranges::none_of(constraints, is_velocity)) return;
    for (std::size_t i = 0; i < gauss_points.size(); ++i) {
        system.constraint_values(t0 + gauss_points[i] * (t - t0), last_event, scratch);
        for (std::size_t k = 0; k < constraints.size(); ++k)
            if (is_velocity(constraints[k])) u[k] += gauss_weights[i] * (t - t0) * scratch[k];
    }
}

void PrescribedMotion::bind(const SemiDiscrete& system, double omega) {
    const auto constraints = system.constraints();
    spacing_ = spacing_of_values / omega;
    for (auto* values : {&start_, &u_, &v_, &a_, &scratch_}) values->assign(constraints.size(), 0.0);
    for (auto& values : values_) values.assign(constraints.size(), 0.0);
}

void PrescribedMotion::step_from(const SemiDiscrete& system, const State& accepted) {
    t0_ = accepted.t;
    last_event_ = accepted.last_event;
    for (std::size_t k = 0; k < start_.size(); ++k) start_[k] = accepted.u[system.constraints()[k].dof];
}

std::size_t PrescribedMotion::hold(const SemiDiscrete& system, State& state, StartReason why) {
    step_from(system, state);
    const auto constraints = system.constraints();
    if (constraints.empty() || why == StartReason::recover) return 0;
    evaluate(system, state.t);
    bool strained = false;
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const std::size_t dof = constraints[k].dof;
        const double before = state.v[dof];
        state.v[dof] = v_[k];
        if (why == StartReason::fresh) {
            strained = strained || state.u[dof] != u_[k];
            state.u[dof] = u_[k];
        } else {
            // a jump of the velocity is work of the support; before the first step it belongs to the initial energy
            state.path.support_work += 0.5 * system.lumped_mass()[dof] * (v_[k] * v_[k] - before * before);
        }
    }
    const bool updates = strained && !(state.z.empty() && state.history.empty());
    if (updates) {
        std::vector<double> f(state.u.size()), z(state.z.size()), history(state.history.size());
        system.force_and_update(state, Trial::of(state), f, z, history);
        state.z = std::move(z);
        state.history = std::move(history);
    }
    step_from(system, state);
    return updates ? 1 : 0;
}

double PrescribedMotion::sample(const SemiDiscrete& system, double t) {
    const double first = std::min(t, std::max(t0_, t - static_cast<double>(n_points - 1) * spacing_));
    for (std::size_t k = 0; k < n_points; ++k)
        system.constraint_values(first + static_cast<double>(k) * spacing_, last_event_, values_[k]);
    return (t - first) / spacing_;
}

void PrescribedMotion::evaluate(const SemiDiscrete& system, double t) {
    const auto constraints = system.constraints();
    t_ = t;
    if (constraints.empty()) return;
    system.constraint_values(t, last_event_, scratch_);
    const std::array<double, n_points> derivative = first_derivative<n_points>(sample(system, t));
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        if (constraints[k].kind == Constraint::Kind::velocity) {
            u_[k] = start_[k];
            v_[k] = scratch_[k];
        } else {
            u_[k] = scratch_[k];
            v_[k] = 0;
            for (std::size_t i = 0; i < n_points; ++i) v_[k] += derivative[i] / spacing_ * values_[i][k];
        }
    }
    add_travel(system, t0_, t, last_event_, scratch_, u_);
}

std::span<const double> PrescribedMotion::acceleration(const SemiDiscrete& system) {
    const auto constraints = system.constraints();
    if (constraints.empty()) return {};
    const double place = sample(system, t_);
    const auto first = first_derivative<n_points>(place), second = second_derivative<n_points>(place);
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const bool velocity = constraints[k].kind == Constraint::Kind::velocity;
        a_[k] = 0;
        for (std::size_t i = 0; i < n_points; ++i)
            a_[k] += (velocity ? first[i] : second[i] / spacing_) / spacing_ * values_[i][k];
    }
    return a_;
}

void PrescribedMotion::put(const SemiDiscrete& system, std::span<double> u, std::span<double> v) const {
    const auto constraints = system.constraints();
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        u[constraints[k].dof] = u_[k];
        v[constraints[k].dof] = v_[k];
    }
}

void PrescribedMotion::reactions(const SemiDiscrete& system, std::span<const double> v, std::span<const double> f,
                                 std::span<double> reactions) {
    const auto constraints = system.constraints();
    if (constraints.empty()) return;
    const auto a = acceleration(system);
    const auto mass = system.lumped_mass();
    net_.assign(f.begin(), f.end());
    subtract_damping(system, v, net_);
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const std::size_t dof = constraints[k].dof;
        reactions[k] = mass[dof] * a[k] - net_[dof];
    }
}

void PrescribedMotion::accelerations(const SemiDiscrete& system, std::span<const double> v, std::span<double> f,
                                     std::span<double> a) {
    subtract_damping(system, v, f);
    const auto mass = system.lumped_mass();
    for (std::size_t i = 0; i < a.size(); ++i) a[i] = f[i] / mass[i];
    put_acceleration(system, a);
}

void PrescribedMotion::put_acceleration(const SemiDiscrete& system, std::span<double> a) {
    const auto constraints = system.constraints();
    const auto supports = acceleration(system);
    for (std::size_t k = 0; k < constraints.size(); ++k) a[constraints[k].dof] = supports[k];
}

void add_support_work(const SemiDiscrete& system, std::span<const double> before, std::span<const double> after,
                      const State& from, State& to) {
    const auto constraints = system.constraints();
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const std::size_t dof = constraints[k].dof;
        to.path.support_work += 0.5 * (before[k] + after[k]) * (to.u[dof] - from.u[dof]);
    }
}

}  // namespace gneiss
