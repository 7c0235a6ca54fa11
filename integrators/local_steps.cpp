#include "integrators/local_steps.hpp"

#include <algorithm>
#include <cmath>

namespace gneiss {
namespace {

/// What is left of the largest eigenvalue, 4, between levels k and k + 1. Every level has to stand what the finer ones
/// leave of theirs and what they share nodes for, hence less towards the finer ones.
double share(int level) { return 0.96 - 0.03 * level; }

/// Pairs of values of nodes from those that they are numbered by.
void take(const double* from, const std::vector<std::int32_t>& parent, double* to) {
    for (std::size_t n = 0; n < parent.size(); ++n) {
        const auto at = 2 * static_cast<std::size_t>(parent[n]);
        to[2 * n] = from[at];
        to[2 * n + 1] = from[at + 1];
    }
}

/// to = base + factor * values, element by element; to is none of the others.
void add_product(const std::vector<double>& base, const std::vector<double>& factor, const std::vector<double>& values,
                 std::vector<double>& to) {
    const double *b = base.data(), *a = factor.data(), *x = values.data();
    double* y = to.data();
    const std::size_t n = to.size();
#pragma omp simd
    for (std::size_t i = 0; i < n; ++i) y[i] = b[i] + a[i] * x[i];
}

}  // namespace

LocalSteps::LocalSteps(std::unique_ptr<Levels> levels, const SemiDiscrete& system)
    : levels_(std::move(levels)), all_(static_cast<std::size_t>(levels_->finest())) {
    std::vector<double> inverse_mass(system.lumped_mass().begin(), system.lumped_mass().end());
    for (double& value : inverse_mass) value = 1 / value;
    for (const Constraint& constraint : system.constraints()) inverse_mass[constraint.dof] = 0;
    for (int k = 1; k <= levels_->finest(); ++k) {
        Level& level = of(k);
        const auto nodes = levels_->nodes(k);
        for (const std::int32_t node : nodes) {
            if (k == 1) {
                level.parent.push_back(node);
            } else {
                const auto coarser = levels_->nodes(k - 1);
                level.parent.push_back(
                    static_cast<std::int32_t>(std::ranges::lower_bound(coarser, node) - coarser.begin()));
            }
            for (std::size_t c = 0; c < 2; ++c)
                level.inverse_mass.push_back(inverse_mass[2 * static_cast<std::size_t>(node) + c]);
        }
        for (auto* values : {&level.u, &level.f_start, &level.f, &level.coarser, &level.first, &level.mean})
            values->assign(2 * nodes.size(), 0.0);
    }
}

void LocalSteps::average(const SemiDiscrete& system, const State& accepted, const Trial& trial, double h,
                         std::span<double> f) {
    accepted_ = &accepted;
    trial_ = trial;
    h_ = h;
    for (int k = 1; k <= levels_->finest(); ++k) {
        Level& level = of(k);
        take(k == 1 ? trial.u.data() : of(k - 1).u.data(), level.parent, level.u.data());
        evaluate(k, level.f_start);
    }
    // what all of them cause is left out of what they begin with
    for (int k = levels_->finest(); k > 0; --k) {
        Level& level = of(k);
        std::ranges::fill(level.coarser, 0.0);
        add_product(level.coarser, level.inverse_mass, level.f_start, level.mean);
        if (k == levels_->finest()) continue;
        const Level& finer = of(k + 1);
        for (std::size_t i = 0; i < finer.mean.size(); ++i)
            level.mean[2 * static_cast<std::size_t>(finer.parent[i / 2]) + i % 2] += finer.mean[i];
    }
    Level& all = of(1);
    take(f.data(), all.parent, all.f.data());
    for (std::size_t i = 0; i < all.mean.size(); ++i) all.coarser[i] = all.inverse_mass[i] * all.f[i] - all.mean[i];
    two_halves(1, true);
    const auto mass = system.lumped_mass();
    for (std::size_t i = 0; i < all.mean.size(); ++i) {
        const std::size_t dof = 2 * static_cast<std::size_t>(all.parent[i / 2]) + i % 2;
        if (all.inverse_mass[i] > 0) f[dof] = 0.5 * mass[dof] * (all.first[i] + all.mean[i]);
    }
}

void LocalSteps::evaluate(int level, std::vector<double>& f) {
    levels_->force(level, *accepted_, trial_, of(level).u, f);
    n_evaluated_ += levels_->n_elements(level);
}

void LocalSteps::two_halves(int level, bool at_start) {
    Level& own = of(level);
    mean_acceleration(level, at_start);
    own.first.swap(own.mean);
    const double h = std::ldexp(h_, 1 - level), factor = h * h / (8 * share(level - 1));
    double* u = own.u.data();
    const double* first = own.first.data();
    const std::size_t n = own.u.size();
#pragma omp simd
    for (std::size_t i = 0; i < n; ++i) u[i] += factor * first[i];
    mean_acceleration(level, false);
}

void LocalSteps::mean_acceleration(int level, bool at_start) {
    Level& own = of(level);
    if (!at_start) evaluate(level, own.f);
    add_product(own.coarser, own.inverse_mass, at_start ? own.f_start : own.f, own.mean);
    if (level == levels_->finest()) return;
    Level& finer = of(level + 1);
    take(own.u.data(), finer.parent, finer.u.data());
    take(own.mean.data(), finer.parent, finer.coarser.data());
    two_halves(level + 1, at_start);
    double* mean = own.mean.data();
    const double *first = finer.first.data(), *second = finer.mean.data();
    for (std::size_t n = 0; n < finer.parent.size(); ++n) {
        const auto at = 2 * static_cast<std::size_t>(finer.parent[n]);
        mean[at] = 0.5 * (first[2 * n] + second[2 * n]);
        mean[at + 1] = 0.5 * (first[2 * n + 1] + second[2 * n + 1]);
    }
}

}  // namespace gneiss
