#include "support/oscillator.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace gneiss::test {

Oscillator::Oscillator(OscillatorModel model) : model_(std::move(model)), tangent_(*this) {
    for (const auto& motion : model_.prescribed) constraints_.push_back(motion.constraint);
    mass_.assign(model_.mass.data(), model_.mass.data() + model_.mass.size());
    if (std::isfinite(model_.switch_time)) events_.push_back(std::make_unique<Switch>(model_.switch_time));
    if (model_.bound.omega == 0) model_.bound = exact_bound();
}

FrequencyBound Oscillator::exact_bound() const {
    const Vector scale = model_.mass.cwiseSqrt().cwiseInverse();
    const auto largest = [&](const Matrix& a) {
        const Matrix scaled = scale.asDiagonal() * a * scale.asDiagonal();
        return Eigen::SelfAdjointEigenSolver<Matrix>(scaled).eigenvalues().maxCoeff();
    };
    return {std::sqrt(largest(model_.stiffness)), model_.viscosity.size() > 0 ? largest(model_.viscosity) : 0.0};
}

State Oscillator::initial_state() const {
    State state;
    const auto n = static_cast<Eigen::Index>(mass_.size());
    const Vector u = model_.initial_u.size() > 0 ? model_.initial_u : Vector::Zero(n);
    const Vector v = model_.initial_v.size() > 0 ? model_.initial_v : Vector::Zero(n);
    state.u.assign(u.data(), u.data() + n);
    state.v.assign(v.data(), v.data() + n);
    state.z.assign(n_internal(), 0.0);
    return state;
}

void Oscillator::constraint_values(double t, double, std::span<double> values) const {
    for (std::size_t k = 0; k < constraints_.size(); ++k)
        values[k] = constraints_[k].kind == Constraint::Kind::displacement ? model_.prescribed[k].u(t)
                                                                           : model_.prescribed[k].v(t);
}

void Oscillator::force(const State& accepted, const Trial& trial, std::span<double> f) const {
    ++n_evaluations_;
    if (until_failure_-- == 0 || broken_) throw RecoverableError("told to fail");
    const Vector z = trial.z.empty() ? updated(accepted, trial) : vector(trial.z);
    const Vector force = applied(trial.t, trial.last_event >= model_.switch_time, vector(trial.u), vector(trial.v), z);
    std::copy(force.data(), force.data() + force.size(), f.begin());
}

void Oscillator::force_and_update(const State& accepted, const Trial& trial, std::span<double> f, std::span<double> z,
                                  std::span<double>) const {
    force(accepted, trial, f);
    const Vector update = updated(accepted, trial);
    std::copy(update.data(), update.data() + update.size(), z.begin());
}

void Oscillator::external_force(const Trial& trial, std::span<double> f) const {
    std::ranges::fill(f, 0.0);
    if (!model_.load) return;
    const Vector load = model_.load(trial.t, trial.last_event >= model_.switch_time);
    std::copy(load.data(), load.data() + load.size(), f.begin());
}

void Oscillator::interaction_force(const State&, const Trial& trial, std::span<double> f, std::span<double>) const {
    const Vector force = model_.interactions.size() > 0 ? Vector(-model_.interactions * vector(trial.u))
                                                        : Vector(-0.5 * model_.stiffness * vector(trial.u));
    std::copy(force.data(), force.data() + force.size(), f.begin());
}

void Oscillator::internal_rate(const State&, const Trial& trial, std::span<double> rate) const {
    const Vector z_rate = maxwell_rate(vector(trial.v), vector(trial.z));
    std::copy(z_rate.data(), z_rate.data() + z_rate.size(), rate.begin());
}

StoredEnergies Oscillator::stored_energies(const State& state) const {
    StoredEnergies energies;
    energies.material = 0.5 * vector(state.u).dot(model_.stiffness * vector(state.u));
    return energies;
}

void Oscillator::add_path_energies(const State& from, State& to) const {
    to.path = from.path;
    const Vector du = vector(to.u) - vector(from.u), v_sum = vector(from.v) + vector(to.v);
    to.path.damping += 0.5 * v_sum.dot(nodal_damping() * du);
    if (model_.load) {
        const bool switched = from.last_event >= model_.switch_time;  // the step ends before the switch
        to.path.external_work += 0.5 * du.dot(model_.load(from.t, switched) + model_.load(to.t, switched));
    }
}

Vector Oscillator::applied(double t, bool switched, const Vector& u, const Vector& v, const Vector& z) const {
    Vector f = -(model_.stiffness * u);
    if (model_.load) f += model_.load(t, switched);
    if (model_.viscosity.size() > 0) f -= model_.viscosity * v;
    if (n_internal() > 0) f -= model_.maxwell.transpose() * z;
    return f;
}

Vector Oscillator::maxwell_rate(const Vector& v, const Vector& z) const {
    return model_.maxwell_stiffness * (model_.maxwell * v) - z / model_.relaxation_time;
}

Matrix Oscillator::nodal_damping() const {
    Matrix c = model_.damping.mass_proportional * Matrix(model_.mass.asDiagonal());
    for (const Damping::Block& block : model_.damping.blocks) {
        const Eigen::Index x = 2 * static_cast<Eigen::Index>(block.node);
        c(x, x) += block.xx;
        c(x, x + 1) += block.xy;
        c(x + 1, x) += block.xy;
        c(x + 1, x + 1) += block.yy;
    }
    return c;
}

