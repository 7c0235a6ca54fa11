#include "mesh/gmsh_reader.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <system_error>
#include <unordered_map>

#include "mesh/check.hpp"
#include "mesh/gmsh_session.hpp"

namespace gneiss {
namespace {

namespace fs = std::filesystem;

/// A file that is gone when the reader is.
class TemporaryFile {
public:
    explicit TemporaryFile(const std::string& text) {
        std::string name = (fs::temp_directory_path() / "gneiss-XXXXXX.geo").string();
        constexpr int suffix_length = 4;
        const int descriptor = mkstemps(name.data(), suffix_length);
        if (descriptor < 0) throw std::system_error(errno, std::generic_category(), "temporary file " + name);
        close(descriptor);
        path_ = name;
        std::ofstream(path_) << text;
    }
    ~TemporaryFile() {
        std::error_code ignored;
        fs::remove(path_, ignored);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    std::string path() const { return path_.string(); }

private:
    fs::path path_;
};

std::string text_of(const fs::path& file) {
    std::ifstream stream(file);
    if (!stream) throw InputError(file.string(), "cannot be opened for reading");
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// The text with // and /* */ comments blanked out. A string that holds // loses its end, which does no harm below.
std::string without_comments(std::string text) {
    for (std::size_t at = 0; (at = text.find('/', at)) != std::string::npos && at + 1 < text.size();) {
        std::size_t end = at + 1;
        if (text[at + 1] == '/')
            end = text.find('\n', at);
        else if (text[at + 1] == '*')
            end = std::min(text.find("*/", at + 2), text.size() - 2) + 2;
        end = std::min(end, text.size());
        if (end > at + 1) std::fill(text.begin() + static_cast<long>(at), text.begin() + static_cast<long>(end), ' ');
        at = end;
    }
    return text;
}

bool is_name_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

bool is_name(const std::string& text) {
    return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) == 0 &&
           std::all_of(text.begin(), text.end(), is_name_character);
}

bool has_word(const std::string& text, const std::string& word) {
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        const bool starts = at == 0 || !is_name_character(text[at - 1]);
        if (starts && (end == text.size() || !is_name_character(text[end]))) return true;
    }
    return false;
}

/// What would go wrong unseen: Gmsh skips a last line without line break, Exit ends the whole process, and parameters
/// that nobody asks for are taken in silence.
void check_geo(const fs::path& file, const std::map<std::string, double>& parameters) {
    const std::string text = text_of(file);
    const std::string geo = without_comments(text);
    const bool reads_others = has_word(geo, "Include") || has_word(geo, "Merge");  // a parameter may be used there
    std::vector<Problem> problems;
    if (!text.empty() && text.back() != '\n')
        problems.push_back({file.string(), "the last line does not end in a line break: Gmsh would skip it"});
    if (has_word(geo, "Exit"))
        problems.push_back({file.string(), "the statement Exit would end the program: use Abort, or take it out"});
    for (const auto& [name, value] : parameters) {
        if (!is_name(name))
            problems.push_back({file.string(), fmt::format("parameter \"{}\" is not a name that Gmsh can read", name)});
        else if (!reads_others && !has_word(geo, name))
            problems.push_back({file.string(), fmt::format("parameter \"{}\" does not occur in the file", name)});
    }
    if (!problems.empty()) throw InputError(problems);
}

void mesh_geo(const GmshSession& session, const fs::path& file, const std::map<std::string, double>& parameters) {
    const std::string where = file.string();
    check_geo(file, parameters);
    // Gmsh refuses to read an empty file: a comment makes sure that there is something.
    std::string definitions = "// parameters\n", comparisons = definitions;
    for (const auto& [name, value] : parameters) {
        definitions += fmt::format("{} = {:.17g};\n", name, value);
        comparisons += fmt::format(
            "If({0} != {1:.17g})\n Error(\"parameter {0} is overwritten by the file: define it there by "
            "DefineConstant[ {0} = ... ]\");\nEndIf\n",
            name, value);
    }
    const TemporaryFile before(definitions), after(comparisons);
    session.run(where, [&] {
        gmsh::merge(before.path());
        gmsh::merge(where);
        gmsh::merge(after.path());
        std::vector<int> types;
        std::vector<std::vector<std::size_t>> elements, nodes;
        gmsh::model::mesh::getElements(types, elements, nodes, 2);
        if (types.empty()) gmsh::model::mesh::generate(2);
        gmsh::model::mesh::setOrder(2);
    });
}

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
    explicit ModelReader(const std::string& where) { draft_.where = where; }

    MeshDraft read() {
        refuse_solids();
        read_nodes();
        read_triangles();
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
        double extent = 0;
        for (double component : x) extent = std::max(extent, std::abs(component));
        constexpr double flatness = 1e-9;  // of the largest coordinate: text files keep 16 digits, older ones fewer
        std::vector<std::size_t> off_plane;
        for (std::size_t n = 0; n < tags.size(); ++n) {
            number_of_node_.emplace(tags[n], static_cast<std::int32_t>(n));
            draft_.nodes.push_back({x[3 * n], x[3 * n + 1]});
            draft_.node_labels.push_back(static_cast<std::int64_t>(tags[n]));
            if (!(std::abs(x[3 * n + 2] - x[2]) <= flatness * extent)) off_plane.push_back(tags[n]);
        }
        if (!off_plane.empty())
            error(fmt::format("the mesh must lie in a plane z = constant: node {} does not ({} such)", off_plane[0],
                              off_plane.size()));
    }

