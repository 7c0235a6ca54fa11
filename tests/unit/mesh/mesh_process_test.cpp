#include "mesh/mesh_process.hpp"

#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "mesh/draft_file.hpp"
#include "tests/unit/mesh/mesh_testing.hpp"

namespace gneiss {
namespace {

using namespace gneiss::testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

MeshDraft small_draft() {
    MeshDraft draft;
    draft.where = "plate.geo";
    for (const auto& [x, y] : std::vector<std::array<double, 2>>{{0, 0}, {0.1, 0}, {0, 1e-300}}) draft.add_node(x, y);
    draft.add_triangle(0, 1, 2);
    draft.report_unused_nodes = false;
    draft.region_names = {"rock", ""};
    draft.element_data["dip"] = {0.25};
    draft.lines["left"] = {{0, MeshDraft::no_node, 2}};
    draft.points["foot"] = {0};
    draft.warnings = {"a thin triangle"};
    return draft;
}

TEST(DraftFile, Draft_ComesBackAsItWas) {
    const TemporaryFolder folder;
    const MeshDraft draft = small_draft();
    write_draft(folder.path() / "draft", draft);
    const MeshDraft back = std::get<MeshDraft>(read_draft(folder.path() / "draft"));
    EXPECT_EQ(back.where, draft.where);
    EXPECT_EQ(back.nodes, draft.nodes);
    EXPECT_EQ(back.node_labels, draft.node_labels);
    EXPECT_EQ(back.report_unused_nodes, draft.report_unused_nodes);
    EXPECT_EQ(back.elements, draft.elements);
    EXPECT_EQ(back.element_labels, draft.element_labels);
    EXPECT_EQ(back.region, draft.region);
    EXPECT_EQ(back.region_names, draft.region_names);
    EXPECT_EQ(back.element_data, draft.element_data);
    EXPECT_EQ(back.lines, draft.lines);
    EXPECT_EQ(back.points, draft.points);
    EXPECT_EQ(back.warnings, draft.warnings);
}

TEST(DraftFile, Problems_ComeBackAsTheyWere) {
    const TemporaryFolder folder;
    write_draft(folder.path() / "draft", std::vector<Problem>{{"plate.geo", "is empty"}, {"", "is lost"}});
    const auto back = std::get<std::vector<Problem>>(read_draft(folder.path() / "draft"));
    ASSERT_EQ(back.size(), 2u);
    EXPECT_EQ(back[0].where, "plate.geo");
    EXPECT_EQ(back[1].message, "is lost");
}

TEST(DraftFile, Cut_IsRefused) {
    const TemporaryFolder folder;
    write_draft(folder.path() / "draft", small_draft());
    const auto size = std::filesystem::file_size(folder.path() / "draft");
    for (std::uintmax_t n = 0; n < size; n += 9) {
        std::filesystem::resize_file(folder.path() / "draft", size - 1 - n);
        EXPECT_THROW(read_draft(folder.path() / "draft"), std::runtime_error) << n;
        write_draft(folder.path() / "draft", small_draft());
    }
}

/// A program that stands for ours: a shell script that is handed `read-mesh RESULT FILE ...`.
class MeshInAProcess : public ::testing::Test {
protected:
    ~MeshInAProcess() override { use_mesh_process({}); }
    MeshDraft read(const std::string& script) {
        folder.write("program", "#!/bin/sh\n" + script);
        ::chmod((folder.path() / "program").c_str(), 0755);
        write_draft(folder.path() / "ready", small_draft());
        use_mesh_process({.program = folder.path() / "program",
                          .progress = [this](const std::filesystem::path&, double,
                                             std::string_view line) { said.emplace_back(line); },
                          .ended = [this] { ++n_ended; }});
        return read_gmsh_apart("plate.geo", {{"lc", 0.1}});
    }
    std::string error_of(const std::string& script) {
        return input_error_of([&] { read(script); });
    }

