#include "model/make_blocks.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "base/suggest.hpp"
#include "mesh/measure.hpp"
#include "mesh/regions.hpp"
#include "model/blocks/make_block.hpp"
#include "model/formula.hpp"
#include "model/material_axes.hpp"

namespace gneiss {
namespace {

constexpr std::int32_t no_material = -1;

std::string where(std::size_t material) { return fmt::format("[[material]] {}", material + 1); }

/// Number of the material of each region of the mesh.
std::vector<std::int32_t> material_of_region(const Mesh& mesh, const std::vector<MaterialOptions>& materials,
                                             std::vector<Problem>& problems) {
    std::vector<std::int32_t> of_region(mesh.region_names.size(), no_material);
    std::string known;
    const std::vector<std::string> all_names = names_of_regions(mesh);
    for (const std::string& name : all_names) known += (known.empty() ? "" : ", ") + name;
    std::int32_t rest = no_material;
    for (std::size_t m = 0; m < materials.size(); ++m) {
        const auto number = static_cast<std::int32_t>(m);
        if (materials[m].regions.empty()) {
            if (rest != no_material)
                problems.push_back({where(m), fmt::format("names no region, like material {}: only one material can "
                                                          "take all regions that no other names",
                                                          rest + 1)});
            rest = number;
        }
        for (const std::string& name : materials[m].regions) {
            const std::vector<std::int32_t> regions = regions_named(mesh, name);
            if (regions.empty()) {
                const std::vector<std::string_view> names(all_names.begin(), all_names.end());
                problems.push_back({where(m), fmt::format("the mesh has no region `{}`; it has: {}{}", name, known,
                                                          suggestion(name, names))});
                continue;
            }
            for (const std::int32_t region : regions) {
                std::int32_t& taken = of_region[static_cast<std::size_t>(region)];
                const std::string& part = mesh.region_names[static_cast<std::size_t>(region)];
                if (taken != no_material && taken != number)
                    problems.push_back(
                        {where(m),
                         part == name
                             ? fmt::format("region `{}` belongs to material {} already", name, taken + 1)
                             : fmt::format("region `{}` overlaps with others: `{}` belongs to material {} already; "
                                           "materials may name those groups only that share no element",
                                           name, part, taken + 1)});
                taken = number;
            }
        }
    }
    for (std::size_t r = 0; r < of_region.size(); ++r) {
        if (of_region[r] == no_material) of_region[r] = rest;
        if (of_region[r] == no_material)
            problems.push_back({"[[material]]", fmt::format("no material for region `{}`", mesh.region_names[r])});
    }
    return of_region;
}

std::vector<std::array<double, 3>> in_situ_stress(const Mesh& mesh, const std::vector<std::int32_t>& elements,
                                                  const std::array<Formula, 3>& formulas) {
    if (std::all_of(formulas.begin(), formulas.end(), [](const Formula& f) { return f.is_zero(); })) return {};
    const std::array<CompiledFormula, 3> compiled{
        CompiledFormula(formulas[0], "xy"), CompiledFormula(formulas[1], "xy"), CompiledFormula(formulas[2], "xy")};
    const auto centroids = element_centroids(mesh);
    std::vector<std::array<double, 3>> stress;
    for (const std::int32_t e : elements) {
        const auto& [x, y] = centroids[static_cast<std::size_t>(e)];
        stress.push_back({compiled[0](x, y), compiled[1](x, y), compiled[2](x, y)});
    }
    return stress;
}

/// What a deck has checked already, and a program that fills the options by hand has not.
void check_ranges(const SolidOptions& solid, const MaterialOptions& material, std::vector<Problem>& problems) {
    const auto require = [&](bool holds, const char* name, double given, const char* allowed) {
        if (!holds) problems.push_back({name, fmt::format("given {}, must be {}", given, allowed)});
    };
    require(solid.thickness > 0 && std::isfinite(solid.thickness), "thickness", solid.thickness, "> 0 m");
    require(material.density > 0 && std::isfinite(material.density), "density", material.density, "> 0 kg/m3");
    require(material.shear_viscosity >= 0, "viscosity.shear", material.shear_viscosity, ">= 0 Pa s");
    require(material.bulk_viscosity >= 0, "viscosity.bulk", material.bulk_viscosity, ">= 0 Pa s");
    if (material.law == LawKind::neo_hookean) {
        require(material.shear_modulus > 0, "constants.mu", material.shear_modulus, "> 0 Pa");
        require(3 * material.lame_lambda + 2 * material.shear_modulus > 0, "constants.lambda", material.lame_lambda,
                "> -2/3 mu");
        return;
    }
    if (const std::string why = inadmissibility(material.constants); !why.empty())
        problems.push_back({"constants", why});
    const auto& stiffening = material.stiffening;
    require(stiffening.k >= 0, "stiffening.k", stiffening.k, ">= 0");
    require(stiffening.p_ref > 0, "stiffening.p_ref", stiffening.p_ref, "> 0 Pa");
    require(stiffening.n >= 0 && stiffening.n <= 1, "stiffening.n", stiffening.n, "in [0, 1]");
    const bool stressed = !std::all_of(material.in_situ_stress.begin(), material.in_situ_stress.end(),
                                       [](const Formula& f) { return f.is_zero(); });
    if (material.form == Form::hyper && (stressed || (stiffening.k > 0 && stiffening.n > 0)))
        problems.push_back({"form", "stress in situ and stiffening need form = \"hypo\""});
}

BlockGeometry block_geometry(const Mesh& mesh, const std::vector<std::int32_t>& elements, const SolidOptions& solid,
                             const MaterialOptions& material, std::vector<Problem>& problems) {
    check_ranges(solid, material, problems);
    BlockGeometry geometry;
    geometry.elements = elements;
    geometry.axis_angle = axis_angles(mesh, elements, material.axes, problems);
    try {
        geometry.in_situ_stress = in_situ_stress(mesh, elements, material.in_situ_stress);
    } catch (const InputError& error) {
        for (const Problem& problem : error.problems()) problems.push_back({"in_situ_stress", problem.message});
    }
    if (solid.volumetric == Volumetric::centre && mesh.kind == ElementKind::compt &&
        (material.law != LawKind::munjiza || material.stress_map != StressMap::direct))
        problems.push_back({"",
                            "volumetric = \"centre\" has no stored energy and goes only with law = \"munjiza\" and "
                            "stress_map = \"direct\""});
    geometry.plane_stress = solid.plane == Plane::stress;
    geometry.thickness = solid.thickness;
    geometry.density = material.density;
    geometry.viscosity = {material.shear_viscosity, material.bulk_viscosity};
    return geometry;
}

std::unique_ptr<ElementBlock> make_block(const Mesh& mesh, BlockGeometry geometry, const SolidOptions& solid,
                                         const MaterialOptions& material) {
    const bool direct = material.stress_map == StressMap::direct;
    if (material.law == LawKind::neo_hookean) return make_neo_hookean_block(mesh, std::move(geometry), solid, material);
    if (material.form == Form::hyper)
        return direct ? make_munjiza_hyperelastic_direct_block(mesh, std::move(geometry), solid, material)
                      : make_munjiza_hyperelastic_block(mesh, std::move(geometry), solid, material);
    return direct ? make_munjiza_hypoelastic_direct_block(mesh, std::move(geometry), solid, material)
                  : make_munjiza_hypoelastic_block(mesh, std::move(geometry), solid, material);
}

}  // namespace

std::vector<std::int32_t> material_of_elements(const Mesh& mesh, const std::vector<MaterialOptions>& materials) {
    std::vector<Problem> problems;
    const std::vector<std::int32_t> of_region = material_of_region(mesh, materials, problems);
    if (!problems.empty()) throw InputError(problems);
    std::vector<std::int32_t> of_element;
    of_element.reserve(mesh.n_elements());
    for (const std::int32_t region : mesh.region) of_element.push_back(of_region[static_cast<std::size_t>(region)]);
    return of_element;
}

std::vector<PlaneStiffness> element_stiffness(const Mesh& mesh, std::span<const std::unique_ptr<ElementBlock>> blocks) {
    std::vector<PlaneStiffness> stiffness(mesh.n_elements());
    for (const auto& block : blocks)
        for (std::size_t local = 0; local < block->n_elements(); ++local)
            stiffness[static_cast<std::size_t>(block->element(local))] =
                plane_stiffness(block->tangent_constants(local), block->axis_angle(local), block->density());
    return stiffness;
}

std::vector<std::unique_ptr<ElementBlock>> make_blocks(const Mesh& mesh, const SolidOptions& solid,
                                                       const std::vector<MaterialOptions>& materials) {
    const std::vector<std::int32_t> material_of = material_of_elements(mesh, materials);
    std::vector<Problem> problems;
    std::vector<std::unique_ptr<ElementBlock>> blocks;
    for (std::size_t m = 0; m < materials.size(); ++m) {
        const MaterialOptions& material = materials[m];
        // straight composites apart: they need a quarter of the geometry
        std::array<std::vector<std::int32_t>, 2> elements;
        for (std::size_t e = 0; e < mesh.n_elements(); ++e)
            if (material_of[e] == static_cast<std::int32_t>(m))
                elements[mesh.kind == ElementKind::compt && has_straight_sides(mesh, e)].push_back(
                    static_cast<std::int32_t>(e));
        for (const bool straight : {false, true}) {
            if (elements[straight].empty()) continue;
            std::vector<Problem> own;
            BlockGeometry geometry = block_geometry(mesh, elements[straight], solid, material, own);
            geometry.straight = straight;
            for (const Problem& problem : own) {
                const Problem here{where(m),
                                   problem.where.empty() ? problem.message : problem.where + ": " + problem.message};
                const bool known = std::any_of(problems.begin(), problems.end(),
                                               [&](const Problem& p) { return p.message == here.message; });
                if (!known) problems.push_back(here);
            }
            if (problems.empty()) blocks.push_back(make_block(mesh, std::move(geometry), solid, material));
        }
    }
    if (!problems.empty()) throw InputError(problems);
    return blocks;
}

}  // namespace gneiss
