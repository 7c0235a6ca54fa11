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
    { const GmshSession session; }
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
        const GmshSession session;
        before = algorithm();
        gmsh::option::setNumber("Mesh.Algorithm", before + 1);
    }
    const GmshSession session;
    EXPECT_EQ(algorithm(), before);
}

TEST(GmshSession, Failure_BecomesInputErrorWithTheFile) {
    const GmshSession session;
    EXPECT_EQ(input_error_of([&] { session.run("plate.geo", [] { gmsh::logger::write("no such curve", "error"); }); }),
              "plate.geo: Gmsh: no such curve");
}

TEST(GmshSession, Warnings_AreKept) {
    const GmshSession session;
    session.run("plate.geo", [] { gmsh::logger::write("a thin triangle", "warning"); });
    EXPECT_THAT(session.warnings(), ::testing::ElementsAre("Gmsh: a thin triangle"));
}

TEST(GmshSession, MeshingAndFailing_PrintsNothing) {
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    {
        const GmshSession session;
        gmsh::logger::write("quiet", "info");
        gmsh::logger::write("quiet", "warning");
        input_error_of([&] { session.run("x", [] { gmsh::logger::write("quiet", "error"); }); });
    }
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace gneiss
