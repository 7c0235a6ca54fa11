// Joints on every edge of a small solid: forces, tangents, energies.

#include "fracture/joints.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <numeric>
#include <random>

#include "fracture/initial_tractions.hpp"
#include "model/stress_at_rest.hpp"
#include "support/one_thread.hpp"
#include "support/small_solids.hpp"

namespace gneiss {
namespace {

/// Strengths of rock, friction and all, and a penalty of twenty times the stiffness of an element.
CohesionProperties<double> strength() {
    return {.tensile_strength = 3e6,
            .cohesion = 8e6,
            .tan_phi_initial = 0.6,
            .tan_phi_residual = 0.4,
            .fracture_energy_i = 300,
            .fracture_energy_ii = 900,
            .penalty = 1e11};
}

struct Jointed {
    std::unique_ptr<InnerSides> sides;
    test::Solid solid;
};

/// @param stressed  in situ, not in equilibrium at the boundary, nor inside
Jointed jointed(bool compt, JointLaw law, bool stressed) {
    Mesh mesh = test::rectangle(compt, 2, 1, {2, 1});
    test::distort(mesh, 0.25, 0.25, 3);
    auto sides = std::make_unique<InnerSides>(mesh);
    std::vector<std::int32_t> all(sides->sides().size());
    std::iota(all.begin(), all.end(), 0);
    sides->open(all);
    std::vector<Joint> joints;
    for (const JointEdge& edge : joint_edges(mesh, *sides, all)) joints.push_back({edge.nodes, strength(), edge.side});
    test::SolidDescription what;
    if (stressed) {
        what.materials[0].form = Form::hypo;
        what.materials[0].in_situ_stress = {Formula("-5e6 - 1e6*y"), Formula(-2e6), Formula("3e5*x")};
    }
    const Mesh copy = mesh;  // make_solid() takes the mesh before it asks for more parts
    Joints* made = nullptr;
    test::Solid solid = test::make_solid(std::move(mesh), what, [&](SolidSystem::Parts& parts) {
        auto interaction = make_joints(copy, joints, law, 1);
        made = interaction.get();
        parts.interactions.push_back(std::move(interaction));
    });
    if (stressed) {
        EXPECT_EQ(preload_joints(*made, *sides, *solid.system, stress_at_rest(*solid.system)), 0U);
    }
    return {std::move(sides), std::move(solid)};
}

struct Choice {
    const char* name;
    bool compt;
    JointLaw law;
    bool stressed = false;
};

class JointsOf : public testing::TestWithParam<Choice> {
protected:
    Jointed made = jointed(GetParam().compt, GetParam().law, GetParam().stressed);
    const test::Solid& solid = made.solid;
    const SolidSystem& system = *solid.system;
    const State rest = system.initial_state();

