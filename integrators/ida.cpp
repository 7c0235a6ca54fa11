#include "integrators/ida.hpp"

#include <fmt/format.h>
#include <ida/ida.h>
#include <cstdlib>

#include "base/errors.hpp"

namespace gneiss {

void Ida::Options::validate() const {
    std::vector<Problem> problems;
    check(problems);
    if (!(max_order >= 0 && max_order <= 5))
        problems.push_back({"integrator.max_order", fmt::format("given {}, must be in [1, 5], or 0 for 5", max_order)});
    if (!problems.empty()) throw InputError(problems);
}

Ida::Ida(const Options& options) : SundialsOde(options, true), options_(options) { options_.validate(); }

void Ida::Deleter::operator()(void* memory) const { IDAFree(&memory); }

void Ida::find_rates(double t) {
    if (rate(t, y(), FirstOrderForm::Part::all, rates_.get()) != 0) {
        guard().rethrow();
        throw RecoverableError(guard().failure());
    }
}

void Ida::create(double t) {
    rates_ = new_vector(values_of(y()).size(), context());
    find_rates(t);
    memory_.reset(IDACreate(context()));
    void* ida = memory_.get();
    const auto residual = [](sunrealtype at, N_Vector y, N_Vector dydt, N_Vector r, void* self) {
        const int flag = static_cast<Ida*>(self)->rate(at, y, FirstOrderForm::Part::all, r);
        N_VLinearSum(1, dydt, -1, r, r);
        return flag;
    };
    const auto weights = [](N_Vector, N_Vector w, void* self) { return static_cast<Ida*>(self)->error_weights(w); };
    const auto newton_matrix = [](sunrealtype at, sunrealtype c, N_Vector y, N_Vector, N_Vector, SUNMatrix, void* self,
                                  N_Vector, N_Vector, N_Vector) {
        return static_cast<Ida*>(self)->linear_system(at, y, false, 1 / c, 1 / c);
    };
    check(IDAInit(ida, residual, t, y(), rates_.get()), "IDAInit");
    GNEISS_SUNDIALS_SILENCE(IDA, ida);
    check(IDASetUserData(ida, this), "IDASetUserData");
    check(IDAWFtolerances(ida, weights), "IDAWFtolerances");
    if (options_.max_order > 0) check(IDASetMaxOrd(ida, options_.max_order), "IDASetMaxOrd");
    if (options().longest > 0) check(IDASetMaxStep(ida, options().longest), "IDASetMaxStep");
    check(IDASetLinearSolver(ida, newton().linear_solver(), newton().matrix()), "IDASetLinearSolver");
    check(IDASetJacFn(ida, newton_matrix), "IDASetJacFn");
    check(IDASetMaxNonlinIters(ida, most_iterations), "IDASetMaxNonlinIters");
}

void Ida::restart(double t) {
    find_rates(t);
    check(IDAReInit(memory_.get(), t, y(), rates_.get()), "IDAReInit");
}

int Ida::step(double, double t_stop, double& t) {
    check(IDASetStopTime(memory_.get(), t_stop), "IDASetStopTime");
    return IDASolve(memory_.get(), t_stop, &t, y(), rates_.get(), IDA_ONE_STEP);
}

int Ida::dense(double t, N_Vector at) { return IDAGetDky(memory_.get(), t, 0, at); }

double Ida::last_step() {
    double dt = 0;
    IDAGetLastStep(memory_.get(), &dt);
    return dt;
}

std::size_t Ida::failed_trials() {
    long by_error = 0, by_solver = 0;
    IDAGetNumErrTestFails(memory_.get(), &by_error);
    IDAGetNumStepSolveFails(memory_.get(), &by_solver);
    return static_cast<std::size_t>(by_error + by_solver);
}

std::string Ida::flag_name(int flag) {
    const std::unique_ptr<char, void (*)(void*)> name(IDAGetReturnFlagName(flag), std::free);
    return name.get();
}

}  // namespace gneiss
