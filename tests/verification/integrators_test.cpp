// One solid under everything there is, by every integrator: the same physics.

#include <gtest/gtest.h>

#include <tuple>

#include "integrators/arkode.hpp"
#include "integrators/bathe.hpp"
#include "integrators/cvode.hpp"
#include "integrators/generalized_alpha.hpp"
#include "integrators/ida.hpp"
#include "integrators/mri.hpp"
#include "integrators/noh_bathe.hpp"
#include "integrators/verlet.hpp"
#include "support/one_thread.hpp"
#include "verification/everything.hpp"
#include "verification/run_solid.hpp"

namespace gneiss {
namespace {

constexpr double t_end = 2e-3;  ///< s: waves cross the block once or twice

struct Scheme {
    std::string name;
    double error;    ///< allowed, of displacement and velocity over their largest
    double balance;  ///< allowed, of the energy
    std::function<std::unique_ptr<Integrator>()> make;
};
void PrintTo(const Scheme& scheme, std::ostream* out) { *out << scheme.name; }

template <class Solver>
std::unique_ptr<Integrator> solver(typename Solver::Options options, double rtol) {
    options.rtol = rtol;
    return std::make_unique<Solver>(options);
}

std::unique_ptr<Integrator> verlet(double safety, Verlet::Form form, const char* composition) {
    return std::make_unique<Verlet>(Verlet::Options{{.safety = safety}, form, composition});
}

// Errors: some hundred steps of a local error of rtol. Order 2 with fixed steps: as measured, and confirmed by halving
// in the contract of integrators; explicit ones with steps of the leapfrog's length, or shorter, have its bounds. Order
// 4 at four times that length: those of Runge-Kutta methods to a tolerance. Balance: implicit schemes damp the
// vibrations that their steps do not resolve, after the jumps of loads, and the ledger says so.
const Scheme schemes[] = {
    {"CentralDifference", 2e-3, 1e-3,
     [] { return std::make_unique<CentralDifference>(CentralDifference::Options{.safety = 0.05}); }},
    {"VelocityVerlet", 2e-3, 1e-3, [] { return verlet(0.05, Verlet::Form::velocity, "single"); }},
    {"PositionVerlet", 2e-3, 1e-3, [] { return verlet(0.05, Verlet::Form::position, "single"); }},
    {"VelocityYoshida", 1e-4, 1e-5, [] { return verlet(0.2, Verlet::Form::velocity, "yoshida_3"); }},
    {"PositionSuzuki", 1e-4, 1e-5, [] { return verlet(0.2, Verlet::Form::position, "suzuki_5"); }},
    {"VelocityMcLachlan", 1e-4, 1e-5, [] { return verlet(0.2, Verlet::Form::velocity, "mclachlan_5"); }},
    {"NohBathe", 2e-3, 1e-3, [] { return std::make_unique<NohBathe>(NohBathe::Options{{.safety = 0.05}}); }},
    {"Bathe", 1e-2, 1e-2, [] { return std::make_unique<Bathe>(Bathe::Options{.rho_inf = 0, .dt = 4e-6}); }},
    {"Multirate", 1e-4, 1e-4,
     [] {
         Mri::Options options;
         options.table = "mri_gark_erk45a";
         options.dt = 4e-6;
         return solver<Mri>(options, 1e-8);
     }},
    {"GeneralizedAlpha", 1e-2, 1e-2,
     [] {
         GeneralizedAlpha::Options options;
         options.dt = 4e-6;
         return std::make_unique<GeneralizedAlpha>(options);
     }},
    {"GeneralizedAlphaAdaptive", 1e-3, 1e-3,
     [] {
         GeneralizedAlpha::Options options;
         options.rtol = 1e-7;
         return std::make_unique<GeneralizedAlpha>(options);
     }},
    {"CvodeBdf", 1e-3, 3e-3, [] { return solver<Cvode>({}, 1e-7); }},
    {"CvodeAdams", 1e-4, 1e-5,
     [] {
         Cvode::Options options;
         options.method = Cvode::Method::adams;
         options.iteration = Cvode::Iteration::functional;
         return solver<Cvode>(options, 1e-7);
     }},
    {"Ida", 1e-3, 3e-3, [] { return solver<Ida>({}, 1e-7); }},
    {"ArkodeExplicit", 1e-4, 1e-5, [] { return solver<Arkode>({}, 1e-7); }},
    // Where rates at the end of a step are those of its last stage, the last correction of Newton's method is not in
    // them: times the stiffness it is an imbalance of forces.
    {"ArkodeImplicit", 1e-4, GNEISS_SUNDIALS_HAS_LAZY_RATES ? 1e-2 : 3e-3,
     [] {
         Arkode::Options options;
         options.table = "esdirk547l2sa_7_4_5";
         return solver<Arkode>(options, 1e-7);
     }},
    {"ArkodeAdditive", 1e-4, 3e-3,
     [] {
         Arkode::Options options;
         options.table = "ark548l2sa_8_4_5";
         return solver<Arkode>(options, 1e-7);
     }},
};

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double difference = 0, largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        difference = std::max(difference, std::abs(a[i] - b[i]));
        largest = std::max(largest, std::abs(b[i]));
    }
    return difference / largest;
}

