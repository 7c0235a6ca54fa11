#include "app/scheme_options.hpp"

namespace gneiss {
namespace {

ProblemScales::Given scales(const IntegratorOptions& o) {
    return {o.displacement_scale, o.velocity_scale, o.stress_scale};
}

template <class Options>
Options to_a_tolerance(const IntegratorOptions& o) {
    Options options;
    options.rtol = o.rtol;
    options.scales = scales(o);
    options.longest = o.longest;
    options.solver = options_of<LinearSolver>(o);
    return options;
}

int newton_iterations(const IntegratorOptions& o) {
    return o.most_iterations > 0 ? o.most_iterations : scheme_defaults::newton_iterations;
}

}  // namespace

template <>
LinearSolverOptions options_of<LinearSolver>(const IntegratorOptions& o) {
    LinearSolverOptions options(o.solver);
    options.preconditioner = o.preconditioner;
    options.tolerance = o.linear_tolerance;
    options.most_iterations = static_cast<std::size_t>(o.most_linear_iterations);
    return options;
}

template <>
CentralDifference::Options options_of<CentralDifference>(const IntegratorOptions& o) {
    return {.safety = o.safety, .dt = o.dt, .lanczos = o.lanczos};
}

template <>
Verlet::Options options_of<Verlet>(const IntegratorOptions& o) {
    return {options_of<CentralDifference>(o), o.position_form ? Verlet::Form::position : Verlet::Form::velocity,
            o.composition};
}

template <>
NohBathe::Options options_of<NohBathe>(const IntegratorOptions& o) {
    return {options_of<CentralDifference>(o), o.split};
}

template <>
GeneralizedAlpha::Options options_of<GeneralizedAlpha>(const IntegratorOptions& o) {
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
    options.interface_tolerance = o.interface_tolerance;
    options.tolerance = o.tolerance;
    options.most_iterations = newton_iterations(o);
    options.solver = options_of<LinearSolver>(o);
    return options;
}

template <>
Bathe::Options options_of<Bathe>(const IntegratorOptions& o) {
    return {o.rho_inf, o.dt, {o.tolerance, newton_iterations(o), options_of<LinearSolver>(o)}, o.interface_tolerance};
}

template <>
Cvode::Options options_of<Cvode>(const IntegratorOptions& o) {
    auto options = to_a_tolerance<Cvode::Options>(o);
    options.method = o.adams ? Cvode::Method::adams : Cvode::Method::bdf;
    options.iteration = o.functional ? Cvode::Iteration::functional : Cvode::Iteration::newton;
    options.stability_detection = o.stability_detection;
    options.max_order = o.max_order;
    return options;
}

template <>
Arkode::Options options_of<Arkode>(const IntegratorOptions& o) {
    auto options = to_a_tolerance<Arkode::Options>(o);
    options.table = o.table;
    options.dt = o.dt;
    return options;
}

template <>
Mri::Options options_of<Mri>(const IntegratorOptions& o) {
    auto options = to_a_tolerance<Mri::Options>(o);
    options.table = o.slow_table;
    options.dt = o.dt;
    return options;
}

template <>
Ida::Options options_of<Ida>(const IntegratorOptions& o) {
    auto options = to_a_tolerance<Ida::Options>(o);
    options.max_order = o.max_order;
    return options;
}

template <>
QuasiStatic::Options options_of<QuasiStatic>(const IntegratorOptions& o) {
    return {options_of<DynamicRelaxation>(o), options_of<LinearSolver>(o), o.matrix_free};
}

template <>
DynamicRelaxation::Options options_of<DynamicRelaxation>(const IntegratorOptions& o) {
    return {o.tolerance, o.step, o.longest, o.shortest, o.most_iterations};
}

}  // namespace gneiss
