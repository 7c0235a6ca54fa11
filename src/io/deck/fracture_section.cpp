// [fracture], [[crack]], [[interface]], and strengths.

#include <set>
#include <string>

#include "io/deck/keys.hpp"
#include "io/deck/sections.hpp"

namespace gneiss::deck {
namespace {

/// A number, or two of them: for edges along the material axis alpha, and across it.
Key<StrengthOptions> directional(std::string_view name, DirectionalOption StrengthOptions::*member, const Spec& spec) {
    return custom<StrengthOptions>(
        name, "a number or an array of 2 numbers", "", spec,
        [=, range = spec.range, unit = spec.unit](const Value& value, TableReader&, StrengthOptions& out) {
            const NumberRule rule{range, unit};
            DirectionalOption& both = out.*member;
            if (value.node().is_array()) return value.read(std::span<double>(both), rule);
            const bool good = value.read(both[0], rule);
            both[1] = both[0];
            return good;
        });
}

/// The scatter's seed means nothing without scatter.
void check_fracture(TableReader& table, FractureOptions& fracture) {
    if (table.given("seed") && !table.failed("weibull_modulus") && fracture.weibull_modulus == 0)
        table.problem("seed", "has no effect without `weibull_modulus`");
}

bool read_regions_between(const Value& value, TableReader&, InterfaceOptions& out) {
    if (const auto* word = value.node().as_string(); word != nullptr && word->get() == "any") {
        out.between_any = true;
        return true;
    }
    const auto values = value.elements(std::nullopt, "two names of regions or more, or \"any\"");
    bool good = values.has_value();
    for (std::size_t i = 0; values && i < values->size(); ++i)
        good = (*values)[i].read(out.between.emplace_back()) && good;
    if (!good) return false;
    if (out.between.size() < 2) {
        value.problem("given a single region, must be two or more");
        return false;
    }
    std::set<std::string> seen;
    for (const std::string& region : out.between)
        if (!seen.insert(region).second) {
            value.problem(fmt::format("given \"{}\" twice, must be different regions", region));
            return false;
        }
    return true;
}

/// Names, each once or more.
bool read_where_to_crack(const Value& value, TableReader&, FractureOptions& out) {
    const auto values = value.elements(std::nullopt, "names of regions and of lines inside the solid");
    bool good = values.has_value();
    if (values) out.on.emplace();
    for (std::size_t i = 0; values && i < values->size(); ++i) good = (*values)[i].read(out.on->emplace_back()) && good;
    return good;
}

void check_interface(TableReader& table, InterfaceOptions&) {
    if (table.given("on") && table.given("between"))
        table.problem("between", "given together with `on`, an interface is found in one way");
}

}  // namespace

bool read_strength(const Value& value, StrengthOptions& out) {
    const toml::table* content = value.node().as_table();
    if (content == nullptr) {
        value.refuse("a table");
        return false;
    }
    const std::size_t before = value.findings().count();
    TableReader keys(value.findings(), *content, value.where(), value.key());
    read_section(strength_section(), keys, out);
    return value.findings().count() == before;
}

const Section<CrackOptions>& crack_section() {
    using C = CrackOptions;
    static const Section<C> section{
        {string("on", &C::on, {.required = true, .meaning = "name of a line inside the solid"})}};
    return section;
}

const Section<InterfaceOptions>& interface_section() {
    using I = InterfaceOptions;
    static const Section<I> section{
        {custom<I>(
             "on", "a string", "",
             {.required = true, .or_else = "between", .meaning = "name of a line inside the solid; or give `between`"},
             [](const Value& value, TableReader&, I& out) { return value.read(out.on); }),
         custom<I>(
             "between", "an array of strings or \"any\"", "",
             {.meaning = "two regions or more: the sides where any two of them meet; `\"any\"`: of all regions; or "
                         "give `on`"},
             read_regions_between),
         custom<I>(
             "strength", "a table", "",
             {.required = true, .meaning = "in place of the materials' on both sides; keys as in `material.strength`"},
             [](const Value& value, TableReader&, I& out) { return read_strength(value, out.strength); })},
        check_interface};
    return section;
}

const Section<StrengthOptions>& strength_section() {
    using S = StrengthOptions;
    static const Section<S> section{
        {directional("tensile", &S::tensile,
                     {.unit = "Pa",
                      .range = above(0),
                      .required = true,
                      .meaning = "tensile strength; two numbers: of edges along the axis alpha and across it"}),
         directional("cohesion", &S::cohesion,
                     {.unit = "Pa", .range = above(0), .required = true, .meaning = "strength in shear alone"}),
         directional("friction", &S::friction,
                     {.range = at_least(0), .required = true, .meaning = "tangent of the angle of internal friction"}),
         directional("residual_friction", &S::residual_friction,
                     {.range = at_least(0), .required = true, .meaning = "the same once the edge has failed"}),
         directional("G_I", &S::fracture_energy_i,
                     {.unit = "J/m²", .range = above(0), .required = true, .meaning = "fracture energy in opening"}),
         directional("G_II", &S::fracture_energy_ii,
                     {.unit = "J/m²", .range = above(0), .required = true, .meaning = "fracture energy in sliding"})}};
    return section;
}

const Section<FractureOptions>& fracture_section() {
    using F = FractureOptions;
    const std::vector<Condition> jointed{{"method", {"extrinsic", "intrinsic", "y_code"}}};
    static const Section<F> section{
        {choice("method", &F::method, fracture_methods, {.meaning = "how edges crack"}),
         choice("criterion", &F::criterion, crack_criteria,
                {.only_for = {{"method", {"extrinsic"}}}, .meaning = "when sides open"}),
         number("overshoot", &F::overshoot,
                {.range = at_least(0),
                 .only_for = {{"method", {"extrinsic"}}},
                 .meaning = "how far tractions may be beyond the strength where sides open, relative: a step that ends "
                            "beyond is taken again, shorter; 0: 0.01, or, under central_difference, verlet and "
                            "noh_bathe, whose steps are short, what a step brings. `run.event_tolerance` goes before "
                            "it"}),
         custom<F>(
             "on", "an array of strings", "",
             {.only_for = jointed,
              .meaning = "names of regions and of lines inside the solid: sides within these regions, on these lines "
                         "and of [[interface]] may crack, all others stay bonded and need no strength; `[]`: those of "
                         "[[interface]] alone; not given: all sides may"},
             read_where_to_crack),
         number("penalty", &F::penalty,
                {.range = above(0),
                 .only_for = jointed,
                 .meaning = "stiffness of joints, times the P-wave modulus over the edge's length"}),
         number("weibull_modulus", &F::weibull_modulus,
                {.range = at_least(0),
                 .only_for = jointed,
                 .meaning = "scatter of strengths from edge to edge: 10 is 12 %; 0: none"}),
         integer("seed", &F::seed,
                 {.range = at_least(0), .only_for = jointed, .meaning = "another seed, another sample"})},
        check_fracture,
        true};
    return section;
}

}  // namespace gneiss::deck