class OneSolid : public testing::TestWithParam<std::tuple<Scheme, bool, Form>> {};

TEST_P(OneSolid, EverythingActs_AgreesWithATightSolution) {
    const auto& [scheme, compt, form] = GetParam();
    const test::Solid solid = test::make_solid(test::rectangle(compt, 2, 2, {4, 4}), test::everything(form));
    Arkode::Options tight;
    tight.table = "fehlberg_13_7_8";
    tight.rtol = 1e-10;
    Arkode reference(tight);
    const State exact = test::run_solid(*solid.system, t_end, reference).state;
    const auto integrator = scheme.make();
    const test::SolidRun run = test::run_solid(*solid.system, t_end, *integrator);
    EXPECT_LT(largest_difference(run.state.u, exact.u), scheme.error);
    EXPECT_LT(largest_difference(run.state.v, exact.v), 5 * scheme.error);  // higher frequencies
    if (!exact.z.empty()) {
        EXPECT_LT(largest_difference(run.state.z, exact.z), 5 * scheme.error);
    }
    EXPECT_LT(run.ledger.balance_error(), scheme.balance);
}

TEST(LocalSteps, EverythingActs_AgreeWithATightSolution) {
    for (const bool compt : {false, true}) {
        for (const Form form : {Form::hyper, Form::hypo}) {
            // columns of 0.05 to 0.8 m between an absorbing side and a moving one
            const int rows = compt ? 12 : 3;
            const test::Solid solid =
                test::make_solid(test::graded(compt, {24, rows}, 0.05, 1.128, 0.8 * rows), test::everything(form));
            Arkode::Options tight;
            tight.table = "fehlberg_13_7_8";
            tight.rtol = 1e-9;
            Arkode reference(tight);
            const State exact = test::run_solid(*solid.system, t_end, reference).state;
            double before = 0;
            for (const double dt : {8e-6, 4e-6}) {
                CentralDifference local({.dt = dt}, 6);
                const test::SolidRun run = test::run_solid(*solid.system, t_end, local);
                EXPECT_GT(local.work().elements, run.n_steps * solid.mesh.n_elements());
                const double error = largest_difference(run.state.u, exact.u);
                EXPECT_LT(error, 2e-3) << compt;
                EXPECT_LT(run.ledger.balance_error(), 2e-3) << compt;
                if (before > 0) {
                    EXPECT_LT(error, before / 3) << compt;  // order 2: a quarter
                }
                before = error;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Schemes, OneSolid,
                         testing::Combine(testing::ValuesIn(schemes), testing::Bool(),
                                          testing::Values(Form::hyper, Form::hypo)),
                         [](const auto& instance) {
                             return std::get<0>(instance.param).name + (std::get<1>(instance.param) ? "Compt" : "Cst") +
                                    (std::get<2>(instance.param) == Form::hyper ? "Hyper" : "Hypo");
                         });

}  // namespace
}  // namespace gneiss
