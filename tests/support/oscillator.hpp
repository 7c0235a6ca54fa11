#pragma once
// A few masses on springs, dashpots and Maxwell elements: a semi-discrete system with everything an integrator has to
// cope with, small enough for an independent reference solution.
//
//     M a + C v = p(t) - K u - D v - B^T z,      z' = k B v - z/tau

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "base/errors.hpp"
#include "system/semi_discrete.hpp"

namespace gneiss::test {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// A jump of the forces at one instant.
class Switch final : public Event {
public:
    explicit Switch(double time) : time_(time) {}
    std::string name() const override { return "switch"; }
    std::optional<double> next_time(const State& state) const override {
        return state.last_event < time_ ? std::optional(time_) : std::nullopt;
    }
    EventOutcome apply(State& accepted) override {
        accepted.last_event = time_;
        return EventOutcome::reinitialise;
    }

private:
    double time_;
};

/// A prescribed motion with its derivatives; m, m/s, m/s2 against s.
struct PrescribedMotion {
    Constraint constraint;
    std::function<double(double t)> u, v, a;
};

struct OscillatorModel {
    Matrix stiffness;                                              ///< K, N/m, shape (n, n)
    Vector mass;                                                   ///< kg, shape (n)
    Damping damping;                                               ///< C
    Matrix viscosity;                                              ///< D, N s/m, shape (n, n); empty: none
    std::function<Vector(double t, bool switched)> load;           ///< N; empty: none
    double switch_time = std::numeric_limits<double>::infinity();  ///< s; infinite: no event
    Matrix maxwell;                                                ///< B, shape (n_internal, n); empty: none
    double maxwell_stiffness = 0;                                  ///< k, N/m
    double relaxation_time = 1;                                    ///< tau, s
    std::vector<PrescribedMotion> prescribed;                      ///< by ascending degree of freedom
    Vector initial_u, initial_v;                                   ///< m, m/s; empty: zero
    bool has_tangent = true;
    bool irreversible = false;  ///< as declared
    Matrix interactions;        ///< part of K that stands for joints and contact, N/m; empty: half of it
    FrequencyBound bound;       ///< as reported; omega = 0: from K and D
};

class Oscillator final : public SemiDiscrete {
public:
    explicit Oscillator(OscillatorModel model);

    const OscillatorModel& model() const { return model_; }
    /// Largest eigenvalues of M^-1 K and M^-1 D, as frequency and rate.
    FrequencyBound exact_bound() const;
    /// How often all forces have been evaluated.
    std::size_t n_evaluations() const { return n_evaluations_; }
    /// One force evaluation fails, once n have succeeded.
    void fail_after(int n) { until_failure_ = n; }
    /// Every force evaluation fails.
    void fail_from_now_on() { broken_ = true; }

    Layout layout() const override { return {mass_.size(), n_internal(), 0}; }
    State initial_state() const override;
    std::span<const double> lumped_mass() const override { return mass_; }
    const Damping& damping() const override { return model_.damping; }
    std::span<const Constraint> constraints() const override { return constraints_; }
    void constraint_values(double t, double, std::span<double> values) const override;
    bool force_depends_on_velocity() const override { return model_.viscosity.size() > 0; }
    bool irreversible() const override { return model_.irreversible; }

    void force(const State& accepted, const Trial& trial, std::span<double> f) const override;
    void force_and_update(const State& accepted, const Trial& trial, std::span<double> f, std::span<double> z,
                          std::span<double>) const override;
    void external_force(const Trial& trial, std::span<double> f) const override;
    using SemiDiscrete::interaction_force;
    void interaction_force(const State&, const Trial& trial, std::span<double> f, std::span<double>) const override;
    void internal_weights(std::span<double> weights) const override { std::ranges::fill(weights, 1.0); }
    void internal_rate(const State&, const Trial& trial, std::span<double> rate) const override;
    double smallest_length() const override { return 1; }
    const Tangent* tangent() const override { return model_.has_tangent ? &tangent_ : nullptr; }
    FrequencyBound frequency_bound(const State&) const override { return model_.bound; }
    StoredEnergies stored_energies(const State& state) const override;
    void add_path_energies(const State& from, State& to) const override;
    std::span<const std::unique_ptr<Event>> events() const override { return events_; }

    // ---- the same equations for a reference solution
    // ------------------------------------------------------------------

    Vector applied(double t, bool switched, const Vector& u, const Vector& v, const Vector& z) const;
    Vector maxwell_rate(const Vector& v, const Vector& z) const;
    /// C as a full matrix.
    Matrix nodal_damping() const;
    static Eigen::Map<const Vector> vector(std::span<const double> values);

private:
    /// As a full matrix in compressed rows.
    class DenseTangent final : public Tangent {
    public:
        explicit DenseTangent(const Oscillator& system);
        bool symmetric() const override { return true; }
        std::size_t n_nonzero() const override { return pattern_.columns.size(); }
        MatrixPattern pattern() const override { return pattern_; }
        void assemble(const State& accepted, const Trial& trial, const Factors& factors,
                      std::span<double> values) const override;

        void assemble_diagonal(const State& accepted, const Trial& trial, const Factors& factors,
                               std::span<double> diagonal) const override;

    private:
        const Oscillator& system_;
        MatrixPattern pattern_;
    };

    std::size_t n_internal() const { return static_cast<std::size_t>(model_.maxwell.rows()); }

    /// dz/d(B u) of a step of length dt along which B u grows linearly.
    double update_stiffness(double dt) const;
    /// z at the end of such a step.
    Vector updated(const State& accepted, const Trial& trial) const;

    OscillatorModel model_;
    std::vector<Constraint> constraints_;
    std::vector<double> mass_;
    std::vector<std::unique_ptr<Event>> events_;
    mutable int until_failure_ = -1;
    mutable std::size_t n_evaluations_ = 0;
    bool broken_ = false;
    DenseTangent tangent_;
};

/// u, v and z of the oscillator at time t by the classic Runge-Kutta method with steps of at most dt that end at the
/// switch: an independent method of order 4.
State runge_kutta(const Oscillator& system, double t_end, double dt);

}  // namespace gneiss::test
