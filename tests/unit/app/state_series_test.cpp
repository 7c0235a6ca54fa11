// Whole states in a file, and how far they are from each other.

#include "app/state_series.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <numeric>

#include "app/comparison.hpp"
#include "base/errors.hpp"
#include "unit/app/square_case.hpp"

namespace gneiss {
namespace {

class StateSeriesOf : public testing::TestWithParam<bool> {
protected:
    std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("gneiss_states_" + std::to_string(::getpid()) + ".h5");
    std::unique_ptr<Case> built = [] {
        CaseOptions options = test::square_options();
        options.solid.compt = GetParam();
        return std::make_unique<Case>(build_case(options));
    }();
    ~StateSeriesOf() override { std::filesystem::remove(file); }

    /// A state with the displacement gradient h and the velocity (v, 2 v) at time t.
    State state_at(double t, double h, double v) const {
        State state = built->system->initial_state();
        state.t = t;
        test::displace(state, *built->mesh, {h, 0, 0, 0});
        for (std::size_t i = 0; i < state.v.size(); ++i) state.v[i] = i % 2 == 0 ? v : 2 * v;
        return state;
    }
};
INSTANTIATE_TEST_SUITE_P(Elements, StateSeriesOf, testing::Bool(),
                         [](const auto& instance) { return std::string(instance.param ? "Compt" : "Cst"); });

TEST_P(StateSeriesOf, ReadAgain_IsWhatWasWritten) {
    StateSeries series(file, *built->mesh, std::nullopt);
    const State first = state_at(0.1, 1e-3, 2), second = state_at(0.2, 2e-3, -1);
    series.add(*built->system, first);
    series.add(*built->system, second);
    series.save();
    const SavedStates read = read_states(file);
    ASSERT_EQ(read.samples.size(), 2u);
    EXPECT_EQ(read.samples[1].t, 0.2);
    const auto sum = [](const std::vector<double>& values) {
        return std::accumulate(values.begin(), values.end(), 0.0);
    };
    EXPECT_NEAR(sum(read.places.node_area), 1, 1e-14);
    EXPECT_NEAR(sum(read.places.triangle_area), 1, 1e-14);
    for (std::size_t k = 0; k < built->mesh->connectivity.size(); ++k) {
        const auto node = static_cast<std::size_t>(built->mesh->connectivity[k]);
        EXPECT_EQ(read.samples[0].displacement[2 * k], first.u[2 * node]);
        EXPECT_EQ(read.samples[1].velocity[2 * k + 1], -2);
        EXPECT_EQ(read.places.node_at[2 * k], built->mesh->nodes[node][0]);
    }
    EXPECT_EQ(read.samples[0].stress.size(), 3 * read.places.triangle_area.size());

    // a restart at t = 0.15 drops what is later
    StateSeries resumed(file, *built->mesh, 0.15);
    resumed.save();
    EXPECT_EQ(read_states(file).samples.size(), 1u);
}

TEST_P(StateSeriesOf, Errors_AreRelativeToTheLargestOfTheReference) {
    StateSeries series(file, *built->mesh, std::nullopt);
    series.add(*built->system, state_at(0.1, 1e-3, 2));
    series.add(*built->system, state_at(0.2, 4e-3, 1));
    series.save();
    const SavedStates reference = read_states(file);
    SavedStates other = reference;
    for (double& u : other.samples[0].displacement) u *= 1.1;
    for (double& v : other.samples[1].velocity) v += 0.1;
    const StateErrors errors = errors_against(other, reference);
    // 0.1 of a quarter of the largest; both components by 0.1 of (2, 4)
    EXPECT_NEAR(errors.displacement.value(), 0.025, 1e-14);
    EXPECT_NEAR(errors.velocity.value(), 0.1 * std::sqrt(2.0) / std::sqrt(20.0), 1e-14);
    EXPECT_EQ(errors.stress, 0);

    ExactOptions exact;
    exact.displacement = {Formula("1e-3*x*(t < 0.15 ? 1 : 4)"), Formula(0.0)};
    exact.velocity = {Formula("t < 0.15 ? 2 : 1"), Formula("t < 0.15 ? 4 : 2")};
    const StateErrors against_form = errors_against(other, exact);
    EXPECT_NEAR(against_form.displacement.value(), errors.displacement.value(), 1e-14);
    EXPECT_NEAR(against_form.velocity.value(), errors.velocity.value(), 1e-14);
    EXPECT_FALSE(against_form.stress);

    other.samples[0].t = 0.11;
    EXPECT_THROW(errors_against(other, reference), InputError);
    other.samples.pop_back();
    EXPECT_THROW(errors_against(other, reference), InputError);
}

}  // namespace
}  // namespace gneiss