Eigen::Map<const Vector> Oscillator::vector(std::span<const double> values) {
    return {values.data(), static_cast<Eigen::Index>(values.size())};
}

double Oscillator::update_stiffness(double dt) const {
    const double x = dt / model_.relaxation_time;
    return model_.maxwell_stiffness * (x != 0 ? -std::expm1(-x) / x : 1.0);  // the mean of exp(-s x) over the step
}

Vector Oscillator::updated(const State& accepted, const Trial& trial) const {
    if (n_internal() == 0) return {};
    const double dt = trial.t - accepted.t;
    return std::exp(-dt / model_.relaxation_time) * vector(accepted.z) +
           update_stiffness(dt) * (model_.maxwell * (vector(trial.u) - vector(accepted.u)));
}

Oscillator::DenseTangent::DenseTangent(const Oscillator& system) : system_(system) {
    const auto n = system.model().mass.size();
    for (Eigen::Index row = 0; row <= n; ++row) pattern_.row_starts.push_back(row * n);
    for (Eigen::Index k = 0; k < n * n; ++k) pattern_.columns.push_back(k % n);
}

void Oscillator::DenseTangent::assemble(const State& accepted, const Trial& trial, const Factors& factors,
                                        std::span<double> values) const {
    const OscillatorModel& model = system_.model();
    Matrix sum = factors.mass * Matrix(model.mass.asDiagonal()) + factors.damping * system_.nodal_damping();
    sum += factors.stiffness * model.stiffness;
    if (trial.z.empty() && model.maxwell.rows() > 0)
        sum += factors.stiffness * system_.update_stiffness(trial.t - accepted.t) * model.maxwell.transpose() *
               model.maxwell;
    if (model.viscosity.size() > 0) sum += factors.velocity * model.viscosity;
    Eigen::Map<Eigen::Matrix<double, -1, -1, Eigen::RowMajor>>(values.data(), sum.rows(), sum.cols()) = sum;
}

void Oscillator::DenseTangent::assemble_diagonal(const State& accepted, const Trial& trial, const Factors& factors,
                                                 std::span<double> diagonal) const {
    std::vector<double> values(n_nonzero());
    assemble(accepted, trial, factors, values);
    for (std::size_t i = 0; i < diagonal.size(); ++i) diagonal[i] = values[i * (diagonal.size() + 1)];
}

State runge_kutta(const Oscillator& system, double t_end, double dt) {
    State state = system.initial_state();
    const OscillatorModel& model = system.model();
    Vector u = Oscillator::vector(state.u), v = Oscillator::vector(state.v), z = Oscillator::vector(state.z);
    const Matrix damping = system.nodal_damping();
    const auto hold = [&](double t, Vector& displacement, Vector& velocity) {
        for (const auto& motion : model.prescribed) {
            const auto dof = static_cast<Eigen::Index>(motion.constraint.dof);
            displacement[dof] = motion.u(t);
            velocity[dof] = motion.v(t);
        }
    };
    struct Rates {
        Vector u, v, z;
    };
    const auto rates = [&](double t, bool switched, Vector u_t, Vector v_t, const Vector& z_t) {
        hold(t, u_t, v_t);
        Vector a = (system.applied(t, switched, u_t, v_t, z_t) - damping * v_t).cwiseQuotient(model.mass);
        for (const auto& motion : model.prescribed) a[static_cast<Eigen::Index>(motion.constraint.dof)] = motion.a(t);
        return Rates{v_t, a, z_t.size() > 0 ? system.maxwell_rate(v_t, z_t) : Vector(z_t)};
    };
    const auto march = [&](double from, double to, bool switched) {
        const auto n = static_cast<int>(std::ceil((to - from) / dt));
        const double h = (to - from) / n;
        for (int i = 0; i < n; ++i) {
            const double t = from + i * h;
            hold(t, u, v);
            const Rates k1 = rates(t, switched, u, v, z);
            const Rates k2 = rates(t + h / 2, switched, u + h / 2 * k1.u, v + h / 2 * k1.v, z + h / 2 * k1.z);
            const Rates k3 = rates(t + h / 2, switched, u + h / 2 * k2.u, v + h / 2 * k2.v, z + h / 2 * k2.z);
            const Rates k4 = rates(t + h, switched, u + h * k3.u, v + h * k3.v, z + h * k3.z);
            u += h / 6 * (k1.u + 2 * k2.u + 2 * k3.u + k4.u);
            v += h / 6 * (k1.v + 2 * k2.v + 2 * k3.v + k4.v);
            z += h / 6 * (k1.z + 2 * k2.z + 2 * k3.z + k4.z);
        }
        hold(to, u, v);
    };
    const double middle = std::min(model.switch_time, t_end);
    march(0, middle, false);
    if (middle < t_end) march(middle, t_end, true);
    state.t = t_end;
    state.u.assign(u.data(), u.data() + u.size());
    state.v.assign(v.data(), v.data() + v.size());
    state.z.assign(z.data(), z.data() + z.size());
    return state;
}

}  // namespace gneiss::test
