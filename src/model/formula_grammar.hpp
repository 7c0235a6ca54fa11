#pragma once
// What an expression of the user may be made of, and its parts. muParser evaluates expressions, but takes more than a
// reader of docs/deck.md would write, and some of it means something else than it says: 0.2 < y < 0.8 compares a truth
// with 0.8, log is the natural one, sum and avg, hidden constants. What is not promised is refused, with what to write.
//
//     condition ? a : b                          lowest
//     a || b      a && b
//     a < b   <=   >   >=   ==   !=              one, not a chain
//     a + b   a - b      a * b   a / b           from the left
//     -a   +a
//     a ^ b                                      from the right; -a^b is -(a^b)
//     number   x   y   t   pi   e   f(a, ...)   (a)

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gneiss {

/// A function that expressions may call.
struct FormulaFunction {
    const char* name;
    const char* arguments;  ///< "x", "y, x" or "a, b, ..."
    const char* meaning;
    double (*one)(double) = nullptr;                     ///< of one argument
    double (*two)(double, double) = nullptr;             ///< of two
    double (*many)(const double*, int count) = nullptr;  ///< of two or more
};
std::span<const FormulaFunction> formula_functions();

struct FormulaConstant {
    const char* name;
    double value;
    const char* meaning;
};
std::span<const FormulaConstant> formula_constants();

struct FormulaOperator {
    const char* text;
    const char* meaning;
};
/// From the one that binds most to the one that binds least.
std::span<const FormulaOperator> formula_operators();

/// A part of an expression.
struct FormulaNode {
    enum class Kind { number, name, call, sign, power, product, sum, comparison, logic, choice, parentheses };
    Kind kind;
    std::string_view text;  ///< of the expression
    std::string_view word;  ///< operator, or name of function, variable, constant
    std::vector<FormulaNode> parts = {};

    /// True or false, and not a number.
    bool is_condition() const;
    /// Whether a name occurs in it.
    bool uses(std::string_view name) const;
};

/// @param text       has to outlive the result
/// @param variables  that it may use, one letter each: "xyt"
/// @throws InputError with empty `where`; the message quotes the expression, says where in it the fault is and what to
/// write
FormulaNode parse_formula(std::string_view text, std::string_view variables);

}  // namespace gneiss
