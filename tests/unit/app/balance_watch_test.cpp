#include "app/balance_watch.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace gneiss {
namespace {

using testing::HasSubstr;

class Balance : public testing::Test {
protected:
    Balance() { options.run.t_end = 1; }
    /// A row at which so much is left over of an energy of 1 J.
    void look(double t, double left_over, double energy = 1) {
        EnergyLedger ledger;
        ledger.largest_before = record.largest_entry;
        ledger.path.external_work = energy;
        ledger.kinetic = energy + left_over;
        if (left_over > 0) ledger.kinetic = energy, ledger.path.external_work = energy - left_over;
        BalanceWatch(options, false).look(t, ledger, record);
    }
    bool warned(double t) const { return BalanceWatch(options, false).to_be_warned_of(t, record); }
    bool ended(double t) const { return BalanceWatch(options, false).to_be_ended(t, record); }

    CaseOptions options;
    BalanceRecord record;
};

TEST_F(Balance, OnePercent_ForAHundredthOfTheRun_IsWarnedOf) {
    look(0.1, 0.009);
    look(0.2, -0.009);
    EXPECT_FALSE(warned(0.2));
    look(0.3, 0.011);
    EXPECT_FALSE(warned(0.3));
    look(0.309, -0.011);
    EXPECT_FALSE(warned(0.309));
    look(0.311, 0.011);
    EXPECT_TRUE(warned(0.311));
    EXPECT_FALSE(ended(0.311));
    EXPECT_NEAR(BalanceWatch::largest_error(record), 0.011, 1e-15);
}

TEST_F(Balance, FirstEnergies_AreNoMeasure) {
    for (const double t : {0.1, 0.101, 0.102, 0.103}) look(t, 1e-9, 1e-9);  // all of next to nothing
    EXPECT_FALSE(warned(0.103));
    look(0.104, 1e-9);
    look(0.2, 1e-9);
    EXPECT_FALSE(warned(0.2));
    EXPECT_NEAR(BalanceWatch::largest_error(record), 1e-9, 1e-20);
}

TEST_F(Balance, Unloaded_IsMeasuredByWhatThereWas) {
    look(0.5, 1e-9);
    look(0.6, 1e-9, 1e-9);
    look(0.7, 1e-9, 1e-9);
    EXPECT_FALSE(warned(0.7));
}

TEST_F(Balance, AtTheEnd_EveryRowCounts) {
    look(1, 0.6);
    EXPECT_TRUE(warned(1));
    EXPECT_TRUE(ended(1));
}

TEST_F(Balance, EnergyGained_EndsTheRun_EnergyLostDoesNot) {
    look(0.5, -0.9);
    look(0.6, -0.9);
    EXPECT_TRUE(warned(0.6));
    EXPECT_FALSE(ended(0.6));
    look(0.7, 0.6);
    look(0.8, 0.6);
    EXPECT_TRUE(ended(0.8));
    options.run.most_energy_gained = 0;
    record = {};
    look(0.7, 0.6);
    look(0.8, 0.6);
    EXPECT_FALSE(ended(0.8));
    EXPECT_TRUE(warned(0.8));
}

TEST_F(Balance, NoNumber_EndsTheRun) {
    look(0.7, NAN);
    look(0.8, NAN);
    EXPECT_TRUE(ended(0.8));
}

TEST_F(Balance, Text_NamesWhatMayBeWrongWithTheScheme) {
    const auto text = [&](const char* type, double left_over) {
        options.integrator.type = type;
        record = {};
        look(0.5, left_over);
        return BalanceWatch(options, false).text(0.5, record);
    };
    EXPECT_EQ(text("cvode", 0.1),
              "energy balance: by t = 0.5 s 0.1 J, 10 % of the largest energy of the run, have come from nothing: bdf "
              "of order 3 to 5 amplifies undamped vibration; a smaller `rtol`, `max_order = 2`, or a scheme for "
              "vibration");
    EXPECT_THAT(text("ida", -0.1), HasSubstr("have got lost: bdf damps what its steps do not resolve"));
    EXPECT_THAT(text("arkode", 0.1), HasSubstr("at the limit of stability"));
    EXPECT_THAT(text("arkode", -0.1), HasSubstr("have got lost: the scheme damps what its steps do not resolve"));
    EXPECT_THAT(text("bathe", -0.1), HasSubstr("the scheme damps what its steps do not resolve"));
    EXPECT_THAT(text("newmark", 0.1), HasSubstr("too long for contact"));
    EXPECT_THAT(text("noh_bathe", -0.1), HasSubstr("`split = 0.5`"));
    EXPECT_THAT(text("mri", 0.1), HasSubstr("a smaller `dt`"));
    EXPECT_THAT(text("central_difference", 0.1), HasSubstr("a smaller `safety`"));
    EXPECT_THAT(BalanceWatch(options, true).text(0.5, record), HasSubstr("load steps too long"));
}

}  // namespace
}  // namespace gneiss
