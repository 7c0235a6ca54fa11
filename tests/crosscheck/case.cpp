#include "case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "materials/small_strain_stiffness.hpp"
#include "mesh/composite.hpp"
#include "mesh/locate.hpp"
#include "mesh/make_mesh.hpp"
#include "mesh/measure.hpp"
#include "mesh/sub_triangles.hpp"
#include "model/boundaries.hpp"
#include "model/loads.hpp"
#include "model/make_blocks.hpp"
#include "model/mesh_names.hpp"
#include "model/problem_list.hpp"
#include "refined_mesh.hpp"

namespace gneiss::crosscheck {
namespace {

// ---- what is no small-strain elasticity -----------------------------------------------------------------------------

void refuse_foreign(const CaseOptions& options, Element element, ProblemList& problems) {
    const auto refuse = [&](bool given, const std::string& where, const char* what, const char* why) {
        if (given) problems.add(where, fmt::format("{}: {}", what, why));
    };
    const char* no_motion = "nothing moves in the cross-check";
    for (std::size_t i = 0; i < options.materials.size(); ++i) {
        const MaterialOptions& m = options.materials[i];
        const std::string where = fmt::format("[[material]] {}", i + 1);
        refuse(m.law != LawKind::munjiza, where, "law", "only munjiza has the constants that the cross-check reads");
        refuse(m.stiffening.k > 0 && m.stiffening.n > 0, where, "stiffening",
               "the moduli of the cross-check are constant");
        refuse(!std::ranges::all_of(m.in_situ_stress, [](const Formula& f) { return f.is_zero(); }), where,
               "in_situ_stress", "the cross-check starts without stress");
        refuse(m.shear_viscosity > 0 || m.bulk_viscosity > 0, where, "viscosity", no_motion);
        refuse(element == Element::taylor_hood && m.law == LawKind::munjiza &&
                   !(m.constants.M_v > 0 && m.constants.M_alpha > 0 && m.constants.M_beta > 0 && m.constants.M_psi > 0),
               where, "constants", "taylor_hood divides by M_v and needs all four Munjiza constants > 0 Pa");
    }
    for (std::size_t i = 0; i < options.boundaries.size(); ++i) {
        const auto kind = options.boundaries[i].kind;
        const std::string where = fmt::format("[[boundary]] {}", i + 1);
        refuse(kind == BoundaryOptions::Kind::velocity, where, "type = \"velocity\"", no_motion);
        refuse(kind == BoundaryOptions::Kind::absorbing, where, "type = \"absorbing\"", no_motion);
    }
    refuse(!options.initial.empty(), "[[initial]]", "velocity", no_motion);
}

// ---- mesh -----------------------------------------------------------------------------------------------------------

/// Of the local nodes of an element, in coordinates in which its corners are (0, 0), (1, 0), (0, 1).
Vector unit_node(ElementKind kind, int local) {
    static constexpr std::array<Vector, 6> compt{{{0, 0}, {0.5, 0}, {1, 0}, {0.5, 0.5}, {0, 1}, {0, 0.5}}};
    return compt[static_cast<std::size_t>(kind == ElementKind::compt ? local : 2 * local)];
}

Vector unit_place(ElementKind kind, int sub_triangle, const std::array<double, 3>& weights) {
    Vector unit{0, 0};
    const SubTriangle& locals = sub_triangles(kind)[static_cast<std::size_t>(sub_triangle)];
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < 2; ++i) unit[i] += weights[k] * unit_node(kind, locals[k])[i];
    return unit;
}

/// The centroids of the sub-triangles of the deck's mesh. That of a triangle is that of its middle sub-triangle, the
/// last.
/// @param levels  how often composites have been replaced by their sub-triangles
std::vector<Place> centroids(std::size_t n_sub_triangles, ElementKind cells, int levels) {
    constexpr std::array<double, 3> middle{1.0 / 3, 1.0 / 3, 1.0 / 3};
    constexpr std::size_t last = sub_triangles_per_composite - 1;
    std::vector<Place> places;
    for (std::size_t t = 0; t < n_sub_triangles; ++t) {
        std::size_t element = t / sub_triangles_per_composite, sub = t % sub_triangles_per_composite;
        for (int level = 0; level < levels; ++level) {
            element = sub_triangles_per_composite * element + sub;
            sub = last;
        }
        if (cells == ElementKind::cst)
            places.push_back(
                {static_cast<std::int32_t>(sub_triangles_per_composite * element + sub), unit_place(cells, 0, middle)});
        else
            places.push_back({static_cast<std::int32_t>(element), unit_place(cells, static_cast<int>(sub), middle)});
    }
    return places;
}

/// As Traction wants them. A boundary may end in the middle of a composite's side.
std::vector<std::array<std::int32_t, 2>> sides(const Mesh& cells, const std::vector<BoundaryEdge>& edges) {
    std::vector<std::array<std::int32_t, 2>> all;
    for (const BoundaryEdge& edge : edges) {
        if (cells.kind == ElementKind::cst) {
            all.push_back({edge.a, edge.b});
            continue;
        }
        const std::int32_t* nodes = cells.element(static_cast<std::size_t>(edge.element));
        for (const auto& [from, mid, to] : composite_sides)
            if (nodes[from] == edge.a && nodes[mid] == edge.b)
                all.push_back({nodes[from], nodes[to]});
            else if (nodes[mid] == edge.a && nodes[to] == edge.b)
                all.push_back({nodes[to], nodes[from]});
    }
    return all;
}

// ---- what the deck puts on it ---------------------------------------------------------------------------------------

/// Voigt's matrix of M_alpha, M_beta and M_psi, turned from the material axes to x and y.
Stiffness stiffness(MunjizaConstants constants, double angle) {
    Stiffness result{constants.M_v, {}};
    constants.M_v = 0;
    const double c = std::cos(angle), s = std::sin(angle);
    // strains (alpha, beta, 2 alpha beta) from (xx, yy, 2 xy)
    const Eigen::Matrix3d turn{{c * c, s * s, c * s}, {s * s, c * c, -c * s}, {-2 * c * s, 2 * c * s, c * c - s * s}};
    const Eigen::Matrix3d rest = turn.transpose() * small_strain_stiffness(constants) * turn;
    for (Eigen::Index i = 0; i < 3; ++i)
        for (Eigen::Index j = 0; j < 3; ++j)
            result.rest[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = rest(i, j);
    return result;
}

std::vector<Stiffness> stiffnesses(const Mesh& cells, const CaseOptions& options) {
    SolidOptions solid = options.solid;
    solid.compt = cells.kind == ElementKind::compt;
    std::vector<Stiffness> all(cells.n_elements());
    for (const auto& block : make_blocks(cells, solid, options.materials))
        for (std::size_t local = 0; local < block->n_elements(); ++local)
            all[static_cast<std::size_t>(block->element(local))] =
                stiffness(block->tangent_constants(local), block->axis_angle(local));
    return all;
}

/// A jump at the end of the run has not happened in it.
double last_event(double t_end) { return std::nextafter(t_end, -std::numeric_limits<double>::infinity()); }

std::vector<Prescribed> prescribed(const Mesh& cells, const CaseOptions& options) {
    const ConstraintSet set = make_constraints(cells, options.boundaries);
    std::vector<double> values(set.constraints().size());
    set.values(options.run.t_end, last_event(options.run.t_end), values);
    std::vector<Prescribed> all;
    for (std::size_t i = 0; i < values.size(); ++i) all.push_back({set.constraints()[i].dof, values[i]});
    return all;
}

/// A load's value times its amplitude at the end of the run.
class LoadValue {
public:
    LoadValue(const LoadOptions& load, double t_end)
        : value_{CompiledFormula(load.value[0], "xy"), CompiledFormula(load.value[1], "xy")},
          amplitude_(load.amplitude),
          t_end_(t_end) {}

    Vector operator()(const Vector& at) const {
        const double a = amplitude_.value(t_end_, last_event(t_end_), at[0], at[1]);
        return {a * value_[0](at[0], at[1]), a * value_[1](at[0], at[1])};
    }

private:
    std::array<CompiledFormula, 2> value_;
    Amplitude amplitude_;
    double t_end_;
};

void add_load(const Mesh& mesh, const Mesh& cells, const LoadOptions& load, double t_end, Elasticity& problem) {
    const LoadValue value(load, t_end);
    switch (load.kind) {
        case LoadOptions::Kind::nodal_force:
            for (const std::int32_t node : nodes_named(mesh, load.on)) {
                const auto index = static_cast<std::size_t>(node);
                problem.nodal_forces.push_back({index, value(mesh.nodes[index])});
            }
            break;
        case LoadOptions::Kind::traction:
            problem.tractions.push_back({sides(cells, boundary_named(cells, load.on)),
                                         [value](const Vector& at, const Vector&) { return value(at); }});
            break;
        case LoadOptions::Kind::pressure:
            problem.tractions.push_back(
                {sides(cells, boundary_named(cells, load.on)), [value](const Vector& at, const Vector& normal) {
                     const double p = value(at)[0];
                     return Vector{-p * normal[0], -p * normal[1]};
                 }});
            break;
        case LoadOptions::Kind::body_force: {
            std::vector<std::int32_t> loaded;
            if (load.on.empty())
                for (std::size_t c = 0; c < cells.n_elements(); ++c) loaded.push_back(static_cast<std::int32_t>(c));
            else
                loaded = elements_named(cells, load.on);
            problem.body_forces.push_back({std::move(loaded), value});
            break;
        }
    }
}

}  // namespace

ElasticCase elastic_case(const CaseOptions& options, Element element, int refine) {
    ProblemList problems;
    refuse_foreign(options, element, problems);
    const Mesh mesh = make_mesh(options.mesh, true, {});
    ElasticCase result;
    result.nodes = mesh.nodes;
    result.n_sub_triangles = sub_triangles_per_composite * mesh.n_elements();
    bool straight = true;
    for (std::size_t e = 0; e < mesh.n_elements(); ++e) straight = straight && has_straight_sides(mesh, e);
    result.composites_are_cells = element != Element::p1 && straight;
    const int levels = refine + (element != Element::p1 && !straight);

    Mesh cells = mesh;
    for (int level = 0; level < levels; ++level) cells = refined(cells);
    if (element == Element::p1) cells = split_composites(cells);

    Elasticity& problem = result.problem;
    problem.element = element;
    problem.thickness = options.solid.thickness;
    problem.nodes = cells.nodes;
    problem.cells = cells.connectivity;
    problem.stress_at = centroids(result.n_sub_triangles, cells.kind, levels);
    problems.attempt("[[material]]", [&] { problem.stiffness = stiffnesses(cells, options); });
    problems.attempt("[[boundary]]", [&] { problem.prescribed = prescribed(cells, options); });
    for (std::size_t i = 0; i < options.loads.size(); ++i)
        problems.attempt(fmt::format("[[load]] {}", i + 1),
                         [&] { add_load(mesh, cells, options.loads[i], options.run.t_end, problem); });
    for (const ProbeOptions& probe : options.output.probes)
        problems.attempt(fmt::format("output.probes `{}`", probe.name), [&] {
            const MeshPoint point = locate(cells, probe.at);
            problem.displacement_at.push_back(
                {static_cast<std::int32_t>(point.element), unit_place(cells.kind, point.sub_triangle, point.weights)});
            result.probe_names.push_back(probe.name);
        });
    problems.throw_if_any();
    return result;
}

}  // namespace gneiss::crosscheck
