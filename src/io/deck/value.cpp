#include "io/deck/value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>

#include "model/formula.hpp"

namespace gneiss::deck {
namespace {

constexpr std::size_t shown_length = 40;  ///< of a value in a message, bytes

std::string shown(const toml::node& node) {
    if (const auto* text = node.as_string()) return fmt::format("\"{}\"", text->get());
    if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
    if (const auto* integer = node.as_integer()) return fmt::format("{}", integer->get());
    if (const auto* boolean = node.as_boolean()) return boolean->get() ? "true" : "false";
    std::string text;
    if (const auto* array = node.as_array()) {
        for (const toml::node& element : *array) text += (text.empty() ? "" : ", ") + shown(element);
        return "[" + text + "]";
    }
    if (const auto* table = node.as_table()) {
        for (const auto& [key, element] : *table) {
            text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key.str(), shown(element));
        }
        return "{" + text + "}";
    }
    std::ostringstream stream;
    node.visit([&](const auto& any) { stream << any; });
    return stream.str();
}

std::string_view kind_of(const toml::node& node) {
    switch (node.type()) {
        case toml::node_type::string:
            return " (a string)";
        case toml::node_type::integer:
            return " (an integer)";
        case toml::node_type::floating_point:
            return " (a number)";
        case toml::node_type::boolean:
            return " (a boolean)";
        case toml::node_type::array:
            return " (an array)";
        case toml::node_type::table:
            return " (a table)";
        default:
            return " (a date or time)";
    }
}

std::optional<double> as_number(const toml::node& node) {
    if (node.is_floating_point() || node.is_integer()) return node.value<double>();
    return std::nullopt;
}

}  // namespace

std::string Position::text() const { return line == 0 ? source : fmt::format("{}:{}:{}", source, line, column); }

Position position_of(const toml::source_region& region, const Position& otherwise) {
    if (!region.begin || !region.path) return otherwise;
    if (region.path->starts_with(Position::override_prefix)) return {*region.path, 0, 0};
    return {*region.path, region.begin.line, region.begin.column};
}

void Findings::add(const Position& where, std::string message) { findings_.push_back({where, std::move(message)}); }

void Findings::note(const Position& where, std::string_view key, std::string_view message) {
    (key.starts_with("compare.") ? notes_on_compare_ : notes_)
        .push_back(fmt::format("{}: key `{}`: {}", where.text(), key, message));
}

std::vector<std::string> Findings::notes(bool of_compare) const { return of_compare ? notes_on_compare_ : notes_; }

void Findings::throw_if_any() const {
    if (findings_.empty()) return;
    std::vector<Finding> sorted = findings_;
    std::stable_sort(sorted.begin(), sorted.end(), [](const Finding& a, const Finding& b) {
        return std::tuple(a.where.line == 0, a.where.line, a.where.column) <
               std::tuple(b.where.line == 0, b.where.line, b.where.column);
    });
    std::vector<Problem> problems;
    for (const Finding& finding : sorted) problems.push_back({finding.where.text(), finding.message});
    throw InputError(std::move(problems));
}

bool Range::contains(double value) const {
    return std::isfinite(value) && (low_open ? value > low : value >= low) &&
           (high_open ? value < high : value <= high);
}

bool Range::is_any() const { return std::isinf(low) && std::isinf(high); }

std::string Range::text() const {
    if (is_any()) return "any";
    if (std::isinf(high)) return fmt::format("{} {}", low_open ? ">" : "≥", low);
    if (std::isinf(low)) return fmt::format("{} {}", high_open ? "<" : "≤", high);
    return fmt::format("{}{}, {}{}", low_open ? '(' : '[', low, high, high_open ? ')' : ']');
}

std::string Range::requirement(std::string_view unit) const {
    if (is_any()) return unit.empty() ? "" : fmt::format(" ({})", unit);
    const std::string_view in = std::isinf(high) || std::isinf(low) ? "" : "in ";
    return fmt::format(" {}{}{}{}", in, text(), unit.empty() ? "" : " ", unit);
}

Value::Value(Findings& findings, const toml::node& node, std::string key, const Position& around)
    : findings_(&findings), node_(&node), key_(std::move(key)), where_(position_of(node.source(), around)) {}

void Value::problem(std::string_view message) const {
    findings_->add(where_, fmt::format("key `{}`: {}", key_, message));
}

void Value::refuse(std::string_view must) const { problem(fmt::format("given {}, must be {}", given(), must)); }

