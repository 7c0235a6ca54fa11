#include "app/make_integrator.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "app/scheme_options.hpp"

namespace gneiss {

bool has_critical_step(const IntegratorOptions& o) {
    return o.type == "central_difference" || o.type == "verlet" || o.type == "noh_bathe";
}

namespace {

bool is_alpha(const IntegratorOptions& o) {
    return o.type == "generalized_alpha" || o.type == "newmark" || o.type == "hht_alpha";
}

template <class Scheme>
std::unique_ptr<Integrator> made(const IntegratorOptions& o) {
    return std::make_unique<Scheme>(options_of<Scheme>(o));
}

}  // namespace

void check_linear_solver(const IntegratorOptions& o, const SemiDiscrete& system) {
    if (o.solver == IntegratorOptions().solver) return;
    std::vector<Problem> problems;
    options_of<LinearSolver>(o).check_symmetry(system.tangent()->symmetric(), problems);
    if (!problems.empty()) throw InputError(problems);
}

std::unique_ptr<Integrator> make_integrator(const IntegratorOptions& o, bool contact) {
    if (o.type == "central_difference")
        return std::make_unique<CentralDifference>(options_of<CentralDifference>(o), o.levels);
    if (o.type == "verlet") return made<Verlet>(o);
    if (o.type == "noh_bathe") return made<NohBathe>(o);
    if (o.type == "bathe") return made<Bathe>(o);
    if (o.type == "quasi_static") {
        auto options = options_of<QuasiStatic>(o);
        options.contact = contact;
        return std::make_unique<QuasiStatic>(options);
    }
    if (o.type == "dynamic_relaxation") return made<DynamicRelaxation>(o);
    if (is_alpha(o)) return made<GeneralizedAlpha>(o);
    if (o.type == "cvode") return made<Cvode>(o);
    if (o.type == "arkode") return made<Arkode>(o);
    if (o.type == "mri") return made<Mri>(o);
    if (o.type == "ida") return made<Ida>(o);
    throw std::logic_error("no integrator " + o.type);
}

}  // namespace gneiss
