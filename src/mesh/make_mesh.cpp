#include "mesh/make_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "base/errors.hpp"
#include "mesh/abaqus_reader.hpp"
#include "mesh/boundary.hpp"
#include "mesh/boundary_parts.hpp"
#include "mesh/check.hpp"
#include "mesh/composite.hpp"
#include "mesh/generators.hpp"
#include "mesh/inner_lines.hpp"
#include "mesh/mesh_file_kind.hpp"
#include "mesh/mesh_process.hpp"

namespace gneiss {
namespace {

using NodePair = std::pair<std::int32_t, std::int32_t>;

MeshDraft draft_of(const MeshOptions& options, const std::filesystem::path& base_dir) {
    switch (options.source) {
        case MeshOptions::Source::file:
            return mesh_file_kind(options.file) == MeshFileKind::abaqus
                       ? read_abaqus(base_dir / options.file)
                       : read_gmsh_apart(base_dir / options.file, options.parameters);
        case MeshOptions::Source::rectangle:
            return rectangle(options);
        case MeshOptions::Source::quadrilateral:
            return quadrilateral(options);
        case MeshOptions::Source::plate_with_hole:
            break;
    }
    return options.layout == MeshOptions::Layout::structured ? structured_plate_with_hole(options)
                                                             : free_plate_with_hole(options);
}

/// The contour edges along a line, with their element and the solid on the left.
std::vector<BoundaryEdge> edges_along(const std::vector<std::array<std::int32_t, 3>>& line,
                                      const std::map<NodePair, BoundaryEdge>& contour_edges) {
    std::map<NodePair, BoundaryEdge> found;  // a side that the line names twice counts once
    for (const auto& [from, mid, to] : line)
        for (const NodePair& ends : {NodePair(std::minmax(from, mid)), NodePair(std::minmax(mid, to))})
            if (const auto edge = contour_edges.find(ends); edge != contour_edges.end()) found.insert(*edge);
    std::vector<BoundaryEdge> edges;
    for (const auto& [ends, edge] : found) edges.push_back(edge);
    return in_walking_order(edges);
}

/// The sides along each line that are not on the contour.
std::map<std::string, std::vector<ElementSide>> sides_inside(const Mesh& composites, const MeshDraft& draft,
                                                             const std::map<NodePair, BoundaryEdge>& contour_edges) {
    std::map<NodePair, std::set<std::string>> names_of;  // by the corners of a side
    for (const auto& [name, line] : draft.lines)
        for (const auto& [from, mid, to] : line)
            if (!contour_edges.contains(NodePair(std::minmax(from, mid))))
                names_of[NodePair(std::minmax(from, to))].insert(name);
    std::map<std::string, std::vector<ElementSide>> inside;
    for (std::int32_t e = 0; e < static_cast<std::int32_t>(composites.n_elements()) && !names_of.empty(); ++e) {
        const std::int32_t* nodes = composites.element(static_cast<std::size_t>(e));
        for (int side = 0; side < 3; ++side) {
            const auto& local = composite_sides[static_cast<std::size_t>(side)];
            const auto found = names_of.find(NodePair(std::minmax(nodes[local.front()], nodes[local.back()])));
            if (found == names_of.end()) continue;
            for (const std::string& name : found->second) inside[name].push_back({e, side});
            names_of.erase(found);  // the element across it has the higher number
        }
    }
    return inside;
}

std::vector<std::int32_t> ascending(std::vector<std::int32_t> nodes) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
}

void name_boundaries(Mesh& mesh, const MeshDraft& draft, MeshReport& report) {
    const std::vector<BoundaryEdge> whole = contour(mesh);
    std::map<NodePair, BoundaryEdge> contour_edges;
    for (const BoundaryEdge& edge : whole) contour_edges.emplace(NodePair(std::minmax(edge.a, edge.b)), edge);
    for (const auto& [name, line] : draft.lines) {
        std::vector<std::int32_t> nodes;
        for (const auto& side : line) nodes.insert(nodes.end(), side.begin(), side.end());
        mesh.node_sets[name] = ascending(std::move(nodes));
        const std::vector<BoundaryEdge> edges = edges_along(line, contour_edges);
        if (!edges.empty()) mesh.boundaries[name] = edges;
        if (!edges.empty() && nodes_of(edges).size() < mesh.node_sets[name].size())
            report.warnings.push_back(
                fmt::format("curve \"{}\" runs inside the solid in part: tractions act on the rest of it alone, "
                            "cracks and interfaces on that part",
                            name));
    }
    mesh.inner_lines = sides_inside(mesh, draft, contour_edges);
    for (const auto& [name, nodes] : draft.points) {  // names are per dimension: a curve may have the same
        std::vector<std::int32_t>& set = mesh.node_sets[name];
        const std::size_t of_curve = set.size();
        set.insert(set.end(), nodes.begin(), nodes.end());
        set = ascending(std::move(set));
        if (of_curve > 0 && set.size() > of_curve)
            report.warnings.push_back(fmt::format(
                "\"{}\" names a curve and points beside it: tractions act on the curve, conditions on nodes on both",
                name));
    }
    if (mesh.node_sets.count("boundary") == 0) {
        mesh.boundaries["boundary"] = whole;
        mesh.node_sets["boundary"] = nodes_of(whole);
    }
    if (draft.lines.empty()) name_sides_of_rectangle(mesh, whole);
}

/// The two sides of sub-triangles that each side of a composite becomes.
std::vector<ElementSide> sides_of_sub_triangles(const Mesh& composites, const Mesh& triangles,
                                                const std::vector<ElementSide>& sides) {
    std::vector<ElementSide> split;
    for (const auto& [element, side] : sides) {
        const std::int32_t* nodes = composites.element(static_cast<std::size_t>(element));
        const auto& local = composite_sides[static_cast<std::size_t>(side)];
        for (std::int32_t cst = sub_triangles_per_composite * element;
             cst < sub_triangles_per_composite * (element + 1); ++cst) {
            const std::int32_t* corners = triangles.element(static_cast<std::size_t>(cst));
            for (int k = 0; k < 3; ++k)
                for (std::size_t half = 0; half < 2; ++half)
                    if (corners[k] == nodes[local[half]] && corners[(k + 1) % 3] == nodes[local[half + 1]])
                        split.push_back({cst, k});
        }
    }
    return split;
}

}  // namespace

