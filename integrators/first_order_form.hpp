#pragma once
// The semi-discrete system as y' = F(t, y) for solvers of ordinary differential equations: y = (u, v) of the free
// degrees of freedom, then z. Prescribed motion is eliminated.

#include <span>
#include <vector>

#include "integrators/prescribed_motion.hpp"
#include "system/semi_discrete.hpp"

namespace gneiss {

class FirstOrderForm {
public:
    /// What of the rates is wanted, for additive and multirate schemes.
    enum class Part {
        all,
        external,             ///< the external forces
        rest,                 ///< all but these
        interactions,         ///< u' = v, and the forces of interactions
        without_interactions  ///< all but these
    };

    /// @param omega  upper bound of the natural frequencies, rad/s
    void bind(const SemiDiscrete& system, double omega);

    std::size_t n_free() const { return free_.size(); }
    std::size_t n_internal() const { return n_internal_; }
    std::size_t size() const { return 2 * n_free() + n_internal(); }
    /// Degrees of freedom of the free ones, ascending.
    std::span<const std::size_t> free() const { return free_; }
    PrescribedMotion& motion() { return motion_; }

    /// @param[out] y  shape (size())
    void pack(const State& state, std::span<double> y) const;
    /// Whether y is what pack() makes of the state.
    bool is_packed(const State& state, std::span<const double> y) const;
    /// @param[out] to  u, v, z and t
    void unpack(const SemiDiscrete& system, double t, std::span<const double> y, State& to);
    /// F(t, y), or a part of it.
    /// @param keep  what has taken all forces, for repeat() and forces_at()
    /// @throws RecoverableError if the forces do
    void rate(const SemiDiscrete& system, const State& accepted, double t, std::span<const double> y, Part part,
              std::span<double> dydt, bool keep = true);

    /// What rate() would give, if it was asked for the same last: a step of a Runge-Kutta method begins where the one
    /// before ended, and that may have been a stage of it, or evaluated for dense output. Not where forces depend on
    /// what the accepted state remembers.
    /// @return whether dydt has been written
    bool repeat(const State& accepted, double t, std::span<const double> y, Part part, std::span<double> dydt) const;
    /// All forces, N, shape (n_dof), without C v, where rate() has taken them last at (t, y); otherwise empty.
    std::span<const double> forces_at(double t, std::span<const double> y) const;
    /// Forces have jumped.
    void forget_forces();

    /// z given where there is one.
    static Trial trial_of(const State& state, double last_event) {
        return {state.t, last_event, state.u, state.v, state.z};
    }

private:
    std::vector<std::size_t> free_;
    std::size_t n_internal_ = 0;
    PrescribedMotion motion_;
    State trial_;
    std::vector<double> f_, part_of_f_;
    double kept_t_ = 0;           ///< s
    double kept_last_event_ = 0;  ///< s
    Part kept_part_ = Part::all;
    std::vector<double> kept_y_, kept_f_, kept_rate_;  ///< of the last rate() of all forces; empty: none
    bool remembers_ = false;                           ///< forces depend on history
};

}  // namespace gneiss
