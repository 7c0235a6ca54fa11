#include "integrators/dynamic_relaxation.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"

namespace gneiss {
namespace {

constexpr double ahead = 0.1;  // beta/h
constexpr double margin = 0.95;
// Prescribed motion comes in no faster than this part of an edge in an iteration. Waves of pressure pass about an edge
// in an iteration, so that the strain in their fronts is about as large; waves of shear are slower, the strain larger.
constexpr double edges_per_iteration = 1e-3;
// The first renewal of masses, then each after this many times as many iterations: a cost of nothing in the long run.
constexpr std::size_t first_renewal = 32, renewal_factor = 2;

/// Tells when forces out of balance have come down to round-off.
class Standstill {
public:
    /// @return whether the forces have been small, and not halved, for half of all iterations so far
    bool reached(std::size_t iteration, double unbalanced) {
        constexpr double small = 1e-6;
        constexpr std::size_t shortest_wait = 2000;  // of a small problem: many periods of its lowest mode
        least_ = std::min(least_, unbalanced);
        if (unbalanced < 0.5 * halved_) {
            halved_ = unbalanced;
            when_ = iteration;
        }
        return least_ < small && iteration - when_ > std::max(shortest_wait, when_);
    }
    double least() const { return least_; }

private:
    double least_ = std::numeric_limits<double>::infinity(), halved_ = least_;
    std::size_t when_ = 0;
};

/// The largest stable step for the largest eigenvalue of D^-1 K: with forces at u + beta v, of an undamped mode,
/// h^2 lambda (1 + 2 beta/h) <= 4, from an eigenvalue -1 of the recursion.
double stable_step(double eigenvalue) { return 2 * std::sqrt(margin / ((1 + 2 * ahead) * eigenvalue)); }

}  // namespace

void DynamicRelaxation::Measures::add(const Measures& other) {
    work += other.work;
    inertia += other.inertia;
    largest = std::max(largest, other.largest);
    largest_free = std::max(largest_free, other.largest_free);
}

DynamicRelaxation::DynamicRelaxation(const Options& options)
    : LoadStepping(options, scheme_defaults::relaxation_iterations) {}

void DynamicRelaxation::allocate(const SemiDiscrete& system) {
    const std::size_t n = system.layout().n_dof;
    for (auto* values : {&mass_, &mobility_, &u_, &v_, &step_, &f_before_}) values->assign(n, 0.0);
    partial_.resize((n + parallel_range - 1) / parallel_range);
}

void DynamicRelaxation::renew_masses(const SemiDiscrete& system, const State& state) {
    system.stiffness_bound(state, trial(), mass_);
    for (std::size_t i = 0; i < mass_.size(); ++i) mobility_[i] = 1 / mass_[i];
    for (const Constraint& constraint : system.constraints()) mobility_[constraint.dof] = 0;
}

auto DynamicRelaxation::measure() -> Measures {
    const double *f = f_.data(), *before = f_before_.data(), *step = step_.data();
    const double *mass = mass_.data(), *mobility = mobility_.data();
    parallel_ranges(f_.size(), [=, this](std::size_t first, std::size_t last) {
        double work = 0, inertia = 0, largest = 0, largest_free = 0;
#pragma omp simd reduction(+ : work, inertia) reduction(max : largest, largest_free)
        for (std::size_t i = first; i < last; ++i) {
            work += step[i] * (before[i] - f[i]);
            inertia += step[i] * mass[i] * step[i];
            const double size = std::abs(f[i]);
            largest = std::max(largest, size);
            largest_free = std::max(largest_free, mobility[i] > 0 ? size : 0.0);
        }
        partial_[first / parallel_range] = {work, inertia, largest, largest_free};
    });
    Measures all;
    for (const Measures& part : partial_) all.add(part);
    return all;
}

void DynamicRelaxation::move(double c, double h) {
    const double kept = (2 - c * h) / (2 + c * h), gained = 2 * h / (2 + c * h);
    const double *f = f_.data(), *mobility = mobility_.data();
    double *u = u_.data(), *v = v_.data(), *step = step_.data(), *before = f_before_.data(), *next = next_.u.data();
    parallel_ranges(f_.size(), [=](std::size_t first, std::size_t last) {
#pragma omp simd
        for (std::size_t i = first; i < last; ++i) {
            v[i] = kept * v[i] + gained * mobility[i] * f[i];
            u[i] += h * v[i];
            const double to = u[i] + ahead * h * v[i];
            step[i] = to - next[i];
            next[i] = to;
            before[i] = f[i];
        }
    });
}

void DynamicRelaxation::prescribe(const SemiDiscrete& system, const State& state, double part) {
    const auto constraints = system.constraints();
    for (std::size_t k = 0; k < constraints.size(); ++k) {
        const std::size_t dof = constraints[k].dof;
        const double before = next_.u[dof];
        next_.u[dof] = state.u[dof] + part * change_[k];
        step_[dof] += next_.u[dof] - before;
    }
}

bool DynamicRelaxation::solve(const SemiDiscrete& system, const State& state) {
    double largest_change = 0;
    for (const double change : change_) largest_change = std::max(largest_change, std::abs(change));
    const double ramp = std::ceil(largest_change / (edges_per_iteration * system.smallest_length()));
    std::ranges::copy(state.u, u_.begin());
    std::ranges::fill(v_, 0.0);
    std::ranges::fill(step_, 0.0);
    renew_masses(system, state);

    double c = 0, eigenvalue = 1, largest_before = 0;
    std::size_t renewal = first_renewal;
    Standstill standstill;
    for (std::size_t k = 0;; ++k) {
        evaluate(system, state);
        Measures now = measure();
        if (k == 0) largest_before = now.largest;  // supports, and loads out of balance before the step
        largest_force_ = std::max(largest_before, now.largest);
        const double unbalanced = largest_force_ > 0 ? now.largest_free / largest_force_ : 0;
        const bool all_in = static_cast<double>(k) >= ramp;
        if (all_in && unbalanced <= options().tolerance) break;
        tell({next_.t, k, unbalanced});
        if (!std::isfinite(now.work) || !std::isfinite(now.largest))
            throw RecoverableError(fmt::format("forces grow without limit after {} iterations", k));
        if (k == static_cast<std::size_t>(options().most_iterations))
            throw Exhausted(
                fmt::format("not at rest after {} iterations, {:.3g} of the forces out of balance", k, unbalanced));
        if (all_in && standstill.reached(k, unbalanced)) {
            constexpr double near = 10;
            if (unbalanced <= near * options().tolerance) break;
            throw Exhausted(fmt::format(
                "{:.3g} of the forces remain out of balance, by round-off: tolerance = {:.3g} cannot be reached",
                standstill.least(), options().tolerance));
        }

        if (k == renewal || now.quotient() > eigenvalue) {
            renew_masses(system, state);
            now = measure();
            // loads that follow the solid, which the masses do not know of
            if (now.quotient() > eigenvalue) eigenvalue = 1.1 * now.quotient();
            if (k == renewal) renewal *= renewal_factor;
        }
        const double h = stable_step(eigenvalue);
        if (now.quotient() > 0) c = std::min(2 * std::sqrt(now.quotient()), 1.9 / h);
        move(c, h);
        prescribe(system, state, std::min(1.0, static_cast<double>(k + 1) / ramp));
        ++counts_.iterations;
    }
    return true;
}

}  // namespace gneiss
