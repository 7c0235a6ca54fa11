// [[load]], [[boundary]], [[initial]] and their amplitudes.

#include "io/deck/amplitude_key.hpp"
#include "io/deck/keys.hpp"
#include "io/deck/sections.hpp"
#include "model/formula.hpp"

namespace gneiss::deck {
namespace {

constexpr std::string_view xy = "xy";

/// Unit of what a load or a prescribed motion takes.
std::string_view load_unit(LoadOptions::Kind kind) {
    switch (kind) {
        case LoadOptions::Kind::nodal_force:
            return "N";
        case LoadOptions::Kind::body_force:
            return "N/m³";
        default:
            return "Pa";
    }
}

bool read_load_value(const Value& value, TableReader& table, LoadOptions& out) {
    const bool pair = value.node().is_array();
    const NumberRule rule{Range{}, load_unit(out.kind)};
    if (!table.failed("type") && pair == (out.kind == LoadOptions::Kind::pressure)) {
        value.refuse(pair ? "one number or expression (Pa) for a pressure"
                          : fmt::format("an array of 2 numbers or expressions, [x, y] ({})", rule.unit));
        return false;
    }
    if (!pair) return value.read(out.value[0], rule, xy);
    const auto values = value.elements(out.value.size(), "numbers or expressions");
    bool good = values.has_value();
    for (std::size_t i = 0; values && i < out.value.size(); ++i)
        good = (*values)[i].read(out.value[i], rule, xy) && good;
    return good;
}

bool read_boundary_value(const Value& value, TableReader&, BoundaryOptions& out) {
    const auto values = value.elements(out.value.size(), "numbers, expressions or \"free\"");
    if (!values) return false;
    const NumberRule rule{Range{}, out.kind == BoundaryOptions::Kind::velocity ? "m/s" : "m"};
    bool good = true;
    for (std::size_t i = 0; i < out.value.size(); ++i) {
        const auto* word = (*values)[i].node().as_string();
        if (word == nullptr || word->get() != "free")
            good = (*values)[i].read(out.value[i].emplace(), rule, xy) && good;
    }
    if (good && !out.value[0] && !out.value[1]) {
        value.refuse("a value in at least one component");
        good = false;
    }
    return good;
}

void set_boundary(BoundaryOptions& out, BoundaryWord word) {
    switch (word) {
        case BoundaryWord::fixed:
            out.kind = BoundaryOptions::Kind::displacement;
            out.value = {Formula(0.0), Formula(0.0)};
            break;
        case BoundaryWord::displacement:
            out.kind = BoundaryOptions::Kind::displacement;
            break;
        case BoundaryWord::velocity:
            out.kind = BoundaryOptions::Kind::velocity;
            break;
        case BoundaryWord::absorbing:
            out.kind = BoundaryOptions::Kind::absorbing;
            break;
    }
}

bool read_expression(const Value& value, TableReader&, AmplitudeOptions& out) {
    Formula formula;
    if (!value.read(formula, NumberRule{}, "xyt")) return false;
    out.expression = formula.text;
    return true;
}

/// Times of a table: ascending, a jump is two equal times, three of them have no meaning.
void check_times(TableReader& table, const AmplitudeOptions& amplitude) {
    const auto& times = amplitude.times;
    if (times.empty()) table.problem("times", "given [], must be at least one time");
    if (times.size() != amplitude.values.size() && !table.failed("values")) {
        table.problem("values", fmt::format("given {} values, must be as many as times, {}", amplitude.values.size(),
                                            times.size()));
    }
    for (std::size_t i = 1; i < times.size(); ++i) {
        if (times[i] < times[i - 1]) {
            table.problem("times", fmt::format("{} s after {} s, must ascend", times[i], times[i - 1]));
            return;
        }
        if (i > 1 && times[i] == times[i - 2]) {
            table.problem("times", fmt::format("{} s more than twice, two equal times make a jump", times[i]));
            return;
        }
    }
}

void check_amplitude(TableReader& table, AmplitudeOptions& amplitude) {
    if (table.failed("type")) return;
    if (amplitude.kind == AmplitudeOptions::Kind::ramp && !table.failed("start") && !table.failed("end") &&
        !(amplitude.end > amplitude.start)) {
        table.problem("end", fmt::format("given {}, must be > {} s, the start", amplitude.end, amplitude.start));
    }
    if (amplitude.kind == AmplitudeOptions::Kind::table && !table.failed("times")) check_times(table, amplitude);
}

}  // namespace

bool read_amplitude(const Value& value, AmplitudeOptions& out) {
    if (const auto* word = value.node().as_string()) {
        const toml::table spelt_out{
            {"type", word->get()}};  // has no place of its own: messages fall back to the string's
        TableReader table(value.findings(), spelt_out, value.where(), value.key());
        read_section(amplitude_section(), table, out);
        return true;
    }
    if (!value.node().is_table()) {
        value.refuse("the name of an amplitude or a table { type = …, … }");
        return false;
    }
    return read_table(value, amplitude_section(), out);
}

const Section<AmplitudeOptions>& amplitude_section() {
    using A = AmplitudeOptions;
    const std::vector<Condition> table{{"type", {"table"}}};
    static const Section<A> section{
        {choice<A>("type", amplitudes, "", [](A& out, A::Kind kind) { out.kind = kind; },
                   {.required = true, .meaning = "course of the factor"}),
         number("start", &A::start,
                {.unit = "s", .only_for = {{"type", {"heaviside", "ramp"}}}, .meaning = "leaves 0 here"}),
         number("end", &A::end,
                {.unit = "s",
                 .required = true,
                 .only_for = {{"type", {"ramp"}}},
                 .meaning = "reaches 1 here, after start"}),
         numbers(
             "times", &A::times,
             {.unit = "s", .required = true, .only_for = table, .meaning = "ascending; two equal times make a jump"}),
         numbers("values", &A::values, {.required = true, .only_for = table, .meaning = "the factor at these times"}),
         custom<A>("expression", "a number or an expression", "",
                   {.required = true, .only_for = {{"type", {"expression"}}}, .meaning = "may use t (s), x and y (m)"},
                   read_expression)},
        check_amplitude};
    return section;
}

const Section<LoadOptions>& load_section() {
    using L = LoadOptions;
    static const Section<L> section{
        {choice<L>("type", loads, "", [](L& out, L::Kind kind) { out.kind = kind; },
                   {.required = true, .meaning = "kind of load"}),
         string("on", &L::on,
                {.needed_for = {{"type", {"nodal_force", "traction", "pressure"}}},
                 .meaning = "name of nodes (nodal_force), of a boundary (traction, pressure) or of a region "
                            "(body_force; left out: everywhere)"}),
         custom<L>("value", "a number or an expression, or an array of 2", "",
                   {.unit = "N, Pa or N/m³",
                    .required = true,
                    .meaning = "[x, y] of the force (N), traction (Pa) or body force (N/m³); a pressure (Pa) is one "
                               "number. May use x and y (m), of the initial shape"},
                   read_load_value),
         amplitude_key<L>({.meaning = "factor against time"})}};
    return section;
}

const Section<BoundaryOptions>& boundary_section() {
    using B = BoundaryOptions;
    const std::vector<Condition> prescribed{{"type", {"displacement", "velocity"}}};
    static const Section<B> section{
        {string("on", &B::on,
                {.required = true, .meaning = "name of a boundary or of nodes; absorbing: of a boundary"}),
         choice<B>("type", boundaries, "", set_boundary, {.required = true, .meaning = "kind of condition"}),
         custom<B>("value", "an array of 2 numbers, expressions or \"free\"", "",
                   {.unit = "m or m/s",
                    .required = true,
                    .only_for = prescribed,
                    .meaning = "[x, y]; \"free\" leaves a component alone. May use x and y (m), of the initial shape"},
                   read_boundary_value),
         amplitude_key<B>({.only_for = prescribed, .meaning = "factor against time"})}};
    return section;
}

const Section<InitialOptions>& initial_section() {
    using I = InitialOptions;
    static const Section<I> section{
        {string("on", &I::on, {.meaning = "name of a region or of nodes; left out: everything"}),
         formulas("velocity", &I::velocity, xy,
                  {.unit = "m/s", .required = true, .meaning = "[x, y]; may use x and y (m)"})}};
    return section;
}

}  // namespace gneiss::deck
