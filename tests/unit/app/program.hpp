#pragma once
// The program as a user meets it: a command line, a folder, what it prints, how it ends.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace gneiss::test {

/// How a call of the program ended.
struct Ended {
    int code = -1;  ///< exit code; minus the number of the signal that killed it
    std::string out, err;
};

/// A test in a folder of its own, removed afterwards, in which it calls the program.
class ProgramTest : public ::testing::Test {
protected:
    ProgramTest() {
        std::string pattern = (std::filesystem::temp_directory_path() / "gneiss_program_XXXXXX").string();
        if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder");
        folder = pattern;
    }
    ~ProgramTest() override { std::filesystem::remove_all(folder); }

    std::string contents(const std::filesystem::path& name) const {
        std::ifstream file(folder / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    void put(const std::filesystem::path& name, const std::string& text) const {
        if (name.has_parent_path()) std::filesystem::create_directories(folder / name.parent_path());
        std::ofstream(folder / name, std::ios::binary) << text;
    }
    bool exists(const std::filesystem::path& name) const { return std::filesystem::exists(folder / name); }
    nlohmann::json summary(const std::filesystem::path& results) const {
        return nlohmann::json::parse(contents(results / "summary.json"), nullptr, false);
    }
    /// Columns of a .csv by their headings.
    std::map<std::string, std::vector<double>> table(const std::filesystem::path& file) const {
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
    std::size_t n_lines(const std::filesystem::path& name) const {
        const std::string text = contents(name);
        return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    }

    /// Calls `gneiss ARGUMENTS` in the folder. The energy balance of a run that comes to its end has to close to a
    /// hundredth, unless balance_may_be_out.
    /// @param meanwhile  called with the process's number while it runs
    Ended gneiss(const std::vector<std::string>& arguments, const std::function<void(pid_t)>& meanwhile = {}) const {
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

    /// Waits until the file is there and the condition holds; half a minute at most.
    static void wait_until(const std::function<bool()>& condition) {
        for (int i = 0; i < 30000 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }

    std::filesystem::path folder;
    bool balance_may_be_out = false;
    bool overwrites = true;  ///< runs and comparisons are called with --overwrite

private:
    static bool redirect(const char* name, int descriptor) {
        const int file = ::open(name, O_WRONLY | O_CREAT | O_TRUNC, 0644);
        return file >= 0 && ::dup2(file, descriptor) >= 0;
    }
};

/// A square of 32 composites under a step pressure: some tens of steps.
inline const std::string small_deck = R"toml(title = "a square"
mesh = { generator = "rectangle", width = 1.0, height = 1.0, cells = [4, 4] }
solid = { plane = "strain" }
run = { t_end = 1e-3 }
output = { fields = 5e-4, history = 1e-4, probes = [{ name = "p", at = [0.5, 0.5], about = [0.0, 0.0] }] }
[[material]]
density = 1000.0
constants = { E = 1e9, nu = 0.25 }
[[load]]
on = "left"
type = "pressure"
value = 1e6
[[boundary]]
on = "right"
type = "fixed"
)toml";

/// Everything that has a memory: hypo-elastic with state-dependent moduli and initial stress, viscous, damped,
/// absorbing and moving boundaries, a load that is switched on under way.
inline const std::string memory_deck = R"toml(title = "everything that has a memory"
mesh = { generator = "rectangle", width = 4.0, height = 2.0, cells = [16, 8], pattern = "crossed" }
solid = { element = "compt", plane = "strain" }
run = { t_end = 0.04, mass_damping = 20.0, checkpoint = 5e-3 }
output = { fields = 1e-2, history = 1e-4, probes = [{ name = "p", at = [2.0, 1.0], about = [0.0, 0.0] }] }
[[material]]
form = "hypo"
density = 1000.0
constants = { M_v = 0.267e9, M_alpha = 0.8e9, M_beta = 1.6e9, M_psi = 0.8e9 }
axes = { angle = "0.2*sin(x/5)" }
stiffening = { k = 0.1, p_ref = 1e6, n = 0.5 }
in_situ_stress = [-1e5, -2e5, 0]
viscosity = { shear = 100.0, bulk = 100.0 }
[[load]]
on = "left"
type = "pressure"
value = 1e6
amplitude = { type = "ramp", end = 5e-4 }
[[load]]
on = "top"
type = "traction"
value = [0, -1e5]
amplitude = { type = "heaviside", start = 1.1e-2 }
[[boundary]]
on = "right"
type = "absorbing"
[[boundary]]
on = "bottom"
type = "displacement"
value = ["free", 1e-3]
amplitude = { type = "expression", expression = "sin(500*t)^2" }
)toml";

}  // namespace gneiss::test
