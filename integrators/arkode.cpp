#include "integrators/arkode.hpp"

#include <arkode/arkode_arkstep.h>
#include <fmt/format.h>
#include <sundials/sundials_config.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "base/errors.hpp"

namespace gneiss {
namespace {

constexpr int none = RungeKuttaTable::none, absent = RungeKuttaTable::absent;

// what the headers at hand do not have is no name
#if GNEISS_SUNDIALS_HAS_TABLES_OF_6_7
#define GNEISS_OF_6_7(id) id
#else
#define GNEISS_OF_6_7(id) absent
#endif
#if GNEISS_SUNDIALS_HAS_TABLES_OF_7_1
#define GNEISS_OF_7_1(id) id
#else
#define GNEISS_OF_7_1(id) absent
#endif

// knoth_wolke_3_3, of three stages and order 3, has no embedded method
constexpr std::array tables{
    RungeKuttaTable{"heun_euler_2_1_2", ARKODE_HEUN_EULER_2_1_2, none},
    RungeKuttaTable{"ralston_euler_2_1_2", GNEISS_OF_7_1(ARKODE_RALSTON_EULER_2_1_2), none, "7.1"},
    RungeKuttaTable{"explicit_midpoint_euler_2_1_2", GNEISS_OF_7_1(ARKODE_EXPLICIT_MIDPOINT_EULER_2_1_2), none, "7.1"},
    RungeKuttaTable{"shu_osher_3_2_3", GNEISS_OF_6_7(ARKODE_SHU_OSHER_3_2_3), none, "6.7"},
    RungeKuttaTable{"knoth_wolke_3_3", ARKODE_KNOTH_WOLKE_3_3, none},
    RungeKuttaTable{"bogacki_shampine_4_2_3", ARKODE_BOGACKI_SHAMPINE_4_2_3, none},
    RungeKuttaTable{"zonneveld_5_3_4", ARKODE_ZONNEVELD_5_3_4, none},
    RungeKuttaTable{"sofroniou_spaletta_5_3_4", GNEISS_OF_6_7(ARKODE_SOFRONIOU_SPALETTA_5_3_4), none, "6.7"},
    RungeKuttaTable{"sayfy_aburub_6_3_4", ARKODE_SAYFY_ABURUB_6_3_4, none},
    RungeKuttaTable{"cash_karp_6_4_5", ARKODE_CASH_KARP_6_4_5, none},
    RungeKuttaTable{"fehlberg_6_4_5", ARKODE_FEHLBERG_6_4_5, none},
    RungeKuttaTable{"dormand_prince_7_4_5", ARKODE_DORMAND_PRINCE_7_4_5, none},
    RungeKuttaTable{"verner_8_5_6", ARKODE_VERNER_8_5_6, none},
    RungeKuttaTable{"verner_9_5_6", GNEISS_OF_6_7(ARKODE_VERNER_9_5_6), none, "6.7"},
    RungeKuttaTable{"verner_10_6_7", GNEISS_OF_6_7(ARKODE_VERNER_10_6_7), none, "6.7"},
    RungeKuttaTable{"fehlberg_13_7_8", ARKODE_FEHLBERG_13_7_8, none},
    RungeKuttaTable{"verner_13_7_8", GNEISS_OF_6_7(ARKODE_VERNER_13_7_8), none, "6.7"},
    RungeKuttaTable{"verner_16_8_9", GNEISS_OF_6_7(ARKODE_VERNER_16_8_9), none, "6.7"},
    RungeKuttaTable{"backward_euler_1_1", none, GNEISS_OF_7_1(ARKODE_BACKWARD_EULER_1_1), "7.1"},
    RungeKuttaTable{"implicit_midpoint_1_2", none, GNEISS_OF_7_1(ARKODE_IMPLICIT_MIDPOINT_1_2), "7.1"},
    RungeKuttaTable{"implicit_trapezoidal_2_2", none, GNEISS_OF_7_1(ARKODE_IMPLICIT_TRAPEZOIDAL_2_2), "7.1"},
    RungeKuttaTable{"sdirk_2_1_2", none, ARKODE_SDIRK_2_1_2},
    RungeKuttaTable{"billington_3_3_2", none, ARKODE_BILLINGTON_3_3_2},
    RungeKuttaTable{"trbdf2_3_3_2", none, ARKODE_TRBDF2_3_3_2},
    RungeKuttaTable{"kvaerno_4_2_3", none, ARKODE_KVAERNO_4_2_3},
    RungeKuttaTable{"esdirk324l2sa_4_2_3", none, ARKODE_ESDIRK324L2SA_4_2_3},
    RungeKuttaTable{"esdirk325l2sa_5_2_3", none, ARKODE_ESDIRK325L2SA_5_2_3},
    RungeKuttaTable{"esdirk32i5l2sa_5_2_3", none, ARKODE_ESDIRK32I5L2SA_5_2_3},
    RungeKuttaTable{"cash_5_2_4", none, ARKODE_CASH_5_2_4},
    RungeKuttaTable{"cash_5_3_4", none, ARKODE_CASH_5_3_4},
    RungeKuttaTable{"sdirk_5_3_4", none, ARKODE_SDIRK_5_3_4},
    RungeKuttaTable{"kvaerno_5_3_4", none, ARKODE_KVAERNO_5_3_4},
    RungeKuttaTable{"esdirk436l2sa_6_3_4", none, ARKODE_ESDIRK436L2SA_6_3_4},
    RungeKuttaTable{"esdirk43i6l2sa_6_3_4", none, ARKODE_ESDIRK43I6L2SA_6_3_4},
    RungeKuttaTable{"qesdirk436l2sa_6_3_4", none, ARKODE_QESDIRK436L2SA_6_3_4},
    RungeKuttaTable{"esdirk437l2sa_7_3_4", none, ARKODE_ESDIRK437L2SA_7_3_4},
    RungeKuttaTable{"kvaerno_7_4_5", none, ARKODE_KVAERNO_7_4_5},
    RungeKuttaTable{"esdirk547l2sa_7_4_5", none, ARKODE_ESDIRK547L2SA_7_4_5},
    RungeKuttaTable{"esdirk547l2sa2_7_4_5", none, ARKODE_ESDIRK547L2SA2_7_4_5},
    RungeKuttaTable{"ark2_3_1_2", GNEISS_OF_6_7(ARKODE_ARK2_ERK_3_1_2), GNEISS_OF_6_7(ARKODE_ARK2_DIRK_3_1_2), "6.7"},
    RungeKuttaTable{"ark324l2sa_4_2_3", ARKODE_ARK324L2SA_ERK_4_2_3, ARKODE_ARK324L2SA_DIRK_4_2_3},
    RungeKuttaTable{"ark436l2sa_6_3_4", ARKODE_ARK436L2SA_ERK_6_3_4, ARKODE_ARK436L2SA_DIRK_6_3_4},
    RungeKuttaTable{"ark437l2sa_7_3_4", ARKODE_ARK437L2SA_ERK_7_3_4, ARKODE_ARK437L2SA_DIRK_7_3_4},
    RungeKuttaTable{"ark548l2sa_8_4_5", ARKODE_ARK548L2SA_ERK_8_4_5, ARKODE_ARK548L2SA_DIRK_8_4_5},
    RungeKuttaTable{"ark548l2sab_8_4_5", ARKODE_ARK548L2SAb_ERK_8_4_5, ARKODE_ARK548L2SAb_DIRK_8_4_5}};

struct TableDeleter {
    void operator()(ARKodeButcherTable table) const { ARKodeButcherTable_Free(table); }
};
using OwnedTable = std::unique_ptr<ARKodeButcherTableMem, TableDeleter>;

OwnedTable coefficients(const RungeKuttaTable& table) {
    return OwnedTable(table.implicit_id >= 0
                          ? ARKodeButcherTable_LoadDIRK(static_cast<ARKODE_DIRKTableID>(table.implicit_id))
                          : ARKodeButcherTable_LoadERK(static_cast<ARKODE_ERKTableID>(table.explicit_id)));
}

const RungeKuttaTable& find_table(const std::string& name) {
    const auto found = std::ranges::find_if(tables, [&](const RungeKuttaTable& table) { return name == table.name; });
    if (found != tables.end() && found->here()) return *found;
    if (found != tables.end())
        throw InputError("integrator.table",
                         fmt::format("given `{}`, which needs SUNDIALS {} or newer; this program was "
                                     "built with {}",
                                     name, found->since, sundials_version()));
    std::string allowed;
    for (const RungeKuttaTable& table : tables)
        if (table.here()) allowed += (allowed.empty() ? "" : ", ") + std::string(table.name);
    throw InputError("integrator.table", fmt::format("given `{}`, must be one of {}", name, allowed));
}

}  // namespace

std::span<const RungeKuttaTable> runge_kutta_tables() { return tables; }
std::string sundials_version() { return SUNDIALS_VERSION; }

int RungeKuttaTable::order() const { return coefficients(*this)->q; }
bool RungeKuttaTable::embedded() const { return coefficients(*this)->p > 0; }

void Arkode::Options::validate() const {
    std::vector<Problem> problems;
    check(problems);
    if (!(dt >= 0 && std::isfinite(dt)))
        problems.push_back({"integrator.dt", fmt::format("given {} s, must be >= 0 s", dt)});
    if (dt == 0 && !find_table(table).embedded())
        problems.push_back(
            {"integrator.dt",
             fmt::format("missing: `{}` estimates no error, so that its steps have to be given", table)});
    if (!problems.empty()) throw InputError(problems);
}

bool Arkode::is_explicit(const std::string& table) {
    return find_table(table).kind() == RungeKuttaTable::Kind::explicit_;
}

Arkode::Arkode(const Options& options)
    : SundialsOde(options, !is_explicit(options.table)), options_(options), table_(find_table(options.table)) {
    options_.validate();
}

void Arkode::Deleter::operator()(void* memory) const { GNEISS_ARKODE(ARKStep, Free)(&memory); }

auto Arkode::explicit_rates() const -> Rates {
    if (table_.explicit_id < 0) return nullptr;
    if (table_.kind() == RungeKuttaTable::Kind::explicit_)
        return [](sunrealtype t, N_Vector y, N_Vector dydt, void* self) {
            return static_cast<Arkode*>(self)->rate(t, y, FirstOrderForm::Part::all, dydt);
        };
    return [](sunrealtype t, N_Vector y, N_Vector dydt, void* self) {
        return static_cast<Arkode*>(self)->rate(t, y, FirstOrderForm::Part::external, dydt);
    };
}

auto Arkode::implicit_rates() const -> Rates {
    if (table_.implicit_id < 0) return nullptr;
    if (table_.kind() == RungeKuttaTable::Kind::implicit)
        return [](sunrealtype t, N_Vector y, N_Vector dydt, void* self) {
            return static_cast<Arkode*>(self)->rate(t, y, FirstOrderForm::Part::all, dydt);
        };
    return [](sunrealtype t, N_Vector y, N_Vector dydt, void* self) {
        return static_cast<Arkode*>(self)->rate(t, y, FirstOrderForm::Part::rest, dydt);
    };
}

void Arkode::create(double t) {
    start_.reset(N_VClone(y()));
    if (!start_) throw std::bad_alloc();
    refused_ = 0;
    memory_.reset(ARKStepCreate(explicit_rates(), implicit_rates(), t, y(), context()));
    void* arkode = memory_.get();
    if (arkode == nullptr) throw std::bad_alloc();
    const auto weights = [](N_Vector, N_Vector w, void* self) { return static_cast<Arkode*>(self)->error_weights(w); };
    const auto newton_matrix = [](sunrealtype at, N_Vector y, N_Vector, SUNMatrix, SUNMatrix, sunbooleantype reuse,
                                  sunbooleantype* fresh, sunrealtype gamma, void* self, N_Vector, N_Vector, N_Vector) {
        *fresh = !reuse;
        return static_cast<Arkode*>(self)->linear_system(at, y, reuse, gamma, 1);
    };
    GNEISS_SUNDIALS_SILENCE(ARKStep, arkode);
    check(GNEISS_ARKODE(ARKStep, SetUserData)(arkode, this), "ARKStepSetUserData");
    check(GNEISS_ARKODE(ARKStep, WFtolerances)(arkode, weights), "ARKStepWFtolerances");
    check(ARKStepSetTableNum(arkode, static_cast<ARKODE_DIRKTableID>(table_.implicit_id),
                             static_cast<ARKODE_ERKTableID>(table_.explicit_id)),
          "ARKStepSetTableNum");
    if (options().longest > 0)
        check(GNEISS_ARKODE(ARKStep, SetMaxStep)(arkode, options().longest), "ARKStepSetMaxStep");
    if (table_.kind() != RungeKuttaTable::Kind::explicit_) {
        nonlinear_ = new_newton_iteration();
        check(GNEISS_ARKODE(ARKStep, SetNonlinearSolver)(arkode, nonlinear_.get()), "ARKStepSetNonlinearSolver");
        trust_no_earlier_rate(nonlinear_.get());
        check(GNEISS_ARKODE(ARKStep, SetLinearSolver)(arkode, newton().linear_solver(), newton().matrix()),
              "ARKStepSetLinearSolver");
        check(GNEISS_ARKODE(ARKStep, SetLinSysFn)(arkode, newton_matrix), "ARKStepSetLinSysFn");
        check(GNEISS_ARKODE(ARKStep, SetMaxNonlinIters)(arkode, most_iterations), "ARKStepSetMaxNonlinIters");
    }
}

void Arkode::restart(double t) {
    check(ARKStepReInit(memory_.get(), explicit_rates(), implicit_rates(), t, y()), "ARKStepReInit");
    check(GNEISS_ARKODE(ARKStep, SetInitStep)(memory_.get(), 0), "ARKStepSetInitStep");  // it is to be estimated
    refused_ = 0;
}

int Arkode::step(double dt, double t_stop, double& t) {
    void* arkode = memory_.get();
    if (dt > 0) {
        // without a stop time, where ARKODE 5.4 interpolates what it has just computed: one to four evaluations of
        // forces
        check(GNEISS_ARKODE(ARKStep, SetFixedStep)(arkode, dt), "ARKStepSetFixedStep");
        const int flag = GNEISS_ARKODE(ARKStep, Evolve)(arkode, t_stop, y(), &t, ARK_ONE_STEP);
        constexpr double round_off = 1e-9;  // of a step
        if (std::abs(t - t_stop) <= round_off * dt) t = t_stop;
        return flag;
    }
    check(GNEISS_ARKODE(ARKStep, SetStopTime)(arkode, t_stop), "ARKStepSetStopTime");
    double from = 0, trial = 0;
    check(GNEISS_ARKODE(ARKStep, GetCurrentTime)(arkode, &from), "ARKStepGetCurrentTime");
    N_VScale(1, y(), start_.get());
    for (int attempt = 0;; ++attempt) {
        const int flag = GNEISS_ARKODE(ARKStep, Evolve)(arkode, t_stop, y(), &t, ARK_ONE_STEP);
        // a stage that cannot be evaluated: ARKODE takes a shorter step where it is implicit alone
        constexpr int most_attempts = 20;
        if (flag != ARK_UNREC_RHSFUNC_ERR || attempt == most_attempts) return flag;
        if (attempt == 0) check(GNEISS_ARKODE(ARKStep, GetCurrentStep)(arkode, &trial), "ARKStepGetCurrentStep");
        constexpr double shorter = 0.25;
        trial = shorter * std::min(trial, t_stop - from);
        ++refused_;
        N_VScale(1, start_.get(), y());
        check(GNEISS_ARKODE(ARKStep, Reset)(arkode, from, y()), "ARKStepReset");
        check(GNEISS_ARKODE(ARKStep, SetInitStep)(arkode, trial), "ARKStepSetInitStep");
    }
}

int Arkode::dense(double t, N_Vector at) { return GNEISS_ARKODE(ARKStep, GetDky)(memory_.get(), t, 0, at); }

double Arkode::last_step() {
    double dt = 0;
    GNEISS_ARKODE(ARKStep, GetLastStep)(memory_.get(), &dt);
    return dt;
}

std::size_t Arkode::failed_trials() {
    long by_error = 0, by_solver = 0;
    GNEISS_ARKODE(ARKStep, GetNumErrTestFails)(memory_.get(), &by_error);
    GNEISS_ARKODE(ARKStep, GetNumStepSolveFails)(memory_.get(), &by_solver);
    return static_cast<std::size_t>(by_error + by_solver) + refused_;
}

std::string Arkode::flag_name(int flag) {
    const std::unique_ptr<char, void (*)(void*)> name(GNEISS_ARKODE(ARKStep, GetReturnFlagName)(flag), std::free);
    return name.get();
}

}  // namespace gneiss
