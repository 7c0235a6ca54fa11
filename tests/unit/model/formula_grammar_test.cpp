#include "model/formula_grammar.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "base/errors.hpp"
#include "model/formula.hpp"

namespace gneiss {
namespace {

std::string fault_of(const std::string& text) {
    try {
        CompiledFormula(Formula(text), "xyt");
        return "no fault";
    } catch (const InputError& error) {
        return error.problems().front().message;
    }
}

/// The expression as the grammar has read it, with parentheses around everything.
std::string spelt_out(const FormulaNode& node) {
    using Kind = FormulaNode::Kind;
    const auto part = [&](std::size_t i) { return spelt_out(node.parts[i]); };
    switch (node.kind) {
        case Kind::number:
        case Kind::name:
            return std::string(node.text);
        case Kind::parentheses:
            return part(0);
        case Kind::sign:
            return fmt::format("({}({}))", node.word, part(0));
        case Kind::choice:
            return fmt::format("(({}) ? ({}) : ({}))", part(0), part(1), part(2));
        case Kind::call: {
            std::string arguments;
            for (std::size_t i = 0; i < node.parts.size(); ++i)
                arguments += fmt::format("{}{}", i > 0 ? "," : "", part(i));
            return fmt::format("{}({})", node.word, arguments);
        }
        case Kind::power:
        case Kind::product:
        case Kind::sum:
        case Kind::comparison:
        case Kind::logic:
            break;
    }
    return fmt::format("(({}){}({}))", part(0), node.word, part(1));
}

TEST(FormulaGrammar, EveryPrecedence_IsThatOfTheEvaluation) {
    const std::array texts{"-2^2",
                           "2^-1^2",
                           "2^3^2",
                           "-t^2*3 - 4/2*y",
                           "2*-x + 3",
                           "1 - 2 - 3",
                           "8/4/2",
                           "-x*-y",
                           "x < y && t > 1 || y < x ? 1 : 2",
                           "x > y || t > 1 && y > x ? 1 : 2",
                           "t < 1 ? 1 : t < 2 ? 2 : 3",
                           "x + 1 < y*2 ? x : y",
                           "sin (x)^2 + max(x, y, t)*atan2(y, x)",
                           "(t > 1)*3 + (x >= y)",
                           "t == 1.5 ? 1 : x != 2 ? 3 : 4",
                           ".5 + 5. + 1.e3*2E-2"};
    for (const std::string text : texts) {
        const CompiledFormula as_written(Formula(text), "xyt");
        const CompiledFormula as_read(Formula(spelt_out(parse_formula(text, "xyt"))), "xyt");
        for (const double t : {0.5, 1.5, 2.5}) EXPECT_EQ(as_written(2, 3, t), as_read(2, 3, t)) << text;
    }
}

TEST(FormulaGrammar, EveryWordOfTheTable_IsEvaluated) {
    for (const FormulaFunction& function : formula_functions()) {
        const bool below_one = std::string_view(function.name) == "atanh";  // infinite at 1
        const std::string arguments = function.one == nullptr ? "1, 2" : (below_one ? "0.5" : "1");
        EXPECT_EQ(fault_of(fmt::format("{}({})", function.name, arguments)), "no fault") << function.name;
    }
    for (const FormulaConstant& constant : formula_constants())
        EXPECT_EQ(CompiledFormula(Formula(std::string(constant.name)), "")(0, 0), constant.value);
}

TEST(FormulaGrammar, ChainedComparison_IsRefusedWithTheRightForm) {
    EXPECT_EQ(
        fault_of("0.2<y<0.8 ? 1e6 : 0"),
        "expression \"0.2<y<0.8 ? 1e6 : 0\": a chained comparison compares a truth, 0 or 1, with the last number: "
        "write `0.2 < y && y < 0.8`, at character 6");
    EXPECT_THAT(fault_of("(0.2 < y) < 0.8"), testing::HasSubstr("write `a < b && b < c`, at character 11"));
}

TEST(FormulaGrammar, WhatOtherLanguagesWrite_IsRefusedWithWhatToWrite) {
    using Pair = std::pair<const char*, const char*>;
    for (const auto& [text, hint] : {Pair{"x**2", "`**`: a power is `a^b`, at character 2"},
                                     Pair{"x > 1 and y > 1", "`and`: write `&&`"},
                                     Pair{"log(x)", "write `ln(…)` for the natural logarithm"},
                                     Pair{"2 x", "a product is `a*b`, at character 3"},
                                     Pair{"2(x)", "a product is `a*b`"},
                                     Pair{"x(2)", "`x` is no function: a product is `x*(…)`"},
                                     Pair{"x = 5", "nothing is assigned"},
                                     Pair{"_pi", "write `pi`"},
                                     Pair{"sum(x, y)", "write `a + b + c`"},
                                     Pair{"avg(x, y)", "write `(a + b)/2`"},
                                     Pair{"1,000", "gives 2 values"},
                                     Pair{"1'000", "is no number"},
                                     Pair{"0x1F", "is no number"},
                                     Pair{"1d-3", "is no number"},
                                     Pair{"\"a\"", "has no meaning"},
                                     Pair{"!(x > 1)", "write the opposite comparison"},
                                     Pair{"x & y", "write `&&`"},
                                     Pair{"x => 1", "write `>=`"},
                                     Pair{"t ? 1 : 0", "`t` is a number where `?` takes a condition"},
                                     Pair{"x && y > 1", "`x` is a number where `&&` takes a condition"},
                                     Pair{"Pi", "did you mean `pi`?"},
                                     Pair{"min(x)", "is given 1 value, must be `min(a, b, …)`"},
                                     Pair{"sin x", "write `sin(x)`"},
                                     Pair{"2·x²", "`·`: write `*`, at character 2"},
                                     Pair{"x\u00b2 + 1", "`²`: write `^2`, at character 2"},
                                     Pair{"pow(x, 2)", "write `a^b`"},
                                     Pair{"if(t > 1, 2, 3)", "write `condition ? a : b`"},
                                     Pair{"sin(x))", "`)` without `(`, at character 7"}})
        EXPECT_THAT(fault_of(text), testing::HasSubstr(hint)) << text;
}

}  // namespace
}  // namespace gneiss
