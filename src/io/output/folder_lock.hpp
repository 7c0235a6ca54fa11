#pragma once
// One process at a time writes into a folder of results.

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace gneiss {

/// Who holds a folder, as its lock file says.
struct LockOwner {
    std::string host;
    pid_t process = 0;
    std::int64_t process_start =
        0;              ///< clock ticks after the machine's start: a number that is given out again differs
    std::string since;  ///< "2026-11-30 03:08:11 UTC"
    std::string what;   ///< "gneiss run /home/me/case.toml"
};

/// This process, from now on. @param what  it does, for the message of those who find the folder locked
LockOwner this_process(std::string_view what);

/// Whether the owner may still be at work: always where it is on another machine, which nobody can ask.
bool may_be_running(const LockOwner& owner);

/// Holds a folder for this process by a lock of the operating system (flock) on the file `run.lock` in it, which says
/// who it is. The system takes the lock back when the process ends, however it ends: a file that a killed process has
/// left locks nothing. On a file system without such locks the file itself decides, see may_be_running().
class FolderLock {
public:
    static constexpr const char* file_name = "run.lock";

    /// @param folder  is there already
    /// @throws InputError  if another process holds it, with who and since when
    /// @throws IoError     if the file cannot be written
    FolderLock(const std::filesystem::path& folder, std::string_view what);
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;
    ~FolderLock();

private:
    void release();

    std::filesystem::path file_;
    int descriptor_ = -1;
};

}  // namespace gneiss
