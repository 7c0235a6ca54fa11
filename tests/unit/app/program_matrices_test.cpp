// `gneiss matrices`: what it leaves is the linearised system, in the order that it says.

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "unit/app/program.hpp"

namespace gneiss {
namespace {

using test::Ended;
using test::memory_deck;
using test::small_deck;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// Sums of some hundred products of order one.
constexpr double round_off = 1e-13;

/// A matrix of a file.
struct ReadMatrix {
    std::size_t n = 0;
    struct Entry {
        std::size_t row, column;
        double value;
    };
    std::vector<Entry> entries;

    explicit ReadMatrix(const std::string& text) {
        std::istringstream in(text);
        std::string heading, comment;
        std::getline(in, heading), std::getline(in, comment);
        EXPECT_EQ(heading, "%%MatrixMarket matrix coordinate real general");
        std::size_t n_columns = 0, n_entries = 0;
        in >> n >> n_columns >> n_entries;
        EXPECT_EQ(n, n_columns);
        for (Entry entry{}; in >> entry.row >> entry.column >> entry.value;) {
            entries.push_back({entry.row - 1, entry.column - 1, entry.value});
            --n_entries;
        }
        EXPECT_EQ(n_entries, 0u);
    }
    std::vector<double> times(const std::vector<double>& x) const {
        std::vector<double> y(n, 0.0);
        for (const Entry& entry : entries) y[entry.row] += entry.value * x[entry.column];
        return y;
    }
    double form(const std::vector<double>& x) const {
        const std::vector<double> y = times(x);
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i) sum += x[i] * y[i];
        return sum;
    }
    /// The largest entry of the matrix less its transpose, over the largest entry.
    double asymmetry() const {
        std::vector<double> dense(n * n, 0.0);
        for (const Entry& entry : entries) dense[entry.row * n + entry.column] = entry.value;
        double difference = 0, largest = 0;
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j) {
                difference = std::max(difference, std::abs(dense[i * n + j] - dense[j * n + i]));
                largest = std::max(largest, std::abs(dense[i * n + j]));
            }
        }
        return difference / largest;
    }
};

