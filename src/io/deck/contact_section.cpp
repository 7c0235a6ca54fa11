// [contact] and [[wall]].

#include "io/deck/keys.hpp"
#include "io/deck/sections.hpp"

namespace gneiss::deck {
namespace {

void check_contact(TableReader& table, ContactOptions& contact) {
    if (table.given("penalty_factor") && contact.penalty > 0)
        table.problem("penalty_factor", "given together with `penalty`, which leaves it without effect");
}

}  // namespace

const Section<ContactOptions>& contact_section() {
    using C = ContactOptions;
    const std::vector<Condition> on{{"method", {"potential"}}};
    static const Section<C> section{
        {choice("method", &C::method, contact_methods,
                {.meaning = "whether bodies, and faces of cracks, feel each other"}),
         number("friction", &C::friction,
                {.range = at_least(0), .only_for = on, .needed_for = on, .meaning = "Coulomb's coefficient; 0: none"}),
         number("restitution", &C::restitution,
                {.range = half_open(0, 1),
                 .only_for = on,
                 .meaning = "e: of the energy that an impact puts into contact, e² comes back"}),
         number("penalty", &C::penalty,
                {.unit = "Pa/m",
                 .range = at_least(0),
                 .only_for = on,
                 .meaning = "pressure per penetration; 0: from `penalty_factor`"}),
         number(
             "penalty_factor", &C::penalty_factor,
             {.range = above(0),
              .only_for = on,
              .meaning = "penalty, times the stiffness of a layer of the smallest elements on either side, in series"}),
         number("tangential_factor", &C::tangential_factor,
                {.range = above(0), .only_for = on, .meaning = "stiffness of what friction holds, times the penalty"}),
         number("potential_cap", &C::potential_cap,
                {.range = above(0),
                 .only_for = on,
                 .meaning = "in sizes of elements: no deeper penetration is pushed out harder"}),
         number("skin", &C::skin,
                {.range = above(0),
                 .only_for = on,
                 .meaning = "in shortest edges of the boundary: pairs are searched again once a node has moved half of "
                            "it"})},
        check_contact,
        true};
    return section;
}

const Section<WallOptions>& wall_section() {
    using W = WallOptions;
    static const Section<W> section{
        {numbers("point", &W::point, {.unit = "m", .required = true, .meaning = "on its face, [x, y]"}),
         numbers("normal", &W::normal,
                 {.required = true, .meaning = "out of the wall, towards the bodies, [x, y]; of any length"}),
         numbers("velocity", &W::velocity, {.unit = "m/s", .meaning = "of the wall, [x, y]"}),
         number("friction", &W::friction, {.range = at_least(0), .meaning = "in place of `contact.friction`"})}};
    return section;
}

}  // namespace gneiss::deck
