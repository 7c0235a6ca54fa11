#include "model/boundaries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "model/mesh_names.hpp"
#include "model/problem_list.hpp"

namespace gneiss {
namespace {

/// One degree of freedom as one entry of the deck prescribes it.
struct Prescription {
    Constraint constraint;
    std::size_t entry;  ///< index into the options
    double pattern;     ///< m or m/s
};

std::string place(std::size_t entry) { return fmt::format("[[boundary]] {}", entry + 1); }

/// True if both say the same: nothing moves where the pattern is zero, whatever the amplitude.
bool agree(const Prescription& p, const Prescription& q, const std::map<std::size_t, Amplitude>& amplitudes) {
    if (p.constraint.kind != q.constraint.kind || p.pattern != q.pattern) return false;
    return p.pattern == 0 || amplitudes.at(p.entry) == amplitudes.at(q.entry);
}

/// The nodal values of one component of one entry.
std::vector<Prescription> prescribe(const Mesh& mesh, const std::vector<std::int32_t>& nodes, std::size_t component,
                                    Constraint::Kind kind, std::size_t entry, const CompiledFormula& value) {
    std::vector<Prescription> all;
    for (std::int32_t node : nodes) {
        const auto index = static_cast<std::size_t>(node);
        const auto& x = mesh.nodes[index];
        all.push_back({{2 * index + component, kind}, entry, value(x[0], x[1])});
    }
    return all;
}

/// What two entries disagree about, told once per pair and component with one node as the example.
class Disagreements {
public:
    void add(const Prescription& p, const Prescription& q) {
        auto& [n, node] = found_[{p.entry, q.entry, p.constraint.dof % 2}];
        if (n++ == 0) node = p.constraint.dof / 2;
    }

