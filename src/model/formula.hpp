#pragma once
// Evaluation of the numbers and expressions that a user gives (Formula in model/options.hpp).

#include <memory>
#include <string>
#include <string_view>

#include "model/options.hpp"

namespace gneiss {

/// A Formula made ready for evaluation. Expressions are made of what formula_grammar.hpp says, and evaluated by
/// muParser. Whatever else muParser would take is refused when the formula is made, with what to write instead. A
/// formula that uses no variable is evaluated once and costs nothing afterwards.
///
/// One object may be used by one thread at a time; copies are independent of each other.
class CompiledFormula {
public:
    /// @param formula    number or expression
    /// @param variables  the names that the expression may use, some of "x", "y" (m) and "t" (s), one letter each:
    /// "xyt"
    /// @throws InputError with empty `where`; the message quotes the expression and says where in it the fault is
    CompiledFormula(const Formula& formula, std::string_view variables);
    CompiledFormula(const CompiledFormula& other);
    CompiledFormula(CompiledFormula&&) noexcept;
    CompiledFormula& operator=(CompiledFormula other) noexcept;
    ~CompiledFormula();

    /// Value at x, y (m) and t (s).
    /// @throws InputError if the value is not finite; the message gives expression, x, y, t
    double operator()(double x, double y, double t = 0) const { return expression_ ? evaluate(x, y, t) : constant_; }

    bool is_constant() const { return !expression_; }

private:
    struct Expression;
    double evaluate(double x, double y, double t) const;

    double constant_ = 0;
    std::unique_ptr<Expression> expression_;  ///< empty when the formula uses no variable
};

}  // namespace gneiss
