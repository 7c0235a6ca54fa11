#include "model/formula_grammar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/errors.hpp"
#include "base/suggest.hpp"

namespace gneiss {
namespace {

double sign(double x) { return x < 0 ? -1.0 : (x > 0 ? 1.0 : 0.0); }

double smallest_of(const double* values, int count) { return *std::min_element(values, values + count); }
double largest_of(const double* values, int count) { return *std::max_element(values, values + count); }

constexpr std::array<FormulaFunction, 22> functions{{
    {"sin", "x", "sine, x in rad", std::sin},
    {"cos", "x", "cosine, x in rad", std::cos},
    {"tan", "x", "tangent, x in rad", std::tan},
    {"asin", "x", "inverse sine, rad", std::asin},
    {"acos", "x", "inverse cosine, rad", std::acos},
    {"atan", "x", "inverse tangent, rad", std::atan},
    {"atan2", "y, x", "angle of the point (x, y) from the x axis, rad", nullptr, std::atan2},
    {"sinh", "x", "hyperbolic sine", std::sinh},
    {"cosh", "x", "hyperbolic cosine", std::cosh},
    {"tanh", "x", "hyperbolic tangent", std::tanh},
    {"asinh", "x", "inverse hyperbolic sine", std::asinh},
    {"acosh", "x", "inverse hyperbolic cosine", std::acosh},
    {"atanh", "x", "inverse hyperbolic tangent", std::atanh},
    {"exp", "x", "e^x", std::exp},
    {"ln", "x", "natural logarithm", std::log},
    {"log10", "x", "logarithm to base 10", std::log10},
    {"sqrt", "x", "square root", std::sqrt},
    {"abs", "x", "absolute value", std::abs},
    {"sign", "x", "-1, 0 or 1", sign},
    {"rint", "x", "nearest whole number; of two the even one", std::nearbyint},
    {"min", "a, b, …", "the smallest of two or more", nullptr, nullptr, smallest_of},
    {"max", "a, b, …", "the largest of two or more", nullptr, nullptr, largest_of},
}};

constexpr std::array<FormulaConstant, 2> constants{
    {{"pi", std::numbers::pi, "3.14159…"}, {"e", std::numbers::e, "2.71828…"}}};

constexpr std::array<FormulaOperator, 8> operators{{
    {"a ^ b", "power, from the right: 2^3^2 = 2^9, -x^2 = -(x^2)"},
    {"-a  +a", "sign"},
    {"a * b  a / b", "from the left"},
    {"a + b  a - b", "from the left"},
    {"a < b  a <= b  a > b  a >= b  a == b  a != b",
     "1 if so, else 0; one at a time: a < b && b < c, not a < b < c. == and != compare to the last bit"},
    {"p && q", "both"},
    {"p || q", "one or both"},
    {"p ? a : b", "a if p, else b; chains: p ? a : q ? b : c"},
}};

/// What people write, and what it is called here.
constexpr std::array<std::pair<std::string_view, std::string_view>, 21> hints{{
    {"and", "`&&`"},
    {"or", "`||`"},
    {"not", "the opposite comparison: `a >= b` for not a < b"},
    {"if", "`condition ? a : b`"},
    {"where", "`condition ? a : b`"},
    {"log", "`ln(…)` for the natural logarithm, `log10(…)` for that to base 10"},
    {"log2", "`ln(…)/ln(2)`"},
    {"pow", "`a^b`"},
    {"square", "`a^2`"},
    {"heaviside", "`t >= t0 ? 1 : 0`"},
    {"step", "`t >= t0 ? 1 : 0`"},
    {"H", "`t >= t0 ? 1 : 0`"},
    {"fabs", "`abs(…)`"},
    {"sgn", "`sign(…)`"},
    {"round", "`rint(…)`"},
    {"floor", "`rint(a - 0.5)`"},
    {"ceil", "`rint(a + 0.5)`"},
    {"sum", "`a + b + c`"},
    {"avg", "`(a + b)/2`"},
    {"_pi", "`pi`"},
    {"_e", "`e`"},
}};

/// Empty: there is none.
std::string_view hint_for(std::string_view name) {
    const auto hint = std::ranges::find(hints, name, &std::pair<std::string_view, std::string_view>::first);
    return hint == hints.end() ? std::string_view{} : hint->second;
}

/// Characters beyond ASCII that look like operators.
constexpr std::array<std::pair<std::string_view, std::string_view>, 9> lookalikes{{
    {"\u2212", "`-`"},
    {"\u2013", "`-`"},
    {"\u00d7", "`*`"},
    {"\u00b7", "`*`"},
    {"\u00b2", "`^2`"},
    {"\u00b3", "`^3`"},
    {"\u2264", "`<=`"},
    {"\u2265", "`>=`"},
    {"\u03c0", "`pi`"},
}};

/// Operators of other languages.
constexpr std::array<std::pair<std::string_view, std::string_view>, 9> foreign_operators{{
    {"**", "a power is `a^b`"},
    {"<>", "write `!=`"},
    {"=<", "write `<=`"},
    {"=>", "write `>=`"},
    {"&", "write `&&`"},
    {"|", "write `||`"},
    {"!", "there is no such operator: write the opposite comparison"},
    {"%", "there is no remainder"},
    {";", "there is one expression"},
}};

constexpr std::array<std::string_view, 17> known_operators{"<=", ">=", "==", "!=", "&&", "||", "<", ">", "+",
                                                           "-",  "*",  "/",  "^",  "(",  ")",  ",", "?"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

struct Token {
    enum class Kind { number, word, symbol, end };
    Kind kind = Kind::end;
    std::string_view text;
};

/// Reads an expression from left to right.
class Parser {
public:
    Parser(std::string_view text, std::string_view variables) : text_(text), variables_(variables) { next(); }

    FormulaNode whole() {
        if (token_.kind == Token::Kind::end) fail("is empty");
        FormulaNode node = choice();
        if (token_.kind == Token::Kind::end) return node;
        if (token_.text == ",") {
            const auto n = 1 + std::ranges::count(text_.substr(place_of(token_)), ',');
            fail(fmt::format("gives {} values, must give one (the decimal sign is a point)", n));
        }
        fail_at(place_of(token_), token_.text == ")" ? "`)` without `(`" : misplaced("an operator"));
    }

private:
    using Kind = FormulaNode::Kind;

    [[noreturn]] void fail(const std::string& what) const {
        throw InputError("", fmt::format("expression \"{}\": {}", text_, what));
    }
    /// A reader counts characters from 1.
    [[noreturn]] void fail_at(std::size_t place, const std::string& what) const {
        const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
        const std::string_view before = text_.substr(0, place);
        const auto characters = std::ssize(before) - std::ranges::count_if(before, continues);
        fail(fmt::format("{}, at character {}", what, characters + 1));
    }
    std::size_t place_of(const Token& token) const {
        return token.kind == Token::Kind::end ? text_.size()
                                              : static_cast<std::size_t>(token.text.data() - text_.data());
    }
    std::size_t place_of(const FormulaNode& node) const {
        return static_cast<std::size_t>(node.text.data() - text_.data());
    }
    std::string misplaced(std::string_view wanted) const {
        if (token_.kind == Token::Kind::end) return "ends too early";
        if (const auto hint = hint_for(token_.text); !hint.empty())
            return fmt::format("`{}`: write {}", token_.text, hint);
        const bool value = token_.kind != Token::Kind::symbol || token_.text == "(";
        if (value && wanted == "an operator")
            return fmt::format("`{}` follows without an operator: a product is `a*b`", token_.text);
        return fmt::format("`{}` where {} is wanted", token_.text, wanted);
    }

    void next() {
        std::size_t at = token_.text.empty() ? 0 : place_of(token_) + token_.text.size();
        while (at < text_.size() && (text_[at] == ' ' || text_[at] == '\t' || text_[at] == '\n' || text_[at] == '\r'))
            ++at;
        const std::string_view rest = text_.substr(at);
        if (rest.empty()) {
            token_ = {Token::Kind::end, {}};
        } else if (is_digit(rest[0]) || rest[0] == '.') {
            token_ = {Token::Kind::number, rest.substr(0, number_length(rest, at))};
        } else if (is_letter(rest[0])) {
            const auto end = std::ranges::find_if(rest, [](char c) { return !is_letter(c) && !is_digit(c); });
            token_ = {Token::Kind::word, rest.substr(0, static_cast<std::size_t>(end - rest.begin()))};
        } else {
            token_ = {Token::Kind::symbol, rest.substr(0, symbol_length(rest, at))};
        }
    }

    std::size_t number_length(std::string_view rest, std::size_t at) const {
        std::size_t n = 0, digits = 0;
        const auto take_digits = [&] {
            for (; n < rest.size() && is_digit(rest[n]); ++n) ++digits;
        };
        take_digits();
        if (n < rest.size() && rest[n] == '.') {
            ++n;
            take_digits();
        }
        if (digits == 0) fail_at(at, "`.` is no number");
        if (n < rest.size() && (rest[n] == 'e' || rest[n] == 'E')) {
            ++n;
            if (n < rest.size() && (rest[n] == '+' || rest[n] == '-')) ++n;
            digits = 0;
            take_digits();
            if (digits == 0) fail_at(at, fmt::format("`{}`: the exponent has no digits", rest.substr(0, n)));
        }
        if (n < rest.size() && (is_letter(rest[n]) || rest[n] == '.' || rest[n] == '\'')) {
            const auto end = std::ranges::find_if(
                rest, [](char c) { return !is_letter(c) && !is_digit(c) && c != '.' && c != '\''; });
            fail_at(at, fmt::format("`{}` is no number: digits, a point, `e` and an exponent; a product is `2*x`",
                                    rest.substr(0, static_cast<std::size_t>(end - rest.begin()))));
        }
        return n;
    }

    std::size_t symbol_length(std::string_view rest, std::size_t at) const {
        if (const auto like =
                std::ranges::find_if(lookalikes, [&](const auto& pair) { return rest.starts_with(pair.first); });
            like != lookalikes.end())
            fail_at(at, fmt::format("`{}`: write {}", like->first, like->second));
        const auto refuse_foreign = [&](std::size_t length) {
            for (const auto& [symbol, hint] : foreign_operators)
                if (symbol.size() == length && rest.starts_with(symbol))
                    fail_at(at, fmt::format("`{}`: {}", symbol, hint));
        };
        refuse_foreign(2);
        for (const std::string_view symbol : known_operators)
            if (rest.starts_with(symbol)) return symbol.size();
        if (rest[0] == ':') return 1;
        if (rest[0] == '=') fail_at(at, "`=`: nothing is assigned in an expression, a comparison is ==");
        refuse_foreign(1);
        std::size_t length = 1;
        while (length < rest.size() && (static_cast<unsigned char>(rest[length]) & 0xC0U) == 0x80U) ++length;
        fail_at(at, fmt::format("`{}` has no meaning", rest.substr(0, length)));
    }

    bool at_symbol(std::string_view symbol) const {
        return token_.kind == Token::Kind::symbol && token_.text == symbol;
    }
    bool at_one_of(std::initializer_list<std::string_view> symbols) const {
        return std::ranges::any_of(symbols, [this](std::string_view symbol) { return at_symbol(symbol); });
    }
    void take(std::string_view symbol) {
        if (!at_symbol(symbol))
            fail_at(place_of(token_), token_.kind == Token::Kind::end
                                          ? fmt::format("ends too early: `{}` is missing", symbol)
                                          : misplaced(fmt::format("`{}`", symbol)));
        last_end_ = place_of(token_) + 1;
        next();
    }
    /// From one place to what was taken last.
    std::string_view text_from(std::size_t begin) const { return text_.substr(begin, last_end_ - begin); }

    FormulaNode made(Kind kind, std::string_view word, std::vector<FormulaNode> parts) const {
        const std::size_t begin = place_of(parts.front());
        return {kind, text_from(begin), word, std::move(parts)};
    }

    FormulaNode choice() {
        FormulaNode condition = logic_or();
        if (!at_symbol("?")) return condition;
        need_condition(condition, "`?`");
        take("?");
        FormulaNode yes = choice();
        take(":");
        FormulaNode no = choice();
        return made(Kind::choice, "?", {std::move(condition), std::move(yes), std::move(no)});
    }
    FormulaNode logic_or() {
        return logic("||", [this] { return logic("&&", [this] { return comparison(); }); });
    }
    template <class Operand>
    FormulaNode logic(std::string_view symbol, Operand operand) {
        FormulaNode left = operand();
        while (at_symbol(symbol)) {
            const std::string_view word = token_.text;
            need_condition(left, fmt::format("`{}`", symbol));
            take(symbol);
            FormulaNode right = operand();
            need_condition(right, fmt::format("`{}`", symbol));
            left = made(Kind::logic, word, {std::move(left), std::move(right)});
        }
        return left;
    }
    /// A number in its place is a slip: x && y > 1 does not compare x.
    void need_condition(const FormulaNode& node, const std::string& of) const {
        if (!node.is_condition())
            fail_at(place_of(node),
                    fmt::format("`{}` is a number where {} takes a condition: write a comparison", node.text, of));
    }
    FormulaNode comparison() {
        FormulaNode left = sum();
        if (!at_comparison()) return left;
        const std::string_view word = token_.text;
        const std::size_t place = place_of(token_);
        take(word);
        FormulaNode right = sum();
        const FormulaNode& chained = left.is_condition() ? left : right;
        if (chained.is_condition())
            fail_at(place, fmt::format("`{}` compares a truth, 0 or 1, with a number: write `a {} b && b {} c`", word,
                                       word, word));
        if (at_comparison()) {
            const std::string_view second = token_.text;
            const std::size_t at = place_of(token_);
            take(second);
            const FormulaNode third = sum();
            fail_at(at, fmt::format("a chained comparison compares a truth, 0 or 1, with the last number: write "
                                    "`{} {} {} && {} {} {}`",
                                    left.text, word, right.text, right.text, second, third.text));
        }
        return made(Kind::comparison, word, {std::move(left), std::move(right)});
    }
    bool at_comparison() const { return at_one_of({"<", "<=", ">", ">=", "==", "!="}); }

    template <class Operand>
    FormulaNode from_the_left(Kind kind, std::initializer_list<std::string_view> symbols, Operand operand) {
        FormulaNode left = operand();
        while (at_one_of(symbols)) {
            const std::string_view word = token_.text;
            take(word);
            FormulaNode right = operand();
            left = made(kind, word, {std::move(left), std::move(right)});
        }
        return left;
    }
    FormulaNode sum() {
        return from_the_left(Kind::sum, {"+", "-"}, [this] { return product(); });
    }
    FormulaNode product() {
        return from_the_left(Kind::product, {"*", "/"}, [this] { return signed_value(); });
    }
    FormulaNode signed_value() {
        if (!at_one_of({"+", "-"})) return power();
        const std::string_view word = token_.text;
        const std::size_t begin = place_of(token_);
        take(word);
        if (at_one_of({"+", "-"})) fail_at(place_of(token_), "two signs in a row: use parentheses");
        std::vector<FormulaNode> parts;
        parts.push_back(signed_value());
        return {Kind::sign, text_from(begin), word, std::move(parts)};
    }
    FormulaNode power() {
        FormulaNode base = primary();
        if (!at_symbol("^")) return base;
        const std::string_view word = token_.text;
        take("^");
        FormulaNode exponent = signed_value();
        return made(Kind::power, word, {std::move(base), std::move(exponent)});
    }

    FormulaNode primary() {
        const std::size_t begin = place_of(token_);
        const std::string_view text = token_.text;
        if (token_.kind == Token::Kind::number) {
            advance();
            return {Kind::number, text, {}};
        }
        if (token_.kind == Token::Kind::word) return named(text, begin);
        if (!at_symbol("(")) fail_at(begin, misplaced("a value"));
        take("(");
        std::vector<FormulaNode> parts;
        parts.push_back(choice());
        if (at_symbol(",")) fail_at(place_of(token_), "`,` in parentheses: the decimal sign is a point");
        take(")");
        return {Kind::parentheses, text_from(begin), {}, std::move(parts)};
    }
    void advance() {
        last_end_ = place_of(token_) + token_.text.size();
        next();
    }

    FormulaNode named(std::string_view name, std::size_t begin) {
        const bool variable = name.size() == 1 && variables_.find(name) != std::string_view::npos;
        const bool constant = std::ranges::find(constants, name, &FormulaConstant::name) != constants.end();
        const auto function = std::ranges::find(functions, name, &FormulaFunction::name);
        if (!variable && !constant && function == functions.end()) fail(unknown(name, begin));
        advance();
        if (function == functions.end()) {
            if (at_symbol("("))
                fail_at(place_of(token_), fmt::format("`{}` is no function: a product is `{}*(…)`", name, name));
            return {Kind::name, name, name};
        }
        if (!at_symbol("("))
            fail_at(begin, fmt::format("`{}` is a function: write `{}({})`", name, name, function->arguments));
        take("(");
        std::vector<FormulaNode> arguments;
        if (!at_symbol(")")) {
            arguments.push_back(choice());
            while (at_symbol(",")) {
                take(",");
                arguments.push_back(choice());
            }
        }
        take(")");
        const std::size_t n = arguments.size();
        const bool fits = function->one != nullptr ? n == 1 : function->two != nullptr ? n == 2 : n >= 2;
        if (!fits)
            fail_at(begin, fmt::format("`{}` is given {} value{}, must be `{}({})` (the decimal sign is a point)",
                                       text_from(begin), n, n == 1 ? "" : "s", name, function->arguments));
        return {Kind::call, text_from(begin), name, std::move(arguments)};
    }

    std::string unknown(std::string_view name, std::size_t begin) const {
        std::string what = fmt::format("unknown name `{}` at character {}", name, begin + 1);
        if (const auto hint = hint_for(name); !hint.empty()) return fmt::format("{}: write {}", what, hint);
        std::string allowed;
        std::vector<std::string_view> names;
        for (const char& variable : variables_) {
            allowed += fmt::format("{}, ", variable);
            names.emplace_back(&variable, 1);
        }
        for (const FormulaConstant& one : constants) names.emplace_back(one.name);
        for (const FormulaFunction& one : functions) names.emplace_back(one.name);
        return fmt::format("{}{}, allowed: {}pi, e and functions", what, name.size() > 1 ? suggestion(name, names) : "",
                           allowed);
    }

    std::string_view text_, variables_;
    Token token_;
    std::size_t last_end_ = 0;  ///< of what was taken last
};

}  // namespace

std::span<const FormulaFunction> formula_functions() { return functions; }
std::span<const FormulaConstant> formula_constants() { return constants; }
std::span<const FormulaOperator> formula_operators() { return operators; }

bool FormulaNode::is_condition() const {
    if (kind == Kind::parentheses) return parts.front().is_condition();
    if (kind == Kind::choice) return parts[1].is_condition() && parts[2].is_condition();
    return kind == Kind::comparison || kind == Kind::logic;
}

bool FormulaNode::uses(std::string_view name) const {
    return (kind == Kind::name && word == name) ||
           std::ranges::any_of(parts, [&](const FormulaNode& part) { return part.uses(name); });
}

FormulaNode parse_formula(std::string_view text, std::string_view variables) { return Parser(text, variables).whole(); }

}  // namespace gneiss
