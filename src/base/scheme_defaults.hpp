#pragma once
// What a scheme takes where nobody says otherwise: the one place from which options of integrators and linear solvers,
// those of a deck, and with them docs/deck.md, have it. What is zero, false or empty there means "none" and is not
// here.

namespace gneiss::scheme_defaults {

inline constexpr double safety = 0.8;  ///< part of the critical step that explicit schemes take

inline constexpr const char* composition = "single";  ///< of verlet
inline constexpr double split = 0.54;                 ///< of noh_bathe, Noh and Bathe (2013)

inline constexpr double rho_inf = 0.8;             ///< of generalized_alpha and bathe
inline constexpr double beta = 0.25, gamma = 0.5;  ///< of newmark: mean acceleration
inline constexpr double alpha = 0.1;               ///< of hht_alpha

/// Of generalized_alpha, newmark, hht_alpha and bathe: most energy that a step may make or lose at joints and contact,
/// over the largest of the run. A hundred kinks at this bound stay within the thousandth to which cracks balance.
inline constexpr double interface_tolerance = 1e-5;

inline constexpr double rtol = 1e-6;                          ///< of steps from an error estimate
inline constexpr bool stability_detection = false;            ///< of cvode
inline constexpr const char* table = "dormand_prince_7_4_5";  ///< of arkode
inline constexpr const char* slow_table = "mri_gark_erk33a";  ///< of mri

inline constexpr double tolerance = 1e-9;              ///< force out of balance over the largest force
inline constexpr int newton_iterations = 20;           ///< far from quadratic convergence after as many
inline constexpr int relaxation_iterations = 1000000;  ///< of dynamic_relaxation, in a load step
inline constexpr double shortest = 1e-6;               ///< load step over the first one, at which a run gives up

inline constexpr const char* solver = "automatic";           ///< of linear systems
inline constexpr const char* preconditioner = "incomplete";  ///< of pcg and gmres
inline constexpr double linear_tolerance = 1e-8;             ///< of pcg and gmres: residual over right side
inline constexpr int linear_iterations = 10000;              ///< of pcg and gmres in one system

}  // namespace gneiss::scheme_defaults
