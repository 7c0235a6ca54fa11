#pragma once
// Magnitudes of displacement, velocity and internal variables against which a relative tolerance is measured: given, or
// taken from the problem. A tolerance relative to each component's own value would follow the smallest motion of the
// farthest node; an absolute one would have to be guessed for every problem.

#include <vector>

#include "base/errors.hpp"
#include "system/semi_discrete.hpp"

namespace gneiss {

class ProblemScales {
public:
    /// What is given stays; 0: from the problem.
    struct Given {
        double displacement = 0;  ///< m
        double velocity = 0;      ///< m/s
        double internal = 0;      ///< Pa, of internal variables

        /// Adds what is wrong, under "integrator.".
        void check(std::vector<Problem>& problems) const;

        friend bool operator==(const Given&, const Given&) = default;
    };

    ProblemScales() = default;
    explicit ProblemScales(const Given& given) : given_(given) {}

    /// Before there is motion: what the largest acceleration of the loads now, or 10/omega from
    /// now, does to a single node within 1/omega. Scales that have been larger stay.
    /// @param omega         upper bound of the natural frequencies, rad/s
    /// @param supports      velocities of prescribed motion, m/s
    /// @return how often it has evaluated forces
    std::size_t start(const SemiDiscrete& system, const State& state, double omega, std::span<const double> supports);
    /// They grow with the largest value so far.
    void include(const State& accepted);

    double displacement() const { return scales_[0]; }
    double velocity() const { return scales_[1]; }
    double internal() const { return scales_[2]; }
    /// 1, or 0 for internal variables that are only counted, shape (n_internal).
    std::span<const double> internal_weights() const { return weights_; }

    std::vector<double> save() const { return scales_; }
    void load(const SemiDiscrete& system, const std::vector<double>& scales);

private:
    void grow(std::size_t kind, double value);

    Given given_;
    std::vector<double> scales_{0, 0, 0};
    std::vector<double> weights_;
};

}  // namespace gneiss
