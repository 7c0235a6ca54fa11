#include "app/make_integrator.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "integrators/arkode.hpp"
#include "integrators/bathe.hpp"
#include "integrators/central_difference.hpp"
#include "integrators/cvode.hpp"
#include "integrators/dynamic_relaxation.hpp"
#include "integrators/generalized_alpha.hpp"
#include "integrators/ida.hpp"
#include "integrators/mri.hpp"
#include "integrators/noh_bathe.hpp"
#include "integrators/quasi_static.hpp"
#include "integrators/verlet.hpp"

namespace gneiss {

bool has_critical_step(const IntegratorOptions& o) {
    return o.type == "central_difference" || o.type == "verlet" || o.type == "noh_bathe";
}

namespace {

bool is_alpha(const IntegratorOptions& o) {
    return o.type == "generalized_alpha" || o.type == "newmark" || o.type == "hht_alpha";
}

ProblemScales::Given scales(const IntegratorOptions& o) {
    return {o.displacement_scale, o.velocity_scale, o.stress_scale};
}

LinearSolverOptions linear_solver(const IntegratorOptions& o) {
    LinearSolverOptions options(o.solver);
    options.preconditioner = o.preconditioner;
    options.tolerance = o.linear_tolerance;
    options.most_iterations = static_cast<std::size_t>(o.most_linear_iterations);
    return options;
}

template <class Options>
Options to_a_tolerance(const IntegratorOptions& o) {
    Options options;
    options.rtol = o.rtol;
    options.scales = scales(o);
    options.longest = o.longest;
    options.solver = linear_solver(o);
    return options;
}

LoadStepping::Options load_steps(const IntegratorOptions& o) {
    return {o.tolerance, o.step, o.longest, o.shortest, o.most_iterations};
}

StableStep::Options stable_step(const IntegratorOptions& o) { return {o.safety, o.dt, o.lanczos}; }

std::unique_ptr<Integrator> make_alpha(const IntegratorOptions& o) {
    using Scheme = GeneralizedAlpha::Scheme;
    GeneralizedAlpha::Options options;
    options.name = o.type;
    options.scheme = o.type == "newmark"     ? Scheme::newmark(o.beta, o.gamma)
                     : o.type == "hht_alpha" ? Scheme::hht(o.alpha)
                                             : Scheme::chung_hulbert(o.rho_inf);
    options.dt = o.dt;
    options.rtol = o.adaptive ? o.rtol : 0;
    options.longest = o.longest;
    options.scales = scales(o);
    options.tolerance = o.tolerance;
    if (o.most_iterations > 0) options.most_iterations = o.most_iterations;
    options.solver = linear_solver(o);
    return std::make_unique<GeneralizedAlpha>(options);
}

std::unique_ptr<Integrator> make_bathe(const IntegratorOptions& o) {
    Bathe::Options options{.rho_inf = o.rho_inf, .dt = o.dt};
    options.newton.tolerance = o.tolerance;
    if (o.most_iterations > 0) options.newton.most_iterations = o.most_iterations;
    options.newton.solver = linear_solver(o);
    return std::make_unique<Bathe>(options);
}

std::unique_ptr<Integrator> make_verlet(const IntegratorOptions& o) {
    using Form = Verlet::Form;
    return std::make_unique<Verlet>(
        Verlet::Options{stable_step(o), o.position_form ? Form::position : Form::velocity, o.composition});
}

std::unique_ptr<Integrator> make_cvode(const IntegratorOptions& o) {
    auto options = to_a_tolerance<Cvode::Options>(o);
    options.method = o.adams ? Cvode::Method::adams : Cvode::Method::bdf;
    options.iteration = o.functional ? Cvode::Iteration::functional : Cvode::Iteration::newton;
    options.stability_detection = o.stability_detection;
    options.max_order = o.max_order;
    return std::make_unique<Cvode>(options);
}

std::unique_ptr<Integrator> make_arkode(const IntegratorOptions& o) {
    auto options = to_a_tolerance<Arkode::Options>(o);
    options.table = o.table;
    options.dt = o.dt;
    return std::make_unique<Arkode>(options);
}

std::unique_ptr<Integrator> make_mri(const IntegratorOptions& o) {
    auto options = to_a_tolerance<Mri::Options>(o);
    options.table = o.slow_table;
    options.dt = o.dt;
    return std::make_unique<Mri>(options);
}

std::unique_ptr<Integrator> make_ida(const IntegratorOptions& o) {
    auto options = to_a_tolerance<Ida::Options>(o);
    options.max_order = o.max_order;
    return std::make_unique<Ida>(options);
}

/// Keys that a deck's own conditions cannot tell to be idle: given, if they differ from their default.
void refuse_idle_keys(const IntegratorOptions& o) {
    const IntegratorOptions usual;
    std::vector<Problem> problems;
    const auto idle = [&](bool given, const char* key, const std::string& reason) {
        if (given) problems.push_back({std::string("integrator.") + key, "has no effect: " + reason});
    };
    if (is_alpha(o) && !o.adaptive) {
        const std::string fixed = "steps are fixed without `adaptive = true`";
        idle(o.rtol != usual.rtol, "rtol", fixed);
        idle(o.displacement_scale != usual.displacement_scale, "displacement_scale", fixed);
        idle(o.longest != usual.longest, "longest", fixed);
    }
    const auto idle_solver = [&](const std::string& reason) {
        idle(o.solver != usual.solver, "solver", reason + ", no linear systems are solved");
    };
    if (o.type == "cvode" && o.functional) idle_solver("with iteration = \"functional\"");
    if (o.type == "arkode" && Arkode::is_explicit(o.table)) idle_solver(fmt::format("with table = \"{}\"", o.table));
    if (!problems.empty()) throw InputError(problems);
}

}  // namespace

void check_linear_solver(const IntegratorOptions& o, const SemiDiscrete& system) {
    if (o.solver == IntegratorOptions().solver) return;
    std::vector<Problem> problems;
    linear_solver(o).check_symmetry(system.tangent()->symmetric(), problems);
    if (!problems.empty()) throw InputError(problems);
}

std::unique_ptr<Integrator> make_integrator(const IntegratorOptions& o, bool contact) {
    refuse_idle_keys(o);
    if (o.type == "central_difference") return std::make_unique<CentralDifference>(stable_step(o), o.levels);
    if (o.type == "verlet") return make_verlet(o);
    if (o.type == "noh_bathe") return std::make_unique<NohBathe>(NohBathe::Options{stable_step(o), o.split});
    if (o.type == "bathe") return make_bathe(o);
    if (o.type == "quasi_static")
        return std::make_unique<QuasiStatic>(
            QuasiStatic::Options{load_steps(o), linear_solver(o), o.matrix_free, contact});
    if (o.type == "dynamic_relaxation") return std::make_unique<DynamicRelaxation>(load_steps(o));
    if (is_alpha(o)) return make_alpha(o);
    if (o.type == "cvode") return make_cvode(o);
    if (o.type == "arkode") return make_arkode(o);
    if (o.type == "mri") return make_mri(o);
    if (o.type == "ida") return make_ida(o);
    throw std::logic_error("no integrator " + o.type);
}

}  // namespace gneiss
