#pragma once
// The program as a user meets it: a command line, a folder, what it prints, how it ends.

#include <gtest/gtest.h>
#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
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
    ProgramTest();
    ~ProgramTest() override;

    std::string contents(const std::filesystem::path& name) const;
    void put(const std::filesystem::path& name, const std::string& text) const;
    bool exists(const std::filesystem::path& name) const;
    nlohmann::json summary(const std::filesystem::path& results) const;
    /// Columns of a .csv by their headings.
    std::map<std::string, std::vector<double>> table(const std::filesystem::path& file) const;
    std::size_t n_lines(const std::filesystem::path& name) const;

    /// Calls `gneiss ARGUMENTS` in the folder. The energy balance of a run that comes to its end has to close to a
    /// hundredth, unless balance_may_be_out.
    /// @param meanwhile  called with the process's number while it runs
    Ended gneiss(const std::vector<std::string>& arguments, const std::function<void(pid_t)>& meanwhile = {}) const;

    /// Waits until the condition holds; half a minute at most.
    static void wait_until(const std::function<bool()>& condition);

    std::filesystem::path folder;
    bool balance_may_be_out = false;
    bool overwrites = true;  ///< runs and comparisons are called with --overwrite
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
