#pragma once
// Equilibria under growing loads by dynamic relaxation: the explicit loop, damped, run to rest. Forces alone are
// needed, no tangent.
//
// In a pseudo-time of its own each load step moves fictitious masses D through
//
//     D v' + c D v = f(t, u + beta v),    u' = v
//
// by the leapfrog of central differences, with steps h near the limit of stability. What serves convergence best is
// found on the way [Papadrakakis, CMAME 25 (1981) 35-48: parameters without trial runs; Wood, IJNME 3 (1971) 145-147:
// row sums as masses, which bound the largest eigenvalue by one]:
//
// D, row sums of the elements' stiffness (SemiDiscrete::stiffness_bound()), so that the largest eigenvalue of D^-1 K is
// at most one whatever the mesh and the material: h = 2 but for a margin. Renewed as the solid deforms. c = 2 sqrt(q),
// critical for the lowest mode that still takes part: q is the Rayleigh quotient of the last step, step.(change of -f)
// / step.D step, which is step.K step / step.D step without a K. beta = h/10, a little damping in proportion to
// stiffness: where tangents are not symmetric some of the highest modes grow by themselves, and c alone does not hold
// them.
//
// Error falls by about exp(-2 sqrt(smallest eigenvalue of D^-1 K)) in an iteration: their number goes with the number
// of elements along the solid, and with the square root of the ratio of bulk to shear modulus. Each costs little more
// than one force evaluation. Sums are taken in a fixed order: the same bits for any number of threads.

#include <vector>

#include "integrators/load_stepping.hpp"

namespace gneiss {

class DynamicRelaxation final : public LoadStepping {
public:
    using Options = LoadStepping::Options;

    explicit DynamicRelaxation(const Options& options);

    std::string name() const override { return "dynamic_relaxation"; }

private:
    /// Sums and largest values over all degrees of freedom.
    struct Measures {
        double work = 0, inertia = 0;          ///< step . (change of -f), step . D step
        double largest = 0, largest_free = 0;  ///< |f|, N: of all; of those that are not prescribed

        void add(const Measures& other);
        /// Of Rayleigh, of the last step; 0 where nothing has moved.
        double quotient() const { return inertia > 0 ? work / inertia : 0; }
    };

    void allocate(const SemiDiscrete& system) override;
    bool solve(const SemiDiscrete& system, const State& state) override;

    void renew_masses(const SemiDiscrete& system, const State& state);
    Measures measure();
    /// One step of pseudo-time from the forces f_, into next_.u.
    void move(double c, double h);
    /// Puts in a part of the changes of prescribed displacements. @param part  0 to 1
    void prescribe(const SemiDiscrete& system, const State& state, double part);

    std::vector<double> mass_, mobility_;          ///< D, N/m; 1/D, m/N, and 0 where motion is prescribed
    std::vector<double> u_, v_, step_, f_before_;  ///< step_: of next_.u in the last iteration
    std::vector<Measures> partial_;
};

}  // namespace gneiss
