// Joints of a solid of several chunks of elements: inside chunks, between them, and displacements that come chunk by
// chunk.

#include <gtest/gtest.h>
#include <omp.h>

#include <array>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "fracture/cohesion_law.hpp"
#include "fracture/joint_kernel.hpp"
#include "fracture/joints.hpp"
#include "support/small_solids.hpp"

namespace gneiss {
namespace {

using Law = MixedModeLaw<Insertion::intrinsic>;

const CohesionProperties<double> joint_properties{.tensile_strength = 3e6,
                                                  .cohesion = 8e6,
                                                  .tan_phi_initial = 0.6,
                                                  .tan_phi_residual = 0.4,
                                                  .fracture_energy_i = 300,
                                                  .fracture_energy_ii = 900,
                                                  .penalty = 1e11};
// Openings are up to these, m, and 3e-5 at the strength. In between many ends are further apart than that and intact,
// because they are compressed or slide: packs of them need the law to tell, most do stay elastic.
constexpr double elastic_size = 5e-6, mixed_size = 3.2e-5, softening_size = 5e-5;

class JointsInChunks : public testing::TestWithParam<bool> {
protected:
    JointsInChunks() {
        omp_set_num_threads(1);
        // 4096 sub-triangles, four chunks
        Mesh mesh = test::rectangle(GetParam(), 2, 1, {32, 16});
        test::distort(mesh, 1.0 / 64, 0.25, 3);
        InnerSides sides(mesh);
        std::vector<std::int32_t> all(sides.sides().size());
        std::iota(all.begin(), all.end(), 0);
        sides.open(all);
        sides.renumber();
        for (const JointEdge& edge : joint_edges(mesh, sides, all))
            joints.push_back({edge.nodes, joint_properties, edge.side});
        apart = test::make_solid(mesh, {});
        const Mesh copy = mesh;  // make_solid() takes the mesh before it asks for more parts
        solid = test::make_solid(std::move(mesh), {}, [&](SolidSystem::Parts& parts) {
            parts.interactions.push_back(make_joints(copy, joints, JointLaw::intrinsic, 1));
        });
        rest = solid.system->initial_state();
    }
    ~JointsInChunks() override { omp_set_num_threads(1); }

    State moved(double size) const {
        State state = rest;
        std::mt19937 random(4);
        std::uniform_real_distribution<double> uniform(-size / 2, size / 2);
        for (double& u : state.u) u = uniform(random);
        return state;
    }
    struct Answer {
        std::vector<double> f, z, history;
        friend bool operator==(const Answer&, const Answer&) = default;
    };
    Answer answer(const State& at) const {
        Answer given{std::vector<double>(at.u.size()), std::vector<double>(at.z.size()), at.history};
        solid.system->force_and_update(rest, Trial::of(at), given.f, given.z, given.history);
        return given;
    }

