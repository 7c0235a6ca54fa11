#include "io/output/folder_lock.hpp"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/errors.hpp"
#include "unit/io/output_folder.hpp"

namespace gneiss {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

using FolderLockOutput = test::OutputFolder;

TEST_F(FolderLockOutput, Held_IsRefusedWithOwner) {
    const FolderLock lock(folder, "gneiss run /home/me/case.toml");
    EXPECT_THAT(
        test::message_of<InputError>([&] { FolderLock(folder, "another"); }),
        AllOf(HasSubstr("in use by `gneiss run /home/me/case.toml`, process " + std::to_string(::getpid()) + " on "),
              HasSubstr(", since 20"), HasSubstr(" UTC"), HasSubstr("--out")));
}

TEST_F(FolderLockOutput, Released_LeavesNothingAndIsFree) {
    { const FolderLock lock(folder, "first"); }
    EXPECT_EQ(n_files(), 0U);
    EXPECT_NO_THROW(FolderLock(folder, "second"));
}

TEST_F(FolderLockOutput, OfAKilledProcess_IsFree) {
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const FolderLock lock(folder, "killed");
        if (::write(ready[1], "x", 1) == 1) ::pause();
        ::_exit(0);
    }
    char byte = 0;
    ASSERT_EQ(::read(ready[0], &byte, 1), 1);
    EXPECT_THAT(test::message_of<InputError>([&] { FolderLock(folder, "early"); }), HasSubstr("`killed`"));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    EXPECT_TRUE(std::filesystem::exists(folder / FolderLock::file_name));
    EXPECT_NO_THROW(FolderLock(folder, "late"));
    ::close(ready[0]);
    ::close(ready[1]);
}

TEST_F(FolderLockOutput, Unwritable_IsAnIoError) {
    EXPECT_THROW(FolderLock(folder / "nowhere", "any"), std::runtime_error);
}

TEST(LockOwner, OnlyTheProcessThatWroteIt_MayBeRunning) {
    const LockOwner here = this_process("any");
    EXPECT_TRUE(may_be_running(here));
    LockOwner other = here;
    ++other.process_start;  // the number was given out again
    EXPECT_FALSE(may_be_running(other));
    other = here;
    other.process = 0;
    EXPECT_FALSE(may_be_running(other));
    other.process = 1 << 30;  // above any number that Linux gives
    EXPECT_FALSE(may_be_running(other));
    other.host += "-2";  // nobody knows
    EXPECT_TRUE(may_be_running(other));
}

}  // namespace
}  // namespace gneiss