    /// Nodes moved at random, in their two parts of a joint apart, by up to `size`, m.
    State moved(double size, unsigned seed) const {
        State state = rest;
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> uniform(-size, size);
        for (double& u : state.u) u = uniform(random);
        return state;
    }
    State accepted(const State& from, State to) const {
        std::vector<double> f(to.u.size()), z(to.z.size()), history(to.history.size());
        system.force_and_update(from, Trial::of(to), f, z, history);
        to.history = history;
        to.z = z;
        system.add_path_energies(from, to);
        return to;
    }
    std::vector<double> force(const State& from, const State& at) const {
        std::vector<double> f(at.u.size());
        system.force(from, Trial::of(at), f);
        return f;
    }
};

INSTANTIATE_TEST_SUITE_P(ElementsAndLaws, JointsOf,
                         testing::Values(Choice{"CstIntrinsic", false, JointLaw::intrinsic},
                                         Choice{"ComptIntrinsic", true, JointLaw::intrinsic},
                                         Choice{"CstYCode", false, JointLaw::y_code},
                                         Choice{"ComptYCode", true, JointLaw::y_code},
                                         Choice{"CstIntrinsicInSitu", false, JointLaw::intrinsic, true},
                                         Choice{"ComptIntrinsicInSitu", true, JointLaw::intrinsic, true},
                                         Choice{"CstYCodeInSitu", false, JointLaw::y_code, true},
                                         Choice{"ComptYCodeInSitu", true, JointLaw::y_code, true}),
                         [](const auto& instance) { return std::string(instance.param.name); });

double largest(const std::vector<double>& values) {
    double size = 0;
    for (const double value : values) size = std::max(size, std::abs(value));
    return size;
}

// openings at the strength are 3e-5 m, at failure some 2e-4 m
constexpr double elastic = 5e-6, softening = 5e-5, broken = 2e-3;

TEST_P(JointsOf, ElementsApart_FeelOneAnotherThroughThem) {
    EXPECT_EQ(solid.mesh.n_nodes(), solid.mesh.connectivity.size());
    EXPECT_GT(rest.history.size(), 0u);
    if (!GetParam().stressed) {
        EXPECT_EQ(largest(force(rest, rest)), 0);
    }
}

TEST_P(JointsOf, AtRest_CopiesOfANodeHaveOneAcceleration_AndNothingIsLost) {
    const std::vector<double> f = force(rest, rest);
    const auto mass = system.lumped_mass();
    const auto original = made.sides->original_of();
    std::vector<double> sum(2 * solid.mesh.n_nodes(), 0.0), weight = sum;
    for (std::size_t i = 0; i < f.size(); ++i) {
        const std::size_t to = 2 * static_cast<std::size_t>(original[i / 2]) + i % 2;
        sum[to] += f[i];
        weight[to] += mass[i];
    }
    double most = 0;
    for (std::size_t i = 0; i < f.size(); ++i) {
        const std::size_t of = 2 * static_cast<std::size_t>(original[i / 2]) + i % 2;
        most = std::max(most, std::abs(f[i] - mass[i] * sum[of] / weight[of]));
    }
    constexpr double traction = 8e6;  // Pa, on sides of 1 m at most: round-off of a dozen of them
    EXPECT_LE(most, 100 * std::numeric_limits<double>::epsilon() * traction);
    const State after = accepted(rest, rest);
    // springs of friction that start at their limit slip by round-off of 1e-5 m, under 1e6 N
    EXPECT_NEAR(after.path.friction, 0, 10 * std::numeric_limits<double>::epsilon() * 1e-5 * 1e6);
    EXPECT_EQ(after.path.fracture, 0);
}

TEST_P(JointsOf, RigidMotion_IsFree) {
    if (GetParam().stressed) GTEST_SKIP() << "its boundary lacks the tractions of the stress in it";
    State turned = rest;
    const double angle = 1.1;
    for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node) {
        const auto& [x, y] = solid.mesh.nodes[node];
        turned.u[2 * node] = std::cos(angle) * x - std::sin(angle) * y - x + 3;
        turned.u[2 * node + 1] = std::sin(angle) * x + std::cos(angle) * y - y - 2;
    }
    // round-off of positions of some metres, 1e-15, times penalty and length
    EXPECT_LE(largest(force(rest, turned)), 1e-14 * 1e11);
}

TEST_P(JointsOf, Forces_BalanceInForceAndMoment) {
    for (const double size : {elastic, softening, broken}) {
        const State at = moved(size, 4);
        const std::vector<double> f = force(rest, at);
        double x = 0, y = 0, moment = 0;
        for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node) {
            const double px = solid.mesh.nodes[node][0] + at.u[2 * node];
            const double py = solid.mesh.nodes[node][1] + at.u[2 * node + 1];
            x += f[2 * node];
            y += f[2 * node + 1];
            moment += px * f[2 * node + 1] - py * f[2 * node];
        }
        // round-off of some hundred forces, times arms of 2 m
        EXPECT_LE(std::max({std::abs(x), std::abs(y), std::abs(moment)}), 1e-13 * largest(f));
    }
}

