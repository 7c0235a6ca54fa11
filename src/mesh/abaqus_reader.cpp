#include "mesh/abaqus_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <unordered_map>

#include "base/errors.hpp"
#include "mesh/abaqus_keywords.hpp"
#include "mesh/check.hpp"
#include "mesh/geometry.hpp"
#include "mesh/loose.hpp"

namespace gneiss {
namespace {

struct Element {
    std::int64_t label;
    bool is_triangle;  ///< else a line
    std::vector<std::int64_t> nodes;
};

struct Node {
    std::int64_t label;
    std::array<double, 3> at;  ///< m
};

struct Set {
    std::string name;  ///< as it was written first
    bool internal = false;
    std::set<std::int64_t> labels;
};

/// A face of an element, S1 to S3; 0: the whole element, a line.
struct Face {
    std::int64_t element;
    int number;
};

/// Nodes, elements and what is named of them. Names are keys in capitals.
struct Part {
    std::vector<Node> nodes;
    std::vector<Element> elements;
    std::map<std::string, Set> node_sets, element_sets;
    std::map<std::string, std::pair<std::string, std::vector<Face>>> surfaces;  ///< with the name as written
};

/// Three or six nodes of a triangle, two or three of a line; 0: another shape.
std::size_t nodes_of_triangle(const std::string& type) {
    static const std::set<std::string> three{"CPS3", "CPE3", "CPE3H", "CPEG3", "CPEG3H", "CPS3T", "CPE3T", "M3D3",
                                             "S3",   "S3R",  "S3RS",  "STRI3", "DC2D3",  "AC2D3", "R3D3",  "SFM3D3"},
        six{"CPS6", "CPS6M",  "CPE6",  "CPE6H", "CPE6M", "CPE6MH", "CPEG6", "CPEG6M", "M3D6",
            "S6",   "STRI65", "DC2D6", "AC2D6", "CPS6T", "CPS6MT", "CPE6T", "CPE6MT"};
    return three.contains(type) ? 3 : six.contains(type) ? 6 : 0;
}

std::size_t nodes_of_line(std::string type) {
    static const std::set<std::string> two{"T2D2", "T3D2", "B21", "B31", "B23", "B33", "R2D2", "RB2D2", "RB3D2"},
        three{"T2D3", "T3D3", "B22", "B32"};
    while (type.ends_with('H') || type.ends_with('T')) type.pop_back();  // hybrid, coupled to temperature
    return two.contains(type) ? 2 : three.contains(type) ? 3 : 0;
}

/// Points and springs: no part of a mesh.
bool has_no_shape(const std::string& type) {
    return std::ranges::any_of(
        std::array{"MASS", "ROTARYI", "SPRING", "DASHPOT", "CONN", "HEATCAP", "DCOUP", "JOINTC", "GAP"},
        [&](const char* start) { return type.starts_with(start); });
}

template <class T>
std::optional<T> number_in(const std::string& text) {
    T value{};
    const char *begin = text.data() + (text.starts_with('+') ? 1 : 0), *end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (error != std::errc{} || stop != end) return std::nullopt;
    return value;
}

/// "1.5D-3" is Fortran's way to write 1.5e-3.
std::optional<double> real_in(std::string text) {
    std::ranges::replace(text, 'D', 'e');
    std::ranges::replace(text, 'd', 'e');
    return text.empty() ? std::optional(0.0) : number_in<double>(text);
}

class AbaqusReader {
public:
    explicit AbaqusReader(const std::filesystem::path& file) { draft_.where = file.string(); }

    MeshDraft read() {
        for (const AbaqusKeyword& keyword : abaqus_keywords(draft_.where)) take(keyword);
        if (instances_.empty() && !flat_.elements.empty()) instances_.push_back({"", {}, flat_});
        if (instances_.empty() && parts_.size() == 1) instances_.push_back({"", {}, parts_.begin()->second});
        if (!problems_.empty()) throw InputError(std::move(problems_));
        // all nodes first: instances may lie anywhere, names may not depend on their order
        for (Instance& instance : instances_) add_nodes(instance);
        for (const Instance& instance : instances_) add_elements(instance);
        check_plane();
        if (!problems_.empty()) throw InputError(std::move(problems_));
        return std::move(draft_);
    }

private:
    struct Instance {
        std::string name;
        std::vector<std::array<double, 3>> moved;  ///< none or one
        Part part;
        std::unordered_map<std::int64_t, std::int32_t> number_of_node = {};
    };

