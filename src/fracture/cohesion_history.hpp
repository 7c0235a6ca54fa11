#pragma once
// What a point of an interface remembers.

#include <array>

#include "base/dual.hpp"

namespace gneiss {

/// Changed only when a step is accepted: laws take it by const reference and return a new one  [FORMULATION 1].
/// All zeros is the intact point of an intrinsic joint, which has nothing to remember: it stays all zeros until it
/// reaches the envelope, so that blocks of intact points need not be written.
/// @tparam T  double, Pack or Dual
template <class T>
struct CohesionHistory {
    T damage = T(0.0);          ///< D, -, 0 to 1
    T lambda_max = T(0.0);      ///< largest lambda so far, -, >= 1; below 1: intact
    T opening = T(0.0);         ///< o at the accepted state, m
    T slip = T(0.0);            ///< s at the accepted state, m
    T slider = T(0.0);          ///< where the spring of friction is without load, m
    T opening_offset = T(0.0);  ///< o* - o, m
    T slip_offset = T(0.0);     ///< s* - s, m
    T fracture_i = T(0.0);      ///< dissipated by fracture so far, J/m2, in opening
    T fracture_ii = T(0.0);     ///< the same in sliding
    T friction = T(0.0);        ///< dissipated by friction so far, J/m2

    /// For loops over all entries: blocks store one array per entry, or one array of them.
    static constexpr std::array<T CohesionHistory::*, 10> members{
        &CohesionHistory::damage,      &CohesionHistory::lambda_max, &CohesionHistory::opening,
        &CohesionHistory::slip,        &CohesionHistory::slider,     &CohesionHistory::opening_offset,
        &CohesionHistory::slip_offset, &CohesionHistory::fracture_i, &CohesionHistory::fracture_ii,
        &CohesionHistory::friction};

    /// Dissipated by fracture so far, J/m2.
    T fracture() const { return fracture_i + fracture_ii; }
};

/// The start of an intact point that carries a traction although nothing has moved.
template <class History>
struct LoadedStart {
    double opening, slip;  ///< m, that the law takes on top of those of the joint
    History history;
};

/// a where the condition holds, else b: entry by entry.
template <class History, class Condition>
History choose_history(const Condition& condition, const History& a, const History& b) {
    History c;
    for (const auto member : History::members) c.*member = choose(condition, a.*member, b.*member);
    return c;
}

}  // namespace gneiss
