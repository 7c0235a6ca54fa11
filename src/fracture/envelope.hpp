#pragma once
// Strength envelope of an intact edge, and the cohesive point that takes its place  [FORMULATION 7].
//
//   (<sigma>/f_t)^2 + (<|tau| - <-sigma> tan phi_i>/c_0)^2 = 1

#include "fracture/cohesion_history.hpp"
#include "fracture/cohesion_properties.hpp"
#include "fracture/parts.hpp"

namespace gneiss {

/// Left side of the envelope, -: 1 on it, more beyond.
/// @param normal  sigma, Pa, tension positive
/// @param shear   tau, Pa
template <class T, class V>
T envelope_index(const CohesionProperties<V>& p, const T& normal, const T& shear) {
    const T tension = positive_part(normal) / T(p.tensile_strength);
    const T cohesive = positive_part(T(magnitude(shear) - p.tan_phi_initial * positive_part(T(-normal))));
    const T ratio = cohesive / T(p.cohesion);
    return tension * tension + ratio * ratio;
}

/// The start of an extrinsic point.
template <class V>
struct InsertedPoint {
    CohesionHistory<V> history;
    V strength_factor;  ///< -, >= 1, by which f_t and c_0 of this point are to be multiplied
    V offset_energy;    ///< J/m2, stored in the springs of the new point: a column of the ledger
};

/// Puts a point of `MixedModeLaw<Insertion::extrinsic>` where an edge carries a traction, so that its traction at
/// o = s = 0 is the same. Shear is parted into friction, at most tan phi_i <-sigma>, and a cohesive rest; offsets and
/// slider load the springs accordingly.
///
/// A step that finds an edge beyond its envelope by some percent has found its strength: the point gets it, by
/// `strength_factor`; energies stay. An edge may also be inserted below its envelope, when another point of the same
/// edge is beyond: it is then elastic with k up to it, and dissipates a little more than G.
/// @param p       as given, not yet scaled
/// @param normal  sigma, Pa, tension positive
/// @param shear   tau, Pa
template <class V>
InsertedPoint<V> insert_point(const CohesionProperties<V>& p, const V& normal, const V& shear) {
    using std::sqrt;
    using xsimd::sqrt;
    const V limit = p.tan_phi_initial * positive_part(V(-normal)), all = magnitude(shear);
    const V friction = with_sign_of(shear, choose(limit < all, limit, all));
    const V cohesive = shear - friction;
    InsertedPoint<V> point;
    point.history.lambda_max = V(1.0);
    point.history.opening_offset = normal / p.penalty;
    point.history.slip_offset = cohesive / p.penalty;
    point.history.slider = -friction / p.penalty;
    const V index = envelope_index(p, normal, shear);
    point.strength_factor = choose(index > 1.0, V(sqrt(index)), V(1.0));
    point.offset_energy = 0.5 * (normal * normal + cohesive * cohesive + friction * friction) / p.penalty;
    return point;
}

}  // namespace gneiss