Mesh make_mesh(const MeshOptions& options, bool compt, const std::filesystem::path& base_dir, MeshReport* report) {
    if (std::vector<Problem> problems = validate(options); !problems.empty()) throw InputError(std::move(problems));
    MeshDraft draft = draft_of(options, base_dir);
    if (!options.curved) straighten_sides(draft);
    MeshReport own;
    Mesh mesh = finish(std::move(draft), compt, report ? *report : own);
    name_parts(mesh, options.parts);
    name_lines(mesh, options.lines);
    return mesh;
}

Mesh finish(MeshDraft draft, bool compt, MeshReport& report) {
    report.warnings.insert(report.warnings.end(), draft.warnings.begin(), draft.warnings.end());
    orient(draft);
    if (std::vector<std::int64_t> folded = straighten_folded(draft); !folded.empty())
        report.warnings.push_back(
            fmt::format("sides made straight, since their mid-side nodes turned a sub-triangle inside out: {}",
                        numbered("element", folded)));
    if (std::vector<Problem> problems = check(draft, report.warnings); !problems.empty())
        throw InputError(std::move(problems));
    renumber(draft);

    Mesh mesh;
    mesh.kind = ElementKind::compt;
    mesh.nodes = std::move(draft.nodes);
    mesh.node_labels = std::move(draft.node_labels);
    mesh.connectivity.reserve(composite_nodes * draft.elements.size());
    for (const auto& element : draft.elements)
        mesh.connectivity.insert(mesh.connectivity.end(), element.begin(), element.end());
    mesh.element_labels = std::move(draft.element_labels);
    mesh.region = std::move(draft.region);
    mesh.region_names = std::move(draft.region_names);
    mesh.element_data = std::move(draft.element_data);
    name_boundaries(mesh, draft, report);
    return compt ? mesh : split_composites(mesh);
}

Mesh split_composites(const Mesh& composites) {
    Mesh mesh = composites;
    mesh.kind = ElementKind::cst;
    mesh.connectivity.clear();
    mesh.connectivity.reserve(composites.n_elements() * 3 * sub_triangles_per_composite);
    for (std::size_t e = 0; e < composites.n_elements(); ++e)
        for (const SubTriangle& abc : composite_sub_triangles)
            for (int i : counter_clockwise(abc)) mesh.connectivity.push_back(composites.element(e)[i]);

    const auto repeat = [](auto& values) {
        auto repeated = values;
        repeated.clear();
        repeated.reserve(values.size() * sub_triangles_per_composite);
        for (const auto& value : values) repeated.insert(repeated.end(), sub_triangles_per_composite, value);
        values = std::move(repeated);
    };
    repeat(mesh.region);
    repeat(mesh.element_labels);
    for (auto& [name, values] : mesh.element_data) repeat(values);

    for (auto& [name, edges] : mesh.boundaries)
        for (BoundaryEdge& edge : edges)
            for (int sub = 0; sub < sub_triangles_per_composite; ++sub) {
                const std::int32_t cst = sub_triangles_per_composite * edge.element + sub;
                const std::int32_t* nodes = mesh.element(static_cast<std::size_t>(cst));
                const auto has = [&](std::int32_t node) { return std::find(nodes, nodes + 3, node) != nodes + 3; };
                if (has(edge.a) && has(edge.b)) {
                    edge.element = cst;
                    break;
                }
            }
    for (auto& [name, sides] : mesh.inner_lines) sides = sides_of_sub_triangles(composites, mesh, sides);
    return mesh;
}

}  // namespace gneiss
