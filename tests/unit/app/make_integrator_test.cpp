// Integrators by the names of a deck.

#include "app/make_integrator.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "integrators/arkode.hpp"
#include "integrators/mri.hpp"
#include "integrators/verlet.hpp"
#include "io/deck/choices.hpp"

namespace gneiss {
namespace {

using testing::HasSubstr;

TEST(MakeIntegrator, RungeKuttaTables_AreThoseOfTheDeckWithTheirOrders) {
    const auto tables = runge_kutta_tables();
    ASSERT_EQ(tables.size(), deck::runge_kutta_tables.size());
    const char* const kinds[] = {"explicit", "implicit", "additive"};
    for (std::size_t k = 0; k < tables.size(); ++k) {
        EXPECT_EQ(deck::runge_kutta_tables[k].name, tables[k].name);
        const std::string kind = fmt::format("{}, order ", kinds[static_cast<int>(tables[k].kind())]);
        const std::string since = tables[k].since ? fmt::format(" (SUNDIALS {})", tables[k].since) : "";
        const std::string_view meaning = deck::runge_kutta_tables[k].meaning;
        if (tables[k].here())
            EXPECT_EQ(meaning, fmt::format("{}{}{}{}", kind, tables[k].order(),
                                           tables[k].embedded() ? "" : ", fixed steps only", since));
        else
            EXPECT_TRUE(meaning.starts_with(kind) && meaning.ends_with(since)) << tables[k].name;
    }
}

TEST(MakeIntegrator, TableThatThisSundialsLacks_IsRefusedWithTheVersionThatHasIt) {
    for (const RungeKuttaTable& table : runge_kutta_tables()) {
        IntegratorOptions options;
        options.type = "arkode";
        options.table = table.name;
        options.dt = 1e-3;
        if (table.here()) {
            EXPECT_NO_THROW(make_integrator(options)) << table.name;
            continue;
        }
        try {
            make_integrator(options);
            FAIL() << table.name;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr(fmt::format("which needs SUNDIALS {} or newer; this program was built "
                                                            "with {}",
                                                            table.since, sundials_version())));
        }
    }
}

TEST(MakeIntegrator, VerletCompositions_AreThoseOfTheDeckWithTheirOrders) {
    const auto compositions = verlet_compositions();
    ASSERT_EQ(compositions.size(), deck::verlet_compositions.size());
    for (std::size_t k = 0; k < compositions.size(); ++k) {
        EXPECT_EQ(deck::verlet_compositions[k].name, compositions[k].name);
        const std::string meaning(deck::verlet_compositions[k].meaning);
        EXPECT_NE(meaning.find(fmt::format("order {}", compositions[k].order)), std::string::npos) << meaning;
    }
}

TEST(MakeIntegrator, MultirateTables_AreThoseOfTheDeckWithTheirOrders) {
    const auto tables = multirate_tables();
    ASSERT_EQ(tables.size(), deck::multirate_tables.size());
    for (std::size_t k = 0; k < tables.size(); ++k) {
        EXPECT_EQ(deck::multirate_tables[k].name, tables[k].name);
        EXPECT_TRUE(deck::multirate_tables[k].meaning.starts_with(fmt::format("order {} (", tables[k].order)));
    }
}

TEST(MakeIntegrator, EveryTypeOfADeck_IsMadeUnderItsName) {
    for (const auto& type : deck::integrators) {
        IntegratorOptions options;
        options.type = type.value;
        options.dt = 1e-3;
        EXPECT_EQ(make_integrator(options)->name(), type.name);
    }
}

TEST(MakeIntegrator, NewmarkWithLinearAcceleration_Adaptive_IsRefused) {
    IntegratorOptions options;
    options.type = "newmark";
    options.beta = 1.0 / 6;
    options.adaptive = true;
    EXPECT_THROW(make_integrator(options), InputError);
}

TEST(MakeIntegrator, StepsLeftOpen_AreRefusedWhereNothingEstimatesThem) {
    IntegratorOptions options;
    options.type = "generalized_alpha";
    EXPECT_THROW(make_integrator(options), InputError);
    options.type = "arkode";
    options.table = "knoth_wolke_3_3";
    EXPECT_THROW(make_integrator(options), InputError);
}

}  // namespace
}  // namespace gneiss
