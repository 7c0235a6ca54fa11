// VERIFICATION 9 and 10: finite rotations, momenta over many steps, hypo-elastic against hyper-elastic along a motion.

#include <gtest/gtest.h>

#include <cmath>

#include "support/eps.hpp"
#include "support/one_thread.hpp"
#include "verification/run_solid.hpp"

namespace gneiss {
namespace {

using test::eps;

struct Kind {
    bool compt;
    LawKind law;
    Form form;
    StressMap map;
};

std::vector<Kind> every_kind() {
    std::vector<Kind> kinds;
    for (const bool compt : {false, true}) {
        for (const Form form : {Form::hyper, Form::hypo})
            for (const StressMap map : {StressMap::conjugate, StressMap::direct})
                kinds.push_back({compt, LawKind::munjiza, form, map});
        kinds.push_back({compt, LawKind::neo_hookean, Form::hyper, StressMap::conjugate});
    }
    return kinds;
}

test::SolidDescription described(const Kind& kind) {
    test::SolidDescription what;
    what.materials[0].law = kind.law;
    what.materials[0].form = kind.form;
    what.materials[0].stress_map = kind.map;
    what.materials[0].shear_modulus = 0.4e9;
    what.materials[0].lame_lambda = 0.5e9;
    what.materials[0].axes.angle = Formula("0.3 + x*y");
    return what;
}

TEST(RigidRotation, AnyFiniteAngle_Forces_AreZeroToRoundOff) {
    for (const Kind& kind : every_kind()) {
        const test::Solid solid = test::distorted_solid(kind.compt, described(kind));
        for (const double angle : {0.1, 1.0, 1.5707963267948966, 2.5, 3.14159, -2.0}) {
            State state = solid.system->initial_state();
            for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node) {
                const auto& [x, y] = solid.mesh.nodes[node];
                state.u[2 * node] = std::cos(angle) * x - std::sin(angle) * y - x + 3;
                state.u[2 * node + 1] = std::sin(angle) * x + std::cos(angle) * y - y - 1;
            }
            std::vector<double> f(state.u.size());
            solid.system->force(solid.system->initial_state(), Trial::of(state), f);
            // strains to eps |u|/h, |u| <= 8 m, h >= 0.1 m; forces M h of a dozen sub-triangles
            const double tolerance = 16 * eps * (8 / 0.1) * 2e9 * 0.25;
            for (const double component : f) ASSERT_NEAR(component, 0, tolerance) << angle;
        }
    }
}

/// Momentum x, y and moment of momentum about the origin, with the masses' current places.
std::array<double, 3> momenta(const test::Solid& solid, const State& state) {
    std::array<double, 3> sum{};
    for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node) {
        const double mass = solid.system->lumped_mass()[2 * node];
        const double x = solid.mesh.nodes[node][0] + state.u[2 * node],
                     y = solid.mesh.nodes[node][1] + state.u[2 * node + 1];
        const double vx = state.v[2 * node], vy = state.v[2 * node + 1];
        sum[0] += mass * vx;
        sum[1] += mass * vy;
        sum[2] += mass * (x * vy - y * vx);
    }
    return sum;
}

TEST(FreeFlight, SpinningDeformingBody_Momenta_AreKeptToRoundOffOver100000Steps) {
    for (const bool compt : {false, true}) {
        test::SolidDescription what;
        // about the middle: spin of 30 rad/s, stretching at 20/s, and a drift; about (1, 0.5) m
        what.initial = {{"", {Formula("2 - 30*(y - 0.5) + 20*(x - 1)"), Formula("1 + 30*(x - 1) - 10*(y - 0.5)")}}};
        Mesh mesh = test::rectangle(compt, 2, 1, {2, 1});
        test::distort(mesh, 0.5, 0.15, 4);
        const test::Solid solid = test::make_solid(std::move(mesh), what);
        State state = solid.system->initial_state();
        CentralDifference integrator({});
        integrator.start(*solid.system, state, StartReason::fresh);
        const std::array<double, 3> at_start = momenta(solid, state);
        double largest_strain = 0, turned = 0;
        for (int step = 0; step < 100000; ++step) {
            integrator.advance(*solid.system, state, 1e3);
            if (step % 1000 == 0) {
                for (const PointFields& point : solid.system->point_fields(state)) {
                    largest_strain = std::max(largest_strain, std::abs(point.stretch[1] - 1));
                    turned = std::max(turned, std::abs(std::atan2(point.alpha[1], point.alpha[0]) - 0.4));
                }
            }
        }
        EXPECT_GT(largest_strain, 0.01);
        EXPECT_GT(turned, 2);
        const std::array<double, 3> at_end = momenta(solid, state);
        // each step rounds every contribution once: m v, and m v x with x up to 2 km of drift; sums of 2e5 forces at
        // random
        const double mass = 2000, speed = 40, way = 3 * state.t + 2;
        const double steps = std::sqrt(1e5);
        EXPECT_NEAR(at_end[0], at_start[0], 10 * steps * eps * mass * speed) << compt;
        EXPECT_NEAR(at_end[1], at_start[1], 10 * steps * eps * mass * speed) << compt;
        EXPECT_NEAR(at_end[2], at_start[2], 10 * steps * eps * mass * speed * way) << compt;
    }
}

TEST(HypoElastic, ConstantModuli_WholeMotion_EqualsHyperElastic) {
    for (const bool compt : {false, true}) {
        for (const StressMap map : {StressMap::conjugate, StressMap::direct}) {
            std::vector<State> ends;
            for (const Form form : {Form::hyper, Form::hypo}) {
                test::SolidDescription what = described({compt, LawKind::munjiza, form, map});
                what.initial = {
                    {"", {Formula("-30*(y - 0.5) + 40*(x - 1)*y"), Formula("30*(x - 1) - 60*x*(y - 0.5)")}}};
                const test::Solid solid = test::distorted_solid(compt, what);
                ends.push_back(test::run_solid(*solid.system, 0.02, {.safety = 1, .dt = 4e-5}).state);
            }
            double difference = 0, size = 0;
            for (std::size_t i = 0; i < ends[0].u.size(); ++i) {
                difference = std::max(difference, std::abs(ends[0].v[i] - ends[1].v[i]));
                size = std::max(size, std::abs(ends[0].v[i]));
            }
            EXPECT_GT(size, 10);
            EXPECT_LE(difference, 1e-10 * size) << compt;  // round-off that hundreds of steps have let grow
        }
    }
}

}  // namespace
}  // namespace gneiss
