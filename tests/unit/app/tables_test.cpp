#include "app/tables.hpp"

#include <gmock/gmock.h>

#include "base/errors.hpp"
#include "unit/app/square_case.hpp"

namespace gneiss {
namespace {

using test::displace;
using test::square_options;

/// Sums of a dozen products of numbers of size one (displacements 1e-3, stresses 1e6, both relative).
constexpr double round_off = 1e-12;

std::vector<std::string> names_of(const std::vector<CsvColumn>& columns) {
    std::vector<std::string> names;
    for (const CsvColumn& column : columns) names.push_back(column.name);
    return names;
}

TEST(HistoryTable, Row_FitsTheColumns) {
    EnergyLedger ledger;
    ledger.kinetic = 3;
    ledger.stored.material = 5;
    ledger.path.external_work = 10;
    ledger.initial = 1;
    ledger.scheme = -2;
    const std::vector<CsvColumn> columns = history_columns();
    const std::vector<double> row = history_row(0.5, 7, 0.1, ledger);
    ASSERT_EQ(row.size(), columns.size());
    const auto value = [&](const std::string& name) {
        for (std::size_t k = 0; k < columns.size(); ++k)
            if (columns[k].name == name) return row[k];
        ADD_FAILURE() << "no column " << name;
        return 0.0;
    };
    EXPECT_EQ(value("t"), 0.5);
    EXPECT_EQ(value("step"), 7);
    EXPECT_EQ(value("dt"), 0.1);
    EXPECT_EQ(value("kinetic"), 3);
    EXPECT_EQ(value("stored_material"), 5);
    EXPECT_EQ(value("external_work"), 10);
    EXPECT_EQ(value("scheme"), -2);
    EXPECT_EQ(value("left_over"), -5);  // 1 + 10 came in, 3 + 5 - 2 are there
    EXPECT_DOUBLE_EQ(value("balance_error"), 0.5);
}

TEST(ProbeTable, Columns_RadialOnesOnlyWithACentre) {
    const Case built = build_case(square_options());
    const ProbeTable probes(*built.mesh, {{"a", {0.5, 0.5}, {}}, {"b", {0.5, 0.5}, std::array{0.0, 0.0}}});
    EXPECT_THAT(names_of(probes.columns()),
                testing::ElementsAre("t", "a.u_x", "a.u_y", "a.v_x", "a.v_y", "a.sigma_xx", "a.sigma_yy", "a.sigma_xy",
                                     "b.u_x", "b.u_y", "b.v_x", "b.v_y", "b.sigma_xx", "b.sigma_yy", "b.sigma_xy",
                                     "b.u_r", "b.u_t", "b.v_r", "b.v_t", "b.sigma_rr", "b.sigma_tt", "b.sigma_rt"));
    EXPECT_EQ(probes.row(*built.system, built.system->initial_state()).size(), probes.columns().size());
    EXPECT_TRUE(ProbeTable().empty());
    EXPECT_FALSE(probes.empty());
}

TEST(ProbeTable, LinearField_IsReproducedAnywhere) {
    const Case built = build_case(square_options());
    State state = built.system->initial_state();
    displace(state, *built.mesh, {1e-3, 2e-3, -3e-3, 4e-3});
    for (std::size_t i = 0; i < state.v.size(); ++i) state.v[i] = 100 * state.u[i];
    const ProbeTable probes(*built.mesh, {{"p", {0.31, 0.77}, {}}});
    const std::vector<double> row = probes.row(*built.system, state);
    const double u_x = 1e-3 * 0.31 + 2e-3 * 0.77, u_y = -3e-3 * 0.31 + 4e-3 * 0.77;
    EXPECT_NEAR(row[1], u_x, round_off);
    EXPECT_NEAR(row[2], u_y, round_off);
    EXPECT_NEAR(row[3], 100 * u_x, 100 * round_off);
    EXPECT_NEAR(row[4], 100 * u_y, 100 * round_off);
}

TEST(ProbeTable, RadialComponents_AreThoseOfTheTurnedFrame) {
    const Case built = build_case(square_options());
    State state = built.system->initial_state();
    displace(state, *built.mesh, {1e-3, 2e-3, 0.5e-3, -1e-3});
    for (std::size_t i = 0; i < state.v.size(); ++i) state.v[i] = -10 * state.u[i];
    // r points from (0.6, 0.2) to (0.3, 0.6): (-3, 4)/5
    const double c = -0.6, s = 0.8;
    const ProbeTable probes(*built.mesh, {{"p", {0.3, 0.6}, std::array{0.6, 0.2}}});
    const std::vector<double> row = probes.row(*built.system, state);
    EXPECT_NEAR(row[8], c * row[1] + s * row[2], round_off);
    EXPECT_NEAR(row[9], -s * row[1] + c * row[2], round_off);
    EXPECT_NEAR(row[10], c * row[3] + s * row[4], round_off);
    EXPECT_NEAR(row[11], -s * row[3] + c * row[4], round_off);

    // the stress as a matrix in the turned frame, R sigma R^T
    const double sigma[2][2] = {{row[5], row[7]}, {row[7], row[6]}}, turn[2][2] = {{c, s}, {-s, c}};
    double turned[2][2] = {};
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
            for (int k = 0; k < 2; ++k)
                for (int l = 0; l < 2; ++l) turned[i][j] += turn[i][k] * sigma[k][l] * turn[j][l];
    ASSERT_GT(std::abs(turned[0][1]), 1e3);
    EXPECT_NEAR(row[12], turned[0][0], 1e6 * round_off);
    EXPECT_NEAR(row[13], turned[1][1], 1e6 * round_off);
    EXPECT_NEAR(row[14], turned[0][1], 1e6 * round_off);
}

TEST(ProbeTable, BadProbes_AreAllReported) {
    const Case built = build_case(square_options());
    try {
        ProbeTable(*built.mesh,
                   {{"in", {0.5, 0.5}, {}}, {"out", {3, 0.5}, {}}, {"centre", {0.5, 0.5}, std::array{0.5, 0.5}}});
        FAIL() << "bad probes were taken";
    } catch (const InputError& error) {
        ASSERT_EQ(error.problems().size(), 2u);
        EXPECT_EQ(error.problems()[0].where, "output.probes `out`");
        EXPECT_EQ(error.problems()[1].where, "output.probes `centre`");
        EXPECT_THAT(error.problems()[1].message, testing::HasSubstr("no radial direction"));
    }
}

}  // namespace
}  // namespace gneiss
