#include "model/energy_ledger.hpp"

#include <gtest/gtest.h>

namespace gneiss {
namespace {

TEST(EnergyLedger, Nothing_BalanceError_IsZero) {
    EXPECT_EQ(EnergyLedger{}.left_over(), 0);
    EXPECT_EQ(EnergyLedger{}.balance_error(), 0);
}

TEST(EnergyLedger, EveryEntry_LeftOver_CountsItWithItsSign) {
    EnergyLedger ledger;
    ledger.initial = 1;
    EXPECT_EQ(ledger.left_over(), -1);
    ledger.path.external_work = 2;
    EXPECT_EQ(ledger.left_over(), -3);
    ledger.path.support_work = 4;
    EXPECT_EQ(ledger.left_over(), -7);
    ledger.kinetic = 8;
    EXPECT_EQ(ledger.left_over(), 1);
    ledger.stored = {16, 32, 64, 128};
    EXPECT_EQ(ledger.left_over(), 1 + 240);
    ledger.path.damping = 256;
    ledger.path.viscous = 512;
    ledger.path.absorbing = 1024;
    ledger.path.friction = 2048;
    ledger.path.fracture = 4096;
    EXPECT_EQ(ledger.left_over(), 1 + 240 + 7936);
    ledger.path.contact = 8192;
    EXPECT_EQ(ledger.left_over(), 1 + 240 + 16128);
    ledger.path.splitting = 16384;
    EXPECT_EQ(ledger.left_over(), 1 + 240 - 256);
    ledger.stored.models = 32768;
    ledger.path.leaked = 65536;
    ledger.path.dampers = 131072;
    EXPECT_EQ(ledger.left_over(), 1 + 240 - 256 + 229376);
    ledger.path.viscous_power = 1e9;  // a rate, no energy
    EXPECT_EQ(ledger.left_over(), 1 + 240 - 256 + 229376);
    ledger.scheme = -3;
    EXPECT_EQ(ledger.left_over(), 1 + 240 - 256 + 229376 - 3);
}

TEST(EnergyLedger, BalanceError_IsRelativeToTheLargestEntry) {
    EnergyLedger ledger;
    ledger.kinetic = 3;
    ledger.stored.material = 6;
    ledger.path.external_work = 10;
    EXPECT_DOUBLE_EQ(ledger.balance_error(), 0.1);
    ledger.path.external_work = -10;  // work that the solid has done counts by its size
    EXPECT_DOUBLE_EQ(ledger.balance_error(), 1.9);
    EXPECT_DOUBLE_EQ(ledger.relative_left_over(), 1.9);
    ledger.path.fracture = 100;
    EXPECT_DOUBLE_EQ(ledger.balance_error(), 1.19);
    ledger.initial = 300;
    EXPECT_DOUBLE_EQ(ledger.relative_left_over(), (119.0 - 300) / 300);
}

TEST(EnergyLedger, Unloaded_BalanceError_IsRelativeToWhatThereHasBeen) {
    EnergyLedger ledger;
    ledger.path.external_work = 1e-12;
    ledger.stored.material = 2e-12;
    EXPECT_DOUBLE_EQ(ledger.balance_error(), 0.5);
    ledger.largest_before = 10;
    EXPECT_DOUBLE_EQ(ledger.balance_error(), 1e-13);
    EXPECT_EQ(ledger.largest_entry(), 10);
}

}  // namespace
}  // namespace gneiss
