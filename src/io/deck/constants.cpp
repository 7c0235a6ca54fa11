// Which set of elastic constants a deck gives, and what the law needs.

#include <algorithm>
#include <cmath>

#include "io/deck/keys.hpp"
#include "io/deck/sections.hpp"
#include "materials/out_of_plane.hpp"

namespace gneiss::deck {
namespace {

/// Poisson's ratios given both must agree to this, relative: they are copied numbers, not measured twice.
constexpr double poisson_agreement = 1e-6;

using Member = std::optional<double> GivenConstants::*;
struct Set {
    std::string_view text;
    std::vector<std::pair<std::string_view, Member>> needed, further;
    std::vector<LawKind> laws;
};

using G = GivenConstants;
const std::vector<Set>& sets() {
    static const std::vector<Set> all{
        {"{ M_v, M_alpha, M_beta, M_psi }",
         {{"M_v", &G::M_v}, {"M_alpha", &G::M_alpha}, {"M_beta", &G::M_beta}, {"M_psi", &G::M_psi}},
         {},
         {LawKind::munjiza}},
        {"{ E, nu }", {{"E", &G::E}, {"nu", &G::nu}}, {}, {LawKind::munjiza, LawKind::neo_hookean}},
        {"{ E_alpha, E_beta, nu_alpha_beta or nu_beta_alpha, G, and nu_p_alpha in plane strain }",
         {{"E_alpha", &G::E_alpha}, {"E_beta", &G::E_beta}, {"G", &G::G}},
         {{"nu_alpha_beta", &G::nu_alpha_beta}, {"nu_beta_alpha", &G::nu_beta_alpha}, {"nu_p_alpha", &G::nu_p_alpha}},
         {LawKind::munjiza}},
        {"{ mu, lambda }", {{"mu", &G::mu}, {"lambda", &G::lambda}}, {}, {LawKind::neo_hookean}},
    };
    return all;
}

bool any_given(const Set& set, const GivenConstants& given) {
    const auto has = [&](const auto& key) { return (given.*key.second).has_value(); };
    return std::any_of(set.needed.begin(), set.needed.end(), has) ||
           std::any_of(set.further.begin(), set.further.end(), has);
}

/// Reports about one key of the table of constants.
void problem(const Value& table, std::string_view key, std::string_view message) {
    const toml::node& node = *table.node().as_table()->get(key);
    Value(table.findings(), node, fmt::format("{}.{}", table.key(), key), table.where()).problem(message);
}

bool compressible(const Value& value, double nu, std::string_view where) {
    if (nu < 0.5) return true;
    problem(value, "nu", fmt::format("given {}, must be < 0.5 {}", nu, where));
    return false;
}

bool resolve_neo_hookean(const Value& value, const GivenConstants& given, MaterialOptions& out) {
    LameConstants lame{given.mu.value_or(0), given.lambda.value_or(0)};
    if (given.E) {
        if (!compressible(value, *given.nu, "for law \"neo_hookean\"")) return false;
        lame = lame_constants(*given.E, *given.nu);
    } else if (!(lame.lambda > -2.0 / 3.0 * lame.mu)) {
        problem(value, "lambda",
                fmt::format("given {}, must be > {} Pa, -2/3 of mu: the bulk modulus is positive", lame.lambda,
                            -2.0 / 3.0 * lame.mu));
        return false;
    }
    out.shear_modulus = lame.mu;
    out.lame_lambda = lame.lambda;
    return true;
}

/// The one independent Poisson's ratio in the plane.
std::optional<double> in_plane_ratio(const Value& value, const GivenConstants& given) {
    if (!given.nu_alpha_beta && !given.nu_beta_alpha) {
        value.problem("`nu_alpha_beta` or `nu_beta_alpha` is missing");
        return std::nullopt;
    }
    if (!given.nu_beta_alpha) return given.nu_alpha_beta;
    const double implied = *given.nu_beta_alpha * *given.E_alpha / *given.E_beta;
    if (!given.nu_alpha_beta) return implied;
    if (std::abs(implied - *given.nu_alpha_beta) <= poisson_agreement * std::abs(implied)) return given.nu_alpha_beta;
    problem(
        value, "nu_beta_alpha",
        fmt::format("given {}, but nu_alpha_beta E_beta / E_alpha = {:.6g}: the compliance must be symmetric, give one "
                    "of the two ratios",
                    *given.nu_beta_alpha, *given.nu_alpha_beta * *given.E_beta / *given.E_alpha));
    return std::nullopt;
}

std::optional<MunjizaConstants> resolve_transverse(const Value& value, const GivenConstants& given, Plane plane,
                                                   double& across) {
    const std::optional<double> nu = in_plane_ratio(value, given);
    const bool lacks_out_of_plane = plane == Plane::strain && !given.nu_p_alpha;
    if (lacks_out_of_plane) value.problem("`nu_p_alpha` is missing, needed in plane strain");
    if (!nu || lacks_out_of_plane) return std::nullopt;
    const TransverselyIsotropic constants{*given.E_alpha, *given.E_beta, *nu, given.nu_p_alpha.value_or(0), *given.G};
    if (plane == Plane::stress) return transversely_isotropic_plane_stress(constants);
    across = transversely_isotropic_across(constants);
    return transversely_isotropic_plane_strain(constants);
}

std::optional<MunjizaConstants> resolve_munjiza(const Value& value, const GivenConstants& given, double& across) {
    if (given.M_v) return MunjizaConstants{*given.M_v, *given.M_alpha, *given.M_beta, *given.M_psi};
    if (!value.findings().plane) return std::nullopt;  // reported where [solid] is read
    const Plane plane = *value.findings().plane;
    if (given.E_alpha) return resolve_transverse(value, given, plane, across);
    if (plane == Plane::stress) return isotropic_plane_stress(*given.E, *given.nu);
    if (!compressible(value, *given.nu, "in plane strain")) return std::nullopt;
    return isotropic_plane_strain(*given.E, *given.nu);
}

}  // namespace

bool check_constants_set(const Value& value, const GivenConstants& given, LawKind law) {
    std::string allowed;
    std::vector<const Set*> used;
    bool foreign = false;
    for (const Set& set : sets()) {
        const bool fits = std::find(set.laws.begin(), set.laws.end(), law) != set.laws.end();
        if (fits) allowed += fmt::format("{}{}", allowed.empty() ? "" : " or ", set.text);
        if (!any_given(set, given)) continue;
        used.push_back(&set);
        foreign = foreign || !fits;
    }
    if (used.size() != 1 || foreign) {
        const std::string_view what = used.size() > 1 ? "mixes several sets"
                                      : used.empty()  ? "gives none"
                                                      : "gives another set";
        value.problem(fmt::format("{}, must be {} for law \"{}\"", what, allowed, name_of(laws, law)));
        return false;
    }
    bool complete = true;
    for (const auto& [name, member] : used.front()->needed) {
        if ((given.*member).has_value()) continue;
        value.problem(fmt::format("`{}` is missing, must be {}", name, used.front()->text));
        complete = false;
    }
    return complete;
}

bool resolve_constants(const Value& value, const GivenConstants& given, MaterialOptions& material) {
    if (material.law == LawKind::neo_hookean) return resolve_neo_hookean(value, given, material);
    const std::optional<MunjizaConstants> constants = resolve_munjiza(value, given, material.across);
    if (!constants) return false;
    if (const std::string reason = inadmissibility(*constants); !reason.empty()) {
        value.problem("inadmissible, " + reason);
        return false;
    }
    material.constants = *constants;
    return true;
}

}  // namespace gneiss::deck
