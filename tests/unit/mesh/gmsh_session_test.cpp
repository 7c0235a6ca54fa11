#include "mesh/gmsh_session.hpp"

#include <omp.h>

#include <clocale>

#include "tests/unit/mesh/mesh_testing.hpp"

#if defined(__SANITIZE_ADDRESS__)
// Gmsh's parser does not free the names of a file that it cannot read.
extern "C" const char* __lsan_default_suppressions() { return "leak:strsave\n"; }
#endif

namespace gneiss {
namespace {

using namespace gneiss::testing;

TEST(GmshSession, NumberOfThreadsAndLocale_AreGivenBack) {
    const int n_threads = omp_get_max_threads();
    const std::string locale = std::setlocale(LC_ALL, nullptr);
    omp_set_num_threads(3);
    { GmshSession session; }
    EXPECT_EQ(omp_get_max_threads(), 3);
    EXPECT_EQ(std::setlocale(LC_ALL, nullptr), locale);
    omp_set_num_threads(n_threads);
}

TEST(GmshSession, Options_DoNotOutliveIt) {
    const auto algorithm = [] {
        double value;
        gmsh::option::getNumber("Mesh.Algorithm", value);
        return value;
    };
    double before;
    {
        GmshSession session;
        before = algorithm();
        gmsh::option::setNumber("Mesh.Algorithm", before + 1);
    }
    GmshSession session;
    EXPECT_EQ(algorithm(), before);
}

TEST(GmshSession, Failure_BecomesInputErrorWithTheFile) {
    GmshSession session;
    EXPECT_EQ(input_error_of([&] { session.run("plate.geo", [] { gmsh::logger::write("no such curve", "error"); }); }),
              "plate.geo: Gmsh: no such curve");
}

TEST(GmshSession, Warnings_AreKept) {
    GmshSession session;
    session.run("plate.geo", [] { gmsh::logger::write("a thin triangle", "warning"); });
    EXPECT_THAT(session.warnings(), ::testing::ElementsAre("Gmsh: a thin triangle"));
}

TEST(GmshSession, HarmlessError_JoinsTheWarnings) {
    GmshSession session;
    const auto is_harmless = [](const std::string& error) { return error.find("option") != std::string::npos; };
    session.run(
        "plate.geo", [] { gmsh::logger::write("no such option", "error"); }, is_harmless);
    EXPECT_THAT(session.warnings(), ::testing::ElementsAre("Gmsh: no such option"));
    EXPECT_EQ(input_error_of([&] {
                  session.run(
                      "plate.geo", [] { gmsh::logger::write("no such curve", "error"); }, is_harmless);
              }),
              "plate.geo: Gmsh: no such curve");
}

TEST(GmshSession, SummaryOfWhatWasSaid_IsLeftOut) {
    GmshSession session;
    session.run("plate.geo", [] {
        for (const char* line : {"a thin triangle", "------------------------------", "Mesh generation error summary",
                                 "    1 warning", "------------------------------", "another one"})
            gmsh::logger::write(line, "warning");
    });
    EXPECT_THAT(session.warnings(), ::testing::ElementsAre("Gmsh: a thin triangle", "Gmsh: another one"));
}

TEST(GmshSession, FileThatIsCalledOtherwise_IsSoInMessages) {
    GmshSession session;
    session.call("/tmp/copy.geo", "plate.geo");
    session.run("plate.geo", [] { gmsh::logger::write("'/tmp/copy.geo', line 3: odd", "warning"); });
    EXPECT_THAT(session.warnings(), ::testing::ElementsAre("Gmsh: 'plate.geo', line 3: odd"));
}

TEST(GmshSession, MeshingAndFailing_PrintsNothing) {
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    {
        GmshSession session;
        gmsh::logger::write("quiet", "info");
        gmsh::logger::write("quiet", "warning");
        input_error_of([&] { session.run("x", [] { gmsh::logger::write("quiet", "error"); }); });
    }
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace gneiss
