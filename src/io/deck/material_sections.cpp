// [[material]] and the tables in it.

#include "io/deck/keys.hpp"
#include "io/deck/sections.hpp"

namespace gneiss::deck {
namespace {

bool read_regions(const Value& value, TableReader&, MaterialOptions& out) {
    if (value.node().is_string()) return value.read(out.regions.emplace_back());
    if (!value.node().is_array()) {
        value.refuse("a string or an array of strings");
        return false;
    }
    const auto values = value.elements(std::nullopt, "strings");
    bool good = true;
    for (const Value& element : *values) good = element.read(out.regions.emplace_back()) && good;
    if (values->empty()) value.refuse("at least one region");
    return good && !values->empty();
}

bool read_constants(const Value& value, TableReader& table, MaterialOptions& out) {
    const std::size_t before = value.findings().count();
    const toml::table* content = value.node().as_table();
    if (content == nullptr) {
        value.refuse("a table");
        return false;
    }
    GivenConstants given;
    TableReader keys(value.findings(), *content, value.where(), value.key());
    read_section(constants_section(), keys, given);
    if (keys.has_unknown() || table.failed("law")) return false;  // what is missing may be what was meant
    const bool sound_values = value.findings().count() == before;
    return check_constants_set(value, given, out.law) && sound_values && resolve_constants(value, given, out);
}

bool read_bedding(const Value& value, TableReader&, AxesOptions& out) {
    const auto lines = value.elements(std::nullopt, "polylines");
    if (!lines) return false;
    bool good = !lines->empty();
    if (lines->empty()) value.refuse("at least one polyline [[x, y], [x, y], …]");
    for (const Value& line : *lines) {
        const auto points = line.elements(std::nullopt, "points [x, y]");
        auto& polyline = out.bedding.emplace_back();
        if (points && points->size() < 2) line.refuse("at least 2 points [x, y]");
        good = points && points->size() >= 2 && good;
        if (!points) continue;
        for (std::size_t i = 0; i < points->size(); ++i) {
            const bool read = (*points)[i].read(std::span<double>(polyline.emplace_back()), NumberRule{Range{}, "m"});
            if (read && i > 0 && polyline[i] == polyline[i - 1]) (*points)[i].problem("equal to the point before it");
            good = read && good;
        }
    }
    return good;
}

void check_axes(TableReader& table, AxesOptions& axes) {
    const std::array<std::pair<std::string_view, AxesOptions::Kind>, 3> ways{{{"angle", AxesOptions::Kind::angle},
                                                                              {"bedding", AxesOptions::Kind::bedding},
                                                                              {"data", AxesOptions::Kind::data}}};
    std::string_view first;
    for (const auto& [key, kind] : ways) {
        if (!table.given(key)) continue;
        if (first.empty()) {
            first = key;
            axes.kind = kind;
        } else {
            table.problem(key, fmt::format("given together with `{}`, axes are given in one way", first));
        }
    }
}

/// FORMULATION 2: sampling the volume at the centre leaves no energy whose gradient the forces could be.
void check_material(TableReader& table, MaterialOptions& material) {
    if (table.findings().volumetric != Volumetric::centre || table.failed("law") || table.failed("stress_map")) return;
    constexpr std::string_view reason =
        "with solid.volumetric = \"centre\", where the tangent is not symmetric and no energy is stored";
    if (material.law == LawKind::neo_hookean) {
        table.problem("law", fmt::format("given \"neo_hookean\", must be \"munjiza\" {}", reason));
    } else if (material.stress_map != StressMap::direct) {
        table.problem("stress_map", fmt::format("is \"conjugate\", must be \"direct\" {}", reason));
    }
}

}  // namespace

const Section<GivenConstants>& constants_section() {
    using C = GivenConstants;
    static const Section<C> section{
        {number("M_v", &C::M_v, {.unit = "Pa", .meaning = "Munjiza constant of the volume"}),
         number("M_alpha", &C::M_alpha, {.unit = "Pa", .meaning = "Munjiza constant of the edge along alpha"}),
         number("M_beta", &C::M_beta, {.unit = "Pa", .meaning = "Munjiza constant of the edge along beta"}),
         number("M_psi", &C::M_psi,
                {.unit = "Pa", .range = above(0), .meaning = "Munjiza constant of the angle, twice the shear modulus"}),
         number("E", &C::E, {.unit = "Pa", .range = above(0), .meaning = "isotropic: Young's modulus"}),
         number("nu", &C::nu,
                {.range = half_open(-1, 0.5),
                 .meaning = "isotropic: Poisson's ratio; below 0.5 in plane strain and for neo_hookean"}),
         number("E_alpha", &C::E_alpha,
                {.unit = "Pa", .range = above(0), .meaning = "transversely isotropic: Young's modulus along alpha"}),
         number("E_beta", &C::E_beta,
                {.unit = "Pa", .range = above(0), .meaning = "transversely isotropic: Young's modulus along beta"}),
         number(
             "nu_alpha_beta", &C::nu_alpha_beta,
             {.meaning =
                  "contraction along beta per stretch along alpha, under stress along alpha; this or `nu_beta_alpha`"}),
         number("nu_beta_alpha", &C::nu_beta_alpha,
                {.meaning = "contraction along alpha per stretch along beta, under stress along beta: `nu_alpha_beta` "
                            "E_beta / E_alpha"}),
         number("nu_p_alpha", &C::nu_p_alpha,
                {.range = open_between(-1, 1),
                 .meaning = "Poisson's ratio between alpha and the direction out of the plane, which span the plane of "
                            "isotropy; needed in plane strain, without effect in plane stress"}),
         number("G", &C::G,
                {.unit = "Pa",
                 .range = above(0),
                 .meaning = "transversely isotropic: shear modulus between alpha and beta"}),
         number("mu", &C::mu, {.unit = "Pa", .range = above(0), .meaning = "neo_hookean: shear modulus"}),
         number("lambda", &C::lambda,
                {.unit = "Pa", .meaning = "neo_hookean: Lamé's first constant, above -2/3 `mu`"})}};
    return section;
}

const Section<AxesOptions>& axes_section() {
    using A = AxesOptions;
    static const Section<A> section{
        {formula("angle", &A::angle, "xy",
                 {.unit = "rad",
                  .meaning = "from x to alpha, counter-clockwise; may use x and y (m) of the element's centroid"}),
         custom<A>(
             "bedding", "an array of polylines", "",
             {.unit = "m",
              .meaning = "`[[[x, y], [x, y], …], …]`: alpha follows the nearest line, interpolated between lines"},
             read_bedding),
         custom<A>("data", "a string", "",
                   {.meaning = "name of numbers per element in the mesh file: the angle in rad"},
                   [](const Value& value, TableReader&, A& out) { return value.read(out.data); })},
        check_axes};
    return section;
}

const Section<MaterialOptions::Stiffening>& stiffening_section() {
    using S = MaterialOptions::Stiffening;
    static const Section<S> section{
        {number("k", &S::k, {.range = at_least(0), .required = true, .meaning = "strength of the stiffening"}),
         number("p_ref", &S::p_ref,
                {.unit = "Pa", .range = above(0), .required = true, .meaning = "pressure of reference"}),
         number("n", &S::n, {.range = between(0, 1), .required = true, .meaning = "exponent"})}};
    return section;
}

const Section<MaterialOptions>& viscosity_section() {
    using M = MaterialOptions;
    static const Section<M> section{
        {number("shear", &M::shear_viscosity,
                {.unit = "Pa s", .range = at_least(0), .meaning = "stress per rate of the deviatoric strain"}),
         number("bulk", &M::bulk_viscosity,
                {.unit = "Pa s", .range = at_least(0), .meaning = "pressure per rate of the volume"})}};
    return section;
}

const Section<MaterialOptions>& material_section() {
    using M = MaterialOptions;
    const std::vector<Condition> munjiza{{"law", {"munjiza"}}}, hypo{{"form", {"hypo"}}};
    static const Section<M> section{
        {custom<M>("region", "a string or an array of strings", "",
                   {.meaning = "regions of the mesh made of it; left out: every region that no other material names"},
                   read_regions),
         choice("law", &M::law, laws, {.meaning = "material law"}),
         choice("form", &M::form, forms,
                {.only_for = munjiza, .meaning = "from the total deformation or from its increments"}),
         choice("stress_map", &M::stress_map, stress_maps,
                {.only_for = munjiza, .meaning = "from Munjiza stresses to forces"}),
         number("density", &M::density,
                {.unit = "kg/m³", .range = above(0), .required = true, .meaning = "mass per initial volume"}),
         custom<M>("constants", "a table", "",
                   {.required = true, .meaning = "elastic constants, one of the sets below"}, read_constants),
         table("axes", &M::axes, axes_section,
               {.only_for = munjiza, .meaning = "direction of the material axis alpha; beta is alpha turned by +90°"}),
         table("stiffening", &M::stiffening, stiffening_section,
               {.only_for = hypo, .meaning = "moduli that grow under confinement"}),
         formulas("in_situ_stress", &M::in_situ_stress, "xy",
                  {.unit = "Pa",
                   .only_for = hypo,
                   .meaning = "Cauchy stress before the run, [xx, yy, xy], tension positive; may use x and y (m)"}),
         table("viscosity", viscosity_section, {.meaning = "viscous stress, added to the elastic one"}),
         custom<M>(
             "strength", "a table", "", {.meaning = "what holds edges together that may crack, see [fracture]"},
             [](const Value& value, TableReader&, M& out) { return read_strength(value, out.strength.emplace()); })},
        check_material};
    return section;
}

}  // namespace gneiss::deck
