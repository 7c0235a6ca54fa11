#include <gmock/gmock.h>
#include <omp.h>

#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "io/output/atomic_file.hpp"
#include "io/output/base64.hpp"
#include "io/output/field_series.hpp"
#include "io/output/zlib_blocks.hpp"
#include "support/vtu_file.hpp"
#include "unit/io/output_folder.hpp"

namespace gneiss {
namespace {

namespace fs = std::filesystem;
using test::message_of;
using test::read_vtu;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::NanSensitiveDoubleEq;
using ::testing::Not;
using ::testing::Pointwise;

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
    Fields fields{{{"speed", speed, "m/s"}, {"displacement", displacement, "m", 2}},
                  {{"cauchy_stress", stress, "Pa", 3, {"xx", "yy", "xy"}},
                   {"munjiza_stress", munjiza, "Pa", 4, {"v", "alpha", "beta", "psi"}}}};

    static std::vector<double> times(const fs::path& path) {
        std::vector<double> result;
        for (const PvdFrame& frame : read_pvd(path)) result.push_back(frame.t);
        return result;
    }
};

TEST_F(FieldOutput, Vtu_ReadBack_HasMeshFieldsAndTime) {
    VtuWriter(mesh).write(folder / "a.vtu", 0.1, 12345, fields);
    const test::VtuFile grid = read_vtu(folder / "a.vtu");
    ASSERT_EQ(grid.n_points(), 4u);
    ASSERT_EQ(grid.n_cells(), 2u);
    EXPECT_EQ(grid.position(3, 1), 1.0 / 3);
    EXPECT_EQ(grid.cell_type(1), 5);  // VTK_TRIANGLE
    EXPECT_THAT(grid.cell_points(1), ElementsAre(0, 2, 3));
    EXPECT_THAT(grid.field("TimeValue").values, ElementsAre(0.1));
    EXPECT_THAT(grid.field("step").values, ElementsAre(12345));
    EXPECT_THAT(grid.of_cell("region").values, ElementsAre(7, 9));

    const test::VtuArray& s = grid.of_point("speed");
    EXPECT_EQ(s(1), 0.2);
    EXPECT_TRUE(std::isnan(s(2)));
    EXPECT_EQ(s(3), 1e-300);

    const test::VtuArray& cauchy = grid.of_cell("cauchy_stress");
    EXPECT_THAT(cauchy.component_names, ElementsAre("xx", "yy", "xy"));
    EXPECT_EQ(cauchy(1, 2), 6);
    const test::VtuArray& four = grid.of_cell("munjiza_stress");
    EXPECT_THAT(four.component_names, ElementsAre("v", "alpha", "beta", "psi"));
    EXPECT_EQ(four(1, 0), 5);
}

TEST_F(FieldOutput, Vtu_Arrays_StateTheirUnits) {
    VtuWriter(mesh).write(folder / "a.vtu", 0.1, 12345, fields);
    const test::VtuFile grid = read_vtu(folder / "a.vtu");
    EXPECT_EQ(grid.field("TimeValue").unit, "s");
    EXPECT_EQ(grid.field("step").unit, "");
    EXPECT_EQ(grid.of_points[0].unit, "m");
    EXPECT_EQ(grid.of_point("speed").unit, "m/s");
    EXPECT_EQ(grid.of_cell("cauchy_stress").unit, "Pa");
    EXPECT_EQ(grid.of_cell("region").unit, "");
}

TEST(Base64, Text_IsThatOfTheStandard) {  // RFC 4648, section 10; bits of every letter
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64({"\x00\xff\xfe\x80", 4}), "AP/+gA==");
}

