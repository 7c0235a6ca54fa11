#include "model/expression_signals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "base/errors.hpp"
#include "model/formula_grammar.hpp"

namespace gneiss {
namespace {

using Kind = FormulaNode::Kind;

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
    return std::ranges::find(words, word) != words.end();
}

void add_switching(const std::string& value, const std::string& difference, ExpressionSignals& to) {
    ExpressionSignals::Switching one{Signal(value), {}};
    if (!difference.empty()) one.difference.emplace_back(difference);
    to.switchings.push_back(std::move(one));
}

void add_comparison(const FormulaNode& a, const FormulaNode& b, ExpressionSignals& to) {
    const std::string difference = fmt::format("({})-({})", a.text, b.text);
    add_switching(fmt::format("({})<({})", a.text, b.text), difference, to);
    add_switching(fmt::format("({})<=({})", a.text, b.text), difference, to);
}

void collect(const FormulaNode& node, ExpressionSignals& to) {
    if (!node.uses("t")) return;
    for (const FormulaNode& part : node.parts) collect(part, to);
    if (node.kind == Kind::comparison) add_comparison(node.parts[0], node.parts[1], to);
    if (node.kind == Kind::sum) to.crossings.emplace_back(std::string(node.text));
    if (node.kind != Kind::call) return;
    const std::string argument(node.parts.front().text);
    if (node.word == "abs") add_switching(fmt::format("({})<0", argument), argument, to);
    if (node.word == "sign") add_switching(std::string(node.text), argument, to);
    if (node.word == "rint") add_switching(std::string(node.text), {}, to);
    if (is_one_of(node.word, {"min", "max"}))
        for (std::size_t i = 0; i < node.parts.size(); ++i)
            for (std::size_t j = i + 1; j < node.parts.size(); ++j) add_comparison(node.parts[i], node.parts[j], to);
    if (is_one_of(node.word, {"sin", "cos", "tan"})) to.phases.emplace_back(argument);
    if (is_one_of(node.word, {"sin", "cos", "tan", "ln", "log10"})) to.crossings.emplace_back(std::string(node.text));
}

}  // namespace

double Signal::operator()(double t) const {
    try {
        return formula_(place_.x, place_.y, t);
    } catch (const InputError&) {
        return std::numeric_limits<double>::quiet_NaN();
    }
}

ExpressionSignals::ExpressionSignals(const std::string& expression) : whole(expression) {
    collect(parse_formula(expression, "xyt"), *this);
}

void ExpressionSignals::stand_at(const Vec2<double>& place) {
    whole.stand_at(place);
    for (Switching& one : switchings) {
        one.value.stand_at(place);
        for (Signal& signal : one.difference) signal.stand_at(place);
    }
    for (Signal& signal : crossings) signal.stand_at(place);
    for (Signal& signal : phases) signal.stand_at(place);
}

}  // namespace gneiss