TEST_P(JointsOf, Tangent_IsTheDerivativeOfTheForce) {
    const State softened = accepted(rest, moved(softening, 5));
    struct At {
        State from, at;
    };
    for (const auto& [from, at] : {At{rest, moved(elastic, 4)}, At{rest, moved(softening, 4)},
                                   At{softened, moved(softening, 6)}, At{softened, moved(2 * softening, 7)}}) {
        const Eigen::MatrixXd matrix = test::dense(*system.tangent(), from, Trial::of(at), {.stiffness = 1});
        // central differences of 1e-9 m against openings of 1e-5 m and curvature over 1e-5 m: (1e-4)^2; a kink of the
        // law may lie within them: hence few entries, not all
        const double step = 1e-9;
        std::size_t far = 0;
        State plus = at, minus = at;
        for (std::size_t j = 0; j < at.u.size(); ++j) {
            plus.u[j] = at.u[j] + step;
            minus.u[j] = at.u[j] - step;
            const std::vector<double> f_plus = force(from, plus), f_minus = force(from, minus);
            plus.u[j] = minus.u[j] = at.u[j];
            for (std::size_t i = 0; i < at.u.size(); ++i) {
                const double expected = (f_minus[i] - f_plus[i]) / (2 * step);
                const double error =
                    std::abs(matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) - expected);
                far += error > 1e-5 * matrix.cwiseAbs().maxCoeff();
            }
        }
        EXPECT_EQ(far, 0u);
    }
}

TEST_P(JointsOf, WorkAlongAPath_IsStoredOrDissipated) {
    // straight out to `size` and back, in steps whose trapezoidal error is of the second order
    for (const double size : {elastic, softening, broken}) {
        const State end = moved(size, 9);
        double errors[2] = {};
        for (const int refined : {0, 1}) {
            const int n = refined ? 800 : 400;
            State at = rest;
            double work = 0, most = 0;  // on the joints and elements
            std::vector<double> f_before = force(at, at);
            for (int step = 1; step <= 2 * n; ++step) {
                const double part = step <= n ? static_cast<double>(step) / n : 2 - static_cast<double>(step) / n;
                State next = at;
                for (std::size_t i = 0; i < next.u.size(); ++i) next.u[i] = part * end.u[i];
                const std::vector<double> f = force(at, next);
                for (std::size_t i = 0; i < f.size(); ++i) work -= 0.5 * (f[i] + f_before[i]) * (next.u[i] - at.u[i]);
                most = std::max(most, work);
                at = accepted(at, next);
                f_before = f;
            }
            const double stored = system.stored_energies(at).sum() - system.stored_energies(rest).sum();
            const double lost = at.path.fracture + at.path.friction;
            errors[refined] = std::abs(work - stored - lost);
            EXPECT_LE(errors[refined], 1e-3 * most) << size;
            if (size == elastic && GetParam().law == JointLaw::intrinsic) {
                EXPECT_EQ(lost, 0);
            }
            if (size == broken) {
                EXPECT_GT(at.path.fracture, 100);
            }
        }
        // of the first order where lanes pass kinks of the law; round-off where all is elastic
        EXPECT_LE(errors[1], 0.6 * errors[0] + 1e-9) << size;
    }
}

TEST_P(JointsOf, OneAndTwoThreads_SameBits) {
    const State at = moved(softening, 4);
    const std::vector<double> once = force(rest, at);
    omp_set_num_threads(2);
    EXPECT_EQ(force(rest, at), once);
    omp_set_num_threads(1);
}

TEST_P(JointsOf, FrequencyBound_IsAboveTheHighestFrequency) {
    const double exact = test::dense_frequencies(system, rest).maxCoeff(), bound = system.frequency_bound(rest).omega;
    EXPECT_GE(bound, exact);
    EXPECT_LE(bound, 2.5 * exact);
}

}  // namespace
}  // namespace gneiss
