// VERIFICATION 5: the boundary moves as under constant strain; the interior finds its equilibrium there, and stress is
// constant to 1e-10. Distorted meshes, every element, plane stress and strain, any axes.

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "support/one_thread.hpp"
#include "support/small_solids.hpp"

namespace gneiss {
namespace {

constexpr double patch_tolerance = 1e-10;  // relative, of the reference case
constexpr double young = 60e9, poisson = 0.25;

struct Patch {
    const char* name;
    bool compt;
    Volumetric volumetric;
    StressMap map;
    LawKind law;
};

const Patch patches[] = {
    {"Cst", false, Volumetric::mean, StressMap::conjugate, LawKind::munjiza},
    {"CstDirect", false, Volumetric::mean, StressMap::direct, LawKind::munjiza},
    {"CstNeoHookean", false, Volumetric::mean, StressMap::conjugate, LawKind::neo_hookean},
    {"ComptMean", true, Volumetric::mean, StressMap::conjugate, LawKind::munjiza},
    {"ComptMeanDirect", true, Volumetric::mean, StressMap::direct, LawKind::munjiza},
    {"ComptCentreDirect", true, Volumetric::centre, StressMap::direct, LawKind::munjiza},
    {"ComptNeoHookean", true, Volumetric::mean, StressMap::conjugate, LawKind::neo_hookean},
};

class PatchTest : public testing::TestWithParam<Patch> {
protected:
    /// Newton's method on the inner nodes, from u = 0 there. The stiffness is a difference, so each step gains about 8
    /// digits.
    static void find_equilibrium(const test::Solid& solid, State& state, const std::vector<Eigen::Index>& inner) {
        std::vector<double> f(state.u.size());
        for (int step = 0; step < 8; ++step) {
            solid.system->force(solid.system->initial_state(), Trial::of(state), f);
            const Eigen::MatrixXd stiffness = test::dense_stiffness(*solid.system, accepted_at(solid, state));
            Eigen::VectorXd residual(static_cast<Eigen::Index>(inner.size()));
            for (std::size_t i = 0; i < inner.size(); ++i)
                residual[static_cast<Eigen::Index>(i)] = f[static_cast<std::size_t>(inner[i])];
            const Eigen::MatrixXd reduced = stiffness(inner, inner);
            const Eigen::VectorXd du = reduced.partialPivLu().solve(residual);
            for (std::size_t i = 0; i < inner.size(); ++i)
                state.u[static_cast<std::size_t>(inner[i])] += du[static_cast<Eigen::Index>(i)];
        }
    }
    static State accepted_at(const test::Solid& solid, const State& state) {
        State accepted = solid.system->initial_state();
        accepted.u = state.u;
        return accepted;
    }
};

TEST_P(PatchTest, DistortedMesh_AffineBoundary_GivesAffineInteriorAndConstantStress) {
    for (const Plane plane : {Plane::stress, Plane::strain}) {
        for (const double angle : {0.0, 0.5, 2.1}) {
            test::SolidDescription what;
            what.solid.plane = plane;
            what.solid.volumetric = GetParam().volumetric;
            MaterialOptions& material = what.materials[0];
            material.law = GetParam().law;
            material.stress_map = GetParam().map;
            const TransverselyIsotropic bedded{young, 0.4 * young, 0.3, 0.2, 0.3 * young};
            material.constants = plane == Plane::stress ? transversely_isotropic_plane_stress(bedded)
                                                        : transversely_isotropic_plane_strain(bedded);
            material.shear_modulus = lame_constants(young, poisson).mu;
            material.lame_lambda = lame_constants(young, poisson).lambda;
            material.axes.angle = angle;
            const test::Solid solid = test::distorted_solid(GetParam().compt, what);

            const double h[2][2] = {{0.01, 0.006}, {-0.002, -0.015}};
            State state = solid.system->initial_state();
            std::vector<double> affine(state.u.size());
            std::vector<bool> outer(solid.mesh.n_nodes(), false);
            for (const std::int32_t node : solid.mesh.node_sets.at("outer"))
                outer[static_cast<std::size_t>(node)] = true;
            std::vector<Eigen::Index> inner;
            for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node)
                for (std::size_t i = 0; i < 2; ++i) {
                    const std::size_t dof = 2 * node + i;
                    affine[dof] = h[i][0] * solid.mesh.nodes[node][0] + h[i][1] * solid.mesh.nodes[node][1];
                    if (outer[node])
                        state.u[dof] = affine[dof];
                    else
                        inner.push_back(static_cast<Eigen::Index>(dof));
                }
            ASSERT_GT(inner.size(), 20u);
            find_equilibrium(solid, state, inner);
            double off = 0;
            for (std::size_t i = 0; i < affine.size(); ++i) off = std::max(off, std::abs(state.u[i] - affine[i]));
            EXPECT_LE(off, patch_tolerance * 0.02) << angle;

            const std::vector<PointFields> fields = solid.system->point_fields(state);
            double size = 0;
            for (const double component : fields[0].cauchy) size = std::max(size, std::abs(component));
            EXPECT_GT(size, 0.005 * young * 0.4);
            for (const PointFields& point : fields)
                for (std::size_t k = 0; k < 3; ++k)
                    EXPECT_NEAR(point.cauchy[k], fields[0].cauchy[k], patch_tolerance * size) << angle;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(EveryElementAndLaw, PatchTest, testing::ValuesIn(patches),
                         [](const auto& patch) { return std::string(patch.param.name); });

}  // namespace
}  // namespace gneiss