class ProgramMatrices : public test::ProgramTest {
protected:
    nlohmann::json write(const std::vector<std::string>& more, const std::filesystem::path& out = "m") const {
        std::vector<std::string> arguments{"matrices", "case.toml", "--out", out, "--threads", "1"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Ended ended = gneiss(arguments);
        EXPECT_EQ(ended.code, 0) << ended.err;
        return nlohmann::json::parse(contents(out / "system.json"), nullptr, false);
    }
    ReadMatrix matrix(const std::string& name, const std::filesystem::path& out = "m") const {
        return ReadMatrix(contents(out / (name + ".mtx")));
    }
};

TEST_F(ProgramMatrices, AffineDisplacement_HasTheEnergyOfTheStrain) {
    put("case.toml", small_deck);
    for (const char* element : {"solid.element=cst", "solid.element=compt"}) {
        const std::vector<std::string> set{element, "load.0.type=traction", "load.0.value=[1e6, 0]"};
        std::vector<std::string> arguments{"--set"};
        arguments.insert(arguments.end(), set.begin(), set.end());
        const nlohmann::json system = write(arguments);
        EXPECT_EQ(system["n_dof"], 162);
        EXPECT_EQ(system["t_s"], 0.0);
        EXPECT_EQ(system["symmetric"], true);
        EXPECT_EQ(system["elements"].size(), element == std::string("solid.element=cst") ? 128u : 32u);
        EXPECT_EQ(system["elements"][0].size(), element == std::string("solid.element=cst") ? 3u : 6u);
        EXPECT_EQ(system["overrides"], set);
        const auto nodes = system["nodes_m"].get<std::vector<std::array<double, 2>>>();
        std::vector<double> u;
        const double h[2][2] = {{1, 0.5}, {-0.25, -2}};
        for (const auto& [x, y] : nodes)
            for (const auto& row : h) u.push_back(row[0] * x + row[1] * y);
        const double lambda = 0.25 * 1e9 / (1.25 * 0.5), mu = 1e9 / (2 * 1.25);  // E = 1 GPa, nu = 0.25; area 1 m2
        const double trace = h[0][0] + h[1][1], shear = 0.5 * (h[0][1] + h[1][0]);
        const double exact =
            lambda * trace * trace + 2 * mu * (h[0][0] * h[0][0] + h[1][1] * h[1][1] + 2 * shear * shear);
        const ReadMatrix stiffness = matrix("stiffness");
        EXPECT_LT(stiffness.asymmetry(), round_off);
        EXPECT_NEAR(stiffness.form(u), exact, round_off * exact);
    }
}

TEST_F(ProgramMatrices, ConstrainedDofs_AreThoseOfTheFixedSide_AndForcesThoseOfTheLoad) {
    put("case.toml", small_deck);
    const nlohmann::json system = write({"--set", "load.0.amplitude=heaviside"});
    const auto nodes = system["nodes_m"].get<std::vector<std::array<double, 2>>>();
    std::vector<std::size_t> right;
    for (std::size_t node = 0; node < nodes.size(); ++node)
        if (nodes[node][0] == 1) right.insert(right.end(), {2 * node, 2 * node + 1});
    EXPECT_EQ(system["constrained_dofs"], right);
    double sum_x = 0, sum_y = 0;
    for (std::size_t node = 0; node < nodes.size(); ++node) {
        sum_x += system["force_N"][2 * node].get<double>();
        sum_y += system["force_N"][2 * node + 1].get<double>();
    }
    EXPECT_NEAR(sum_x, 1e6, round_off * 1e6) << "a pressure of 1 MPa on 1 m2, switched on at t = 0";
    EXPECT_NEAR(sum_y, 0, round_off * 1e6);
}

TEST_F(ProgramMatrices, MassAndDamping_OfATranslation) {
    put("case.toml", small_deck);
    write({"--set", "run.mass_damping=3", "material.0.viscosity={shear=5.0}"});
    const std::vector<double> translation(162, 1.0);  // 1 m/s in x and y; viscous stress does not see it
    EXPECT_NEAR(matrix("mass").form(translation), 2 * 1000, round_off * 2000);
    EXPECT_NEAR(matrix("damping").form(translation), 3 * 2 * 1000, round_off * 6000);
    EXPECT_EQ(matrix("mass").entries.size(), 162u);
    EXPECT_GT(matrix("damping").entries.size(), 162u) << "viscous stress couples nodes";
}

TEST_F(ProgramMatrices, OfFollowersAndOfTheCentre_IsNotSymmetric) {
    put("case.toml", small_deck);
    EXPECT_EQ(write({})["symmetric"], false) << "a follower pressure";
    const std::vector<std::string> centre{"--set",
                                          "load.0.type=traction",
                                          "load.0.value=[1e6, 0]",
                                          "solid.element=compt",
                                          "solid.volumetric=centre",
                                          "--set",
                                          "material.0.stress_map=\"direct\""};
    EXPECT_EQ(write(centre)["symmetric"], false);
    // A M_v b_mean b_centre against its transpose: b_centre is 2 b_mean or 0 [FORMULATION 2], M_v of the size of the
    // others
    EXPECT_GT(matrix("stiffness").asymmetry(), 0.01);
}

TEST_F(ProgramMatrices, Solver_ThatWouldRefuseTheSystem_IsNotAsked) {
    put("case.toml", small_deck);  // with a follower pressure
    const std::string quasi_static = "integrator={type = \"quasi_static\", solver = \"cholmod\"}";
    ASSERT_NE(gneiss({"run", "case.toml", "--quiet", "--out", "run", "--set", quasi_static}).code, 0);
    EXPECT_EQ(write({"--set", quasi_static})["symmetric"], false);
}

TEST_F(ProgramMatrices, PrescribedMotion_IsInTheState) {
    put("case.toml", small_deck);
    // the fixed side, elsewhere and moving
    const nlohmann::json system = write(
        {"--set",
         "boundary.0={on = \"right\", type = \"displacement\", value = [1e-3, \"2e-3*y\"], amplitude = \"constant\"}"});
    const auto nodes = system["nodes_m"].get<std::vector<std::array<double, 2>>>();
    for (std::size_t node = 0; node < nodes.size(); ++node) {
        const bool right = nodes[node][0] == 1;
        EXPECT_EQ(system["displacement_m"][2 * node], right ? 1e-3 : 0.0);
        EXPECT_EQ(system["displacement_m"][2 * node + 1], right ? 2e-3 * nodes[node][1] : 0.0);
    }
}

TEST_F(ProgramMatrices, Restart_GivesTheMatricesOfItsState) {
    put("case.toml", memory_deck);
    ASSERT_EQ(gneiss({"run", "case.toml", "--quiet", "--threads", "1", "--out", "run", "--set", "run.t_end=2e-3"}).code,
              0);
    const nlohmann::json start = write({}, "start"), later = write({"--restart", "run/checkpoint.h5"}, "later");
    EXPECT_EQ(later["t_s"], 2e-3);
    EXPECT_NE(later["displacement_m"], start["displacement_m"]);
    EXPECT_NE(contents("later/stiffness.mtx"), contents("start/stiffness.mtx"));
    EXPECT_EQ(contents("later/mass.mtx"), contents("start/mass.mtx"));
}

TEST_F(ProgramMatrices, DefaultFolder_IsThatOfTheRun) {
    put("case.toml", small_deck);
    ASSERT_EQ(gneiss({"matrices", "case.toml"}).code, 0);
    for (const char* name : {"stiffness.mtx", "damping.mtx", "mass.mtx", "system.json"})
        EXPECT_TRUE(exists(std::filesystem::path("results/case") / name)) << name;
}

TEST_F(ProgramMatrices, WrongUse_IsRefused) {
    put("case.toml", small_deck);
    EXPECT_EQ(gneiss({"matrices"}).code, 2);
    EXPECT_EQ(gneiss({"matrices", "case.toml", "--restart", "nowhere.h5"}).code, 2);
    put("taken", "a file where the folder should be");
    const Ended ended = gneiss({"matrices", "case.toml", "--out", "taken"});
    EXPECT_EQ(ended.code, 3);
    EXPECT_THAT(ended.err, AllOf(StartsWith("gneiss: "), HasSubstr("taken")));
}

}  // namespace
}  // namespace gneiss
