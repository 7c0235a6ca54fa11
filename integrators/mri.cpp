#include "integrators/mri.hpp"

#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_mristep.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <new>

#include "base/errors.hpp"

namespace gneiss {
namespace {

/// Of the fast part: of a higher order than any slow table.
constexpr ARKODE_ERKTableID fast_table = ARKODE_DORMAND_PRINCE_7_4_5;

struct CouplingDeleter {
    void operator()(MRIStepCoupling coupling) const { MRIStepCoupling_Free(coupling); }
};
using OwnedCoupling = std::unique_ptr<MRIStepCouplingMem, CouplingDeleter>;

// Knoth and Wolke; Sandu
constexpr std::array tables{MultirateTable{"mis_kw3", ARKODE_MIS_KW3, 3, 3.79},
                            MultirateTable{"mri_gark_erk33a", ARKODE_MRI_GARK_ERK33a, 3, 2.63},
                            MultirateTable{"mri_gark_erk45a", ARKODE_MRI_GARK_ERK45a, 4, 2.96}};

const MultirateTable& find_table(const std::string& name) {
    const auto found = std::ranges::find_if(tables, [&](const MultirateTable& table) { return name == table.name; });
    if (found != tables.end()) return *found;
    std::string allowed;
    for (const MultirateTable& table : tables) allowed += (allowed.empty() ? "" : ", ") + std::string(table.name);
    throw InputError("integrator.slow_table", fmt::format("given `{}`, must be one of {}", name, allowed));
}

}  // namespace

std::span<const MultirateTable> multirate_tables() { return tables; }

void Mri::Options::validate() const {
    std::vector<Problem> problems;
    check(problems);
    if (!(dt > 0 && std::isfinite(dt)))
        problems.push_back({"integrator.dt", fmt::format("given {} s, must be > 0 s: of the slow part", dt)});
    if (!problems.empty()) throw InputError(problems);
}

Mri::Mri(const Options& options) : SundialsOde(options, false), options_(options), table_(find_table(options.table)) {
    options_.validate();
}

void Mri::SlowDeleter::operator()(void* memory) const { GNEISS_ARKODE(MRIStep, Free)(&memory); }
void Mri::FastDeleter::operator()(void* memory) const { GNEISS_ARKODE(ARKStep, Free)(&memory); }
void Mri::StepperDeleter::operator()(void* stepper) const {
    auto own = static_cast<MRIStepInnerStepper>(stepper);
    MRIStepInnerStepper_Free(&own);
}

auto Mri::slow_rates() -> Rates {
    return [](sunrealtype t, N_Vector y, N_Vector dydt, void* self) {
        return static_cast<Mri*>(self)->rate(t, y, FirstOrderForm::Part::without_interactions, dydt);
    };
}

auto Mri::fast_rates() -> Rates {
    return [](sunrealtype t, N_Vector y, N_Vector dydt, void* self) {
        return static_cast<Mri*>(self)->rate(t, y, FirstOrderForm::Part::interactions, dydt);
    };
}

void Mri::create(double t) {
    const auto weights = [](N_Vector, N_Vector w, void* self) { return static_cast<Mri*>(self)->error_weights(w); };
    fast_.reset(ARKStepCreate(fast_rates(), nullptr, t, y(), context()));
    void* fast = fast_.get();
    if (fast == nullptr) throw std::bad_alloc();
    GNEISS_SUNDIALS_SILENCE(ARKStep, fast);
    check(GNEISS_ARKODE(ARKStep, SetUserData)(fast, this), "ARKStepSetUserData");
    check(GNEISS_ARKODE(ARKStep, WFtolerances)(fast, weights), "ARKStepWFtolerances");
    check(ARKStepSetTableNum(fast, ARKODE_DIRK_NONE, fast_table), "ARKStepSetTableNum");
    const auto follow = [](sunrealtype at, N_Vector y, void* self) {
        return static_cast<Mri*>(self)->follow_interactions(at, y);
    };
    check(GNEISS_ARKODE(ARKStep, SetPostprocessStepFn)(fast, follow), "ARKStepSetPostprocessStepFn");
    constexpr long no_limit = -1;  // between two stages of the slow part
    check(GNEISS_ARKODE(ARKStep, SetMaxNumSteps)(fast, no_limit), "ARKStepSetMaxNumSteps");
    MRIStepInnerStepper stepper = nullptr;
    check(ARKStepCreateMRIStepInnerStepper(fast, &stepper), "ARKStepCreateMRIStepInnerStepper");
    stepper_.reset(stepper);
    slow_.reset(MRIStepCreate(slow_rates(), nullptr, t, y(), stepper, context()));
    void* slow = slow_.get();
    if (slow == nullptr) throw std::bad_alloc();
    GNEISS_SUNDIALS_SILENCE(MRIStep, slow);
    check(GNEISS_ARKODE(MRIStep, SetUserData)(slow, this), "MRIStepSetUserData");
    const OwnedCoupling coupling(MRIStepCoupling_LoadTable(static_cast<ARKODE_MRITableID>(table_.id)));
    check(MRIStepSetCoupling(slow, coupling.get()), "MRIStepSetCoupling");
#if GNEISS_SUNDIALS_HAS_LAZY_RATES
    // up to 7.1 the slope at the start of the first step is not evaluated, and the cubic of tables of order 4 is drawn
    // with what stands in memory: a parabola does without it
    constexpr int parabola = 2;
    check(GNEISS_ARKODE(MRIStep, SetInterpolantDegree)(slow, parabola), "MRIStepSetInterpolantDegree");
#endif
}

void Mri::destroy() {
    slow_.reset();
    stepper_.reset();
    fast_.reset();
}

void Mri::restart(double t) {
    check(ARKStepReInit(fast_.get(), fast_rates(), nullptr, t, y()), "ARKStepReInit");
    check(MRIStepReInit(slow_.get(), slow_rates(), nullptr, t, y()), "MRIStepReInit");
}

int Mri::step(double dt, double t_stop, double& t) {
    begin_path();
    check(GNEISS_ARKODE(MRIStep, SetFixedStep)(slow_.get(), dt), "MRIStepSetFixedStep");
    check(GNEISS_ARKODE(MRIStep, SetStopTime)(slow_.get(), t_stop), "MRIStepSetStopTime");
    return GNEISS_ARKODE(MRIStep, Evolve)(slow_.get(), t_stop, y(), &t, ARK_ONE_STEP);
}

int Mri::dense(double t, N_Vector at) { return GNEISS_ARKODE(MRIStep, GetDky)(slow_.get(), t, 0, at); }

double Mri::last_step() {
    double dt = 0;
    GNEISS_ARKODE(MRIStep, GetLastStep)(slow_.get(), &dt);
    return dt;
}

std::size_t Mri::failed_trials() {
    long by_error = 0;
    GNEISS_ARKODE(ARKStep, GetNumErrTestFails)(fast_.get(), &by_error);
    return static_cast<std::size_t>(by_error);
}

std::string Mri::doubt(const FrequencyBound& bound) const {
    const double slow = std::sqrt(std::max(0.0, bound.omega * bound.omega - bound.of_bonds));
    if (options_.dt * slow <= table_.limit) return {};
    return fmt::format(
        "integrator.dt = {:.4g} s: `{}` is stable up to {:.4g} s for all but contact and joints here; above, "
        "energy may come from nothing",
        options_.dt, table_.name, table_.limit / slow);
}

std::string Mri::flag_name(int flag) {
    const std::unique_ptr<char, void (*)(void*)> name(GNEISS_ARKODE(MRIStep, GetReturnFlagName)(flag), std::free);
    return name.get();
}

}  // namespace gneiss
