#pragma once
// Multirate infinitesimal methods, MRIStep of SUNDIALS' ARKODE: what parts of the solid exert on each other (contact,
// joints) in short steps, everything else in long ones of fixed length, explicit
// [SUNDIALS' MRIStep; by its names Knoth and Wolke 1998, Sandu 2019: integrators/README.md].
//
//     fast:  u' = v,  v' = M^-1 f_interactions(t, u)          slow:  v' = M^-1 (f - f_interactions - C v),  z' = g
//
// Between the stages of the slow method the fast part is integrated by an explicit Runge-Kutta method, with steps from
// its error estimate, under a polynomial in time that stands for the slow part. The stability of the slow part bounds
// the step, and one that is above is warned of. What contact and joints remember moves on in every short step, what
// materials remember once in a long one.

#include <span>
#include <string>

#include "base/scheme_defaults.hpp"
#include "integrators/sundials_ode.hpp"

namespace gneiss {

/// Coefficients of a slow method, by SUNDIALS' name in small letters.
struct MultirateTable {
    const char* name;
    int id;  ///< SUNDIALS' number
    int order;
    double limit;  ///< of omega dt of the slow part, without damping; measured: integrators/README.md
};

std::span<const MultirateTable> multirate_tables();

class Mri final : public SundialsOde {
public:
    struct Options : SundialsOde::Options {
        std::string table = scheme_defaults::slow_table;
        double dt = 0;  ///< of the slow part, s, > 0

        /// @throws InputError
        void validate() const;

        friend bool operator==(const Options&, const Options&) = default;
    };

    explicit Mri(const Options& options);

    std::string name() const override { return "mri"; }
    /// Between the ends of long steps its polynomial sees nothing of the short ones.
    bool interpolates() const override { return false; }

private:
    void create(double t) override;
    void destroy() override;
    void restart(double t) override;
    int step(double dt, double t_stop, double& t) override;
    int dense(double t, N_Vector at) override;
    double last_step() override;
    std::size_t failed_trials() override;
    std::string flag_name(int flag) override;
    double fixed_step() const override { return options_.dt; }
    std::string doubt(const FrequencyBound& bound) const override;
    using Rates = int (*)(double t, N_Vector y, N_Vector dydt, void* self);
    static Rates slow_rates();
    static Rates fast_rates();

    struct SlowDeleter {
        void operator()(void* memory) const;
    };
    struct FastDeleter {
        void operator()(void* memory) const;
    };
    struct StepperDeleter {
        void operator()(void* stepper) const;
    };

    Options options_;
    const MultirateTable& table_;
    // freed in the reverse order
    std::unique_ptr<void, FastDeleter> fast_;
    std::unique_ptr<void, StepperDeleter> stepper_;
    std::unique_ptr<void, SlowDeleter> slow_;
};

}  // namespace gneiss
