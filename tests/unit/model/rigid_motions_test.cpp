// Motions that supports leave free against the null space of the dense stiffness.

#include "model/rigid_motions.hpp"

#include <gmock/gmock.h>

#include "support/one_thread.hpp"
#include "support/small_solids.hpp"

namespace gneiss {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Zero eigenvalues of the stiffness on the free degrees of freedom, at rest.
std::size_t n_zero_energy_motions(const test::Solid& solid) {
    const Eigen::MatrixXd stiffness = test::dense_stiffness(*solid.system, solid.system->initial_state());
    std::vector<bool> fixed(static_cast<std::size_t>(stiffness.rows()), false);
    for (const Constraint& constraint : solid.system->constraints()) fixed[constraint.dof] = true;
    std::vector<Eigen::Index> free;
    for (std::size_t i = 0; i < fixed.size(); ++i)
        if (!fixed[i]) free.push_back(static_cast<Eigen::Index>(i));
    const Eigen::MatrixXd held = stiffness(free, free);
    const Eigen::VectorXd eigenvalues =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (held + held.transpose())).eigenvalues();
    // between the error of differences, 1e-9, and the smallest elastic one of a dozen elements, 1e-3
    constexpr double zero = 1e-6;
    return static_cast<std::size_t>((eigenvalues.array() < zero * eigenvalues.maxCoeff()).count());
}

BoundaryOptions held(const char* on, bool x, bool y) {
    BoundaryOptions boundary;
    boundary.on = on;
    if (x) boundary.value[0] = Formula(0.0);
    if (y) boundary.value[1] = Formula(0.0);
    return boundary;
}

TEST(RigidMotions, EverySupport_LeavesAsManyMotionsAsTheStiffnessHasZeros) {
    struct Case {
        std::vector<BoundaryOptions> supports;
        std::vector<std::string> left;
    };
    const std::string x = "translation in x", y = "translation in y";
    // 2 m x 1 m; the points are corners
    for (const Case& c : std::vector<Case>{
             {{}, {x, y, "rotation about (1, 0.5)"}},
             {{held("left", true, false)}, {y}},
             {{held("bottom", true, false)}, {y, "rotation about (1, 0)"}},
             {{held("bottom", false, true)}, {x}},
             {{held("right", false, true)}, {x, "rotation about (2, 0.5)"}},
             {{held("bottom_left", true, true)}, {"rotation about (0, 0)"}},
             {{held("bottom_left", true, false), held("top_right", false, true)}, {"rotation about (2, 0)"}},
             {{held("bottom_left", true, true), held("bottom_right", true, false)}, {"rotation about (0, 0)"}},
             {{held("bottom_left", true, true), held("bottom_right", false, true)}, {}},
             {{held("bottom_left", true, true), held("top_left", true, false)}, {}},
             {{held("left", true, true)}, {}}}) {
        test::SolidDescription what;
        what.boundaries = c.supports;
        const test::Solid solid = test::make_solid(test::rectangle(true, 2, 1, {2, 1}), what);
        const auto parts = free_parts(solid.mesh, solid.system->constraints());
        const std::vector<std::string> left = parts.empty() ? std::vector<std::string>{} : parts[0].motions;
        ASSERT_LE(parts.size(), 1u);
        EXPECT_EQ(left, c.left);
        EXPECT_EQ(n_zero_energy_motions(solid), left.size());
        if (!parts.empty()) {
            EXPECT_EQ(parts[0].n_elements, solid.mesh.n_elements());
        }
    }
}

TEST(RigidMotions, LooseParts_AreFoundAndDescribed) {
    // three squares in a row that do not touch: the first is held, the second stands on one pin, the third is free
    Mesh mesh = test::rectangle(false, 1, 1, {1, 1});
    const auto n = static_cast<std::int32_t>(mesh.n_nodes());
    const Mesh one = mesh;
    for (int copy = 1; copy < 3; ++copy) {
        for (const auto& [x, y] : one.nodes) mesh.nodes.push_back({x + 2 * copy, y});
        for (const std::int32_t node : one.connectivity) mesh.connectivity.push_back(node + copy * n);
    }
    std::vector<Constraint> constraints;
    const auto hold = [&](double x, double y) {
        for (std::size_t node = 0; node < mesh.n_nodes(); ++node)
            if (mesh.nodes[node] == std::array{x, y})
                for (std::size_t c : {0, 1}) constraints.push_back({2 * node + c, Constraint::Kind::displacement});
    };
    hold(0, 0);
    hold(1, 0);
    hold(3, 1);
    const auto parts = free_parts(mesh, constraints);
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_THAT(parts[0].motions, ElementsAre("rotation about (3, 1)"));
    EXPECT_THAT(parts[1].motions, ElementsAre("translation in x", "translation in y", "rotation about (4.5, 0.5)"));
    EXPECT_EQ(describe(parts, mesh),
              "the part of 8 elements around (2.5, 0.5): rotation about (3, 1); the part of 8 elements around (4.5, "
              "0.5): translation in x, translation in y, rotation about (4.5, 0.5)");
    EXPECT_THAT(describe(std::vector<FreePart>(7, parts[0]), mesh), HasSubstr("; and 2 more parts"));
}

}  // namespace
}  // namespace gneiss