    std::vector<Joint> joints;
    test::Solid apart{}, solid{};
    State rest;
};

TEST_P(JointsInChunks, Forces_AreThoseOfTheJointsOneByOne) {
    for (const double size : {elastic_size, mixed_size, softening_size}) {
        const State at = moved(size);
        std::vector<double> expected(at.u.size());
        apart.system->force(apart.system->initial_state(), Trial::of(at), expected);
        std::size_t n_intact = 0;
        for (const Joint& joint : joints) {
            std::array<Vec2<double>, joint_nodes> x, u;
            for (std::size_t k = 0; k < joint_nodes; ++k) {
                const auto node = static_cast<std::size_t>(joint.nodes[k]);
                x[k] = {solid.mesh.nodes[node][0], solid.mesh.nodes[node][1]};
                u[k] = {at.u[2 * node], at.u[2 * node + 1]};
            }
            const Vec2<double> edge = x[1] - x[0];
            const auto motion = joint_motion(edge, u);
            std::array<Traction<double>, joint_points> tractions;
            for (std::size_t i = 0; i < joint_points; ++i) {
                tractions[i] = Law::traction(joint_properties, {}, motion.opening[i], motion.slip[i]);
                n_intact += Law::stays_intact(joint_properties, 0.0, motion.opening[i], motion.slip[i]);
            }
            const auto f = joint_forces(motion, 0.5 * std::sqrt(dot(edge, edge)), tractions);
            for (std::size_t k = 0; k < joint_nodes; ++k) {
                const auto node = static_cast<std::size_t>(joint.nodes[k]);
                expected[2 * node] += f[k].x;
                expected[2 * node + 1] += f[k].y;
            }
        }
        if (size == elastic_size) {
            EXPECT_EQ(n_intact, joint_points * joints.size());
        } else {
            EXPECT_LT(n_intact, joint_points * joints.size());
        }
        EXPECT_GT(n_intact, joints.size() / 4);
        const std::vector<double> f = answer(at).f;
        double scale = 0;
        for (const double value : expected) scale = std::max(scale, std::abs(value));
        // round-off of a direction, 1e-16 of a line of 1e-2 m, against openings of 1e-5 m
        for (std::size_t i = 0; i < f.size(); ++i) ASSERT_NEAR(f[i], expected[i], 1e-12 * scale) << size << ' ' << i;
    }
}

TEST_P(JointsInChunks, InteractionForce_IsWhatTheyAddToTheElements) {
    const State at = moved(mixed_size);
    std::vector<double> elements(at.u.size()), joined(at.u.size(), 1e300);
    apart.system->force(apart.system->initial_state(), Trial::of(at), elements);
    solid.system->interaction_force(rest, Trial::of(at), joined);
    const std::vector<double> f = answer(at).f;
    double scale = 0;
    for (const double value : f) scale = std::max(scale, std::abs(value));
    for (std::size_t i = 0; i < f.size(); ++i)
        ASSERT_NEAR(elements[i] + joined[i], f[i], 1e-14 * scale) << i;  // other order of a dozen additions
}

TEST_P(JointsInChunks, Threads_AnyNumber_SameBits) {
    for (const double size : {elastic_size, mixed_size, softening_size}) {
        const State at = moved(size);
        const Answer once = answer(at);
        for (const int threads : {2, 3}) {
            omp_set_num_threads(threads);
            EXPECT_TRUE(answer(at) == once) << size << ", " << threads;
        }
        omp_set_num_threads(1);
    }
}

/// Counts how often each degree of freedom comes, and that no force stands there before.
class Counted final : public Arrival {
public:
    Counted(const std::vector<double>& from, std::vector<double>& to, const std::vector<double>& f)
        : came(from.size(), 0), early(from.size(), 0), from_(from), to_(to), f_(f) {}
    void bring(std::size_t first, std::size_t last) const override {
        for (std::size_t i = first; i < last; ++i) {
            to_[i] = from_[i];
            ++came[i];
            early[i] = f_[i] != no_force;
        }
    }
    static constexpr double no_force = 1e300;
    mutable std::vector<int> came, early;

private:
    const std::vector<double>& from_;
    std::vector<double>& to_;
    const std::vector<double>& f_;
};

TEST_P(JointsInChunks, DisplacementsOnTheirWay_ComeOnceBeforeTheForce_SameBits) {
    // a whole solid too, where chunks share nodes
    const test::Solid whole = test::make_solid(test::rectangle(GetParam(), 2, 1, {32, 16}), {});
    for (const test::Solid* one : std::array<const test::Solid*, 3>{&solid, &apart, &whole})
        for (const int threads : {1, 3}) {
            omp_set_num_threads(threads);
            const State from = one->system->initial_state();
            State at = from;
            std::mt19937 random(4);
            std::uniform_real_distribution<double> uniform(-mixed_size, mixed_size);
            for (double& u : at.u) u = uniform(random);
            std::vector<double> expected(at.u.size()), f(at.u.size(), Counted::no_force), z(at.z.size()),
                history(at.history), u(at.u.size(), std::numeric_limits<double>::quiet_NaN());
            one->system->force(from, Trial::of(at), expected);
            const Counted arrival(at.u, u, f);
            one->system->force_on_arrival(from, {at.t, at.last_event, u, at.v, {}}, arrival, f, z, history);
            EXPECT_EQ(f, expected);
            EXPECT_EQ(u, at.u);
            EXPECT_EQ(arrival.came, std::vector<int>(u.size(), 1));
            EXPECT_EQ(arrival.early, std::vector<int>(u.size(), 0));
        }
}

INSTANTIATE_TEST_SUITE_P(Elements, JointsInChunks, testing::Values(false, true),
                         [](const auto& instance) { return std::string(instance.param ? "Compt" : "Cst"); });

}  // namespace
}  // namespace gneiss
