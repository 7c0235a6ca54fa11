#include "mesh/gmsh_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <unordered_map>

#include "mesh/check.hpp"
#include "mesh/geo_file.hpp"
#include "mesh/geometry.hpp"
#include "mesh/gmsh_session.hpp"
#include "mesh/loose.hpp"
#include "mesh/mesh_file_kind.hpp"

namespace gneiss {
namespace {

namespace fs = std::filesystem;

constexpr const char* default_region = "solid";  // of surfaces in no group

constexpr int line_2 = 1, triangle_3 = 2, line_3 = 8, triangle_6 = 9;  // Gmsh's numbers of element types

std::string type_name(int type) {
    std::string name;
    int dim, order, n_nodes, n_primary;
    std::vector<double> coordinates;
    gmsh::model::mesh::getElementProperties(type, name, dim, order, n_nodes, coordinates, n_primary);
    return name;
}

/// Turns Gmsh's current model into a draft and collects what is wrong with it on the way.
class ModelReader {
public:
    /// @param is_version_2  of the format, or 1: groups are told of elements, not of surfaces
    ModelReader(const std::string& where, bool is_version_2) : is_version_2_(is_version_2) { draft_.where = where; }

    MeshDraft read() {
        refuse_solids();
        read_nodes();
        read_triangles();
        check_plane();
        read_lines();
        read_points();
        if (problems_.empty()) read_data();
        if (!problems_.empty()) throw InputError(problems_);
        return std::move(draft_);
    }

private:
    using Tags = std::vector<std::size_t>;

    void error(std::string message) { problems_.push_back({draft_.where, std::move(message)}); }

    static std::string group_name(int dim, int group) {
        std::string name;
        gmsh::model::getPhysicalName(dim, group, name);
        return name.empty() ? std::to_string(group) : name;
    }

    /// Calls visit(type, elements, nodes) for each kind of element on an entity; tag -1: on all of the dimension.
    template <class Visit>
    static void for_each_type(int dim, int tag, Visit&& visit) {
        std::vector<int> types;
        std::vector<Tags> elements, nodes;
        gmsh::model::mesh::getElements(types, elements, nodes, dim, tag);
        for (std::size_t i = 0; i < types.size(); ++i) visit(types[i], elements[i], nodes[i]);
    }

    /// Calls visit(name, entity) for the members of every physical group.
    template <class Visit>
    static void for_each_member(int dim, Visit&& visit) {
        gmsh::vectorpair groups;
        gmsh::model::getPhysicalGroups(groups, dim);
        for (const auto& [group_dim, group] : groups) {
            std::vector<int> entities;
            gmsh::model::getEntitiesForPhysicalGroup(dim, group, entities);
            for (int entity : entities) visit(group_name(dim, group), entity);
        }
    }

    void refuse(int type, const Tags& elements) {
        error(fmt::format("only triangles of 3 or 6 nodes are read: element {} is a {} ({} such)", elements.at(0),
                          type_name(type), elements.size()));
    }

    void refuse_solids() {
        for_each_type(3, -1, [&](int type, const Tags& elements, const Tags&) { refuse(type, elements); });
    }

    void read_nodes() {
        Tags tags;
        std::vector<double> x, parametric;
        gmsh::model::mesh::getNodes(tags, x, parametric, -1, -1, false, false);
        for (std::size_t n = 0; n < tags.size(); ++n) {
            const Point2 at{x[3 * n], x[3 * n + 1]};
            const auto [entry, is_new] = number_of_node_.emplace(tags[n], static_cast<std::int32_t>(n));
            if (!is_new && draft_.nodes[static_cast<std::size_t>(entry->second)] != at)
                error(fmt::format(
                    "two nodes have the number {}: nodes are numbered from 1 (Gmsh takes a node 0 for node 1)",
                    tags[n]));
            draft_.nodes.push_back(at);
            draft_.node_labels.push_back(static_cast<std::int64_t>(tags[n]));
            heights_.push_back(x[3 * n + 2]);
        }
    }

    void check_plane() {
        const std::vector<std::int64_t> off = off_plane(draft_, heights_);
        if (!off.empty())
            error(fmt::format("the mesh must lie in a plane z = constant: node {} does not ({} such)", off[0],
                              off.size()));
    }

    std::int32_t node(std::size_t tag) const { return number_of_node_.at(tag); }

