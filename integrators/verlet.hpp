#pragma once
// Compositions of Störmer-Verlet steps: explicit, symmetric in time, symplectic where forces have a potential.
//
// A step of length h, in its velocity form (kick, drift, kick)
//
//     v(1/2) = v + h/2 M^-1 (f - C v),   u' = u + h v(1/2),   (1 + h/2 M^-1 C) v' = v(1/2) + h/2 M^-1 f'
//
// or in its position form (drift, kick, drift: the leapfrog of positions at halves of steps)
//
//     u(1/2) = u + h/2 v,   (1 + h/2 M^-1 C) v' = (1 - h/2 M^-1 C) v + h M^-1 f(1/2),   u' = u(1/2) + h/2 v'
//
// is undone by a step of length -h. A step of the scheme is one of them, of order 2, or several, of lengths g_i dt with
// sum g_i = 1: of order 4 where sum g_i^3 = 0, which takes g_i < 0  [Yoshida, Phys. Lett. A 150 (1990) 262; Forest and
// Ruth, Physica D 43 (1990) 105; Suzuki, Phys. Lett. A 146 (1990) 319; McLachlan, SIAM J. Sci. Comput. 16 (1995) 151],
// of orders 6, 8 and 10 where more sums vanish  [Yoshida, as above; Suzuki and Umeno, Springer Proc. Phys. 76 (1993)
// 74; Sofroniou and Spaletta, Optim. Methods Softw. 20 (2005) 597].
//
// z follows its exact update along every drift, back in time too. Forces that depend on v are evaluated anew until they
// are symmetric to the scheme's order. What cannot be undone (damage, friction, restitution) refuses steps back.
// Energies of the path are summed sub-step by sub-step, negative ones among them: of the scheme's order, as u and v.

#include <span>
#include <string>
#include <vector>

#include "base/scheme_defaults.hpp"
#include "integrators/explicit_sub_steps.hpp"

namespace gneiss {

/// Lengths of the sub-steps over that of the step, symmetric.
struct VerletComposition {
    const char* name;
    int order;
    std::vector<double> sub_steps;
    StabilityLimit limit;

    bool goes_back() const { return sub_steps.size() > 1; }
};

std::span<const VerletComposition> verlet_compositions();

class Verlet final : public ExplicitSubSteps {
public:
    enum class Form { velocity, position };
    struct Options {
        StableStep::Options step;
        Form form = Form::velocity;
        std::string composition = scheme_defaults::composition;

        /// @throws InputError
        void validate() const;

        friend bool operator==(const Options&, const Options&) = default;
    };

    explicit Verlet(const Options& options);

    std::string name() const override { return "verlet"; }

private:
    void take(const SemiDiscrete& system, const State& state, double dt, double t_end) override;
    /// Steps back in time and what cannot be undone do not go together.
    void check(const SemiDiscrete& system) const override;
    void allocate(const SemiDiscrete& system) override;
    /// Every evaluation at the velocity that the one before has led to leaves the step less unsymmetric by one order;
    /// the first one, at a velocity of order 1, by h^3.
    int evaluations_with_velocity() const override { return composition_.order - 1; }
    bool damping_limits() const override { return composition_.goes_back(); }
    /// A linear system's energy is conserved in 1/2 v(n-1/2) . M v(n+1/2).
    bool has_excess() const override { return options_.form == Form::velocity && !composition_.goes_back(); }

    /// A sub-step in the position form.
    /// @param accepted     the state at the beginning of the whole step
    /// @param first, last  sub-step of it
    void position_form(const SemiDiscrete& system, const State& accepted, const State& from, double h, double t,
                       bool first, bool last);

    Options options_;
    const VerletComposition& composition_;
    State middle_, middle_before_;  ///< of the position form
};

}  // namespace gneiss
