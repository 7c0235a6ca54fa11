// What the nodal criterion sees before a node parts is what ends begin with after: forces of loads, gas and cohesion
// are told apart element by element.

#include "fracture/nodal_criterion.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "integrators/central_difference.hpp"
#include "support/cracking_solid.hpp"
#include "support/one_thread.hpp"
#include "support/plate_with_hole.hpp"
#include "system/march.hpp"

namespace gneiss {
namespace {

enum class Loaded { pressure, traction, gas };

struct CriterionCase {
    bool compt;
    Loaded by;
};

std::string name_of(const testing::TestParamInfo<CriterionCase>& instance) {
    static constexpr std::array names{"Pressure", "Traction", "Gas"};
    return std::string(instance.param.compt ? "Compt" : "Cst") + names[static_cast<std::size_t>(instance.param.by)];
}

/// A hole that is widened until its wall cracks.
class NodalCriterionUnderLoad : public testing::TestWithParam<CriterionCase> {
protected:
    static test::SolidDescription widened(Loaded by) {
        test::SolidDescription what;
        what.materials[0].strength =
            StrengthOptions{{2e6, 2e6}, {8e6, 8e6}, {0.6, 0.6}, {0.4, 0.4}, {200, 200}, {2000, 2000}};
        if (by == Loaded::gas) {
            LumpedOptions gas;
            gas.name = "gas";
            gas.on = "hole";
            gas.pressure = 6e6;
            what.lumped = {gas};
            return what;
        }
        LoadOptions load;
        load.on = "hole";
        load.kind = by == Loaded::pressure ? LoadOptions::Kind::pressure : LoadOptions::Kind::traction;
        if (by == Loaded::pressure)
            load.value = {Formula(6e6), Formula(0.0)};
        else
            load.value = {Formula("6e6*x"), Formula("6e6*y")};
        what.loads = {load};
        return what;
    }
};

INSTANTIATE_TEST_SUITE_P(Cases, NodalCriterionUnderLoad,
                         testing::Values(CriterionCase{false, Loaded::pressure}, CriterionCase{true, Loaded::pressure},
                                         CriterionCase{false, Loaded::traction}, CriterionCase{true, Loaded::traction},
                                         CriterionCase{true, Loaded::gas}),
                         name_of);

TEST_P(NodalCriterionUnderLoad, Ends_BeginWithTheUtilisationThatOpenedThem) {
    test::CrackingSolid solid =
        test::cracking_solid(test::plate_with_hole(GetParam().compt, 5, {0.4, 0.8}), widened(GetParam().by));
    // short steps, so that all that is beyond the envelope is so by little, and one end of a fan is as good as another
    CentralDifference integrator(CentralDifference::Options{.safety = 0.1});
    State state = solid.system->initial_state();
    double largest = 0;
    std::size_t n_openings = 0;
    March march;
    march.t_end = 1.2e-3;
    const std::size_t n_events = 12;
    // in front of what looks at the state: what it will see
    class Witness final : public Event {
    public:
        Witness(const Cracking& cracking, double& largest) : cracking_(cracking), largest_(largest) {}
        std::string name() const override { return "witness"; }
        std::optional<double> next_time(const State&) const override { return std::nullopt; }
        bool watches() const override { return true; }
        EventOutcome apply(State&) override { return EventOutcome::none; }
        EventOutcome look(State& accepted) override {
            largest_ = std::max(largest_, cracking_.indicator(accepted));
            return EventOutcome::none;
        }

    private:
        const Cracking& cracking_;
        double& largest_;
    };
    solid.system->add_event(std::make_unique<Witness>(*solid.cracking, largest));
    march.after_step = [&](const StepReport&) {
        if (solid.cracking->n_events() == n_openings) return true;
        n_openings = solid.cracking->n_events();
        // round-off of forces that are a hundred times the node's
        constexpr double of_large_forces = 1e-9;
        EXPECT_NEAR(solid.cracking->overshoot(state).largest, std::max(largest, 0.0), of_large_forces)
            << "opening " << n_openings << " at " << state.t;
        return n_openings < n_events;
    };
    march.run(*solid.system, integrator, state, false);
    EXPECT_EQ(n_openings, n_events);
    EXPECT_GT(largest, 0);
    EXPECT_LT(largest, 0.05);
}

}  // namespace
}  // namespace gneiss
