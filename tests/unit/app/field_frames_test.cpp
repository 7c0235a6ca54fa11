#include "app/field_frames.hpp"

#include <gmock/gmock.h>

#include "support/vtu_file.hpp"
#include "unit/app/square_case.hpp"
#include "unit/io/output_folder.hpp"

namespace gneiss {
namespace {

using test::displace;
using test::square_options;
using test::VtuFile;
using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

/// Strains of 1e-3: what separates a linear stress from the logarithmic one, relative.
constexpr double small_strain = 5e-3;

class Frames : public test::OutputFolder {
protected:
    /// One frame of the square under the displacement u = H x, v = 10 u, read back.
    VtuFile frame(const CaseOptions& options, const std::array<double, 4>& h) {
        built = build_case(options);
        State state = built.system->initial_state();
        displace(state, *built.mesh, h);
        for (std::size_t i = 0; i < state.v.size(); ++i) state.v[i] = 10 * state.u[i];
        state.t = 0.25;
        FieldFrames(folder, *built.mesh, {}).write(*built.system, state, 17);
        return test::read_vtu(folder / "fields_000000.vtu");
    }
    Case built;
};

TEST_F(Frames, Names_AndComponents_AreWhatADocumentedFrameHolds) {
    const VtuFile grid = frame(square_options(), {1e-3, 0, 0, 0});
    EXPECT_THAT(grid.names(grid.point_data), UnorderedElementsAre("displacement", "velocity", "speed"));
    EXPECT_THAT(grid.names(grid.cell_data), UnorderedElementsAre("element", "region", "cauchy_stress", "munjiza_stress",
                                                                 "stretch", "axis_alpha", "axis_beta"));
    EXPECT_EQ(grid.of_point("displacement").n_components, 3u);
    EXPECT_EQ(grid.of_point("velocity").n_components, 3u);
    EXPECT_EQ(grid.of_point("speed").n_components, 1u);
    // the order in which VTK keeps symmetric tensors
    EXPECT_THAT(grid.of_cell("cauchy_stress").component_names, ElementsAre("XX", "YY", "ZZ", "XY", "YZ", "XZ"));
    EXPECT_THAT(grid.of_cell("munjiza_stress").component_names, ElementsAre("v", "alpha", "beta", "psi"));
    EXPECT_THAT(grid.of_cell("stretch").component_names, ElementsAre("v", "alpha", "beta", "psi"));
    for (const char* axis : {"axis_alpha", "axis_beta"}) EXPECT_EQ(grid.of_cell(axis).n_components, 3u) << axis;
    for (const char* number : {"element", "region"}) EXPECT_EQ(grid.of_cell(number).type, "Int32") << number;
    EXPECT_EQ(grid.of_cell("cauchy_stress").unit, "Pa");
    EXPECT_EQ(grid.of_cell("munjiza_stress").unit, "Pa");
    EXPECT_EQ(grid.of_cell("stretch").unit, "");
    EXPECT_EQ(grid.of_point("displacement").unit, "m");
    EXPECT_EQ(grid.of_point("velocity").unit, "m/s");
    EXPECT_EQ(grid.of_point("speed").unit, "m/s");
}

TEST_F(Frames, Composite_HasFourCellsThatCoverIt) {
    const VtuFile grid = frame(square_options(), {0, 0, 0, 0});
    ASSERT_EQ(grid.n_cells(), 32u);
    double area = 0;
    for (std::size_t cell = 0; cell < 32; ++cell) {
        EXPECT_EQ(grid.of_cell("element")(cell), static_cast<double>(cell / 4));
        const std::vector<std::size_t> corners = grid.cell_points(cell);
        ASSERT_EQ(corners.size(), 3u);
        const auto from_first = [&](std::size_t k, std::size_t c) {
            return grid.position(corners[k], c) - grid.position(corners[0], c);
        };
        const double twice = from_first(1, 0) * from_first(2, 1) - from_first(2, 0) * from_first(1, 1);
        EXPECT_GT(twice, 0) << "counter-clockwise";
        area += 0.5 * twice;
    }
    EXPECT_DOUBLE_EQ(area, 1);
}

TEST_F(Frames, Cst_HasOneCellEach) {
    CaseOptions options = square_options();
    options.solid.compt = false;
    const VtuFile grid = frame(options, {0, 0, 0, 0});
    EXPECT_EQ(grid.n_cells(), 32u);
    EXPECT_EQ(grid.of_cell("element")(31), 31);
}

TEST_F(Frames, SmallStretch_FieldsHaveTheirValues) {
    CaseOptions options = square_options();
    options.materials[0].axes.angle = Formula(0.5);
    const VtuFile grid = frame(options, {1e-3, 0, 0, 0});
    // Hooke: M_v = lambda = 4e8, M_alpha = M_beta = M_psi = 2G = 8e8, strain 1e-3 along x
    const test::VtuArray &cauchy = grid.of_cell("cauchy_stress"), &stretch = grid.of_cell("stretch");
    const test::VtuArray &alpha = grid.of_cell("axis_alpha"), &munjiza = grid.of_cell("munjiza_stress");
    for (std::size_t cell = 0; cell < grid.n_cells(); ++cell) {
        const double sigma[] = {12e5, 4e5, 4e5, 0, 0, 0};  // sigma_zz = lambda tr eps
        for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(cauchy(cell, k), sigma[k], small_strain * 12e5) << k;
        EXPECT_NEAR(stretch(cell, 0), 1.001, 1e-12);
        EXPECT_NEAR(munjiza(cell, 0), 4e5, small_strain * 4e5);
        EXPECT_NEAR(alpha(cell, 1) / alpha(cell, 0), std::tan(0.5) / 1.001, 1e-12);
    }
    const test::VtuArray &u = grid.of_point("displacement"), &speed = grid.of_point("speed");
    for (std::size_t i = 0; i < grid.n_points(); ++i) {
        EXPECT_EQ(u(i, 0), 1e-3 * grid.position(i, 0));
        EXPECT_EQ(speed(i), 10 * u(i, 0));
    }
}

TEST_F(Frames, InSituStress_HasTheStressAcrossThatPlaneStrainMakesOfIt) {
    CaseOptions options = square_options();
    options.materials[0].form = Form::hypo;
    options.materials[0].in_situ_stress = {Formula(-3e6), Formula(-2e6), Formula(5e5)};
    const test::VtuArray cauchy = frame(options, {0, 0, 0, 0}).of_cell("cauchy_stress");
    const double sigma[] = {-3e6, -2e6, 0.25 * -5e6, 5e5, 0, 0};  // nu = 1/4
    for (std::size_t cell = 0; cell < cauchy.n_rows(); ++cell)
        for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(cauchy(cell, k), sigma[k], 1e-12 * 3e6) << k;
}

TEST_F(Frames, PlaneStress_HasNoStressAcrossThePlane) {
    CaseOptions options = square_options();
    options.solid.plane = Plane::stress;
    const test::VtuArray cauchy = frame(options, {1e-3, 0, 0, 0}).of_cell("cauchy_stress");
    for (std::size_t cell = 0; cell < cauchy.n_rows(); ++cell) EXPECT_EQ(cauchy(cell, 2), 0);
}

}  // namespace
}  // namespace gneiss
