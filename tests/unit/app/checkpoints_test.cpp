#include "app/checkpoints.hpp"

#include <gmock/gmock.h>

#include "base/errors.hpp"
#include "system/march.hpp"
#include "unit/app/square_case.hpp"
#include "unit/io/output_folder.hpp"

namespace gneiss {
namespace {

using test::square_options;

class Checkpoints : public test::OutputFolder {
protected:
    static CaseOptions options() {
        CaseOptions options = square_options();
        options.materials[0].form = Form::hypo;
        options.materials[0].shear_viscosity = 10;
        options.loads.emplace_back();
        options.loads[0].kind = LoadOptions::Kind::pressure;
        options.loads[0].on = "left";
        options.loads[0].value = {1e6, 0.0};
        options.run.mass_damping = 10;
        return options;
    }
    /// Marches `n` steps.
    static void step(const Case& built, State& state, int n, bool resumed) {
        March march;
        march.t_end = built.options.run.t_end;
        march.after_step = [&n](const StepReport&) { return --n > 0; };
        march.run(*built.system, *built.integrator, state, resumed);
    }
    std::filesystem::path path() const { return folder / "checkpoint.h5"; }
};

TEST_F(Checkpoints, SavedAndLoaded_EverythingIsTheSame) {
    const Case built = build_case(options());
    State state = built.system->initial_state();
    step(built, state, 5, false);
    save_checkpoint(path(), "fnv1a64:1", built, state, {5, -2.5});

    const Case again = build_case(options());
    State loaded = again.system->initial_state();
    RunProgress progress;
    EXPECT_EQ(load_checkpoint(path(), again, loaded, progress), "fnv1a64:1");
    EXPECT_EQ(progress.step, 5u);
    EXPECT_EQ(progress.initial_energy, -2.5);
    EXPECT_EQ(loaded.t, state.t);
    EXPECT_EQ(loaded.last_event, state.last_event);
    EXPECT_EQ(loaded.u, state.u);
    EXPECT_EQ(loaded.v, state.v);
    EXPECT_EQ(loaded.z, state.z);
    EXPECT_EQ(loaded.history, state.history);
    EXPECT_FALSE(state.z.empty());
    EXPECT_NE(state.path.external_work, 0);
    EXPECT_EQ(loaded.path.external_work, state.path.external_work);
    EXPECT_EQ(loaded.path.damping, state.path.damping);
    EXPECT_EQ(loaded.path.viscous, state.path.viscous);
    EXPECT_EQ(loaded.path.viscous_power, state.path.viscous_power);
    EXPECT_EQ(again.integrator->save(), built.integrator->save());

    step(built, state, 5, true);
    step(again, loaded, 5, true);
    EXPECT_EQ(loaded.u, state.u);
    EXPECT_EQ(loaded.v, state.v);
}

TEST_F(Checkpoints, OtherMeshOrSystem_IsRefused) {
    const Case built = build_case(options());
    State state = built.system->initial_state();
    step(built, state, 1, false);
    save_checkpoint(path(), "fnv1a64:1", built, state, {1, 0});
    const auto error_with = [&](const CaseOptions& other) {
        const Case wrong = build_case(other);
        State into = wrong.system->initial_state();
        RunProgress progress;
        return test::message_of<InputError>([&] { load_checkpoint(path(), wrong, into, progress); });
    };
    CaseOptions other = options();
    other.mesh.width = 2;
    EXPECT_EQ(
        error_with(other),
        path().string() +
            ": was written for another mesh or other laws than the deck gives, or by a program built for other packs");
    other = options();
    other.solid.compt = false;
    EXPECT_EQ(
        error_with(other),
        path().string() +
            ": was written for another mesh or other laws than the deck gives, or by a program built for other packs");
    other = options();
    other.materials[0].form = Form::hyper;
    EXPECT_THAT(error_with(other), testing::HasSubstr("other laws than the deck gives"));
}

}  // namespace
}  // namespace gneiss
