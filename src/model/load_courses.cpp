#include "model/load_courses.hpp"

#include <fmt/format.h>

#include <set>

#include "base/errors.hpp"
#include "model/mesh_names.hpp"

namespace gneiss {
namespace {

using Places = std::vector<Vec2<double>>;

template <class Nodes>
Places places_of(const Mesh& mesh, const Nodes& nodes) {
    Places places;
    for (const std::int32_t node : nodes) {
        const auto& x = mesh.nodes[static_cast<std::size_t>(node)];
        places.push_back({x[0], x[1]});
    }
    return places;
}

Places places_of_edges(const Mesh& mesh, const std::vector<BoundaryEdge>& edges) {
    std::set<std::int32_t> nodes;
    for (const BoundaryEdge& edge : edges) nodes.insert({edge.a, edge.b});
    return places_of(mesh, nodes);
}

Places places_of(const Mesh& mesh, const LoadOptions& load) {
    if (load.kind == LoadOptions::Kind::nodal_force) return places_of(mesh, nodes_named(mesh, load.on));
    if (load.kind != LoadOptions::Kind::body_force) return places_of_edges(mesh, boundary_named(mesh, load.on));
    std::set<std::int32_t> nodes;
    const auto add = [&](std::size_t element) {
        const std::int32_t* of_element = mesh.element(element);
        nodes.insert(of_element, of_element + mesh.nodes_per_element());
    };
    if (load.on.empty())
        for (std::size_t e = 0; e < mesh.n_elements(); ++e) add(e);
    else
        for (const std::int32_t e : elements_named(mesh, load.on)) add(static_cast<std::size_t>(e));
    return places_of(mesh, nodes);
}

}  // namespace

Courses LoadCourses::all() const {
    Courses some;
    for (const Courses* list : {&loads, &boundaries, &lumped})
        for (const auto& course : *list)
            if (course) some.push_back(course);
    return some;
}

LoadCourses find_courses(const Mesh& mesh, const CaseOptions& options) {
    LoadCourses found;
    const auto find = [&](const char* section, const AmplitudeOptions& amplitude, auto places, Courses& courses) {
        courses.emplace_back();
        if (amplitude.kind == AmplitudeOptions::Kind::constant) return;
        try {
            Places at = places();
            if (at.empty()) at.push_back({0, 0});
            courses.back() = std::make_shared<const AmplitudeCourse>(course_of(amplitude, options.run.t_end, at));
            for (const std::string& warning : courses.back()->warnings)
                found.warnings.push_back(fmt::format("{} {}: amplitude: expression \"{}\" {}", section, courses.size(),
                                                     amplitude.expression, warning));
        } catch (const InputError&) {
            // told, with its place, by whoever makes the load
        }
    };
    for (const LoadOptions& load : options.loads)
        find(
            "[[load]]", load.amplitude, [&] { return places_of(mesh, load); }, found.loads);
    for (const BoundaryOptions& boundary : options.boundaries)
        find(
            "[[boundary]]", boundary.amplitude, [&] { return places_of(mesh, nodes_named(mesh, boundary.on)); },
            found.boundaries);
    for (const LumpedOptions& model : options.lumped)
        find(
            "[[lumped]]", model.amplitude,
            [] {
                return Places{{0, 0}};
            },
            found.lumped);
    return found;
}

}  // namespace gneiss
