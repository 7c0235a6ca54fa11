// The numerical inf-sup test of COMPT with `mean` volume [Chapelle and Bathe, Computers and Structures 47 (1993);
// Bathe, Finite Element Procedures, (4.207)]: does every pressure, one per composite, have a displacement that answers
// to it, however fine the mesh?
//
//     beta_h = min over q of max over v of  int q div v / (|v| |q|),   |v|^2 = int eps(v):eps(v),   |q|^2 = int q^2
//
// The stiffness is linear in M_v: K = T + M_v B^T S^-1 B, with B the integrals of div v over the composites and S their
// areas. With M_alpha = M_beta = M_psi = 1 Pa, T is the norm of v, and the squares of beta_h and its likes are the
// eigenvalues of the volumetric part against T that are not zero: as many as there are pressures that are controlled.

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "support/one_thread.hpp"
#include "support/small_solids.hpp"

namespace gneiss {
namespace {

using Pattern = MeshOptions::Pattern;

/// Eigenvalues below it are zero: round-off times the condition of T, 1e-16 x 1e4, with room.
constexpr double no_control = 1e-9;
/// Of the finest over the coarsest of three meshes; where the pair is not stable, it is 1/4.
constexpr double stable = 0.8;

struct InfSup {
    double beta = 0;
    Eigen::Index n_controlled = 0;
    std::size_t n_pressures = 0;
};

/// On the unit square with the left and the bottom edge fixed.
InfSup inf_sup(bool compt, Pattern pattern, int n) {
    InfSup found;
    Eigen::MatrixXd stiffness[2];  // of M_v = 0 and 1 Pa, on the free degrees of freedom
    for (const int M_v : {0, 1}) {
        test::SolidDescription what;
        what.solid.plane = Plane::strain;
        what.materials[0].constants = {double(M_v), 1, 1, 1};
        for (const char* side : {"left", "bottom"}) {
            BoundaryOptions fixed_side;
            fixed_side.on = side;
            fixed_side.value = {Formula(0.0), Formula(0.0)};
            what.boundaries.push_back(fixed_side);
        }
        const test::Solid solid = test::make_solid(test::rectangle(compt, 1, 1, {n, n}, pattern), what);
        const State rest = solid.system->initial_state();
        const Eigen::MatrixXd all = test::dense(*solid.system->tangent(), rest, Trial::of(rest), {.stiffness = 1});
        std::vector<bool> fixed(rest.u.size(), false);
        for (const Constraint& constraint : solid.system->constraints()) fixed[constraint.dof] = true;
        std::vector<Eigen::Index> free;
        for (std::size_t dof = 0; dof < fixed.size(); ++dof)
            if (!fixed[dof]) free.push_back(static_cast<Eigen::Index>(dof));
        stiffness[M_v] = all(free, free);
        found.n_pressures = solid.mesh.n_elements();
    }
    const Eigen::MatrixXd volumetric = stiffness[1] - stiffness[0];
    const Eigen::VectorXd values =
        Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(volumetric, stiffness[0], Eigen::EigenvaluesOnly)
            .eigenvalues();
    found.n_controlled = (values.array() > no_control).count();
    found.beta = std::sqrt(values[values.size() - found.n_controlled]);
    return found;
}

class InfSupOfCompt : public testing::TestWithParam<std::pair<const char*, Pattern>> {};

TEST_P(InfSupOfCompt, Refinement_KeepsEveryPressureUnderControl) {
    double coarsest = 0;
    for (const int n : {2, 4, 8}) {
        const InfSup found = inf_sup(true, GetParam().second, n);
        EXPECT_EQ(found.n_controlled, static_cast<Eigen::Index>(found.n_pressures)) << n;
        if (n == 2) coarsest = found.beta;
        EXPECT_GE(found.beta, stable * coarsest) << n;
    }
}

INSTANTIATE_TEST_SUITE_P(EveryPattern, InfSupOfCompt,
                         testing::Values(std::pair("UniformRight", Pattern::uniform_right),
                                         std::pair("UniformLeft", Pattern::uniform_left),
                                         std::pair("Alternating", Pattern::alternating),
                                         std::pair("Crossed", Pattern::crossed)),
                         [](const auto& family) { return std::string(family.param.first); });

TEST(InfSupOfCst, Refinement_LosesControl) {
    const double coarse = inf_sup(false, Pattern::uniform_right, 2).beta;
    const double fine = inf_sup(false, Pattern::uniform_right, 4).beta;
    EXPECT_NEAR(fine / coarse, 0.5, 0.02) << "in proportion to the element: CST locks";
    const InfSup alternating = inf_sup(false, Pattern::alternating, 4);
    EXPECT_LT(alternating.n_controlled, static_cast<Eigen::Index>(alternating.n_pressures)) << "checkerboards";
}

}  // namespace
}  // namespace gneiss
