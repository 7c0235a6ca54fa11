#pragma once
// The words a deck may use where one of several things is chosen, each with its meaning in one line.

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "model/options.hpp"

namespace gneiss::deck {

template <class E>
struct Choice {
    std::string_view name;
    E value;
    std::string_view meaning;
};

template <class E>
using Choices = std::span<const Choice<E>>;

/// How a deck names what BoundaryOptions holds: `fixed` is short for a displacement of zero.
enum class BoundaryWord { fixed, displacement, velocity, absorbing };

inline constexpr std::array<Choice<MeshOptions::Source>, 3> mesh_generators{{
    {"rectangle", MeshOptions::Source::rectangle,
     "rows and columns of rectangular cells, two composites in each (four if crossed)"},
    {"quadrilateral", MeshOptions::Source::quadrilateral, "the same cells between four corners: a trapezoid, say"},
    {"plate_with_hole", MeshOptions::Source::plate_with_hole,
     "square block with a round hole at its centre, the origin"},
}};

inline constexpr std::array<Choice<MeshOptions::Pattern>, 4> mesh_patterns{{
    {"uniform_right", MeshOptions::Pattern::uniform_right, "every diagonal rises to the right"},
    {"uniform_left", MeshOptions::Pattern::uniform_left, "every diagonal rises to the left"},
    {"alternating", MeshOptions::Pattern::alternating, "diagonals alternate like a chess board"},
    {"crossed", MeshOptions::Pattern::crossed, "both diagonals, four composites in a cell"},
}};

inline constexpr std::array<Choice<MeshOptions::Layout>, 2> mesh_layouts{{
    {"free", MeshOptions::Layout::free, "triangulated freely, without any symmetry"},
    {"structured", MeshOptions::Layout::structured, "rings and rays, with every symmetry of the square"},
}};

inline constexpr std::array<Choice<bool>, 2> row_places{{
    {"times", false, "at the multiples of the interval: cvode, arkode, ida interpolate, steps of others end there"},
    {"steps", true, "at the end of the first step that reaches each multiple: no step is changed"},
}};

inline constexpr std::array<Choice<bool>, 2> vtu_data{{
    {"raw", false, "compressed bytes behind the elements: the smallest files; ParaView and VTK read them"},
    {"base64", true, "the same as text in the element of each array, a third larger: meshio too, under any Python"},
}};

inline constexpr std::array<Choice<bool>, 2> elements{{
    {"compt", true, "composite triangle of six nodes, free of volumetric locking"},
    {"cst", false, "constant strain triangles on the same nodes, four for each composite"},
}};

inline constexpr std::array<Choice<Plane>, 2> planes{{
    {"stress", Plane::stress, "plane stress: a thin plate"},
    {"strain", Plane::strain, "plane strain: a slice of a long body"},
}};

inline constexpr std::array<Choice<Volumetric>, 2> volumetrics{{
    {"mean", Volumetric::mean, "current over initial area of the whole composite; conservative"},
    {"centre", Volumetric::centre, "det F of the middle sub-triangle; not conservative, offered for comparison"},
}};

inline constexpr std::array<Choice<LawKind>, 2> laws{{
    {"munjiza", LawKind::munjiza, "anisotropic, logarithmic stretches of volume, two edges and their angle"},
    {"neo_hookean", LawKind::neo_hookean, "isotropic, compressible neo-Hookean"},
}};

inline constexpr std::array<Choice<Form>, 2> forms{{
    {"hyper", Form::hyper, "stress from the total deformation"},
    {"hypo", Form::hypo, "stress from increments; moduli may depend on the state, initial stress allowed"},
}};

inline constexpr std::array<Choice<StressMap>, 2> stress_maps{{
    {"conjugate", StressMap::conjugate, "forces are the exact gradient of a stored energy"},
    {"direct", StressMap::direct, "Cauchy stress straight from the Munjiza stress; conservative to first order only"},
}};

inline constexpr std::array<Choice<LoadOptions::Kind>, 4> loads{{
    {"nodal_force", LoadOptions::Kind::nodal_force, "the same force on every node of a set"},
    {"traction", LoadOptions::Kind::traction, "force per initial area of a boundary, in fixed directions"},
    {"pressure", LoadOptions::Kind::pressure,
     "follower pressure on a boundary, along its current normal, positive onto the solid"},
    {"body_force", LoadOptions::Kind::body_force, "force per initial volume of a region"},
}};

inline constexpr std::array<Choice<LumpedOptions::Kind>, 3> lumped_models{{
    {"gas", LumpedOptions::Kind::gas, "ideal gas in a cavity, its pressure from the current volume; may leak and burn"},
    {"mass", LumpedOptions::Kind::mass, "rigid platen with a mass on spring and damper: a drop hammer"},
    {"actuator", LumpedOptions::Kind::actuator, "rigid platen on a spring whose motion is given: a testing machine"},
}};

inline constexpr std::array<Choice<BoundaryWord>, 4> boundaries{{
    {"fixed", BoundaryWord::fixed, "no displacement"},
    {"displacement", BoundaryWord::displacement, "given displacement, either component or both"},
    {"velocity", BoundaryWord::velocity, "given velocity, either component or both"},
    {"absorbing", BoundaryWord::absorbing,
     "lets waves out: traction against the velocity, by the impedance of the material"},
}};

inline constexpr std::array<Choice<AmplitudeOptions::Kind>, 5> amplitudes{{
    {"constant", AmplitudeOptions::Kind::constant, "1 at all times"},
    {"heaviside", AmplitudeOptions::Kind::heaviside, "0 before start, 1 from then on"},
    {"ramp", AmplitudeOptions::Kind::ramp, "0 before start, linear, 1 from end on"},
    {"table", AmplitudeOptions::Kind::table, "linear between points, held before the first and after the last"},
    {"expression", AmplitudeOptions::Kind::expression, "an expression of t, x and y"},
}};

inline const std::array<Choice<std::string>, 13> integrators{{
    {"central_difference", "central_difference", "explicit leapfrog of second order, step from the stability bound"},
    {"verlet", "verlet", "explicit compositions of Störmer-Verlet steps, symmetric in time, order 2 to 10"},
    {"noh_bathe", "noh_bathe", "explicit, two sub-steps, order 2, damps frequencies near its limit (Noh and Bathe)"},
    {"generalized_alpha", "generalized_alpha", "implicit, order 2, damps high frequencies alone (Chung and Hulbert)"},
    {"newmark", "newmark", "implicit, order 2 where `gamma` is 1/2"},
    {"hht_alpha", "hht_alpha", "implicit, order 2 (Hilber, Hughes and Taylor)"},
    {"bathe", "bathe", "implicit, two sub-steps, order 2, damps high frequencies (Bathe)"},
    {"cvode", "cvode", "multistep formulas of variable order and step, to a tolerance (SUNDIALS)"},
    {"arkode", "arkode", "Runge-Kutta: explicit, implicit or both, to a tolerance or with fixed steps (SUNDIALS)"},
    {"mri", "mri", "multirate: contact and joints in short steps, the rest in long fixed ones, explicit (SUNDIALS)"},
    {"ida", "ida", "BDF of the system in residual form, to a tolerance (SUNDIALS)"},
    {"quasi_static", "quasi_static", "equilibria under growing loads, by Newton's method; time is load time"},
    {"dynamic_relaxation", "dynamic_relaxation",
     "equilibria under growing loads, by a damped explicit loop; time is load time"},
}};

inline constexpr std::array<Choice<bool>, 2> multistep_methods{{
    {"bdf", false, "backward differentiation, for stiff systems"},
    {"adams", true, "Adams-Moulton, orders up to 12, for motion that has to be resolved anyway"},
}};

inline constexpr std::array<Choice<bool>, 2> iterations{{
    {"newton", false, "Newton's method with exact tangents"},
    {"functional", true, "fixed point, without matrices: steps stay near those of explicit schemes"},
}};

inline const std::array<Choice<std::string>, 45> runge_kutta_tables{{
    {"heun_euler_2_1_2", "heun_euler_2_1_2", "explicit, order 2"},
    {"ralston_euler_2_1_2", "ralston_euler_2_1_2", "explicit, order 2 (SUNDIALS 7.1)"},
    {"explicit_midpoint_euler_2_1_2", "explicit_midpoint_euler_2_1_2", "explicit, order 2 (SUNDIALS 7.1)"},
    {"shu_osher_3_2_3", "shu_osher_3_2_3", "explicit, order 3 (SUNDIALS 6.7)"},
    {"knoth_wolke_3_3", "knoth_wolke_3_3", "explicit, order 3, fixed steps only"},
    {"bogacki_shampine_4_2_3", "bogacki_shampine_4_2_3", "explicit, order 3"},
    {"zonneveld_5_3_4", "zonneveld_5_3_4", "explicit, order 4"},
    {"sofroniou_spaletta_5_3_4", "sofroniou_spaletta_5_3_4", "explicit, order 4 (SUNDIALS 6.7)"},
    {"sayfy_aburub_6_3_4", "sayfy_aburub_6_3_4", "explicit, order 4"},
    {"cash_karp_6_4_5", "cash_karp_6_4_5", "explicit, order 5"},
    {"fehlberg_6_4_5", "fehlberg_6_4_5", "explicit, order 5"},
    {"dormand_prince_7_4_5", "dormand_prince_7_4_5", "explicit, order 5"},
    {"verner_8_5_6", "verner_8_5_6", "explicit, order 6"},
    {"verner_9_5_6", "verner_9_5_6", "explicit, order 6 (SUNDIALS 6.7)"},
    {"verner_10_6_7", "verner_10_6_7", "explicit, order 7 (SUNDIALS 6.7)"},
    {"fehlberg_13_7_8", "fehlberg_13_7_8", "explicit, order 8"},
    {"verner_13_7_8", "verner_13_7_8", "explicit, order 8 (SUNDIALS 6.7)"},
    {"verner_16_8_9", "verner_16_8_9", "explicit, order 9 (SUNDIALS 6.7)"},
    {"backward_euler_1_1", "backward_euler_1_1", "implicit, order 1, fixed steps only (SUNDIALS 7.1)"},
    {"implicit_midpoint_1_2", "implicit_midpoint_1_2", "implicit, order 2, fixed steps only (SUNDIALS 7.1)"},
    {"implicit_trapezoidal_2_2", "implicit_trapezoidal_2_2", "implicit, order 2, fixed steps only (SUNDIALS 7.1)"},
    {"sdirk_2_1_2", "sdirk_2_1_2", "implicit, order 2"},
    {"billington_3_3_2", "billington_3_3_2", "implicit, order 2"},
    {"trbdf2_3_3_2", "trbdf2_3_3_2", "implicit, order 2"},
    {"kvaerno_4_2_3", "kvaerno_4_2_3", "implicit, order 3"},
    {"esdirk324l2sa_4_2_3", "esdirk324l2sa_4_2_3", "implicit, order 3"},
    {"esdirk325l2sa_5_2_3", "esdirk325l2sa_5_2_3", "implicit, order 3"},
    {"esdirk32i5l2sa_5_2_3", "esdirk32i5l2sa_5_2_3", "implicit, order 3"},
    {"cash_5_2_4", "cash_5_2_4", "implicit, order 4"},
    {"cash_5_3_4", "cash_5_3_4", "implicit, order 4"},
    {"sdirk_5_3_4", "sdirk_5_3_4", "implicit, order 4"},
    {"kvaerno_5_3_4", "kvaerno_5_3_4", "implicit, order 4"},
    {"esdirk436l2sa_6_3_4", "esdirk436l2sa_6_3_4", "implicit, order 4"},
    {"esdirk43i6l2sa_6_3_4", "esdirk43i6l2sa_6_3_4", "implicit, order 4"},
    {"qesdirk436l2sa_6_3_4", "qesdirk436l2sa_6_3_4", "implicit, order 4"},
    {"esdirk437l2sa_7_3_4", "esdirk437l2sa_7_3_4", "implicit, order 4"},
    {"kvaerno_7_4_5", "kvaerno_7_4_5", "implicit, order 5"},
    {"esdirk547l2sa_7_4_5", "esdirk547l2sa_7_4_5", "implicit, order 5"},
    {"esdirk547l2sa2_7_4_5", "esdirk547l2sa2_7_4_5", "implicit, order 5"},
    {"ark2_3_1_2", "ark2_3_1_2", "additive, order 2 (SUNDIALS 6.7)"},
    {"ark324l2sa_4_2_3", "ark324l2sa_4_2_3", "additive, order 3"},
    {"ark436l2sa_6_3_4", "ark436l2sa_6_3_4", "additive, order 4"},
    {"ark437l2sa_7_3_4", "ark437l2sa_7_3_4", "additive, order 4"},
    {"ark548l2sa_8_4_5", "ark548l2sa_8_4_5", "additive, order 5"},
    {"ark548l2sab_8_4_5", "ark548l2sab_8_4_5", "additive, order 5"},
}};

/// Whether a table of Runge-Kutta needs no linear systems.
inline bool is_explicit_table(std::string_view name) {
    const auto found = std::ranges::find(runge_kutta_tables, name, &Choice<std::string>::name);
    return found != runge_kutta_tables.end() && found->meaning.starts_with("explicit");
}

inline const std::array<Choice<std::string>, 3> multirate_tables{{
    {"mis_kw3", "mis_kw3", "order 3 (Knoth and Wolke)"},
    {"mri_gark_erk33a", "mri_gark_erk33a", "order 3 (Sandu)"},
    {"mri_gark_erk45a", "mri_gark_erk45a", "order 4 (Sandu)"},
}};

inline constexpr std::array<Choice<bool>, 2> verlet_forms{{
    {"velocity", false, "kick, drift, kick: forces at the end of a sub-step"},
    {"position", true, "drift, kick, drift: forces in the middle of a sub-step, the leapfrog of positions"},
}};

inline const std::array<Choice<std::string>, 7> verlet_compositions{{
    {"single", "single", "one step, order 2"},
    {"yoshida_3", "yoshida_3", "3 sub-steps, order 4 (Yoshida; Forest and Ruth)"},
    {"suzuki_5", "suzuki_5", "5 sub-steps, order 4 (Suzuki)"},
    {"mclachlan_5", "mclachlan_5", "5 sub-steps, order 4 (McLachlan)"},
    {"yoshida_7", "yoshida_7", "7 sub-steps, order 6 (Yoshida)"},
    {"suzuki_umeno_15", "suzuki_umeno_15", "15 sub-steps, order 8 (Suzuki and Umeno)"},
    {"sofroniou_spaletta_35", "sofroniou_spaletta_35", "35 sub-steps, order 10 (Sofroniou and Spaletta)"},
}};

inline constexpr std::array<Choice<FractureOptions::Criterion>, 3> crack_criteria{{
    {"nodal", FractureOptions::Criterion::nodal,
     "a node parts where no tractions inside the envelope keep the elements around it together: the limit of "
     "`intrinsic` for stiff joints"},
    {"mean", FractureOptions::Criterion::mean, "a side opens where the mean traction of its two elements reaches it"},
    {"larger", FractureOptions::Criterion::larger, "a side opens where the larger traction of its two elements does"},
}};

inline constexpr std::array<Choice<FractureOptions::Method>, 4> fracture_methods{{
    {"none", FractureOptions::Method::none, "elements stay together"},
    {"extrinsic", FractureOptions::Method::extrinsic,
     "sides open where their traction reaches the strength and soften from there: no compliance before"},
    {"intrinsic", FractureOptions::Method::intrinsic,
     "joints on every edge from the start, elastic up to the strength, then one damage law in mixed mode"},
    {"y_code", FractureOptions::Method::y_code, "the same with the joint of Y-code, which dissipates 16 % too much"},
}};

inline constexpr std::array<Choice<ContactOptions::Method>, 2> contact_methods{{
    {"none", ContactOptions::Method::none, "bodies pass through each other"},
    {"potential", ContactOptions::Method::potential,
     "points of every boundary against the triangles of every body, pushed out by a potential"},
}};

inline const std::array<Choice<std::string>, 6> linear_solvers{{
    {"automatic", "automatic", "CHOLMOD where the tangent is symmetric and positive definite, UMFPACK elsewhere"},
    {"cholmod", "cholmod", "Cholesky, for symmetric positive definite tangents alone"},
    {"klu", "klu", "LU for small and very sparse matrices"},
    {"umfpack", "umfpack", "LU by fronts, for large matrices"},
    {"pcg", "pcg", "conjugate gradients, for symmetric positive definite tangents alone"},
    {"gmres", "gmres", "generalized minimal residuals, for any tangent"},
}};

inline const std::array<Choice<std::string>, 2> preconditioners{{
    {"incomplete", "incomplete", "a factorisation with about as many entries as the tangent"},
    {"diagonal", "diagonal", "the diagonal: no memory, many iterations"},
}};

inline constexpr std::array<Choice<bool>, 2> step_bounds{{
    {"element", false, "largest frequency of any single element: safe, cheap"},
    {"lanczos", true, "Lanczos estimate for the assembled mesh: a larger step"},
}};

/// The name of a value among the choices; empty if it is not among them.
template <class E, std::size_t n>
std::string_view name_of(const std::array<Choice<E>, n>& choices, const E& value) {
    for (const auto& choice : choices) {
        if (choice.value == value) return choice.name;
    }
    return {};
}

}  // namespace gneiss::deck