    void error(const AbaqusKeyword& keyword, std::string message) {
        problems_.push_back({keyword.where, fmt::format("*{}: {}", keyword.name, message)});
    }
    void error(const AbaqusKeyword& keyword, const AbaqusLine& line, const std::string& message) {
        problems_.push_back(
            {line.where(), fmt::format("*{}: \"{}\" is not {}", keyword.name, fmt::join(line.entries, ", "), message)});
    }

    /// What a keyword of a mesh speaks about: an instance that it names, the one that is open, a part, or the file.
    Part& scope(const AbaqusKeyword& keyword) {
        if (const std::string name = capitals(keyword.value("INSTANCE")); !name.empty()) {
            const auto found = std::ranges::find(instances_, name, &Instance::name);
            if (found != instances_.end()) return found->part;
            error(keyword, fmt::format("there is no instance `{}`", name));
            return nowhere_;
        }
        if (open_instance_) return instances_.back().part;
        if (!open_part_.empty()) return parts_[open_part_];
        return flat_;
    }

    void take(const AbaqusKeyword& keyword) {
        const std::string& name = keyword.name;
        if (name == "NODE") take_nodes(keyword);
        if (name == "ELEMENT") take_elements(keyword);
        if (name == "NSET") take_set(keyword, scope(keyword).node_sets, "NSET");
        if (name == "ELSET") take_set(keyword, scope(keyword).element_sets, "ELSET");
        if (name == "SURFACE") take_surface(keyword);
        if (name == "PART")
            parts_.try_emplace(open_part_ = capitals(keyword.value("NAME")));  // may stay empty: all in the instance
        if (name == "END PART") open_part_.clear();
        if (name == "INSTANCE") take_instance(keyword);
        if (name == "END INSTANCE") open_instance_ = false;
        static const std::set<std::string> makers{"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYSTEM"};
        if (makers.contains(name)) error(keyword, "is not read: write the nodes and elements out");
    }

    void take_nodes(const AbaqusKeyword& keyword) {
        Part& part = scope(keyword);
        Set* const set = set_of(part.node_sets, keyword, "NSET");
        for (const AbaqusLine& line : keyword.data) {
            const auto& entries = line.entries;
            const auto label = number_in<std::int64_t>(entries.at(0));
            std::array<std::optional<double>, 3> at{0.0, 0.0, 0.0};  // of those that are left out
            for (std::size_t k = 0; k < 3 && k + 1 < entries.size(); ++k) at[k] = real_in(entries[k + 1]);
            constexpr std::size_t fewest = 2, most = 4;
            if (entries.size() < fewest || entries.size() > most || !label || !at[0] || !at[1] || !at[2])
                return error(keyword, line, "a node and its coordinates, three at most");
            part.nodes.push_back({*label, {*at[0], *at[1], *at[2]}});
            if (set != nullptr) set->labels.insert(*label);
        }
    }

    void take_elements(const AbaqusKeyword& keyword) {
        const std::string type = capitals(keyword.value("TYPE"));
        const bool is_triangle = nodes_of_triangle(type) > 0;
        const std::size_t n = is_triangle ? nodes_of_triangle(type) : nodes_of_line(type);
        if (n == 0 && has_no_shape(type)) {
            draft_.warnings.push_back(fmt::format("elements of type {} are left out", type));
            return;
        }
        if (n == 0)
            return error(keyword, fmt::format("type {}: only plane triangles are read, CPS3, CPE3, CPS6 and CPE6, and "
                                              "trusses and beams along their sides",
                                              type));
        Part& part = scope(keyword);
        Set* const set = set_of(part.element_sets, keyword, "ELSET");
        for (std::size_t k = 0; k < keyword.data.size(); ++k) {
            AbaqusLine line = keyword.data[k];
            // a comma behind the last node of an element is one too many and goes on nowhere
            while (line.ends_in_comma && line.entries.size() <= n && k + 1 < keyword.data.size()) {
                const AbaqusLine& below = keyword.data[++k];
                line.entries.insert(line.entries.end(), below.entries.begin(), below.entries.end());
                line.ends_in_comma = below.ends_in_comma;
            }
            Element element{0, is_triangle, {}};
            bool good = line.entries.size() == n + 1;
            for (std::size_t i = 0; i <= n && good; ++i) {
                const auto label = number_in<std::int64_t>(line.entries[i]);
                good = label.has_value();
                if (i == 0 && good) element.label = *label;
                if (i > 0 && good) element.nodes.push_back(*label);
            }
            if (!good) return error(keyword, line, fmt::format("an element and its {} nodes", n));
            if (set != nullptr) set->labels.insert(element.label);
            part.elements.push_back(std::move(element));
        }
    }

