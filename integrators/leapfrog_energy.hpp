#pragma once
// The energy that a leapfrog conserves, against that of the state at the ends of its steps.

#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "system/integrator.hpp"

namespace gneiss {

/// Of a linear system the leapfrog conserves 1/2 v(n-1/2) . M v(n+1/2) and the stored energy to round-off: 1/2 v . M v
/// at the end of a step exceeds the first by dt^2/8 a . M a. Of that, what has come since the run began counts: at rest
/// there is no energy, and a step may change under a constant acceleration (free fall) without a trace. What a . M a
/// jumps by where forces do has no time to come, and does not count.
class LeapfrogEnergy {
public:
    /// a . M a, kg m2/s4.
    /// @param partial  scratch
    static double square(std::span<const double> a, std::span<const double> inverse_mass,
                         std::vector<double>& partial) {
        return ordered_sum(a.size(), partial, [&](std::size_t first, std::size_t last) {
            double sum = 0;
            for (std::size_t i = first; i < last; ++i) sum += a[i] * a[i] / inverse_mass[i];
            return sum;
        });
    }

    /// @param before, after  square() before and after forces have jumped; `before` of a new run means nothing
    void start(StartReason why, double before, double after) {
        if (why == StartReason::fresh)
            uncounted_ = after;
        else if (why != StartReason::recover)  // a failed step has left no acceleration
            uncounted_ += after - before;
    }

    /// What 1/2 v . M v counts too much, J.
    double excess(double dt, std::span<const double> a, std::span<const double> inverse_mass,
                  std::vector<double>& partial) const {
        return 0.125 * dt * dt * (square(a, inverse_mass, partial) - uncounted_);
    }

    void save(IntegratorMemory& memory) const { memory["uncounted"] = {uncounted_}; }
    void load(const std::string& integrator, const IntegratorMemory& memory) {
        uncounted_ = remembered(memory, integrator, "uncounted", 1)[0];
    }

private:
    double uncounted_ = 0;  ///< of a . M a, kg m2/s4
};

}  // namespace gneiss
