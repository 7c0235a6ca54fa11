#pragma once
// Steps of explicit schemes: below a critical step that is looked at anew every so often, and such that they fill the
// time to the next stop evenly.

#include <vector>

#include "base/errors.hpp"
#include "base/scheme_defaults.hpp"
#include "system/integrator.hpp"
#include "system/levels.hpp"

namespace gneiss {

/// What an explicit scheme stands: on x'' + c x' + omega^2 x = 0 steps with (omega dt/W)^2 + c dt/X <= 1 do not grow,
/// W = `omega_dt`, X = `damping_dt`. Exact for the leapfrog and for Noh and Bathe's scheme, on the safe side for
/// compositions of many sub-steps.
struct StabilityLimit {
    double omega_dt = 2;
    double damping_dt = 1;

    /// s.
    double critical_time_step(const FrequencyBound& bound) const;
};

class StableStep {
public:
    struct Options {
        double safety = scheme_defaults::safety;  ///< factor on the critical step, (0, 1]
        double dt = 0;                            ///< fixed step, s; 0: from the critical step
        bool lanczos = false;  ///< bound omega by a Lanczos estimate of the assembled pencil, closer than the elements'

        int bound_interval = 0;  ///< steps between two looks at the bound; 0: adapted to how fast it changes

        /// Adds what is wrong, under "integrator.".
        void check(std::vector<Problem>& problems) const;
        /// @throws InputError
        void validate() const;

        friend bool operator==(const Options&, const Options&) = default;
    };

    StableStep(const Options& options, const StabilityLimit& limit) : options_(options), limit_(limit) {}
    /// From here on the bound is that of steps of elements' own lengths, null: of one step for all.
    void take_levels(const Levels* levels, const StabilityLimit& limit) {
        levels_ = levels;
        limit_ = limit;
    }

    /// Where a run starts or starts anew, before supports are put where they belong.
    /// @param damping_rate  of C, 1/s, where the scheme's stability depends on it: added to the bound's
    void start(const SemiDiscrete& system, const State& state, StartReason why, double damping_rate = 0);
    /// Once they are: they may have strained the solid.
    void supports_held(const SemiDiscrete& system, const State& state, StartReason why);

    /// Looks at the bound if that is due, and chooses the next step, dt().
    /// @throws RecoverableError if the given step is longer than the critical one
    void plan(const SemiDiscrete& system, const State& state, double t_stop);
    /// The step has been taken.
    void count() { ++steps_since_bound_; }
    /// Whether plan() will look at the bound.
    bool look_due() const { return steps_since_bound_ >= bound_interval_; }

    /// Longest step that plan() would choose, s.
    double longest() const { return options_.dt > 0 ? options_.dt : options_.safety * critical_; }
    double dt() const { return dt_; }  ///< last step planned, s; before the first one what it is likely to be
    void set_dt(double dt) { dt_ = dt; }
    /// Critical step of the bound last evaluated, s, without the safety factor.
    double critical_time_step() const { return critical_; }

    /// Bound of the natural frequencies last evaluated, rad/s.
    double omega() const { return bound_.omega; }

    /// Under the names "step" and "bound".
    void save(IntegratorMemory& memory) const;
    void load(const std::string& integrator, const IntegratorMemory& memory, double damping_rate = 0);

private:
    void evaluate_bound(const SemiDiscrete& system, const State& state);
    /// The critical step of bound_.
    void take_bound(const SemiDiscrete& system, const State& state);

    Options options_;
    StabilityLimit limit_;
    const Levels* levels_ = nullptr;
    double dt_ = 0;
    double critical_ = 0;
    double damping_rate_ = 0;  ///< of C, 1/s
    FrequencyBound bound_;
    bool bound_held_ = false;    ///< of the last start: what is new are bonds
    double bound_interval_ = 0;  ///< steps between two evaluations of the bound, adapted to how it changes
    double steps_since_bound_ = 0;
};

}  // namespace gneiss