std::string Value::given() const {
    std::string text = shown(*node_);
    if (text.size() > shown_length) {
        std::size_t end = shown_length;
        while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // keep UTF-8 characters whole
        text = text.substr(0, end) + "…";
    }
    return text;
}

std::optional<std::vector<Value>> Value::elements(std::optional<std::size_t> size, std::string_view of_what) const {
    const toml::array* array = node_->as_array();
    if (array == nullptr || (size && array->size() != *size)) {
        const std::string count = size ? fmt::format("{} ", *size) : "";
        problem(
            fmt::format("given {}{}, must be an array of {}{}", given(), array ? "" : kind_of(*node_), count, of_what));
        return std::nullopt;
    }
    std::vector<Value> values;
    for (std::size_t i = 0; i < array->size(); ++i) {
        values.emplace_back(*findings_, *array->get(i), fmt::format("{}[{}]", key_, i), where_);
    }
    return values;
}

bool Value::read(double& out, const NumberRule& rule) const {
    const std::optional<double> number = as_number(*node_);
    if (!number) {
        problem(
            fmt::format("given {}{}, must be a number{}", given(), kind_of(*node_), rule.range.requirement(rule.unit)));
        return false;
    }
    if (!rule.range.contains(*number)) {
        refuse((rule.range.is_any() ? "finite" : "") +
               rule.range.requirement(rule.unit).substr(rule.range.is_any() ? 0 : 1));
        return false;
    }
    out = *number;
    return true;
}

bool Value::read(int& out, const NumberRule& rule) const {
    const toml::value<std::int64_t>* integer = node_->as_integer();
    if (integer == nullptr) {
        const std::optional<double> number = as_number(*node_);
        const bool is_whole = number && *number == std::trunc(*number) && std::abs(*number) < 1e9;
        problem(fmt::format(
            "given {}{}, must be an integer{}{}", is_whole ? fmt::format("{:.1f}", *number) : given(), kind_of(*node_),
            rule.range.requirement(rule.unit),
            is_whole ? fmt::format(": write {:.0f}, what has a point is no integer in TOML", *number) : ""));
        return false;
    }
    const std::int64_t number = integer->get();
    const bool fits = number >= std::numeric_limits<int>::min() && number <= std::numeric_limits<int>::max();
    if (!fits || !rule.range.contains(static_cast<double>(number))) {
        refuse(fits ? rule.range.requirement(rule.unit).substr(1) : "an integer of 32 bits");
        return false;
    }
    out = static_cast<int>(number);
    return true;
}

bool Value::read(bool& out) const {
    if (const auto* boolean = node_->as_boolean()) {
        out = boolean->get();
        return true;
    }
    refuse("true or false");
    return false;
}

bool Value::read(std::string& out) const {
    const auto* text = node_->as_string();
    if (text == nullptr) {
        problem(fmt::format("given {}{}, must be a string", given(), kind_of(*node_)));
        return false;
    }
    if (text->get().empty()) {
        problem("given \"\", must not be empty");
        return false;
    }
    out = text->get();
    return true;
}

bool Value::read(Formula& out, const NumberRule& rule, std::string_view variables) const {
    if (const auto* text = node_->as_string()) {
        out = Formula(text->get());
        return expression(out, variables);
    }
    if (!as_number(*node_)) {
        problem(fmt::format("given {}{}, must be a number or an expression", given(), kind_of(*node_)));
        return false;
    }
    double number = 0;
    if (!read(number, rule)) return false;
    out = Formula(number);
    return true;
}

bool Value::expression(const Formula& formula, std::string_view variables) const {
    try {
        CompiledFormula(formula, variables);
    } catch (const InputError& error) {
        problem(error.problems().front().message);
        return false;
    }
    return true;
}

bool Value::read(std::span<double> out, const NumberRule& rule) const {
    const auto values = elements(out.size(), "numbers" + rule.range.requirement(rule.unit));
    bool good = values.has_value();
    for (std::size_t i = 0; values && i < out.size(); ++i) good = (*values)[i].read(out[i], rule) && good;
    return good;
}

bool Value::read(std::vector<double>& out, const NumberRule& rule) const {
    const auto values = elements(std::nullopt, "numbers" + rule.range.requirement(rule.unit));
    if (!values) return false;
    out.assign(values->size(), 0.0);
    bool good = true;
    for (std::size_t i = 0; i < out.size(); ++i) good = (*values)[i].read(out[i], rule) && good;
    return good;
}

}  // namespace gneiss::deck