TEST_F(FieldOutput, Vtu_Base64_HoldsTheSameArraysAndUnits) {
    VtuWriter(mesh).write(folder / "raw.vtu", 0.1, 12345, fields);
    VtuWriter(mesh, VtuData::base64).write(folder / "text.vtu", 0.1, 12345, fields);
    EXPECT_THAT(contents(folder / "text.vtu"), Not(HasSubstr("AppendedData")));
    const test::VtuFile raw = read_vtu(folder / "raw.vtu"), text = read_vtu(folder / "text.vtu");
    for (const auto part : {&test::VtuFile::field_data, &test::VtuFile::point_data, &test::VtuFile::cell_data,
                            &test::VtuFile::of_points, &test::VtuFile::of_cells}) {
        ASSERT_EQ(raw.names(raw.*part), text.names(text.*part));
        for (std::size_t i = 0; i < (raw.*part).size(); ++i) {
            const test::VtuArray &a = (raw.*part)[i], &b = (text.*part)[i];
            EXPECT_EQ(a.unit, b.unit) << a.name;
            EXPECT_EQ(a.component_names, b.component_names) << a.name;
            EXPECT_THAT(b.values, Pointwise(NanSensitiveDoubleEq(), a.values)) << a.name;
        }
    }
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
    const test::VtuFile grid = read_vtu(folder / "a.vtu");
    ASSERT_EQ(grid.n_cells(), 3u);
    EXPECT_EQ(grid.cell_type(2), 3);  // VTK_LINE
    EXPECT_THAT(grid.cell_points(2), ElementsAre(3, 2));
    EXPECT_THAT(grid.of_cell("side").values, ElementsAre(5, 6, 8));
    EXPECT_EQ(grid.of_cell("damage")(1), 1);
    cracks.points = std::span(points).first(3);
    EXPECT_EQ(message_of<std::invalid_argument>([&] { VtuWriter{cracks}; }),
              "VtuWriter: line 1 names point 3, allowed: 0 to 2");
}

TEST_F(FieldOutput, Vtu_WithoutAnyCell_CanBeRead) {  // a solid that has not cracked yet
    for (const VtuData data : {VtuData::raw, VtuData::base64}) {
        VtuWriter(FieldMesh{}, data).write(folder / "a.vtu", 0, 0, {});
        EXPECT_EQ(read_vtu(folder / "a.vtu").n_cells(), 0u);
    }
}

TEST_F(FieldOutput, Vtu_PlaneVector_IsPaddedToThree) {
    VtuWriter(mesh).write(folder / "a.vtu", 0, 0, fields);
    const test::VtuFile grid = read_vtu(folder / "a.vtu");
    EXPECT_THAT(grid.of_point("displacement").values, ElementsAre(1, 2, 0, 3, 4, 0, 5, 6, 0, 7, 8, 0));
}

TEST_F(FieldOutput, Vtu_TwoNamedComponents_StayTwo) {
    VtuWriter(mesh).write(folder / "a.vtu", 0, 0, {{{"pair", displacement, "", 2, {"r", "theta"}}}, {}});
    EXPECT_EQ(read_vtu(folder / "a.vtu").of_point("pair").n_components, 2u);
}

/// A strip of n triangles with vectors, scalars and numbers that repeat and that do not: many blocks, a few exact ones.
TEST_F(FieldOutput, Vtu_OfManyBlocks_IsReadBackAndHasTheSameBytesForAnyNumberOfThreads) {
    constexpr std::size_t n = 3 * zlib_block_size;  // bytes of types: three full blocks
    std::vector<std::array<double, 2>> strip(n + 2);
    std::vector<std::array<std::int32_t, 3>> of_strip(n);
    std::vector<double> vectors, values;
    for (std::size_t i = 0; i < strip.size(); ++i) {
        strip[i] = {0.1 * static_cast<double>(i), static_cast<double>(i % 2)};
        vectors.insert(vectors.end(), {std::sin(static_cast<double>(i)), -static_cast<double>(i)});
    }
    for (std::size_t e = 0; e < n; ++e) {
        const auto first = static_cast<std::int32_t>(e);
        of_strip[e] = {first, first + 1, first + 2};
        values.push_back(std::cos(static_cast<double>(e)));
    }
    for (const VtuData data : {VtuData::raw, VtuData::base64}) {
        std::string bytes;
        for (const int n_threads : {1, 2, 5}) {
            omp_set_num_threads(n_threads);
            VtuWriter({strip, of_strip}, data)
                .write(folder / "a.vtu", 0.5, 1, {{{"u", vectors, "m", 2}}, {{"values", values}}});
            const std::string written = contents(folder / "a.vtu");
            if (bytes.empty()) bytes = written;
            EXPECT_TRUE(written == bytes) << n_threads << " threads";
        }
        omp_set_num_threads(omp_get_num_procs());

        const test::VtuFile grid = read_vtu(folder / "a.vtu");
        ASSERT_EQ(grid.n_cells(), n);
        EXPECT_EQ(grid.of_cell("values").values, values);
        EXPECT_THAT(grid.cell_points(n - 1), ElementsAre(n - 1, n, n + 1));
        const test::VtuArray& u = grid.of_point("u");
        ASSERT_EQ(u.n_rows(), strip.size());
        for (std::size_t i = 0; i < strip.size(); ++i) {
            ASSERT_EQ(grid.position(i, 0), strip[i][0]) << i;
            ASSERT_EQ(u(i, 0), vectors[2 * i]) << i;
            ASSERT_EQ(u(i, 1), vectors[2 * i + 1]) << i;
            ASSERT_EQ(u(i, 2), 0) << i;
        }
    }
}

