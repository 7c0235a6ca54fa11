#include "unit/app/program.hpp"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace gneiss::test {
namespace {

bool redirect(const char* name, int descriptor) {
    const int file = ::open(name, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    return file >= 0 && ::dup2(file, descriptor) >= 0;
}

}  // namespace

ProgramTest::ProgramTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "gneiss_program_XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder");
    folder = pattern;
}

ProgramTest::~ProgramTest() { std::filesystem::remove_all(folder); }

std::string ProgramTest::contents(const std::filesystem::path& name) const {
    std::ifstream file(folder / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void ProgramTest::put(const std::filesystem::path& name, const std::string& text) const {
    if (name.has_parent_path()) std::filesystem::create_directories(folder / name.parent_path());
    std::ofstream(folder / name, std::ios::binary) << text;
}

bool ProgramTest::exists(const std::filesystem::path& name) const { return std::filesystem::exists(folder / name); }

nlohmann::json ProgramTest::summary(const std::filesystem::path& results) const {
    return nlohmann::json::parse(contents(results / "summary.json"), nullptr, false);
}

std::map<std::string, std::vector<double>> ProgramTest::table(const std::filesystem::path& file) const {
    std::istringstream lines(contents(file));
    std::string line, cell;
    std::getline(lines, line);
    std::vector<std::string> headings;
    for (std::istringstream cells(line); std::getline(cells, cell, ',');) headings.push_back(cell);
    std::map<std::string, std::vector<double>> columns;
    while (std::getline(lines, line)) {
        std::istringstream cells(line);
        for (const std::string& heading : headings) {
            std::getline(cells, cell, ',');
            columns[heading].push_back(std::stod(cell));
        }
    }
    return columns;
}

std::size_t ProgramTest::n_lines(const std::filesystem::path& name) const {
    const std::string text = contents(name);
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

Ended ProgramTest::gneiss(const std::vector<std::string>& arguments,
                          const std::function<void(pid_t)>& meanwhile) const {
    std::vector<std::string> given = arguments;
    if (overwrites && !given.empty() && (given[0] == "run" || given[0] == "compare"))
        given.insert(given.begin() + 1, "--overwrite");
    const pid_t child = ::fork();
    if (child == 0) {
        std::vector<char*> argv{const_cast<char*>(GNEISS_PROGRAM)};
        for (const std::string& argument : given) argv.push_back(const_cast<char*>(argument.c_str()));
        argv.push_back(nullptr);
        const bool ready = ::chdir(folder.c_str()) == 0 && redirect("stdout.txt", STDOUT_FILENO) &&
                           redirect("stderr.txt", STDERR_FILENO);
        if (ready) ::execv(GNEISS_PROGRAM, argv.data());
        ::_exit(127);
    }
    if (meanwhile) meanwhile(child);
    int status = 0;
    ::waitpid(child, &status, 0);
    Ended ended;
    ended.code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    ended.out = contents("stdout.txt");
    ended.err = contents("stderr.txt");
    if (ended.code == 0 && arguments[0] == "run" && !balance_may_be_out) {
        const auto out = std::ranges::find(arguments, "--out");
        const auto results = out != arguments.end() ? std::filesystem::path(*(out + 1))
                                                    : "results" / std::filesystem::path(arguments[1]).stem();
        const nlohmann::json found = summary(results);
        if (found.is_object()) {
            EXPECT_LT(found["largest_balance_error"], 0.01) << results;
        }
    }
    return ended;
}

void ProgramTest::wait_until(const std::function<bool()>& condition) {
    for (int i = 0; i < 30000 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace gneiss::test