    /// The set that a keyword names; null: it names none.
    static Set* set_of(std::map<std::string, Set>& sets, const AbaqusKeyword& keyword, const std::string& parameter) {
        const std::string name = keyword.value(parameter);
        if (name.empty()) return nullptr;
        Set& set = sets[capitals(name)];
        if (set.name.empty()) set.name = name;
        set.internal = keyword.has("INTERNAL");
        return &set;
    }

    void take_set(const AbaqusKeyword& keyword, std::map<std::string, Set>& sets, const std::string& parameter) {
        Set* const set = set_of(sets, keyword, parameter);
        if (set == nullptr) return error(keyword, fmt::format("{} is missing", parameter));
        if (parameter == "NSET" && keyword.has("ELSET"))
            return error(keyword, "nodes of a set of elements are not read: write them out");
        for (const AbaqusLine& line : keyword.data) {
            const auto& entries = line.entries;
            if (keyword.has("GENERATE")) {
                constexpr std::size_t fewest = 2, most = 3;
                const auto first = number_in<std::int64_t>(entries.at(0));
                const auto last = entries.size() > 1 ? number_in<std::int64_t>(entries[1]) : std::nullopt;
                const auto step = entries.size() > 2 ? number_in<std::int64_t>(entries[2]) : 1;
                if (entries.size() < fewest || entries.size() > most || !first || !last || !step || *step < 1 ||
                    *last < *first)
                    return error(keyword, line, "a first number, a last one not below it, and a step");
                for (std::int64_t label = *first; label <= *last; label += *step) set->labels.insert(label);
                continue;
            }
            for (const std::string& entry : entries) {
                if (const auto label = number_in<std::int64_t>(entry)) {
                    set->labels.insert(*label);
                } else if (const auto other = sets.find(capitals(entry)); other != sets.end()) {
                    set->labels.insert(other->second.labels.begin(), other->second.labels.end());
                } else if (!take_of_instance(entry, keyword, parameter) && !entry.empty()) {
                    return error(keyword, fmt::format("\"{}\" is neither a number nor a set", entry));
                }
            }
        }
    }

    /// `Instance.7` or `Instance.set`, in a set of the assembly: joins the set of this name in the instance.
    /// @return false if the entry is none
    bool take_of_instance(const std::string& entry, const AbaqusKeyword& keyword, const std::string& parameter) {
        const std::size_t dot = entry.rfind('.');
        if (dot == std::string::npos) return false;
        const auto found = std::ranges::find(instances_, capitals(entry.substr(0, dot)), &Instance::name);
        if (found == instances_.end()) return false;
        auto& sets = parameter == "NSET" ? found->part.node_sets : found->part.element_sets;
        const std::string what = entry.substr(dot + 1);
        const auto other = sets.find(capitals(what));
        const auto label = number_in<std::int64_t>(what);
        if (!label && other == sets.end()) return false;
        const std::set<std::int64_t> labels = label ? std::set{*label} : other->second.labels;
        set_of(sets, keyword, parameter)->labels.insert(labels.begin(), labels.end());
        return true;
    }