    void read_triangles() {
        std::map<int, std::vector<std::string>> groups_of_surface;
        for_each_member(2, [&](const std::string& name, int surface) {
            auto& groups = groups_of_surface[surface];
            if (std::find(groups.begin(), groups.end(), name) == groups.end()) groups.push_back(name);
        });
        std::vector<int> without_group;
        std::size_t n_without = 0;
        gmsh::vectorpair surfaces;
        gmsh::model::getEntities(surfaces, 2);
        for (const auto& [dim, surface] : surfaces) {
            const auto groups = groups_of_surface.find(surface);
            for_each_type(2, surface, [&](int type, const Tags& elements, const Tags& nodes) {
                if (type != triangle_3 && type != triangle_6) {
                    refuse(type, elements);
                    return;
                }
                if (groups != groups_of_surface.end() && groups->second.size() > 1 && is_version_2_ &&
                    !has_repeated(nodes, type == triangle_3 ? 3 : 6))
                    error(
                        fmt::format("elements of groups \"{}\" share the geometrical tag {}, and Gmsh puts all of them "
                                    "in each group: "
                                    "give every group geometrical tags of its own (meshio: cell_data "
                                    "\"gmsh:geometrical\", equal to "
                                    "\"gmsh:physical\"), or write version 4.1",
                                    fmt::join(groups->second, "\", \""), surface));
                if (groups == groups_of_surface.end()) {
                    if (without_group.empty() || without_group.back() != surface) without_group.push_back(surface);
                    n_without += elements.size();
                }
                add_triangles(type, elements, nodes,
                              groups == groups_of_surface.end() ? draft_.region_of({default_region})
                                                                : draft_.region_of(groups->second));
            });
        }
        if (!without_group.empty() && !groups_of_surface.empty())
            draft_.warnings.push_back(fmt::format(
                "{} triangles on {}, in no physical group while others are in some: they are region \"{}\"", n_without,
                numbered("surface", {without_group.begin(), without_group.end()}), default_region));
    }

    /// Whether elements come more than once: version 2 writes them once for each of their groups.
    static bool has_repeated(const Tags& nodes, std::size_t per_element) {
        std::set<std::vector<std::size_t>> seen;
        for (std::size_t first = 0; first < nodes.size(); first += per_element)
            if (!seen.emplace(nodes.begin() + static_cast<std::ptrdiff_t>(first),
                              nodes.begin() + static_cast<std::ptrdiff_t>(first + per_element))
                     .second)
                return true;
        return false;
    }

    /// Gmsh numbers the corners first, then the mid-sides after corner 1, 2 and 3.
    void add_triangles(int type, const Tags& elements, const Tags& nodes, std::int32_t region) {
        const std::size_t n = type == triangle_3 ? 3 : 6;
        std::set<std::vector<std::size_t>> seen;  // those of version 2 come once for each of their groups
        for (std::size_t e = 0; e < elements.size(); ++e) {
            const auto first = nodes.begin() + static_cast<std::ptrdiff_t>(n * e);
            if (is_version_2_ && !seen.emplace(first, first + static_cast<std::ptrdiff_t>(n)).second) continue;
            std::array<std::int32_t, 6> element;
            for (std::size_t i = 0; i < 3; ++i) {
                element[2 * i] = node(nodes[n * e + i]);
                element[2 * i + 1] = n == 6 ? node(nodes[n * e + 3 + i]) : MeshDraft::no_node;
            }
            draft_.elements.push_back(element);
            draft_.element_labels.push_back(static_cast<std::int64_t>(elements[e]));
            draft_.region.push_back(region);
        }
    }

    void read_lines() {
        for_each_member(1, [&](const std::string& name, int curve) {
            for_each_type(1, curve, [&](int type, const Tags& elements, const Tags& nodes) {
                if (type != line_2 && type != line_3) {
                    refuse(type, elements);
                    return;
                }
                const std::size_t n = type == line_2 ? 2 : 3;
                for (std::size_t e = 0; e < elements.size(); ++e)
                    draft_.lines[name].push_back({node(nodes[n * e]),
                                                  n == 3 ? node(nodes[n * e + 2]) : MeshDraft::no_node,
                                                  node(nodes[n * e + 1])});
            });
        });
    }

    void read_points() {
        for_each_member(0, [&](const std::string& name, int point) {
            for_each_type(0, point, [&](int, const Tags&, const Tags& nodes) {
                for (std::size_t tag : nodes) draft_.points[name].push_back(node(tag));
            });
        });
    }

