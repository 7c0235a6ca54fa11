#include "model/formula.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <thread>

#include "base/errors.hpp"

namespace gneiss {
namespace {

std::string message_of(const std::string& expression, std::string_view variables = "xy") {
    try {
        const CompiledFormula formula(Formula(expression), variables);
        formula(0, 0, 0);
    } catch (const InputError& error) {
        return error.problems().front().message;
    }
    return "no error";
}

TEST(Formula, Number_GivesShortestExactText) {
    EXPECT_EQ(Formula(0.1).text, "0.1");
    EXPECT_EQ(Formula(1e6).text, "1000000");
    EXPECT_EQ(std::stod(Formula(1.0 / 3.0).text), 1.0 / 3.0);
    EXPECT_TRUE(Formula(0.0).is_zero());
    EXPECT_TRUE(Formula().is_zero());
    EXPECT_FALSE(Formula(std::string("0")).is_zero());  // an expression is not looked into
}

TEST(CompiledFormula, Number_IsConstant) {
    const CompiledFormula formula(Formula(2.5), "");
    EXPECT_TRUE(formula.is_constant());
    EXPECT_EQ(formula(1, 2, 3), 2.5);
}

TEST(CompiledFormula, ExpressionWithoutVariables_IsConstant) {
    const CompiledFormula formula(Formula(std::string("pi/4 + 0*e")), "xyt");
    EXPECT_TRUE(formula.is_constant());
    EXPECT_EQ(formula(7, 7, 7), std::numbers::pi / 4);
}

TEST(CompiledFormula, Variables_TakeTheirPlaces) {
    const CompiledFormula formula(Formula(std::string("100*x + 10*y + t")), "xyt");
    EXPECT_FALSE(formula.is_constant());
    EXPECT_EQ(formula(1, 2, 3), 123.0);
    EXPECT_EQ(formula(1, 2), 120.0);
}

TEST(CompiledFormula, Conditional_Works) {
    const CompiledFormula formula(Formula(std::string("x >= 1 && y != 2 ? -1 : 1")), "xy");
    EXPECT_EQ(formula(0, 0), 1.0);
    EXPECT_EQ(formula(1, 0), -1.0);
    EXPECT_EQ(formula(1, 2), 1.0);
}

TEST(CompiledFormula, Copies_AreIndependent) {
    const CompiledFormula first(Formula(std::string("x + y")), "xy");
    CompiledFormula second(Formula(0.0), "xy");
    {
        const CompiledFormula original(Formula(std::string("x - y")), "xy");
        second = original;
    }
    const CompiledFormula moved = std::move(second);
    EXPECT_EQ(first(3, 1), 4.0);
    EXPECT_EQ(moved(3, 1), 2.0);
}

TEST(CompiledFormula, CopyPerThread_GivesSameValues) {
    const CompiledFormula formula(Formula(std::string("sin(x) + t")), "xyt");
    double wrong[2] = {0, 0};
    auto work = [&](int id, CompiledFormula mine) {
        for (int i = 0; i < 2000; ++i) wrong[id] += mine(i, 0, id) != std::sin(static_cast<double>(i)) + id;
    };
    std::thread one(work, 0, formula), two(work, 1, formula);
    one.join();
    two.join();
    EXPECT_EQ(wrong[0] + wrong[1], 0.0);
}

TEST(CompiledFormula, BadExpression_IsReportedWithItsPlace) {
    EXPECT_EQ(message_of("2*z"),
              "expression \"2*z\": unknown name `z` at character 3, allowed: x, y, pi, e and functions");
    EXPECT_EQ(message_of("x + t"),
              "expression \"x + t\": unknown name `t` at character 5, allowed: x, y, pi, e and functions");
    EXPECT_EQ(message_of("sin(x"), "expression \"sin(x\": ends too early: `)` is missing, at character 6");
    EXPECT_EQ(message_of("1 +"), "expression \"1 +\": ends too early, at character 4");
    EXPECT_EQ(message_of(""), "expression \"\": is empty");
    EXPECT_EQ(message_of("x = 1"),
              "expression \"x = 1\": `=`: nothing is assigned in an expression, a comparison is ==, at character 3");
    EXPECT_EQ(message_of("0,5"), "expression \"0,5\": gives 2 values, must give one (the decimal sign is a point)");
    EXPECT_EQ(message_of("x == 0 ? 1 : 2"), "no error");
}

TEST(CompiledFormula, ValueNotFinite_Throws) {
    EXPECT_EQ(message_of("1/x"), "expression \"1/x\": is inf at x = 0 m, y = 0 m, t = 0 s");
    EXPECT_EQ(message_of("sqrt(-1)"), "expression \"sqrt(-1)\": is not a number at x = 0 m, y = 0 m, t = 0 s");
}

}  // namespace
}  // namespace gneiss