    /// Surfaces of an assembly name sets that lie in an instance: each is looked for in all of them.
    void take_surface(const AbaqusKeyword& keyword) {
        const std::string name = keyword.value("NAME"), type = capitals(keyword.value("TYPE"));
        if (!type.empty() && type != "ELEMENT") return;  // of nodes: a set of nodes says the same
        std::vector<Part*> scopes{&scope(keyword)};
        if (scopes[0] == &flat_ && !instances_.empty()) {
            scopes.clear();
            for (Instance& instance : instances_) scopes.push_back(&instance.part);
        }
        for (const AbaqusLine& line : keyword.data) {
            constexpr std::size_t most = 2;
            const std::string what = capitals(line.entries.at(0));
            const std::string face = line.entries.size() > 1 ? capitals(line.entries[1]) : "";
            if (line.entries.size() > most) return error(keyword, line, "an element, or a set of them, and a face");
            const int number =
                face.size() == 2 && face[0] == 'S' && face[1] >= '1' && face[1] <= '3' ? face[1] - '0' : 0;
            if (number == 0 && !face.empty() && face != "SPOS" && face != "SNEG")
                return error(keyword, fmt::format("\"{}\" is not a face of a triangle, S1 to S3", face));
            bool found = false;
            for (Part* part : scopes) {
                auto& [written, faces] = part->surfaces[capitals(name)];
                written = name;
                const auto set = part->element_sets.find(what);
                if (set != part->element_sets.end()) {
                    for (const std::int64_t label : set->second.labels) faces.push_back({label, number});
                    found = true;
                } else if (const auto label = number_in<std::int64_t>(what)) {
                    faces.push_back({*label, number});
                    found = true;
                }
            }
            if (!found)
                error(keyword, fmt::format("\"{}\" is neither an element nor a set of elements", line.entries[0]));
        }
    }

    void take_instance(const AbaqusKeyword& keyword) {
        Instance instance{capitals(keyword.value("NAME")), {}, {}};
        open_instance_ = true;
        if (const std::string part = capitals(keyword.value("PART")); !part.empty()) {
            if (const auto found = parts_.find(part); found != parts_.end())
                instance.part = found->second;
            else
                error(keyword, fmt::format("there is no part `{}`", part));
        }
        if (keyword.data.size() > 1) error(keyword, "is rotated, which is not read");
        if (!keyword.data.empty()) {
            std::array<double, 3> by{0, 0, 0};
            const AbaqusLine& line = keyword.data[0];
            if (line.entries.size() > by.size()) error(keyword, line, "a translation along x, y and z");
            for (std::size_t k = 0; k < by.size() && k < line.entries.size(); ++k) {
                const auto component = real_in(line.entries[k]);
                if (!component) error(keyword, line, "a translation along x, y and z");
                by[k] = component.value_or(0);
            }
            instance.moved.push_back(by);
        }
        instances_.push_back(std::move(instance));
    }

    void add_nodes(Instance& instance) {
        for (const Node& node : instance.part.nodes) {
            std::array<double, 3> at = node.at;
            for (const auto& by : instance.moved)
                for (std::size_t k = 0; k < 3; ++k) at[k] += by[k];
            if (!instance.number_of_node.emplace(node.label, static_cast<std::int32_t>(draft_.nodes.size())).second) {
                problems_.push_back({draft_.where, fmt::format("node {} is given twice", node.label)});
                return;
            }
            draft_.nodes.push_back({at[0], at[1]});
            draft_.node_labels.push_back(node.label);
            heights_.push_back(at[2]);
        }
    }