    void report(const Mesh& mesh, const std::vector<BoundaryOptions>& options, ProblemList& problems) const {
        for (const auto& [key, example] : found_) {
            const auto& [p, q, component] = key;
            const auto& [n, node] = example;
            problems.add(place(q),
                         fmt::format("on = \"{}\" prescribes another {} motion than {} on \"{}\" at {} node{}: "
                                     "node {} at ({}, {})",
                                     options[q].on, component == 0 ? 'x' : 'y', place(p), options[p].on, n,
                                     n == 1 ? "" : "s, among them", mesh.node_labels[node], mesh.nodes[node][0],
                                     mesh.nodes[node][1]));
        }
    }

private:
    std::map<std::tuple<std::size_t, std::size_t, std::size_t>, std::pair<std::size_t, std::size_t>> found_;
};

/// One entry's prescriptions and its amplitude, or problems.
void read_entry(const Mesh& mesh, const BoundaryOptions& boundary, std::size_t entry,
                const std::shared_ptr<const AmplitudeCourse>& course, std::vector<Prescription>& prescriptions,
                std::map<std::size_t, Amplitude>& amplitudes, ProblemList& problems) {
    const std::string where = place(entry);
    const bool is_displacement = boundary.kind == BoundaryOptions::Kind::displacement;
    std::vector<std::int32_t> nodes;
    problems.attempt(where, [&] { nodes = nodes_named(mesh, boundary.on); });
    problems.attempt(where, [&] { amplitudes.emplace(entry, Amplitude(boundary.amplitude, course)); });
    if (!boundary.value[0] && !boundary.value[1]) {
        problems.add(where, fmt::format("on = \"{}\" prescribes neither x nor y", boundary.on));
    }
    bool moves = false;
    for (std::size_t component = 0; component < 2; ++component) {
        if (!boundary.value[component]) continue;
        problems.attempt(where, [&] {
            const CompiledFormula value(*boundary.value[component], "xy");
            const auto kind = is_displacement ? Constraint::Kind::displacement : Constraint::Kind::velocity;
            const std::vector<Prescription> more = prescribe(mesh, nodes, component, kind, entry, value);
            moves |= std::any_of(more.begin(), more.end(), [](const Prescription& p) { return p.pattern != 0; });
            prescriptions.insert(prescriptions.end(), more.begin(), more.end());
        });
    }
    const auto amplitude = amplitudes.find(entry);
    if (is_displacement && moves && amplitude != amplitudes.end() && amplitude->second.has_jump()) {
        problems.add(where, fmt::format("on = \"{}\": a displacement cannot jump, its velocity would be infinite; "
                                        "use a ramp, or prescribe a velocity",
                                        boundary.on));
    }
}

}  // namespace

ConstraintSet::ConstraintSet(std::vector<Constraint> constraints, std::vector<Group> groups)
    : constraints_(std::move(constraints)), groups_(std::move(groups)) {
    assert(std::is_sorted(constraints_.begin(), constraints_.end(),
                          [](const Constraint& p, const Constraint& q) { return p.dof < q.dof; }));
}

void ConstraintSet::values(double t, double last_event, std::span<double> out) const {
    assert(out.size() == constraints_.size());
    for (const Group& group : groups_) {
        const Amplitude::Instant amplitude = group.amplitude.at(t, last_event);
        for (const Group::Entry& entry : group.entries) {
            out[entry.position] = entry.pattern * amplitude(entry.x, entry.y);
        }
    }
}

std::vector<double> ConstraintSet::switch_times() const {
    std::set<double> times;
    for (const Group& group : groups_) {
        const std::vector<double> more = group.amplitude.switch_times();
        times.insert(more.begin(), more.end());
    }
    return {times.begin(), times.end()};
}

ConstraintSet make_constraints(const Mesh& mesh, const std::vector<BoundaryOptions>& options, const Courses& courses) {
    ProblemList problems;
    std::vector<Prescription> prescriptions;
    std::map<std::size_t, Amplitude> amplitudes;
    for (std::size_t i = 0; i < options.size(); ++i) {
        if (options[i].kind == BoundaryOptions::Kind::absorbing) continue;
        read_entry(mesh, options[i], i, course_at(courses, i), prescriptions, amplitudes, problems);
    }
    problems.throw_if_any();

    std::stable_sort(prescriptions.begin(), prescriptions.end(),
                     [](const Prescription& p, const Prescription& q) { return p.constraint.dof < q.constraint.dof; });
    std::vector<Constraint> constraints;
    std::map<std::size_t, std::vector<ConstraintSet::Group::Entry>> entries;
    Disagreements disagreements;
    const Prescription* first = nullptr;
    for (const Prescription& p : prescriptions) {
        if (first && first->constraint.dof == p.constraint.dof) {
            if (!agree(*first, p, amplitudes)) disagreements.add(*first, p);
            continue;
        }
        first = &p;
        const auto& x = mesh.nodes[p.constraint.dof / 2];
        entries[p.entry].push_back({constraints.size(), p.pattern, x[0], x[1]});
        constraints.push_back(p.constraint);
    }
    disagreements.report(mesh, options, problems);
    problems.throw_if_any();

    std::vector<ConstraintSet::Group> groups;
    for (auto& [entry, list] : entries) groups.push_back({amplitudes.at(entry), std::move(list)});
    return {std::move(constraints), std::move(groups)};
}

std::vector<BoundaryEdge> absorbing_edges(const Mesh& mesh, const std::vector<BoundaryOptions>& options) {
    ProblemList problems;
    std::vector<BoundaryEdge> edges;
    std::set<std::pair<std::int32_t, std::int32_t>> seen;
    for (std::size_t i = 0; i < options.size(); ++i) {
        if (options[i].kind != BoundaryOptions::Kind::absorbing) continue;
        problems.attempt(place(i), [&] {
            for (const BoundaryEdge& edge : boundary_named(mesh, options[i].on)) {
                if (seen.emplace(edge.a, edge.b).second) edges.push_back(edge);
            }
        });
    }
    problems.throw_if_any();
    return edges;
}

}  // namespace gneiss