    /// Data are no reason to refuse a mesh: what cannot be taken is warned of, and is an error where a deck asks for
    /// it.
    void read_data() {
        std::vector<int> views;
        gmsh::view::getTags(views);
        for (int view : views) {
            const std::string name = view_name(view);
            std::string kind;
            Tags tags;
            std::vector<std::vector<double>> rows;
            double time;
            int n_components = 0;
            gmsh::view::getModelData(view, 0, kind, tags, rows, time, n_components);
            if (kind.empty()) continue;  // a view that a script has made: sizes of elements, say
            if (kind != "ElementData") {
                draft_.warnings.push_back(fmt::format("{} \"{}\" is not read: only ElementData is", kind, name));
                continue;
            }
            std::unordered_map<std::size_t, double> value_of;
            for (std::size_t i = 0; i < tags.size() && n_components == 1; ++i) value_of[tags[i]] = rows[i].at(0);
            if (draft_.element_data.contains(name)) {
                value_of.clear();
                draft_.warnings.push_back(fmt::format("element data \"{}\" are given twice: neither is taken", name));
            }
            if (n_components != 1)
                draft_.warnings.push_back(
                    fmt::format("element data \"{}\" have {} components: only one is read", name, n_components));
            draft_.element_data[name] = values_of_elements(name, value_of);
        }
    }

    /// @param value_of  by label; empty: none can be taken, which has been said
    std::vector<double> values_of_elements(const std::string& name,
                                           const std::unordered_map<std::size_t, double>& value_of) {
        std::vector<double> values;
        std::vector<std::int64_t> missing;
        for (std::int64_t label : draft_.element_labels) {
            const auto at = value_of.find(static_cast<std::size_t>(label));
            values.push_back(at == value_of.end() ? std::numeric_limits<double>::quiet_NaN() : at->second);
            if (at == value_of.end()) missing.push_back(label);
        }
        if (!missing.empty() && !value_of.empty())
            draft_.warnings.push_back(
                fmt::format("element data \"{}\" have no number for {}", name, numbered("element", missing)));
        return values;
    }

    static std::string view_name(int tag) {
        const int index = gmsh::view::getIndex(tag);
        std::string name;
        gmsh::option::getString(fmt::format("View[{}].Name", index), name);
        return name;
    }

    MeshDraft draft_;
    const bool is_version_2_;
    std::vector<Problem> problems_;
    std::vector<double> heights_;  ///< z of the draft's nodes, m
    std::unordered_map<std::size_t, std::int32_t> number_of_node_;
};

}  // namespace

MeshDraft draft_of_current_model(const std::string& where) { return ModelReader(where, false).read(); }

namespace {

/// Whether groups are told of elements: so it was up to version 2.2.
bool is_version_2(const fs::path& file) {
    std::ifstream stream(file);
    std::string word;
    stream >> word;
    double version = 0;
    if (word == "$MeshFormat") stream >> version;
    constexpr double first_with_entities = 3;
    return version < first_with_entities;
}

/// @throws InputError if the file is of another program that ends its meshes in .msh too; Gmsh would take it for a
/// script
void check_msh(const fs::path& file) {
    std::ifstream stream(file);
    if (!stream) throw InputError(file.string(), "cannot be opened for reading");
    char first = 0;
    if (!(stream >> first)) throw InputError(file.string(), "is empty");
    if (first == '$') return;
    if (first == '(')
        throw InputError(
            file.string(),
            "is a mesh of ANSYS Fluent, not of Gmsh: \"meshio convert --input-format ansys --output-format "
            "gmsh\" makes one of it");
    throw InputError(file.string(), "is no mesh of Gmsh: the file does not begin with $MeshFormat");
}

/// Gmsh's word on a view that does not belong to a mesh.
bool is_list_of_a_script(const std::string& error) { return error.find("contain model data") != std::string::npos; }

/// Partitions in a file of version 2 that Gmsh cannot follow: it goes on without, and they are of no use here.
bool is_about_partitions(const std::string& error) {
    return error.find("All elements are not partitioned") != std::string::npos ||
           error.find("Partition tag cannot be") != std::string::npos;
}

}  // namespace

MeshDraft read_gmsh(const fs::path& file, const std::map<std::string, double>& parameters, bool aloud) {
    const std::string where = file.string();
    if (!fs::is_regular_file(file)) throw InputError(where, "there is no such file");
    const bool is_geo = mesh_file_kind(file) == MeshFileKind::geo;
    if (!is_geo) check_msh(file);
    GmshSession session(aloud);
    if (is_geo)
        mesh_geo(session, file, parameters);
    else
        session.run(
            where, [&] { gmsh::merge(where); }, is_about_partitions);
    const std::vector<std::string> warnings = session.warnings();
    MeshDraft draft = session.run(
        where, [&] { return ModelReader(where, !is_geo && is_version_2(file)).read(); }, is_list_of_a_script);
    draft.report_unused_nodes = !is_geo;  // a .geo has construction points, the centres of arcs for one
    draft.warnings.insert(draft.warnings.end(), warnings.begin(), warnings.end());
    drop_loose_names(draft);
    add_mid_sides(draft);
    return draft;
}

}  // namespace gneiss
