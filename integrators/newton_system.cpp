#include "integrators/newton_system.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "integrators/free_part.hpp"

namespace gneiss {
namespace {

const Tangent& tangent_of(const SemiDiscrete& system) { return tangent_of(system, "an implicit scheme"); }

}  // namespace

NewtonSystem::NewtonSystem(const SemiDiscrete& system, FirstOrderForm& form, const LinearSolverOptions& solver,
                           SUNContext context)
    : system_(system),
      form_(form),
      free_(free_part(system, tangent_of(system))),
      solver_(make_linear_solver(solver, tangent_of(system).symmetric())),
      damped_(system.force_depends_on_velocity() || system.damping().mass_proportional > 0 ||
              !system.damping().blocks.empty()) {
    const SparsePattern pattern = free_.pattern();
    if (free_.n() > 0) solver_.analyse(pattern);
    const auto mass = system.lumped_mass();
    for (std::size_t row = 0; row < free_.n(); ++row) {
        mass_.push_back(mass[form.free()[row]]);
        const auto begin = pattern.columns.begin();
        const auto found = std::lower_bound(begin + pattern.row_starts[row], begin + pattern.row_starts[row + 1],
                                            static_cast<std::int64_t>(row));
        diagonal_.push_back(static_cast<std::size_t>(found - begin));
    }
    const Layout layout = system.layout();
    full_.resize(tangent_of(system).n_nonzero());
    values_.resize(pattern.n_nonzero());
    right_.resize(free_.n());
    at_.u.resize(layout.n_dof);
    at_.v.resize(layout.n_dof);
    at_.z.resize(layout.n_internal);
    at_.history.resize(layout.n_history);
    if (layout.n_internal > 0) {
        for (auto* values : {&f_, &f_zero_, &v_}) values->assign(layout.n_dof, 0.0);
        for (auto* values : {&z_, &rate_, &rate_zero_}) values->assign(layout.n_internal, 0.0);
    }

    matrix_ = new_matrix(this, context);
    linear_solver_ = new_linear_solver(this, context);
}

void NewtonSystem::take_tangent(const Trial& trial, const Tangent::Factors& factors, std::vector<double>& to) {
    system_.tangent()->assemble(at_, trial, factors, full_);
    to.resize(values_.size());
    free_.take_values(full_, to);
}

void NewtonSystem::linearise(const State& accepted, double t, std::span<const double> y) {
    at_.last_event = accepted.last_event;
    form_.unpack(system_, t, y, at_);
    if (form_.n_internal() > 0) {
        // the memory that accepting u would leave, with the stresses of y
        const Trial updated{t, at_.last_event, at_.u, at_.v, {}};
        system_.force_and_update(accepted, updated, f_, z_, at_.history);
        take_tangent(FirstOrderForm::trial_of(at_, at_.last_event), {.stiffness = 1}, given_);
    } else {
        at_.history = accepted.history;
    }
    const Trial folded{t, at_.last_event, at_.u, at_.v, {}};
    take_tangent(folded, {.stiffness = 1}, folded_);
    beside_ = free_.take(system_.tangent()->beside(at_, folded, {.stiffness = 1}));
    if (damped_) take_tangent(folded, {.damping = 1, .velocity = 1}, damping_);
    ++counts_.linearisations;
}

double NewtonSystem::bytes() const {
    const std::size_t n_matrices = 2 + (damped_ ? 1 : 0) + (form_.n_internal() > 0 ? 1 : 0);  // folded_, values_, ...
    return static_cast<double>((n_matrices * values_.size() + full_.size()) * sizeof(double) + free_.bytes()) +
           (free_.n() > 0 ? solver_.expected_factor_bytes() : 0.0);
}

void NewtonSystem::set_up() {
    if (free_.n() == 0) return;
    const double gamma = gamma_, square = gamma * gamma;
    parallel_ranges(values_.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) values_[k] = square * folded_[k];
        if (damped_)
            for (std::size_t k = first; k < last; ++k) values_[k] += gamma * damping_[k];
    });
    for (std::size_t row = 0; row < diagonal_.size(); ++row) values_[diagonal_[row]] += mass_[row];
    LowRank beside = beside_;
    for (LowRank::Dyad& dyad : beside.dyads) dyad.factor *= square;
    solver_.factorise(values_, beside);
    ++counts_.factorisations;
}

void NewtonSystem::solve(std::span<const double> b, std::span<double> x) {
    const std::size_t n = free_.n();
    if (x.data() != b.data()) std::ranges::copy(b, x.begin());
    if (right_scale_ != 1)
        for (double& value : x) value *= right_scale_;
    const auto x_u = x.first(n), x_v = x.subspan(n, n), x_z = x.subspan(2 * n);
    if (n > 0) {
        multiply(free_.pattern(), form_.n_internal() > 0 ? given_ : folded_, x_u, right_);
        beside_.add_product(1, x_u, right_);
        for (std::size_t i = 0; i < n; ++i) right_[i] = mass_[i] * x_v[i] - gamma_ * right_[i];
        if (form_.n_internal() > 0) add_internal_forces(x_z);
        solver_.solve(right_, x_v);
        for (std::size_t i = 0; i < n; ++i) x_u[i] += gamma_ * x_v[i];
    }
    if (form_.n_internal() > 0) internal_changes(x_z, x_v, x_z);
    ++counts_.solves;
}

void NewtonSystem::add_internal_forces(std::span<const double> b_z) {
    std::ranges::fill(z_, 0.0);
    Trial trial = Trial::of(at_);
    trial.z = z_;
    counts_.evaluations += 2;
    system_.force(at_, trial, f_zero_);
    std::ranges::copy(b_z, z_.begin());
    system_.force(at_, trial, f_);
    const auto free = form_.free();
    for (std::size_t i = 0; i < free.size(); ++i) right_[i] += gamma_ * (f_[free[i]] - f_zero_[free[i]]);
}

void NewtonSystem::internal_changes(std::span<const double> b_z, std::span<const double> dv, std::span<double> x_z) {
    Trial trial = Trial::of(at_);
    trial.z = at_.z;
    trial.v = v_;
    std::ranges::fill(v_, 0.0);
    system_.internal_rate(at_, trial, rate_zero_);
    free_.put(dv, v_);
    system_.internal_rate(at_, trial, rate_);
    for (std::size_t k = 0; k < x_z.size(); ++k) x_z[k] = b_z[k] + gamma_ * (rate_[k] - rate_zero_[k]);
}

}  // namespace gneiss
