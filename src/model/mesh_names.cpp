#include "model/mesh_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/errors.hpp"
#include "base/suggest.hpp"
#include "mesh/regions.hpp"

namespace gneiss {
namespace {

template <class Map>
std::vector<std::string> keys(const Map& map) {
    std::vector<std::string> names;
    for (const auto& [name, unused] : map) names.push_back(name);
    return names;
}

bool is_region(const Mesh& mesh, const std::string& name) { return !regions_named(mesh, name).empty(); }

/// @param wanted  "boundary", "nodes", "region", "line inside the solid": what the name should have been
InputError unknown_name(const Mesh& mesh, const std::string& name, const std::string& wanted,
                        const std::vector<std::string>& names) {
    std::string message = fmt::format("on = \"{}\": ", name);
    if (is_region(mesh, name)) {
        message += fmt::format("this is a region, needed: {}", wanted);
    } else if (mesh.boundaries.contains(name)) {
        message += fmt::format("this is a boundary, needed: {}", wanted);
    } else if (mesh.inner_lines.contains(name)) {
        message += fmt::format("this is a line inside the solid, needed: {}", wanted);
    } else if (mesh.node_sets.contains(name)) {
        message += fmt::format("these are nodes, needed: {}", wanted);
    } else {
        message += fmt::format("the mesh has no {} of this name", wanted);
    }
    if (names.empty()) return {"", message + "; there are none"};
    message += fmt::format("; there are: \"{}\"", fmt::join(names, "\", \""));
    if (const std::string_view meant = nearest(name, {names.begin(), names.end()}); !meant.empty()) {
        message += fmt::format("; did you mean \"{}\"?", meant);
    }
    return {"", message};
}

std::vector<std::int32_t> nodes_of(const Mesh& mesh, const std::vector<std::int32_t>& elements) {
    std::vector<std::int32_t> nodes;
    for (std::int32_t e : elements) {
        const std::int32_t* first = mesh.element(static_cast<std::size_t>(e));
        nodes.insert(nodes.end(), first, first + mesh.nodes_per_element());
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
}

}  // namespace

const std::vector<BoundaryEdge>& boundary_named(const Mesh& mesh, const std::string& name) {
    const auto found = mesh.boundaries.find(name);
    if (found == mesh.boundaries.end()) throw unknown_name(mesh, name, "boundary", keys(mesh.boundaries));
    return found->second;
}

const std::vector<ElementSide>& inner_line_named(const Mesh& mesh, const std::string& name) {
    const auto found = mesh.inner_lines.find(name);
    if (found == mesh.inner_lines.end())
        throw unknown_name(mesh, name, "line inside the solid", keys(mesh.inner_lines));
    return found->second;
}

const std::vector<std::int32_t>& nodes_named(const Mesh& mesh, const std::string& name) {
    const auto found = mesh.node_sets.find(name);
    if (found == mesh.node_sets.end()) throw unknown_name(mesh, name, "boundary or nodes", keys(mesh.node_sets));
    return found->second;
}

std::vector<std::int32_t> elements_named(const Mesh& mesh, const std::string& region) {
    const std::vector<std::int32_t> wanted = regions_named(mesh, region);
    if (wanted.empty()) throw unknown_name(mesh, region, "region", names_of_regions(mesh));
    std::vector<std::int32_t> elements;
    for (std::size_t e = 0; e < mesh.n_elements(); ++e) {
        if (std::ranges::binary_search(wanted, mesh.region[e])) elements.push_back(static_cast<std::int32_t>(e));
    }
    return elements;
}

std::vector<std::int32_t> region_or_nodes_named(const Mesh& mesh, const std::string& name) {
    const auto set = mesh.node_sets.find(name);
    if (is_region(mesh, name)) {
        std::vector<std::int32_t> nodes = nodes_of(mesh, elements_named(mesh, name));
        // a curve called like its surface, or points on it, add nothing
        if (set != mesh.node_sets.end() && !std::ranges::includes(nodes, set->second)) {
            throw InputError("", fmt::format("on = \"{}\": both a region and a set of nodes have this name", name));
        }
        return nodes;
    }
    if (set != mesh.node_sets.end()) return set->second;
    std::vector<std::string> names = names_of_regions(mesh);
    for (const std::string& other : keys(mesh.node_sets)) {
        if (!is_region(mesh, other)) names.push_back(other);
    }
    throw unknown_name(mesh, name, "region, boundary or nodes", names);
}

}  // namespace gneiss
