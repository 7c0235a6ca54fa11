#include "integrators/cvode.hpp"

#include <cvode/cvode.h>
#include <fmt/format.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>
#include <cstdlib>

#include "base/errors.hpp"

namespace gneiss {

void Cvode::Options::validate() const {
    std::vector<Problem> problems;
    check(problems);
    const int highest = method == Method::bdf ? 5 : 12;
    if (!(max_order >= 0 && max_order <= highest))
        problems.push_back({"integrator.max_order",
                            fmt::format("given {}, must be in [1, {}], or 0 for {}", max_order, highest, highest)});
    if (!problems.empty()) throw InputError(problems);
}

Cvode::Cvode(const Options& options) : SundialsOde(options, options.iteration == Iteration::newton), options_(options) {
    options_.validate();
}

void Cvode::Deleter::operator()(void* memory) const { CVodeFree(&memory); }

void Cvode::create(double t) {
    const bool bdf = options_.method == Method::bdf;
    memory_.reset(CVodeCreate(bdf ? CV_BDF : CV_ADAMS, context()));
    void* cvode = memory_.get();
    const auto rates = [](sunrealtype at, N_Vector y, N_Vector dydt, void* self) {
        return static_cast<Cvode*>(self)->rate(at, y, FirstOrderForm::Part::all, dydt);
    };
    const auto weights = [](N_Vector, N_Vector w, void* self) { return static_cast<Cvode*>(self)->error_weights(w); };
    const auto newton_matrix = [](sunrealtype at, N_Vector y, N_Vector, SUNMatrix, sunbooleantype reuse,
                                  sunbooleantype* fresh, sunrealtype gamma, void* self, N_Vector, N_Vector, N_Vector) {
        *fresh = !reuse;
        return static_cast<Cvode*>(self)->linear_system(at, y, reuse, gamma, 1);
    };
    check(CVodeInit(cvode, rates, t, y()), "CVodeInit");
    GNEISS_SUNDIALS_SILENCE(CVode, cvode);
    check(CVodeSetUserData(cvode, this), "CVodeSetUserData");
    check(CVodeWFtolerances(cvode, weights), "CVodeWFtolerances");
    if (options_.max_order > 0) check(CVodeSetMaxOrd(cvode, options_.max_order), "CVodeSetMaxOrd");
    if (options().longest > 0) check(CVodeSetMaxStep(cvode, options().longest), "CVodeSetMaxStep");
    if (bdf && options_.stability_detection) check(CVodeSetStabLimDet(cvode, SUNTRUE), "CVodeSetStabLimDet");
    const bool newton_iteration = options_.iteration == Iteration::newton;
    nonlinear_ =
        newton_iteration ? new_newton_iteration() : OwnedNonlinearSolver(SUNNonlinSol_FixedPoint(y(), 0, context()));
    check(CVodeSetNonlinearSolver(cvode, nonlinear_.get()), "CVodeSetNonlinearSolver");
    if (newton_iteration) {
        trust_no_earlier_rate(nonlinear_.get());
        check(CVodeSetLinearSolver(cvode, newton().linear_solver(), newton().matrix()), "CVodeSetLinearSolver");
        check(CVodeSetLinSysFn(cvode, newton_matrix), "CVodeSetLinSysFn");
        check(CVodeSetMaxNonlinIters(cvode, most_iterations), "CVodeSetMaxNonlinIters");
    }
}

void Cvode::restart(double t) { check(CVodeReInit(memory_.get(), t, y()), "CVodeReInit"); }

int Cvode::step(double, double t_stop, double& t) {
    check(CVodeSetStopTime(memory_.get(), t_stop), "CVodeSetStopTime");
    return CVode(memory_.get(), t_stop, y(), &t, CV_ONE_STEP);
}

int Cvode::dense(double t, N_Vector at) { return CVodeGetDky(memory_.get(), t, 0, at); }

double Cvode::last_step() {
    double dt = 0;
    CVodeGetLastStep(memory_.get(), &dt);
    return dt;
}

std::size_t Cvode::failed_trials() {
    long by_error = 0, by_solver = 0;
    CVodeGetNumErrTestFails(memory_.get(), &by_error);
    CVodeGetNumStepSolveFails(memory_.get(), &by_solver);
    return static_cast<std::size_t>(by_error + by_solver);
}

std::string Cvode::flag_name(int flag) {
    const std::unique_ptr<char, void (*)(void*)> name(CVodeGetReturnFlagName(flag), std::free);
    return name.get();
}

}  // namespace gneiss
