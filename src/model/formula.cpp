#include "model/formula.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <cmath>
#include <numbers>

#include "base/errors.hpp"

namespace gneiss {

Formula::Formula(double value) : text(fmt::format("{}", value)), constant(value) {}

/// The parser holds pointers to the variables, so both live and are copied together.
struct CompiledFormula::Expression {
    Expression(std::string expression, std::string_view names);
    Expression(const Expression& other) : Expression(other.text, other.variables) {}
    Expression& operator=(const Expression&) = delete;

    std::string text;
    std::string variables;
    double x = 0, y = 0, t = 0;
    mu::Parser parser;
};

namespace {

std::string allowed_names(std::string_view variables) {
    std::string names;
    for (char name : variables) names += fmt::format("{}, ", name);
    return names + "pi, e";
}

/// muParser counts from 0, a reader from 1.
std::string fault(const std::string& text, const mu::ParserError& error, std::string_view variables) {
    switch (error.GetCode()) {
        case mu::ecUNASSIGNABLE_TOKEN:
            return fmt::format("expression \"{}\": unknown name `{}` at character {}, allowed: {} and functions", text,
                               error.GetToken(), error.GetPos() + 1, allowed_names(variables));
        case mu::ecEMPTY_EXPRESSION:
            return "expression \"\": is empty";
        case mu::ecUNEXPECTED_EOF:
            return fmt::format("expression \"{}\": ends too early", text);
        default:
            return fmt::format("expression \"{}\": {}", text, error.GetMsg());
    }
}

/// `x = 1` would overwrite a variable: muParser allows it, a formula of position and time does not.
std::size_t find_assignment(std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '=') continue;
        if (i + 1 < text.size() && text[i + 1] == '=') {
            ++i;
        } else if (i == 0 || std::string_view("<>!").find(text[i - 1]) == std::string_view::npos) {
            return i;
        }
    }
    return std::string_view::npos;
}

}  // namespace

CompiledFormula::Expression::Expression(std::string expression, std::string_view names)
    : text(std::move(expression)), variables(names) {
    if (const std::size_t at = find_assignment(text); at != std::string::npos) {
        throw InputError(
            "", fmt::format("expression \"{}\": assignment at character {}, a comparison is ==", text, at + 1));
    }
    try {
        parser.DefineConst("pi", std::numbers::pi);
        parser.DefineConst("e", std::numbers::e);
        if (names.find('x') != std::string_view::npos) parser.DefineVar("x", &x);
        if (names.find('y') != std::string_view::npos) parser.DefineVar("y", &y);
        if (names.find('t') != std::string_view::npos) parser.DefineVar("t", &t);
        parser.SetExpr(text);
        parser.Eval();  // compiles: muParser reports syntax errors at the first evaluation
    } catch (const mu::ParserError& error) {
        throw InputError("", fault(text, error, names));
    }
    if (parser.GetNumResults() != 1) {
        throw InputError(
            "", fmt::format("expression \"{}\": gives {} values, must give one (the decimal sign is a point)", text,
                            parser.GetNumResults()));
    }
}

CompiledFormula::CompiledFormula(const Formula& formula, std::string_view variables) {
    if (formula.constant) {
        constant_ = *formula.constant;
        return;
    }
    expression_ = std::make_unique<Expression>(formula.text, variables);
    if (expression_->parser.GetUsedVar().empty()) {
        constant_ = evaluate(0, 0, 0);
        expression_.reset();
    }
}

CompiledFormula::CompiledFormula(const CompiledFormula& other)
    : constant_(other.constant_),
      expression_(other.expression_ ? std::make_unique<Expression>(*other.expression_) : nullptr) {}
CompiledFormula::CompiledFormula(CompiledFormula&&) noexcept = default;
CompiledFormula::~CompiledFormula() = default;

CompiledFormula& CompiledFormula::operator=(CompiledFormula other) noexcept {
    constant_ = other.constant_;
    expression_ = std::move(other.expression_);
    return *this;
}

double CompiledFormula::evaluate(double x, double y, double t) const {
    Expression& expression = *expression_;
    expression.x = x;
    expression.y = y;
    expression.t = t;
    double value = 0;
    try {
        value = expression.parser.Eval();
    } catch (const mu::ParserError& error) {
        throw InputError("", fault(expression.text, error, expression.variables));
    }
    if (!std::isfinite(value)) {
        const std::string shown = std::isnan(value) ? "not a number" : fmt::format("{}", value);
        throw InputError("", fmt::format("expression \"{}\": is {} at x = {} m, y = {} m, t = {} s", expression.text,
                                         shown, x, y, t));
    }
    return value;
}

}  // namespace gneiss
