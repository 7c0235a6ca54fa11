#include <gmock/gmock.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "io/output/atomic_file.hpp"
#include "io/output/field_series.hpp"
#include "unit/io/output_folder.hpp"

namespace gneiss {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The unit square cut into two triangles, with a field of every shape.
class FieldOutput : public test::OutputFolder {
protected:
    std::vector<std::array<double, 2>> points{{0, 0}, {1, 0}, {1, 1}, {0, 1.0 / 3}};
    std::vector<std::array<std::int32_t, 3>> triangles{{0, 1, 2}, {0, 2, 3}};
    std::vector<std::int32_t> region{7, 9};
    FieldMesh mesh{points, triangles, {{"region", region}}};

    std::vector<double> speed{0.1, 0.2, nan, 1e-300};
    std::vector<double> displacement{1, 2, 3, 4, 5, 6, 7, 8};
    std::vector<double> stress{1, 2, 3, 4, 5, 6};
    std::vector<double> munjiza{1, 2, 3, 4, 5, 6, 7, 8};
    Fields fields{{{"speed", speed}, {"displacement", displacement, 2}},
                  {{"cauchy_stress", stress, 3, {"xx", "yy", "xy"}},
                   {"munjiza_stress", munjiza, 4, {"v", "alpha", "beta", "psi"}}}};