TEST_F(FieldOutput, Vtu_SameWriterTwice_FramesDoNotMix) {
    const VtuWriter writer(mesh);
    writer.write(folder / "a.vtu", 0, 0, fields);
    writer.write(folder / "b.vtu", 1, 1, {{{"only", speed}}, {}});
    const test::VtuFile grid = read_vtu(folder / "b.vtu");
    EXPECT_THAT(grid.names(grid.point_data), ElementsAre("only"));
    EXPECT_THAT(grid.names(grid.cell_data), ElementsAre("region"));
}

TEST_F(FieldOutput, Vtu_BadInput_IsRefusedWithItsName) {
    const auto message = [&](const FieldMesh& m, const Fields& f) {
        return message_of<std::invalid_argument>([&] { VtuWriter(m).write(folder / "a.vtu", 0, 0, f); });
    };
    EXPECT_EQ(message(mesh, {{{"u", speed, "m", 2}}, {}}), "field u: 4 numbers for 4 rows of 2 components");
    EXPECT_EQ(message(mesh, {{}, {{"s", stress, "Pa", 3, {"xx"}}}}), "field s: 3 components, but 1 names for them");
    EXPECT_EQ(message(mesh, {{{"u", speed}, {"u", speed}}, {}}), "field 'u': every array needs a name of its own");
    EXPECT_EQ(message(mesh, {{}, {{"region", std::span(speed).first(2)}}}),
              "field 'region': every array needs a name of its own");
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
    EXPECT_THAT(message, HasSubstr("none/a.vtu: cannot open: No such file or directory"));
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
    EXPECT_EQ(read_vtu(folder / frames[1].file).field("TimeValue")(0), 1e-4 / 3);
    EXPECT_EQ(n_files(), 3u);
}

TEST_F(FieldOutput, Series_OnANewMesh_KeepsItsData) {
    for (const VtuData data : {VtuData::raw, VtuData::base64}) {
        FieldSeries series(folder, mesh, {}, "fields", data);
        series.set_mesh(mesh);
        series.write(0, 0, fields);
        const bool is_raw = contents(folder / "fields_000000.vtu").find("AppendedData") != std::string::npos;
        EXPECT_EQ(is_raw, data == VtuData::raw);
    }
}

TEST_F(FieldOutput, Series_SameTimeAgain_ReplacesTheFrame) {
    FieldSeries series(folder, mesh);
    series.write(0.5, 10, fields);
    series.write(0.5, 11, fields);
    EXPECT_EQ(series.n_frames(), 1u);
    EXPECT_EQ(read_vtu(folder / "fields_000000.vtu").field("step")(0), 11);
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
    EXPECT_EQ(read_vtu(folder / "fields_000003.vtu").field("TimeValue")(0), 0.25);
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
    EXPECT_EQ(read_vtu(folder / "fields_000000.vtu").n_cells(), 2u);
    EXPECT_EQ(read_vtu(folder / "fields_000001.vtu").n_cells(), 3u);
}

}  // namespace
}  // namespace gneiss
