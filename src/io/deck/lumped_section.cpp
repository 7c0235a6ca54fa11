// [[lumped]]: models of a few numbers that are coupled to a boundary.

#include "io/deck/amplitude_key.hpp"
#include "io/deck/keys.hpp"
#include "io/deck/sections.hpp"

namespace gneiss::deck {
namespace {

bool read_burn(const Value& value, TableReader&, LumpedOptions& out) {
    return read_table(value, burn_section(), out.burn.emplace());
}

void check_burn(TableReader& table, BurnOptions& burn) {
    if (table.failed("exponent") || table.failed("reference_pressure")) return;
    if (burn.exponent > 0 && burn.reference_pressure == 0)
        table.problem(
            "reference_pressure",
            fmt::format("missing, needed with exponent = {}: what the pressure is measured against", burn.exponent));
    if (burn.exponent == 0 && table.given("reference_pressure"))
        table.problem("reference_pressure", "has no effect: with exponent = 0 the pressure does not matter");
}

void check_lumped(TableReader& table, LumpedOptions& lumped) {
    if (!table.failed("direction") && table.given("direction") && lumped.direction == std::array{0.0, 0.0})
        table.problem("direction", "has no length");
    if (lumped.kind == LumpedOptions::Kind::mass && table.given("amplitude") && !table.given("force"))
        table.problem("amplitude", "has no effect without `force`");
    if (lumped.bonded && lumped.gap > 0)
        table.problem("gap", "must be 0 where `bonded` is true: the bond would pull from the start");
    if (lumped.kind == LumpedOptions::Kind::actuator && !table.failed("amplitude") && lumped.displacement != 0 &&
        lumped.amplitude.kind == AmplitudeOptions::Kind::constant)
        table.problem(
            "amplitude",
            "missing or constant, must begin at 0: the actuator would stand at its displacement at the start");
}

}  // namespace

const Section<BurnOptions>& burn_section() {
    using B = BurnOptions;
    static const Section<B> section{
        {number("energy", &B::energy, {.unit = "J", .range = above(0), .required = true, .meaning = "of the charge"}),
         number("time", &B::time,
                {.unit = "s",
                 .range = above(0),
                 .required = true,
                 .meaning = "in which all but 1/e of it burns, at the reference pressure"}),
         number("exponent", &B::exponent,
                {.range = at_least(0), .meaning = "of the pressure in the rate of burning (Vieille's law)"}),
         number("reference_pressure", &B::reference_pressure,
                {.unit = "Pa", .range = above(0), .meaning = "needed where exponent > 0"})},
        check_burn};
    return section;
}

const Section<LumpedOptions>& lumped_section() {
    using L = LumpedOptions;
    const std::vector<Condition> gas{{"type", {"gas"}}}, mass{{"type", {"mass"}}}, actuator{{"type", {"actuator"}}},
        platen{{"type", {"mass", "actuator"}}};
    static const Section<L> section{
        {choice<L>("type", lumped_models, "", [](L& out, L::Kind kind) { out.kind = kind; },
                   {.required = true, .meaning = "kind of model"}),
         custom<L>(
             "name", "a string", "",
             {.required = true,
              .meaning = "heads its columns of history.csv; no two alike, no blanks, commas or quotes"},
             [](const Value& value, TableReader&, L& out) { return read_column_name(value, out.name, "history.csv"); }),
         string("on", &L::on, {.required = true, .meaning = "name of a boundary; gas: the wall of its cavity"}),
         number("pressure", &L::pressure,
                {.unit = "Pa", .range = above(0), .required = true, .only_for = gas, .meaning = "at t = 0"}),
         number("gamma", &L::gamma,
                {.range = above(1), .only_for = gas, .meaning = "exponent of the adiabatic, p V^gamma"}),
         number("leak", &L::leak,
                {.unit = "1/s",
                 .range = at_least(0),
                 .only_for = gas,
                 .meaning = "part of its mass that is lost per second, with the energy it carries"}),
         custom<L>("burn", "a table", "",
                   {.only_for = gas, .meaning = "a charge that burns in it: `{ energy = …, time = … }`"}, read_burn),
         numbers("about", &L::about,
                 {.unit = "m",
                  .only_for = gas,
                  .meaning = "point in which the planes of symmetry meet that close an open boundary, [x, y]"}),
         numbers("direction", &L::direction,
                 {.required = true,
                  .only_for = platen,
                  .meaning = "in which it pushes, [x, y], of any length; it moves along it alone"}),
         number("stiffness", &L::stiffness,
                {.unit = "N/m",
                 .range = above(0),
                 .required = true,
                 .only_for = platen,
                 .meaning = "of the spring between it and the whole boundary"}),
         number("gap", &L::gap,
                {.unit = "m", .range = at_least(0), .only_for = platen, .meaning = "between them at the start"}),
         boolean("bonded", &L::bonded,
                 {.only_for = platen, .meaning = "whether it pulls as well; false: it lets go of the boundary"}),
         number("mass", &L::mass,
                {.unit = "kg", .range = above(0), .required = true, .only_for = mass, .meaning = "of the platen"}),
         number("damping", &L::damping,
                {.unit = "N s/m",
                 .range = at_least(0),
                 .only_for = mass,
                 .meaning = "of the damper beside the spring, while they touch"}),
         number("ground_stiffness", &L::ground_stiffness,
                {.unit = "N/m",
                 .range = at_least(0),
                 .only_for = mass,
                 .meaning = "of a spring to the ground, at rest at the start"}),
         number("velocity", &L::velocity, {.unit = "m/s", .only_for = mass, .meaning = "at t = 0, along direction"}),
         number("force", &L::force,
                {.unit = "N", .only_for = mass, .meaning = "on it, along direction: its weight, say"}),
         number("displacement", &L::displacement,
                {.unit = "m", .required = true, .only_for = actuator, .meaning = "along direction, at amplitude 1"}),
         amplitude_key<L>(
             {.only_for = platen, .meaning = "factor on force or displacement against time; may not use x and y"})},
        check_lumped};
    return section;
}

}  // namespace gneiss::deck
