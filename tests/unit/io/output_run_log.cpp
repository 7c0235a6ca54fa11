#include "io/output/run_log.hpp"

#include <gmock/gmock.h>

#include "io/output/atomic_file.hpp"
#include "unit/io/output_folder.hpp"

namespace gneiss {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

class RunLog : public test::OutputFolder {
protected:
    const std::filesystem::path path = folder / "run.log";

    static void write_one_of_each(const RunLogOptions& options) {
        const auto log = open_run_log(options);
        log->debug("force: element 3");
        log->info("step: t = {:.0e}, dt = {:.0e}", 1e-3, 2e-7);
        log->warn("balance error {}", 0.1);
        log->error("element 3 is inverted");
    }
    static std::string stderr_of(const RunLogOptions& options) {
        ::testing::internal::CaptureStderr();
        write_one_of_each(options);
        return ::testing::internal::GetCapturedStderr();
    }
};

TEST_F(RunLog, File_HasRecordsWithTimeAndLevel) {
    stderr_of({path});
    const std::string text = contents(path);
    EXPECT_THAT(text, ContainsRegex("[0-9]{4}-[0-9]{2}-[0-9]{2} [0-9:.]{12} info  step: t = 1e-03, dt = 2e-07\n"));
    EXPECT_THAT(text, HasSubstr("warning balance error 0.1\n"));
    EXPECT_THAT(text, HasSubstr("error element 3 is inverted\n"));
    EXPECT_THAT(text, Not(HasSubstr("force")));
}

TEST_F(RunLog, Stderr_GetsWarningsAndErrors) {
    EXPECT_EQ(stderr_of({path}), "gneiss: warning: balance error 0.1\ngneiss: error: element 3 is inverted\n");
}

TEST_F(RunLog, Quiet_LeavesErrorsOnStderrAndAllInTheFile) {
    RunLogOptions options{path};
    options.quiet = true;
    EXPECT_EQ(stderr_of(options), "gneiss: error: element 3 is inverted\n");
    EXPECT_THAT(contents(path), HasSubstr("balance error"));
}

TEST_F(RunLog, Verbose_HasDebugRecords) {
    RunLogOptions options{path};
    options.verbose = true;
    stderr_of(options);
    EXPECT_THAT(contents(path), HasSubstr("debug force: element 3\n"));
}

TEST_F(RunLog, Records_AreInTheFileAtOnce) {
    const auto log = open_run_log({path});
    log->info("mesh: 4 nodes");
    EXPECT_THAT(contents(path), HasSubstr("mesh: 4 nodes\n"));
}

TEST_F(RunLog, Append_KeepsWhatIsThere) {
    put(path, "before\n");
    open_run_log({path, true})->info("after");
    EXPECT_THAT(contents(path), HasSubstr("before\n"));
    EXPECT_THAT(contents(path), HasSubstr("after\n"));
    open_run_log({path, false})->info("anew");
    EXPECT_THAT(contents(path), Not(HasSubstr("before")));
}

TEST_F(RunLog, NoFile_LogsToStderrAlone) {
    EXPECT_THAT(stderr_of({}), HasSubstr("element 3 is inverted"));
    EXPECT_EQ(n_files(), 0u);
}

TEST_F(RunLog, ParentIsAFile_IoError) {
    put(folder / "file", "");
    EXPECT_THAT(test::message_of<IoError>([&] { open_run_log({folder / "file" / "run.log"}); }),
                HasSubstr("run.log: cannot open the log: "));
}

}  // namespace
}  // namespace gneiss
