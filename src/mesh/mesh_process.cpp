#include "mesh/mesh_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <string_view>
#include <system_error>

#include "mesh/draft_file.hpp"
#include "mesh/gmsh_reader.hpp"

extern char** environ;

namespace gneiss {
namespace {

namespace fs = std::filesystem;

MeshProcess& settings() {
    static MeshProcess process;
    return process;
}

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

/// A folder that is gone with all that is in it when this is: what the child leaves where it is ended as well.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "gneiss-mesh-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) fail("temporary folder");
        path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const fs::path& path() const { return path_; }

private:
    fs::path path_;
};

/// Environment variables of this process with another folder for temporary files.
std::vector<std::string> environment_with(const fs::path& temporary) {
    std::vector<std::string> all;
    for (char** variable = environ; *variable != nullptr; ++variable)
        if (std::string_view(*variable).rfind("TMPDIR=", 0) != 0) all.emplace_back(*variable);
    all.push_back("TMPDIR=" + temporary.string());
    return all;
}

std::vector<char*> pointers(std::vector<std::string>& words) {
    std::vector<char*> all;
    for (std::string& word : words) all.push_back(word.data());
    all.push_back(nullptr);
    return all;
}

volatile std::sig_atomic_t signal_that_came = 0;

/// While one lives, SIGINT, SIGTERM and SIGHUP are noted instead of ending the process; those that it ignores stay
/// ignored.
class SignalNote {
public:
    SignalNote() {
        signal_that_came = 0;
        for (std::size_t i = 0; i < signals.size(); ++i) {
            struct sigaction ours {};
            ours.sa_handler = [](int signal) { signal_that_came = signal; };
            sigemptyset(&ours.sa_mask);
            sigaction(signals[i], nullptr, &former_[i]);
            if (former_[i].sa_handler != SIG_IGN) sigaction(signals[i], &ours, nullptr);
        }
    }
    ~SignalNote() {
        for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &former_[i], nullptr);
    }
    static bool is_noted(int signal) { return std::ranges::find(signals, signal) != signals.end(); }
    SignalNote(const SignalNote&) = delete;
    SignalNote& operator=(const SignalNote&) = delete;

private:
    static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP};
    std::array<struct sigaction, signals.size()> former_{};
};

/// A child process whose output is read line by line.
class Child {
public:
    /// A new program, not a copy of this one: a copy would have neither the threads of this process nor the locks that
    /// they hold.
    Child(std::vector<std::string> command, std::vector<std::string> environment) {
        std::array<int, 2> ends;
        if (pipe2(ends.data(), O_CLOEXEC) != 0) fail("pipe");
        output_ = ends[0];
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
        posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
        const std::vector<char*> words = pointers(command), variables = pointers(environment);
        const int error = posix_spawn(&pid_, words[0], &actions, nullptr, words.data(), variables.data());
        posix_spawn_file_actions_destroy(&actions);
        close(ends[1]);
        if (error != 0) {
            close(output_);
            throw std::system_error(error, std::generic_category(), command[0]);
        }
    }
    ~Child() {
        if (pid_ > 0) {
            kill(pid_, SIGKILL);
            wait();
        }
        close(output_);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    /// Waits for output, a fifth of a second at most. @return false at its end
    bool listen() {
        pollfd waited{output_, POLLIN, 0};
        constexpr int milliseconds = 200;
        if (poll(&waited, 1, milliseconds) <= 0) return true;
        std::array<char, 4096> buffer;
        const ssize_t n = read(output_, buffer.data(), buffer.size());
        if (n < 0) return errno == EINTR;
        for (ssize_t i = 0; i < n; ++i) add(buffer[static_cast<std::size_t>(i)]);
        return n > 0;
    }

    /// @return status of waitpid()
    int wait() {
        int status = 0;
        while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) continue;
        pid_ = 0;
        return status;
    }

    void signal(int number) const { kill(pid_, number); }
    const std::deque<std::string>& last_lines() const { return lines_; }

private:
    void add(char c) {
        if (c != '\n' && c != '\r') {
            line_ += c;
            return;
        }
        if (line_.find_first_not_of(' ') != std::string::npos) lines_.push_back(line_);
        constexpr std::size_t kept = 3;
        if (lines_.size() > kept) lines_.pop_front();
        line_.clear();
    }

    pid_t pid_ = 0;
    int output_ = -1;
    std::string line_;
    std::deque<std::string> lines_;
};

std::string how_it_ended(int status, const std::deque<std::string>& said) {
    std::string text;
    if (WIFSIGNALED(status))
        text = fmt::format("Gmsh died at work on it, of signal {} ({}{})", WTERMSIG(status),
                           strsignal(WTERMSIG(status)), WTERMSIG(status) == SIGKILL ? ": out of memory?" : "");
    else
        text = fmt::format("Gmsh ended at work on it, with status {}", WEXITSTATUS(status));
    for (std::size_t i = 0; i < said.size(); ++i) text += (i == 0 ? "; it said last: " : " | ") + said[i];
    return text;
}

}  // namespace

void use_mesh_process(MeshProcess process) { settings() = std::move(process); }

MeshDraft read_gmsh_apart(const fs::path& file, const std::map<std::string, double>& parameters) {
    const MeshProcess& process = settings();
    if (process.program.empty()) return read_gmsh(file, parameters);
    using Clock = std::chrono::steady_clock;
    const Clock::time_point started = Clock::now();
    const TemporaryFolder temporary;
    const fs::path result = temporary.path() / "draft";
    std::vector<std::string> command{process.program.string(), std::string(mesh_process_command), result.string(),
                                     file.string()};
    for (const auto& [name, value] : parameters) command.push_back(fmt::format("{}={:.17g}", name, value));
    const SignalNote note;
    Child child(std::move(command), environment_with(temporary.path()));
    while (child.listen() && signal_that_came == 0)
        if (process.progress)
            process.progress(file, std::chrono::duration<double>(Clock::now() - started).count(),
                             child.last_lines().empty() ? "" : std::string_view(child.last_lines().back()));
    if (signal_that_came != 0) child.signal(signal_that_came);
    const int status = child.wait();
    if (process.ended) process.ended();
    if (signal_that_came != 0) throw MeshInterrupted(signal_that_came);
    if (WIFSIGNALED(status) && SignalNote::is_noted(WTERMSIG(status))) throw MeshInterrupted(WTERMSIG(status));
    if (status != 0) throw InputError(file.string(), how_it_ended(status, child.last_lines()));
    if (!fs::exists(result))
        throw InputError(file.string(), "Gmsh ended at work on it, before there was a mesh: by a statement Exit?");
    DraftOrProblems read = read_draft(result);
    if (auto* problems = std::get_if<std::vector<Problem>>(&read)) throw InputError(std::move(*problems));
    return std::get<MeshDraft>(std::move(read));
}

int serve_mesh(const std::vector<std::string>& words) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // what it says last is to come out before it dies
    constexpr int wrong_use = 2, failed = 3;
    if (words.size() < 2) return wrong_use;
    std::map<std::string, double> parameters;
    for (std::size_t i = 2; i < words.size(); ++i) {
        const std::size_t equals = words[i].rfind('=');
        if (equals == std::string::npos) return wrong_use;
        parameters[words[i].substr(0, equals)] = std::strtod(words[i].c_str() + equals + 1, nullptr);
    }
    try {
        constexpr bool aloud = true;
        write_draft(words[0], read_gmsh(words[1], parameters, aloud));
    } catch (const InputError& error) {
        write_draft(words[0], error.problems());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return failed;
    }
    return 0;
}

}  // namespace gneiss