    TemporaryFolder folder;
    std::vector<std::string> said;
    int n_ended = 0;
};

TEST_F(MeshInAProcess, Program_IsHandedFileAndParametersAndLeavesADraft) {
    const std::string there = folder.path().string();
    const MeshDraft draft =
        read("echo \"$1 $3 $4\" > " + there + "/words; cp " + there + "/ready $2; echo Meshing; sleep 0.3\n");
    EXPECT_EQ(draft.nodes, small_draft().nodes);
    std::ifstream words(folder.path() / "words");
    std::string line;
    std::getline(words, line);
    EXPECT_EQ(line, "read-mesh plate.geo lc=0.10000000000000001");
    EXPECT_THAT(said, ::testing::Contains("Meshing"));
    EXPECT_EQ(n_ended, 1);
}

TEST_F(MeshInAProcess, ProgramThatDies_IsAnErrorWithItsLastWords) {
    EXPECT_THAT(error_of("echo 'Info : Meshing curve 3'; echo 'Info : Meshing surface 7'; kill -SEGV $$\n"),
                ::testing::AllOf(StartsWith("plate.geo: Gmsh died at work on it, of signal 11 ("),
                                 HasSubstr("); it said last: Info : Meshing curve 3 | Info : Meshing surface 7")));
    EXPECT_THAT(error_of("kill -KILL $$\n"), HasSubstr("of signal 9 (Killed: out of memory?)"));
    EXPECT_THAT(error_of("echo no room >&2; exit 3\n"),
                HasSubstr("plate.geo: Gmsh ended at work on it, with status 3; it said last: no room"));
    EXPECT_THAT(error_of("exit 0\n"), HasSubstr("before there was a mesh"));
    EXPECT_EQ(n_ended, 4);
}

TEST_F(MeshInAProcess, Interrupt_StopsTheProgramAndIsPassedOn) {
    ::signal(SIGINT, SIG_DFL);  // where these tests run in the background, a shell has it ignored
    try {
        read("kill -INT $PPID; exec sleep 60\n");
        ADD_FAILURE() << "no MeshInterrupted";
    } catch (const MeshInterrupted& interrupted) {
        EXPECT_EQ(interrupted.signal, SIGINT);
    }
    try {
        read("kill -INT $$; sleep 60\n");  // a terminal sends it to both
        ADD_FAILURE() << "no MeshInterrupted";
    } catch (const MeshInterrupted& interrupted) {
        EXPECT_EQ(interrupted.signal, SIGINT);
    }
}

TEST_F(MeshInAProcess, TemporaryFiles_AreGoneHoweverTheProgramEnds) {
    const std::filesystem::path temporary = folder.path() / "tmp";
    std::filesystem::create_directory(temporary);
    const char* const before = std::getenv("TMPDIR");
    const std::string former = before == nullptr ? "" : before;
    ::setenv("TMPDIR", temporary.c_str(), 1);
    const std::string leave = "touch $TMPDIR/left; test -e $TMPDIR/left || exit 9; ";
    EXPECT_EQ(read(leave + "cp " + folder.path().string() + "/ready $2\n").nodes, small_draft().nodes);
    EXPECT_THAT(error_of(leave + "kill -KILL $$\n"), HasSubstr("of signal 9"));
    EXPECT_THROW(read(leave + "kill -TERM $PPID; exec sleep 60\n"), MeshInterrupted);
    EXPECT_THROW(read(leave + "kill -HUP $PPID; exec sleep 60\n"), MeshInterrupted);
    EXPECT_TRUE(std::filesystem::is_empty(temporary));
    before == nullptr ? ::unsetenv("TMPDIR") : ::setenv("TMPDIR", former.c_str(), 1);
}

TEST_F(MeshInAProcess, ProgramThatIsNotThere_IsAnError) {
    use_mesh_process({.program = folder.path() / "nothing"});
    EXPECT_THROW(read_gmsh_apart("plate.geo", {}), std::system_error);
}

}  // namespace
}  // namespace gneiss
