#include "io/output/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/errors.hpp"
#include "io/output/atomic_file.hpp"

namespace gneiss {
namespace {

namespace fs = std::filesystem;

std::string host_name() {
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

/// Field 22 of /proc/PID/stat [proc(5)]; 0 if there is no such process.
std::int64_t start_of(pid_t process) {
    std::ifstream file(fmt::format("/proc/{}/stat", process));
    std::string text((std::istreambuf_iterator<char>(file)), {});
    const std::size_t name_end = text.rfind(')');  // field 2, the program's name, may hold blanks
    if (name_end == std::string::npos) return 0;
    std::istringstream fields(text.substr(name_end + 1));
    constexpr int fields_between = 19;  // 3 to 21
    std::string skipped;
    for (int i = 0; i < fields_between; ++i) fields >> skipped;
    std::int64_t start = 0;
    fields >> start;
    return start;
}

LockOwner owner_in(const fs::path& file) {
    std::ifstream stream(file);
    const auto json = nlohmann::json::parse(stream, nullptr, false);
    LockOwner owner;
    if (!json.is_object()) return owner;  // not written yet, or gone again
    owner.host = json.value("host", "");
    owner.process = json.value("process", pid_t{0});
    owner.process_start = json.value("process_start", std::int64_t{0});
    owner.since = json.value("since", "");
    owner.what = json.value("what", "");
    return owner;
}

[[noreturn]] void refuse(const fs::path& folder, const LockOwner& owner) {
    const std::string who = owner.process == 0
                                ? "another process"
                                : fmt::format("`{}`, process {} on {}, since {}", owner.what, owner.process,
                                              owner.host.empty() ? "this machine" : owner.host, owner.since);
    throw InputError(folder.string(), fmt::format("in use by {}: wait until it has ended, or give the results another "
                                                  "folder with --out",
                                                  who));
}

bool is_still(int descriptor, const fs::path& file) {
    struct stat opened {
    }, there{};
    return ::fstat(descriptor, &opened) == 0 && ::stat(file.c_str(), &there) == 0 && opened.st_ino == there.st_ino &&
           opened.st_dev == there.st_dev;
}

}  // namespace

LockOwner this_process(std::string_view what) {
    return {host_name(), ::getpid(), start_of(::getpid()), fmt::format("{:%F %T} UTC", fmt::gmtime(std::time(nullptr))),
            std::string(what)};
}

bool may_be_running(const LockOwner& owner) {
    if (owner.process <= 0) return false;
    if (owner.host != host_name()) return true;
    return start_of(owner.process) != 0 && start_of(owner.process) == owner.process_start;
}

FolderLock::FolderLock(const fs::path& folder, std::string_view what) : file_(folder / file_name) {
    for (;;) {
        descriptor_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor_ < 0) throw io_error_from_errno(file_, "cannot open");
        if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) {
            if (is_still(descriptor_, file_)) break;
            ::close(descriptor_);  // who had it before has removed the file meanwhile
            continue;
        }
        const bool knows_locks = errno == EWOULDBLOCK;
        const LockOwner owner = owner_in(file_);
        if (!knows_locks && !may_be_running(owner)) break;
        ::close(descriptor_);
        refuse(folder, owner);
    }
    const LockOwner owner = this_process(what);
    const nlohmann::ordered_json json{{"what", owner.what},
                                      {"host", owner.host},
                                      {"process", owner.process},
                                      {"process_start", owner.process_start},
                                      {"since", owner.since}};
    try {
        if (::ftruncate(descriptor_, 0) != 0) throw io_error_from_errno(file_, "cannot write");
        write_all(descriptor_, json.dump(2) + '\n', file_);
    } catch (...) {
        release();
        throw;
    }
}

FolderLock::~FolderLock() { release(); }

void FolderLock::release() {
    std::error_code ignored;
    fs::remove(file_, ignored);     // while it is locked: nobody else has it yet
    ::flock(descriptor_, LOCK_UN);  // a child process may have inherited it
    ::close(descriptor_);
}

}  // namespace gneiss
