#pragma once
// Local steps of the leapfrog: where elements would not stand the step h, it takes the mean of the acceleration over
// the motion that they would make in shorter steps  [after Diaz and Grote's local time-stepping and its stabilised
// form, as told in Grote and Mitkova, arXiv:1205.0654, and Grote, Michel and Sauter, arXiv:2005.13350; formulas derived
// in docs/decisions/022].
//
// With a_k the accelerations that elements of level k and c_k those that all coarser ones and everything else cause,
// held where level k begins, and h_k = h 2^-k, the mean acceleration of level k and finer at displacements u is
//
//     A_k(u, c_k) = (A' + A'')/2,   A' = A_k+1(u, c_k + a_k(u)),   A'' = A_k+1(u + h_k^2/(8 mu_k) A', c_k + a_k(u)),
//
// and A = c + a(u) at the finest one. For mu = 1 this is the leapfrog's motion in two halves of h_k that starts from
// rest, as a mean; mu below 1 takes the resonances away at which it would be unstable. A_0 depends on u alone, so that
// the leapfrog with it is of order 2, symmetric in time, and conserves an energy of a linear system.

#include <memory>
#include <span>
#include <vector>

#include "integrators/stable_step.hpp"
#include "system/levels.hpp"
#include "system/semi_discrete.hpp"

namespace gneiss {

class LocalSteps {
public:
    /// Of steps with a level's frequencies taken as ElementLevels does, and of any number of levels up to
    /// `most_levels`.
    static constexpr StabilityLimit limit{.omega_dt = 1.8};
    static constexpr int most_levels = 6;

    LocalSteps(std::unique_ptr<Levels> levels, const SemiDiscrete& system);

    const Levels& levels() const { return *levels_; }

    /// Makes f, the forces at a trial, M A_0 for free degrees of freedom.
    /// @param accepted  from which z and history are taken, with the trial's displacements
    /// @param h         longest step that will be taken, s
    /// @throws RecoverableError if an element is inverted
    void average(const SemiDiscrete& system, const State& accepted, const Trial& trial, double h, std::span<double> f);

    /// Evaluations of elements so far, those of whole evaluations left out.
    std::size_t n_evaluated() const { return n_evaluated_; }

private:
    /// Pairs of values at nodes(k).
    struct Level {
        std::vector<std::int32_t> parent;  ///< number of the node among those of the next coarser level
        std::vector<double> inverse_mass;  ///< 0 where the motion is prescribed
        std::vector<double> u, f_start, f;
        std::vector<double> coarser;      ///< c_k
        std::vector<double> first, mean;  ///< A', A''
    };
    Level& of(int level) { return all_[static_cast<std::size_t>(level - 1)]; }
    void evaluate(int level, std::vector<double>& f);
    /// A_k into mean, from u and coarser. At the start forces are those that average() has evaluated already.
    void mean_acceleration(int level, bool at_start);
    /// A' and A'' of level - 1 into first and mean, from u, which it moves, and coarser.
    void two_halves(int level, bool at_start);

    std::unique_ptr<Levels> levels_;
    std::vector<Level> all_;  ///< 1 to the finest
    std::size_t n_evaluated_ = 0;
    // of one call
    const State* accepted_ = nullptr;
    Trial trial_;
    double h_ = 0;
};

}  // namespace gneiss