    std::int32_t node(std::size_t tag) const { return number_of_node_.at(tag); }

    void read_triangles() {
        std::map<int, std::vector<std::string>> groups_of_surface;
        for_each_member(2, [&](const std::string& name, int surface) { groups_of_surface[surface].push_back(name); });
        gmsh::vectorpair surfaces;
        gmsh::model::getEntities(surfaces, 2);
        for (const auto& [dim, surface] : surfaces) {
            std::int32_t region = 0;
            const auto groups = groups_of_surface.find(surface);
            if (groups_of_surface.empty())
                region = region_number("solid");
            else if (groups != groups_of_surface.end())
                region = region_number(groups->second[0]);
            for_each_type(2, surface, [&](int type, const Tags& elements, const Tags& nodes) {
                if (type != triangle_3 && type != triangle_6) {
                    refuse(type, elements);
                    return;
                }
                if (!groups_of_surface.empty() && groups == groups_of_surface.end())
                    error(fmt::format(
                        "{} triangles, of which element {} is the first, are on surface {}, which belongs to "
                        "no physical group while other surfaces do",
                        elements.size(), elements.at(0), surface));
                else if (groups != groups_of_surface.end() && groups->second.size() > 1)
                    error(fmt::format("surface {} belongs to more than one physical group: \"{}\" and \"{}\"", surface,
                                      groups->second[0], groups->second[1]));
                add_triangles(type, elements, nodes, region);
            });
        }
    }

    /// Gmsh numbers the corners first, then the mid-sides after corner 1, 2 and 3.
    void add_triangles(int type, const Tags& elements, const Tags& nodes, std::int32_t region) {
        const std::size_t n = type == triangle_3 ? 3 : 6;
        for (std::size_t e = 0; e < elements.size(); ++e) {
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

    std::int32_t region_number(const std::string& name) {
        auto& names = draft_.region_names;
        auto at = std::find(names.begin(), names.end(), name);
        if (at == names.end()) at = names.insert(at, name);
        return static_cast<std::int32_t>(at - names.begin());
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

    void read_data() {
        std::vector<int> views;
        gmsh::view::getTags(views);
        for (int view : views) {
            const std::string name = view_name(view);
            std::string kind;
            Tags tags;
            std::vector<std::vector<double>> rows;
            double time;
            int n_components;
            gmsh::view::getModelData(view, 0, kind, tags, rows, time, n_components);
            if (kind != "ElementData") {
                draft_.warnings.push_back(fmt::format("{} \"{}\" is not read: only ElementData is", kind, name));
                continue;
            }
            if (n_components != 1) {
                error(fmt::format("element data \"{}\" have {} components; only one is read", name, n_components));
                continue;
            }
            std::map<std::size_t, double> value_of;
            for (std::size_t i = 0; i < tags.size(); ++i) value_of[tags[i]] = rows[i].at(0);
            add_data(name, value_of);
        }
    }

    void add_data(const std::string& name, const std::map<std::size_t, double>& value_of) {
        std::vector<std::int64_t> missing;
        std::vector<double> values;
        for (std::int64_t label : draft_.element_labels) {
            const auto at = value_of.find(static_cast<std::size_t>(label));
            if (at == value_of.end())
                missing.push_back(label);
            else
                values.push_back(at->second);
        }
        if (!missing.empty())
            error(fmt::format("element data \"{}\" are missing for {}", name, numbered("element", missing)));
        else if (!draft_.element_data.emplace(name, std::move(values)).second)
            error(fmt::format("element data \"{}\" are given twice", name));
    }

    static std::string view_name(int tag) {
        const int index = gmsh::view::getIndex(tag);
        std::string name;
        gmsh::option::getString(fmt::format("View[{}].Name", index), name);
        return name;
    }

    MeshDraft draft_;
    std::vector<Problem> problems_;
    std::unordered_map<std::size_t, std::int32_t> number_of_node_;
};

}  // namespace

MeshDraft draft_of_current_model(const std::string& where) { return ModelReader(where).read(); }

MeshDraft read_gmsh(const fs::path& file, const std::map<std::string, double>& parameters) {
    const std::string where = file.string();
    if (!fs::is_regular_file(file)) throw InputError(where, "there is no such file");
    const GmshSession session;
    const bool is_geo = file.extension() == ".geo";
    if (is_geo)
        mesh_geo(session, file, parameters);
    else
        session.run(where, [&] { gmsh::merge(where); });
    MeshDraft draft = session.run(where, [&] { return draft_of_current_model(where); });
    draft.report_unused_nodes = !is_geo;  // a .geo has construction points, the centres of arcs for one
    const std::vector<std::string> warnings = session.warnings();
    draft.warnings.insert(draft.warnings.end(), warnings.begin(), warnings.end());
    add_mid_sides(draft);
    return draft;
}

}  // namespace gneiss
