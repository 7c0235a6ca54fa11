#pragma once
// Plane waves in an anisotropic solid, and boundaries that let them leave  [FORMULATION 8, 9].

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "base/vec2.hpp"
#include "materials/elastic_constants.hpp"
#include "mesh/mesh.hpp"
#include "system/semi_discrete.hpp"

namespace gneiss {

/// Small-strain stiffness of the plane on orthogonal material axes alpha, beta, Pa, with what else a wave needs.
struct PlaneStiffness {
    double C_aaaa, C_bbbb, C_aabb, C_abab;
    double axis_angle;  ///< of alpha from x, rad
    double density;     ///< kg/m3, > 0
};

/// C_aaaa = M_v + M_alpha, C_bbbb = M_v + M_beta, C_aabb = M_v, C_abab = M_psi/2  [FORMULATION 9].
PlaneStiffness plane_stiffness(const MunjizaConstants& constants, double axis_angle, double density);

/// A symmetric 2 x 2 matrix.
struct SymmetricMatrix {
    double xx, xy, yy;

    Vec2<double> operator*(const Vec2<double>& v) const { return {xx * v.x + xy * v.y, xy * v.x + yy * v.y}; }
};

/// Gamma_ik = C_ijkl n_j n_l, Pa, in x and y.
/// @param n  unit vector
SymmetricMatrix christoffel_matrix(const PlaneStiffness& stiffness, const Vec2<double>& n);

/// The symmetric positive definite root of such a matrix, by Cayley and Hamilton:
/// (A + sqrt(det A) I) / sqrt(tr A + 2 sqrt(det A)).
SymmetricMatrix square_root(const SymmetricMatrix& matrix);

/// Z = (rho Gamma(n))^(1/2), Pa s/m: a plane wave that leaves along n has the traction -Z v on the plane normal to n.
SymmetricMatrix impedance(const PlaneStiffness& stiffness, const Vec2<double>& n);

/// A plane wave along a given direction n.
struct PlaneWave {
    double phase_speed;           ///< along n, m/s
    Vec2<double> polarisation;    ///< unit vector of the particle motion
    Vec2<double> group_velocity;  ///< of its energy, m/s; its component along n is the phase speed
};

/// The faster wave (quasi-longitudinal where the names make sense) and the slower one.
/// @param n  unit vector
std::array<PlaneWave, 2> plane_waves(const PlaneStiffness& stiffness, const Vec2<double>& n);

/// C of a boundary with the traction -Z v: each edge gives h L/2 Z of its outward reference normal to both its nodes.
/// Exact for plane waves that meet the boundary normally, of either polarisation.
/// @param edges      each once
/// @param stiffness  of an element of the mesh
/// @param thickness  h, m, > 0
/// @return N s/m, by ascending node, one block per node
std::vector<Damping::Block> absorbing_blocks(const Mesh& mesh, std::span<const BoundaryEdge> edges,
                                             const std::function<PlaneStiffness(int element)>& stiffness,
                                             double thickness);

/// Energy that leaves through the blocks between two accepted states, J: 1/2 (C v_from + C v_to) . (u_to - u_from), the
/// sum that closes the balance of the leapfrog.
double absorbed_work(std::span<const Damping::Block> blocks, const Trial& from, const Trial& to);

}  // namespace gneiss
