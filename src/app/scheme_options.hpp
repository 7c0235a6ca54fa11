#pragma once
// The options of each scheme as a deck gives them. What a deck leaves out is what the scheme has anyway.

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
#include "model/options.hpp"

namespace gneiss {

template <class Scheme>
struct OptionsOf {
    using Type = typename Scheme::Options;
};
template <>
struct OptionsOf<LinearSolver> {
    using Type = LinearSolverOptions;
};

/// Of an integrator, or of the solver of its linear systems. GeneralizedAlpha has three types.
template <class Scheme>
typename OptionsOf<Scheme>::Type options_of(const IntegratorOptions& options);

template <>
LinearSolverOptions options_of<LinearSolver>(const IntegratorOptions& options);
template <>
CentralDifference::Options options_of<CentralDifference>(const IntegratorOptions& options);
template <>
Verlet::Options options_of<Verlet>(const IntegratorOptions& options);
template <>
NohBathe::Options options_of<NohBathe>(const IntegratorOptions& options);
template <>
GeneralizedAlpha::Options options_of<GeneralizedAlpha>(const IntegratorOptions& options);
template <>
Bathe::Options options_of<Bathe>(const IntegratorOptions& options);
template <>
Cvode::Options options_of<Cvode>(const IntegratorOptions& options);
template <>
Arkode::Options options_of<Arkode>(const IntegratorOptions& options);
template <>
Mri::Options options_of<Mri>(const IntegratorOptions& options);
template <>
Ida::Options options_of<Ida>(const IntegratorOptions& options);
template <>
QuasiStatic::Options options_of<QuasiStatic>(const IntegratorOptions& options);
template <>
DynamicRelaxation::Options options_of<DynamicRelaxation>(const IntegratorOptions& options);

}  // namespace gneiss
