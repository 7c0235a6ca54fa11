#include "model/formula.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <cmath>

#include "base/errors.hpp"
#include "model/formula_grammar.hpp"

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

/// What parse_formula() has let through and muParser does not take.
std::string fault(const std::string& text, const mu::ParserError& error) {
    return fmt::format("expression \"{}\": {}", text, error.GetMsg());
}

}  // namespace

CompiledFormula::Expression::Expression(std::string expression, std::string_view names)
    : text(std::move(expression)), variables(names) {
    parse_formula(text, names);
    try {
        parser.ClearFun();
        parser.ClearConst();
        for (const FormulaConstant& constant : formula_constants()) parser.DefineConst(constant.name, constant.value);
        for (const FormulaFunction& function : formula_functions()) {
            if (function.one != nullptr) parser.DefineFun(function.name, function.one);
            if (function.two != nullptr) parser.DefineFun(function.name, function.two);
            if (function.many != nullptr) parser.DefineFun(function.name, function.many);
        }
        if (names.find('x') != std::string_view::npos) parser.DefineVar("x", &x);
        if (names.find('y') != std::string_view::npos) parser.DefineVar("y", &y);
        if (names.find('t') != std::string_view::npos) parser.DefineVar("t", &t);
        std::string compact = text;  // muParser takes no space between a function and its parentheses
        std::erase_if(compact, [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; });
        parser.SetExpr(compact);
        parser.Eval();  // compiles: muParser reports syntax errors at the first evaluation
    } catch (const mu::ParserError& error) {
        throw InputError("", fault(text, error));
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
        throw InputError("", fault(expression.text, error));
    }
    if (!std::isfinite(value)) {
        const std::string shown = std::isnan(value) ? "not a number" : fmt::format("{}", value);
        throw InputError("", fmt::format("expression \"{}\": is {} at x = {} m, y = {} m, t = {} s", expression.text,
                                         shown, x, y, t));
    }
    return value;
}

}  // namespace gneiss