    void add_elements(const Instance& instance) {
        const Part& part = instance.part;
        std::unordered_map<std::int64_t, std::vector<std::string>> sets_of;  // of elements
        for (const auto& [key, set] : part.element_sets)
            if (!set.internal)
                for (const std::int64_t label : set.labels) sets_of[label].push_back(set.name);
        std::unordered_map<std::int64_t, const Element*> element_of;
        std::set<std::int64_t> missing, used;
        const auto node = [&](std::int64_t label) {
            const auto found = instance.number_of_node.find(label);
            if (found == instance.number_of_node.end()) missing.insert(label);
            return found == instance.number_of_node.end() ? 0 : found->second;
        };
        for (const Element& element : part.elements) {
            if (!element_of.emplace(element.label, &element).second) {
                problems_.push_back({draft_.where, fmt::format("element {} is given twice", element.label)});
                return;
            }
            const auto found = sets_of.find(element.label);
            const std::vector<std::string> sets = found == sets_of.end() ? std::vector<std::string>{} : found->second;
            if (element.is_triangle) {
                std::array<std::int32_t, 6> six;
                for (std::size_t i = 0; i < 3; ++i) {
                    six[2 * i] = node(element.nodes[i]);
                    six[2 * i + 1] = element.nodes.size() == 6 ? node(element.nodes[3 + i]) : MeshDraft::no_node;
                }
                used.insert(element.nodes.begin(), element.nodes.end());
                draft_.elements.push_back(six);
                draft_.element_labels.push_back(element.label);
                draft_.region.push_back(draft_.region_of(sets.empty() ? std::vector<std::string>{"solid"} : sets));
                continue;
            }
            std::vector<std::int32_t> nodes;
            for (const std::int64_t label : element.nodes) nodes.push_back(node(label));
            for (const std::string& name : sets) draft_.lines[name].push_back(line_along(nodes));
        }
        if (!missing.empty())
            problems_.push_back({draft_.where, fmt::format("elements name nodes that are not there: {}",
                                                           numbered("node", {missing.begin(), missing.end()}))});
        if (!problems_.empty()) return;
        add_surfaces(part, element_of, node);
        for (const auto& [key, set] : part.node_sets) {
            if (set.internal) continue;
            std::vector<std::int64_t> beside;  // reference points of couplings, for one
            for (const std::int64_t label : set.labels)
                if (used.contains(label))
                    draft_.points[set.name].push_back(node(label));
                else
                    beside.push_back(label);
            if (!beside.empty())
                draft_.warnings.push_back(fmt::format("set \"{}\": {} belong to no triangle and are left out", set.name,
                                                      numbered("node", std::move(beside))));
        }
    }

    template <class NodeOf>
    void add_surfaces(const Part& part, const std::unordered_map<std::int64_t, const Element*>& element_of,
                      NodeOf&& node) {
        for (const auto& [key, surface] : part.surfaces)
            for (const Face& face : surface.second) {
                const auto found = element_of.find(face.element);
                if (found == element_of.end()) {
                    problems_.push_back({draft_.where, fmt::format("surface \"{}\": there is no element {}",
                                                                   surface.first, face.element)});
                    continue;
                }
                const Element& element = *found->second;
                if (face.number == 0) {
                    if (element.is_triangle) continue;  // the whole plane of a shell: no line
                    std::vector<std::int32_t> nodes;
                    for (const std::int64_t label : element.nodes) nodes.push_back(node(label));
                    draft_.lines[surface.first].push_back(line_along(nodes));
                    continue;
                }
                const auto from = static_cast<std::size_t>(face.number - 1);
                draft_.lines[surface.first].push_back(
                    {node(element.nodes[from]),
                     element.nodes.size() == 6 ? node(element.nodes[3 + from]) : MeshDraft::no_node,
                     node(element.nodes[(from + 1) % 3])});
            }
    }

    /// Of three nodes, Abaqus has the one between the ends in the second place, other programs in the third.
    std::array<std::int32_t, 3> line_along(const std::vector<std::int32_t>& nodes) const {
        if (nodes.size() == 2) return {nodes[0], MeshDraft::no_node, nodes[1]};
        const auto at = [&](std::size_t i) { return draft_.nodes[static_cast<std::size_t>(nodes[i])]; };
        const bool second = distance(at(1), midpoint(at(0), at(2))) < distance(at(2), midpoint(at(0), at(1)));
        return second ? std::array{nodes[0], nodes[1], nodes[2]} : std::array{nodes[0], nodes[2], nodes[1]};
    }

    void check_plane() {
        const std::vector<std::int64_t> off = off_plane(draft_, heights_);
        if (!off.empty())
            problems_.push_back({draft_.where, fmt::format("the mesh must lie in a plane z = constant: {} {} not",
                                                           numbered("node", off), off.size() == 1 ? "does" : "do")});
    }

    MeshDraft draft_;
    std::vector<Problem> problems_;
    std::vector<double> heights_;  ///< z of the draft's nodes, m
    Part flat_, nowhere_;
    std::map<std::string, Part> parts_;
    std::vector<Instance> instances_;
    std::string open_part_;
    bool open_instance_ = false;
};

}  // namespace

MeshDraft read_abaqus(const std::filesystem::path& file) {
    MeshDraft draft = AbaqusReader(file).read();
    drop_loose_names(draft);
    add_mid_sides(draft);
    return draft;
}

}  // namespace gneiss