    static vtkNew<vtkUnstructuredGrid> read(const fs::path& path) {
        vtkNew<vtkXMLUnstructuredGridReader> reader;
        reader->SetFileName(path.c_str());
        reader->Update();
        vtkNew<vtkUnstructuredGrid> grid;
        grid->ShallowCopy(reader->GetOutput());
        return grid;
    }
    static std::vector<double> times(const fs::path& path) {
        std::vector<double> result;
        for (const PvdFrame& frame : read_pvd(path)) result.push_back(frame.t);
        return result;
    }
};

TEST_F(FieldOutput, Vtu_ReadBack_HasMeshFieldsAndTime) {
    VtuWriter(mesh).write(folder / "a.vtu", 0.1, 12345, fields);
    const auto grid = read(folder / "a.vtu");
    ASSERT_EQ(grid->GetNumberOfPoints(), 4);
    ASSERT_EQ(grid->GetNumberOfCells(), 2);
    EXPECT_EQ(grid->GetPoint(3)[1], 1.0 / 3);
    EXPECT_EQ(grid->GetCellType(1), VTK_TRIANGLE);
    vtkNew<vtkIdList> corners;
    grid->GetCellPoints(1, corners);
    EXPECT_EQ(corners->GetId(0), 0);
    EXPECT_EQ(corners->GetId(1), 2);
    EXPECT_EQ(corners->GetId(2), 3);
    EXPECT_EQ(grid->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 0.1);
    EXPECT_EQ(grid->GetFieldData()->GetArray("step")->GetTuple1(0), 12345);
    EXPECT_EQ(grid->GetCellData()->GetArray("region")->GetTuple1(1), 9);

    vtkDataArray* s = grid->GetPointData()->GetArray("speed");
    EXPECT_EQ(s->GetTuple1(1), 0.2);
    EXPECT_TRUE(std::isnan(s->GetTuple1(2)));
    EXPECT_EQ(s->GetTuple1(3), 1e-300);

    vtkDataArray* cauchy = grid->GetCellData()->GetArray("cauchy_stress");
    ASSERT_EQ(cauchy->GetNumberOfComponents(), 3);
    EXPECT_STREQ(cauchy->GetComponentName(2), "xy");
    EXPECT_EQ(cauchy->GetComponent(1, 2), 6);
    vtkDataArray* four = grid->GetCellData()->GetArray("munjiza_stress");
    ASSERT_EQ(four->GetNumberOfComponents(), 4);
    EXPECT_STREQ(four->GetComponentName(1), "alpha");
    EXPECT_EQ(four->GetComponent(1, 0), 5);
}

TEST_F(FieldOutput, Vtu_OfLines_HasLines) {
    const std::vector<std::array<std::int32_t, 2>> lines{{0, 1}, {1, 3}, {3, 2}};
    const std::vector<std::int32_t> side{5, 6, 8};
    const std::vector<double> damage{0.5, 1, nan};
    FieldMesh cracks;
    cracks.points = points;
    cracks.lines = lines;
    cracks.integers = {{"side", side}};
    VtuWriter(cracks).write(folder / "a.vtu", 0, 0, {{}, {{"damage", damage}}});
    const auto grid = read(folder / "a.vtu");
    ASSERT_EQ(grid->GetNumberOfCells(), 3);
    EXPECT_EQ(grid->GetCellType(2), VTK_LINE);
    vtkNew<vtkIdList> ends;
    grid->GetCellPoints(2, ends);
    EXPECT_EQ(ends->GetId(0), 3);
    EXPECT_EQ(ends->GetId(1), 2);
    EXPECT_EQ(grid->GetCellData()->GetArray("side")->GetTuple1(2), 8);
    EXPECT_EQ(grid->GetCellData()->GetArray("damage")->GetTuple1(1), 1);
    cracks.points = std::span(points).first(3);
    EXPECT_EQ(message_of<std::invalid_argument>([&] { VtuWriter{cracks}; }),
              "VtuWriter: line 1 names point 3, allowed: 0 to 2");
}

TEST_F(FieldOutput, Vtu_WithoutAnyCell_CanBeRead) {  // a solid that has not cracked yet
    VtuWriter(FieldMesh{}).write(folder / "a.vtu", 0, 0, {});
    EXPECT_EQ(read(folder / "a.vtu")->GetNumberOfCells(), 0);
}

TEST_F(FieldOutput, Vtu_PlaneVector_IsPaddedToThree) {
    VtuWriter(mesh).write(folder / "a.vtu", 0, 0, fields);
    vtkNew<vtkUnstructuredGrid> grid = read(folder / "a.vtu");
    vtkDataArray* u = grid->GetPointData()->GetArray("displacement");
    ASSERT_EQ(u->GetNumberOfComponents(), 3);
    for (int i = 0; i < 4; ++i) {
        EXPECT_EQ(u->GetComponent(i, 0), 2 * i + 1);
        EXPECT_EQ(u->GetComponent(i, 1), 2 * i + 2);
        EXPECT_EQ(u->GetComponent(i, 2), 0);
    }
}

TEST_F(FieldOutput, Vtu_TwoNamedComponents_StayTwo) {
    VtuWriter(mesh).write(folder / "a.vtu", 0, 0, {{{"pair", displacement, 2, {"r", "theta"}}}, {}});
    EXPECT_EQ(read(folder / "a.vtu")->GetPointData()->GetArray("pair")->GetNumberOfComponents(), 2);
}

TEST_F(FieldOutput, Vtu_File_IsCompressedAppendedRaw) {
    VtuWriter(mesh).write(folder / "a.vtu", 0, 0, fields);
    const std::string text = contents(folder / "a.vtu");
    EXPECT_THAT(text, HasSubstr("compressor=\"vtkZLibDataCompressor\""));
    EXPECT_THAT(text, HasSubstr("<AppendedData encoding=\"raw\">"));
}

TEST_F(FieldOutput, Vtu_SameWriterTwice_FramesDoNotMix) {
    const VtuWriter writer(mesh);
    writer.write(folder / "a.vtu", 0, 0, fields);
    writer.write(folder / "b.vtu", 1, 1, {{{"only", speed}}, {}});
    const auto grid = read(folder / "b.vtu");
    EXPECT_EQ(grid->GetPointData()->GetNumberOfArrays(), 1);
    EXPECT_EQ(grid->GetCellData()->GetNumberOfArrays(), 1);  // region
}

TEST_F(FieldOutput, Vtu_BadInput_IsRefusedWithItsName) {
    const auto message = [&](const FieldMesh& m, const Fields& f) {
        return message_of<std::invalid_argument>([&] { VtuWriter(m).write(folder / "a.vtu", 0, 0, f); });
    };
    EXPECT_EQ(message(mesh, {{{"u", speed, 2}}, {}}), "field u: 4 numbers for 4 rows of 2 components");
    EXPECT_EQ(message(mesh, {{}, {{"s", stress, 3, {"xx"}}}}), "field s: 3 components, but 1 names for them");
    EXPECT_EQ(message(mesh, {{{"u", speed}, {"u", speed}}, {}}), "field 'u': every array needs a name of its own");
    EXPECT_EQ(message(mesh, {{{"", speed}}, {}}), "field '': every array needs a name of its own");
    EXPECT_EQ(message({points, triangles, {{"region", std::span(region).first(1)}}}, {}),
              "field region: 1 numbers for 2 triangles");
    triangles[1][2] = 4;
    EXPECT_EQ(message(mesh, {}), "VtuWriter: triangle 1 names point 4, allowed: 0 to 3");
    triangles[1][2] = -1;
    EXPECT_EQ(message(mesh, {}), "VtuWriter: triangle 1 names point -1, allowed: 0 to 3");
    EXPECT_EQ(n_files(), 0u);
}

TEST_F(FieldOutput, Vtu_DiskFull_IoErrorAndNothingOnStderr) {
    const fs::path path = folder / "a.vtu";
    fill_disk(path);
    ::testing::internal::CaptureStderr();
    const std::string message = message_of<IoError>([&] { VtuWriter(mesh).write(path, 0, 0, fields); });
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(message, path.string() + ": cannot write: No space left on device");
    EXPECT_EQ(n_files(), 0u);
}

TEST_F(FieldOutput, Vtu_NoSuchFolder_IoErrorAndNothingOnStderr) {
    ::testing::internal::CaptureStderr();
    const std::string message =
        message_of<IoError>([&] { VtuWriter(mesh).write(folder / "none" / "a.vtu", 0, 0, fields); });
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    EXPECT_THAT(message, HasSubstr("none/a.vtu: cannot write: No such file or directory"));
}

TEST_F(FieldOutput, Series_Frames_AreNumberedAndListed) {
    FieldSeries series(folder, mesh);
    EXPECT_FALSE(series.last_time().has_value());
    series.write(0.0, 0, fields);
    series.write(1e-4 / 3, 10, fields);
    EXPECT_EQ(series.n_frames(), 2u);
    EXPECT_EQ(series.last_time(), 1e-4 / 3);

    const std::vector<PvdFrame> frames = read_pvd(folder / "fields.pvd");
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_EQ(frames[0].file, "fields_000000.vtu");
    EXPECT_EQ(frames[1].file, "fields_000001.vtu");
    EXPECT_EQ(frames[1].t, 1e-4 / 3);
    EXPECT_EQ(read(folder / frames[1].file)->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 1e-4 / 3);
    EXPECT_EQ(n_files(), 3u);
}

TEST_F(FieldOutput, Series_SameTimeAgain_ReplacesTheFrame) {
    FieldSeries series(folder, mesh);
    series.write(0.5, 10, fields);
    series.write(0.5, 11, fields);
    EXPECT_EQ(series.n_frames(), 1u);
    EXPECT_EQ(read(folder / "fields_000000.vtu")->GetFieldData()->GetArray("step")->GetTuple1(0), 11);
    EXPECT_THROW(series.write(0.4, 9, fields), std::invalid_argument);
}

TEST_F(FieldOutput, Series_BegunAnew_RemovesOldFramesAndNothingElse) {
    for (const char* name : {"fields_of_gold.vtu", "fields_000007.vtu.bak", "notes.txt"}) put(folder / name, "mine");
    {
        FieldSeries series(folder, mesh);
        for (int i = 0; i < 3; ++i) series.write(i, i, fields);
    }
    FieldSeries series(folder, mesh);
    EXPECT_EQ(n_files(), 4u);  // the three and an empty list
    EXPECT_THAT(times(folder / "fields.pvd"), ElementsAre());
    series.write(5, 5, fields);
    EXPECT_THAT(times(folder / "fields.pvd"), ElementsAre(5));
}

TEST_F(FieldOutput, Series_Restarted_DropsLaterFramesAndGoesOn) {
    {
        FieldSeries series(folder, mesh);
        for (int i = 0; i < 5; ++i) series.write(0.1 * i, i, fields);
    }
    FieldSeries series(folder, mesh, 0.1 * 2);
    EXPECT_EQ(series.last_time(), 0.1 * 2);
    EXPECT_FALSE(fs::exists(folder / "fields_000003.vtu"));
    EXPECT_THAT(times(folder / "fields.pvd"), ElementsAre(0, 0.1, 0.2));
    series.write(0.25, 3, fields);
    EXPECT_THAT(times(folder / "fields.pvd"), ElementsAre(0, 0.1, 0.2, 0.25));
    EXPECT_EQ(read(folder / "fields_000003.vtu")->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 0.25);
}

TEST_F(FieldOutput, Series_RestartedElsewhere_BeginsAnew) {
    FieldSeries series(folder, mesh, 0.7);
    series.write(0.7, 1, fields);
    EXPECT_THAT(times(folder / "fields.pvd"), ElementsAre(0.7));
}

TEST_F(FieldOutput, Series_RestartedOnDamagedList_InputErrorAndNothingOnStderr) {
    for (const char* text : {"not a list at all", "<VTKFile><Collection><DataSet file=\"a\"/></Collection></VTKFile>",
                             "<VTKFile><Collection><DataSet timestep=\"1\""}) {
        put(folder / "fields.pvd", text);
        ::testing::internal::CaptureStderr();
        EXPECT_THAT(message_of<InputError>([&] { FieldSeries(folder, mesh, 0.5); }), HasSubstr("fields.pvd: ")) << text;
        EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << text;
    }
}

TEST_F(FieldOutput, Series_DiskFullInTheMiddle_ListNamesWholeFramesOnly) {
    FieldSeries series(folder, mesh);
    series.write(0, 0, fields);
    fill_disk(folder / "fields_000001.vtu");
    EXPECT_THROW(series.write(1, 1, fields), IoError);
    EXPECT_THAT(times(folder / "fields.pvd"), ElementsAre(0));
    series.write(1, 1, fields);  // there is room again
    EXPECT_THAT(times(folder / "fields.pvd"), ElementsAre(0, 1));
}

TEST_F(FieldOutput, Series_NewMesh_HoldsFromThenOn) {
    FieldSeries series(folder, mesh);
    series.write(0, 0, fields);
    points.push_back({2, 2});
    triangles.push_back({1, 4, 2});
    series.set_mesh({points, triangles});
    series.write(1, 1, {});
    EXPECT_EQ(read(folder / "fields_000000.vtu")->GetNumberOfCells(), 2);
    EXPECT_EQ(read(folder / "fields_000001.vtu")->GetNumberOfCells(), 3);
}

}  // namespace
}  // namespace gneiss
