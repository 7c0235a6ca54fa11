#pragma once
// The words a deck may use where one of several things is chosen, each with its meaning in one line.

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

inline constexpr std::array<Choice<MeshOptions::Source>, 2> mesh_generators{{
    {"rectangle", MeshOptions::Source::rectangle,
     "rows and columns of rectangular cells, two composites in each (four if crossed)"},
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

inline const std::array<Choice<std::string>, 2> integrators{{
    {"central_difference", "central_difference", "explicit leapfrog of second order, step from the stability bound"},
    {"quasi_static", "quasi_static", "equilibria under growing loads, by Newton's method; time is load time"},
}};

inline const std::array<Choice<std::string>, 4> linear_solvers{{
    {"automatic", "automatic", "CHOLMOD where the tangent is symmetric and positive definite, UMFPACK elsewhere"},
    {"cholmod", "cholmod", "Cholesky, for symmetric positive definite tangents alone"},
    {"klu", "klu", "LU for small and very sparse matrices"},
    {"umfpack", "umfpack", "LU by fronts, for large matrices"},
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
