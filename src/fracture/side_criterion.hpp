#pragma once
// Sides open as a whole where the stresses of their two elements reach the strength.

#include "fracture/crack_criterion.hpp"

namespace gneiss {

/// A side opens where the envelope is reached by the mean of the tractions on its two sides, or by the larger one.
/// Nodes part once elements around them have come apart; what an end then begins with is not what the criterion looked
/// at, and may be beyond the strength.
class SideCriterion final : public CrackCriterion {
public:
    enum class Of { mean, larger };
    SideCriterion(Parts parts, Of of) : CrackCriterion(parts), of_(of) {}

private:
    CrackOpenings find(const State& state) override;
    double find_utilisation(const State& state) override;
    /// Closed sides of elements with a stress that may reach their strength, each with its utilisation.
    std::vector<std::pair<std::int32_t, double>> watched_sides(const State& state);
    double utilisation_of(const State& state, std::int32_t side);

    Of of_;
    std::int64_t look_ = 0;
    std::vector<std::int64_t> looked_at_;  ///< per side
    std::vector<std::int32_t> candidates_;
};

}  // namespace gneiss
