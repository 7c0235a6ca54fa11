#pragma once
// ARKODE of SUNDIALS: Runge-Kutta methods, explicit, diagonally implicit, and additive pairs of both, by the name of
// their table  [Reynolds et al., ACM TOMS 49 (2023) 1].
//
// Additive pairs leave the external forces to their explicit half and everything else to the implicit one.

#include <span>
#include <string>

#include "base/scheme_defaults.hpp"
#include "integrators/sundials_ode.hpp"

namespace gneiss {

/// A table of coefficients, by SUNDIALS' name in small letters: stages, order of the embedded method, order.
struct RungeKuttaTable {
    enum class Kind { explicit_, implicit, additive };
    static constexpr int none = -1, absent = -2;

    const char* name;
    int explicit_id, implicit_id;  ///< SUNDIALS' numbers; none: it has no such half; absent: this SUNDIALS has it not
    const char* since = nullptr;   ///< version of SUNDIALS that first had it; null: every one that gneiss compiles with

    Kind kind() const {
        return implicit_id == none ? Kind::explicit_ : explicit_id == none ? Kind::implicit : Kind::additive;
    }
    bool here() const { return explicit_id != absent && implicit_id != absent; }
    int order() const;      ///< of a table that is here
    bool embedded() const;  ///< has a second method that estimates the error; of a table that is here
};

std::span<const RungeKuttaTable> runge_kutta_tables();
/// Version of the SUNDIALS that this program was built with.
std::string sundials_version();

class Arkode final : public SundialsOde {
public:
    struct Options : SundialsOde::Options {
        std::string table = scheme_defaults::table;
        double dt = 0;  ///< fixed step, s; 0: from the error estimate

        /// @throws InputError
        void validate() const;

        friend bool operator==(const Options&, const Options&) = default;
    };

    /// Whether a table, by name, is explicit: there is nothing to solve.
    /// @throws InputError if there is none of this name
    static bool is_explicit(const std::string& table);
    explicit Arkode(const Options& options);

    std::string name() const override { return "arkode"; }

private:
    void create(double t) override;
    void destroy() override { memory_.reset(); }
    void restart(double t) override;
    int step(double dt, double t_stop, double& t) override;
    /// Tables of order 5 evaluate once, those of higher orders four times.
    int dense(double t, N_Vector at) override;
    double last_step() override;
    std::size_t failed_trials() override;
    std::string flag_name(int flag) override;
    double fixed_step() const override { return options_.dt; }
    /// Right-hand sides of the explicit and of the implicit half.
    using Rates = int (*)(double t, N_Vector y, N_Vector dydt, void* self);
    Rates explicit_rates() const;
    Rates implicit_rates() const;

    Options options_;
    const RungeKuttaTable& table_;
    struct Deleter {
        void operator()(void* memory) const;
    };
    OwnedVector start_;        ///< y where a step begins
    std::size_t refused_ = 0;  ///< trials with a stage that could not be evaluated
    OwnedNonlinearSolver nonlinear_;
    std::unique_ptr<void, Deleter> memory_;
};

}  // namespace gneiss
