#include "app/field_frames.hpp"

#include <gmock/gmock.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include "unit/app/square_case.hpp"
#include "unit/io/output_folder.hpp"

namespace gneiss {
namespace {

using test::displace;
using test::square_options;

/// Strains of 1e-3: what separates a linear stress from the logarithmic one, relative.
constexpr double small_strain = 5e-3;

class Frames : public test::OutputFolder {
protected:
    /// One frame of the square under the displacement u = H x, v = 10 u, read back.
    vtkUnstructuredGrid* frame(const CaseOptions& options, const std::array<double, 4>& h) {
        built = build_case(options);
        State state = built.system->initial_state();
        displace(state, *built.mesh, h);
        for (std::size_t i = 0; i < state.v.size(); ++i) state.v[i] = 10 * state.u[i];
        state.t = 0.25;
        FieldFrames(folder, *built.mesh, {}).write(*built.system, state, 17);
        reader->SetFileName((folder / "fields_000000.vtu").c_str());
        reader->Update();
        return reader->GetOutput();
    }
    static void expect_components(vtkDataArray* array, const std::vector<std::string>& names) {
        ASSERT_NE(array, nullptr);
        ASSERT_EQ(array->GetNumberOfComponents(), static_cast<int>(names.size())) << array->GetName();
        for (int k = 0; k < array->GetNumberOfComponents(); ++k)
            EXPECT_EQ(array->GetComponentName(k), names[static_cast<std::size_t>(k)]) << array->GetName();
    }

    Case built;
    vtkNew<vtkXMLUnstructuredGridReader> reader;
};

TEST_F(Frames, Names_AndComponents_AreWhatADocumentedFrameHolds) {
    vtkUnstructuredGrid* grid = frame(square_options(), {1e-3, 0, 0, 0});
    EXPECT_EQ(grid->GetPointData()->GetNumberOfArrays(), 3);
    EXPECT_EQ(grid->GetCellData()->GetNumberOfArrays(), 7);
    EXPECT_EQ(grid->GetPointData()->GetArray("displacement")->GetNumberOfComponents(), 3);
    EXPECT_EQ(grid->GetPointData()->GetArray("velocity")->GetNumberOfComponents(), 3);
    EXPECT_EQ(grid->GetPointData()->GetArray("speed")->GetNumberOfComponents(), 1);
    expect_components(grid->GetCellData()->GetArray("cauchy_stress"), {"xx", "yy", "xy"});
    expect_components(grid->GetCellData()->GetArray("munjiza_stress"), {"v", "alpha", "beta", "psi"});
    expect_components(grid->GetCellData()->GetArray("stretch"), {"v", "alpha", "beta", "psi"});
    for (const char* axis : {"axis_alpha", "axis_beta"})
        EXPECT_EQ(grid->GetCellData()->GetArray(axis)->GetNumberOfComponents(), 3) << axis;
    for (const char* number : {"element", "region"})
        EXPECT_EQ(grid->GetCellData()->GetArray(number)->GetDataType(), VTK_INT) << number;
}

TEST_F(Frames, Composite_HasFourCellsThatCoverIt) {
    vtkUnstructuredGrid* grid = frame(square_options(), {0, 0, 0, 0});
    ASSERT_EQ(grid->GetNumberOfCells(), 32);
    vtkDataArray* element = grid->GetCellData()->GetArray("element");
    double area = 0;
    for (int cell = 0; cell < 32; ++cell) {
        EXPECT_EQ(element->GetTuple1(cell), cell / 4);
        vtkNew<vtkIdList> corners;
        grid->GetCellPoints(cell, corners);
        double x[3][3];
        for (int k = 0; k < 3; ++k) grid->GetPoint(corners->GetId(k), x[k]);
        const double twice = (x[1][0] - x[0][0]) * (x[2][1] - x[0][1]) - (x[2][0] - x[0][0]) * (x[1][1] - x[0][1]);
        EXPECT_GT(twice, 0) << "counter-clockwise";
        area += 0.5 * twice;
    }
    EXPECT_DOUBLE_EQ(area, 1);
}

TEST_F(Frames, Cst_HasOneCellEach) {
    CaseOptions options = square_options();
    options.solid.compt = false;
    vtkUnstructuredGrid* grid = frame(options, {0, 0, 0, 0});
    EXPECT_EQ(grid->GetNumberOfCells(), 32);
    EXPECT_EQ(grid->GetCellData()->GetArray("element")->GetTuple1(31), 31);
}

TEST_F(Frames, SmallStretch_FieldsHaveTheirValues) {
    CaseOptions options = square_options();
    options.materials[0].axes.angle = Formula(0.5);
    vtkUnstructuredGrid* grid = frame(options, {1e-3, 0, 0, 0});
    // Hooke: M_v = lambda = 4e8, M_alpha = M_beta = M_psi = 2G = 8e8, strain 1e-3 along x
    vtkDataArray* cauchy = grid->GetCellData()->GetArray("cauchy_stress");
    vtkDataArray* stretch = grid->GetCellData()->GetArray("stretch");
    vtkDataArray* alpha = grid->GetCellData()->GetArray("axis_alpha");
    vtkDataArray* munjiza = grid->GetCellData()->GetArray("munjiza_stress");
    for (int cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
        EXPECT_NEAR(cauchy->GetComponent(cell, 0), 12e5, small_strain * 12e5);
        EXPECT_NEAR(cauchy->GetComponent(cell, 1), 4e5, small_strain * 12e5);
        EXPECT_NEAR(cauchy->GetComponent(cell, 2), 0, small_strain * 12e5);
        EXPECT_NEAR(stretch->GetComponent(cell, 0), 1.001, 1e-12);
        EXPECT_NEAR(munjiza->GetComponent(cell, 0), 4e5, small_strain * 4e5);
        EXPECT_NEAR(alpha->GetComponent(cell, 1) / alpha->GetComponent(cell, 0), std::tan(0.5) / 1.001, 1e-12);
    }
    vtkDataArray* u = grid->GetPointData()->GetArray("displacement");
    vtkDataArray* speed = grid->GetPointData()->GetArray("speed");
    for (int i = 0; i < grid->GetNumberOfPoints(); ++i) {
        EXPECT_EQ(u->GetComponent(i, 0), 1e-3 * grid->GetPoint(i)[0]);
        EXPECT_EQ(speed->GetTuple1(i), 10 * u->GetComponent(i, 0));
    }
}

}  // namespace
}  // namespace gneiss
