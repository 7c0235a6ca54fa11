#include "fracture/cracking.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/errors.hpp"
#include "base/index.hpp"

namespace gneiss {
namespace {

void add_to_record(std::vector<double>& record, std::span<const std::int32_t> numbers) {
    record.push_back(static_cast<double>(numbers.size()));
    record.insert(record.end(), numbers.begin(), numbers.end());
}

/// Places on a side in a checkpoint's numbers of its nodes.
constexpr std::int32_t most_places = 3;

/// Nodes that were one, and the ends that wait between them.
struct Family {
    std::vector<std::int32_t> nodes;
    std::vector<std::size_t> ends;
};

std::vector<Family> families(std::span<const Joints::WaitingEnd> ends) {
    std::map<std::int32_t, std::size_t> family_of;
    std::vector<Family> all;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const auto a = family_of.find(ends[i].a), b = family_of.find(ends[i].b);
        std::size_t target;
        if (a == family_of.end() && b == family_of.end()) {
            target = all.size();
            all.emplace_back();
        } else {
            target = a != family_of.end() ? a->second : b->second;
            if (a != family_of.end() && b != family_of.end() && a->second != b->second) {
                Family& from = all[b->second];
                for (const std::int32_t node : from.nodes) family_of[node] = target;
                all[target].nodes.insert(all[target].nodes.end(), from.nodes.begin(), from.nodes.end());
                all[target].ends.insert(all[target].ends.end(), from.ends.begin(), from.ends.end());
                from = {};
            }
        }
        for (const std::int32_t node : {ends[i].a, ends[i].b})
            if (family_of.emplace(node, target).second) all[target].nodes.push_back(node);
        all[target].ends.push_back(i);
    }
    std::erase_if(all, [](const Family& family) { return family.nodes.empty(); });
    return all;
}

}  // namespace

Cracking::Cracking(Parts parts) : parts_(std::move(parts)) {
    if (!parts_.properties.empty())
        criterion_ = make_crack_criterion(parts_.criterion, {parts_.mesh, parts_.inner, parts_.solid, parts_.joints,
                                                             parts_.properties, parts_.thickness});
}

std::span<const double> Cracking::history(const State& state) const {
    return parts_.solid.history_of(parts_.joints, state);
}

std::vector<bool> Cracking::broken_sides(const State& state) const {
    std::vector<bool> broken(parts_.inner.sides().size());
    for (std::size_t s = 0; s < broken.size(); ++s) broken[s] = parts_.inner.is_open(static_cast<std::int32_t>(s));
    const auto own = history(state);
    for (std::size_t joint = 0; joint < parts_.joints.n_joints(); ++joint) {
        const auto [side, failed] = parts_.joints.failure(joint, own);
        const auto s = index(side);
        // a side holds as long as one of its joints does
        broken[s] = failed && (parts_.joints.part_of_side(joint) == 0 || broken[s]);
    }
    return broken;
}

bool Cracking::stirred(const State& state) const {
    if (parts_.come_apart && parts_.joints.any_failed(history(state))) return true;
    const ElementForces& elements = parts_.solid.elements();
    for (std::size_t b = 0; b < elements.blocks().size(); ++b)
        if (std::ranges::any_of(elements.beyond(b, state), [](double lanes) { return lanes != 0; })) return true;
    return false;
}

EventOutcome Cracking::look(State& accepted) {
    CrackOpenings openings;
    Change change;
    if (criterion_) openings = criterion_->openings(accepted);
    change.opened = std::move(openings.ends);
    if (parts_.come_apart) change.failed = parts_.come_apart(parts_.joints.sides_let_go(accepted, history(accepted)));
    if (change.opened.empty() && change.failed.empty()) return EventOutcome::none;
    if (!change.opened.empty() && !first_opening_) first_opening_ = accepted.t;
    accepted.path.splitting -=
        parts_.joints.hand_over(change.failed, accepted, parts_.solid.history_of(parts_.joints, accepted));
    part(change, accepted);
    wake_ends(accepted, openings.starts);
    return EventOutcome::resize;
}

void Cracking::part(const Change& change, State& state) {
    std::vector<std::int32_t> opened, ends;  // sides that were whole; nodes of sides
    for (const SideNode& end : change.opened) {
        ends.push_back(most_places * end.side + end.place);
        if (!parts_.inner.is_open(end.side) && (opened.empty() || opened.back() != end.side))
            opened.push_back(end.side);
    }
    const std::vector<NodeCopy> copies = parts_.inner.open(change.opened);
    std::vector<std::int32_t> elements;
    for (const NodeCopy& copy : copies)
        for (const std::int32_t node : {copy.original, copy.copy}) {
            const auto at = parts_.inner.elements_at(node);
            elements.insert(elements.end(), at.begin(), at.end());
        }
    std::ranges::sort(elements);
    elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
    if (criterion_) {
        std::vector<std::int32_t> around = elements;  // and of ends that have opened while their node holds together
        for (const SideNode& end : change.opened) {
            const InnerSide& side = parts_.inner.sides()[index(end.side)];
            around.insert(around.end(), {side.left.element, side.right.element});
        }
        criterion_->follow(around);
    }
    std::optional<SolidSystem::Surroundings> surroundings;
    if (parts_.surroundings && named(copies)) surroundings = parts_.surroundings(parts_.mesh);
    parts_.solid.follow({parts_.mesh, copies, elements, opened, change.failed}, std::move(surroundings), state);
    add_to_record(record_, ends);
    add_to_record(record_, change.failed);
    ++n_events_;
}

auto Cracking::overshoot(const State& state) const -> Overshoot {
    const auto own = history(state);
    double dissipated = 0, beyond = 0;
    for (std::size_t joint = 0; joint < parts_.joints.n_joints(); ++joint) {
        const JointState at = parts_.joints.state_of(joint, state, own);
        for (std::size_t i = 0; i < 2; ++i) {
            const double energy = at.length * (at.fracture_i[i] + at.fracture_ii[i]);
            dissipated += energy;
            beyond += energy * (at.strength_factor[i] - 1);
        }
    }
    return {largest_overshoot_, dissipated > 0 ? beyond / dissipated : 0};
}

std::vector<double> Cracking::save() const {
    std::vector<double> saved{largest_overshoot_, first_opening_.value_or(-1)};
    saved.insert(saved.end(), record_.begin(), record_.end());
    return saved;
}

void Cracking::replay(const std::vector<double>& record) {
    State any = parts_.solid.initial_state();
    const auto bad = [] { return InputError("cracks", "of the checkpoint do not fit the mesh"); };
    const std::size_t n_sides = parts_.inner.sides().size(), n_ends = n_sides * most_places;
    if (record.size() < 2) throw bad();
    largest_overshoot_ = record[0];
    if (record[1] >= 0) first_opening_ = record[1];
    std::size_t next = 2;
    const auto take = [&](std::size_t n_all) {
        const auto limit = static_cast<double>(n_all);
        if (!(next < record.size() && record[next] >= 0 && record[next] <= limit)) throw bad();
        const auto n = static_cast<std::size_t>(record[next++]);
        if (n > record.size() - next) throw bad();
        std::vector<std::int32_t> numbers;
        for (std::size_t i = 0; i < n; ++i, ++next) {
            if (!(record[next] >= 0 && record[next] < limit)) throw bad();
            numbers.push_back(static_cast<std::int32_t>(record[next]));
        }
        return numbers;
    };
    while (next < record.size()) {
        Change change;
        for (const std::int32_t number : take(n_ends)) {
            change.opened.push_back({number / most_places, number % most_places});
            if (index(change.opened.back().place) >= side_nodes(parts_.mesh.kind, 0).size()) throw bad();
        }
        change.failed = take(n_sides);
        part(change, any);
    }
}

bool Cracking::named(const std::vector<NodeCopy>& copies) const {
    if (copies.empty()) return false;
    if (parts_.loads_everywhere) return true;
    return std::ranges::any_of(parts_.mesh.node_sets, [&](const auto& set) {
        return std::ranges::any_of(
            copies, [&](const NodeCopy& copy) { return std::ranges::binary_search(set.second, copy.original); });
    });
}

double Cracking::indicator(const State& state) const { return criterion_ ? criterion_->utilisation(state) - 1 : -1; }

void Cracking::wake_ends(State& state, const std::vector<CrackOpenings::Start>& starts) {
    const auto own = parts_.solid.history_of(parts_.joints, state);
    const auto ends = parts_.joints.waiting(state, own);
    if (ends.empty()) return;
    force_.resize(state.u.size());
    parts_.solid.force(state, Trial::of(state), force_);
    for (const Damping::Block& block : parts_.solid.damping().blocks) {
        const std::size_t x = 2 * index(block.node), y = x + 1;
        force_[x] -= block.xx * state.v[x] + block.xy * state.v[y];
        force_[y] -= block.xy * state.v[x] + block.yy * state.v[y];
    }
    const auto mass = parts_.solid.lumped_mass();
    const auto constraints = parts_.solid.constraints();
    const auto prescribed = [&](std::size_t dof) {
        return std::ranges::binary_search(constraints, dof, {}, &Constraint::dof);
    };
    using Key = std::tuple<std::int32_t, std::size_t, std::size_t>;
    std::map<Key, Vec2<double>> found;
    for (const CrackOpenings::Start& start : starts) found[{start.side, start.part, start.end}] = start.on_left;
    if (criterion_) criterion_->look_at(state);
    double offset_energy = 0;
    for (const Family& family : families(ends)) {
        const auto n = static_cast<Eigen::Index>(family.nodes.size());
        const auto place = [&](std::int32_t node) {
            return std::ranges::find(family.nodes, node) - family.nodes.begin();
        };
        // tractions to begin with, and the force imbalance of each copy under them
        std::vector<std::array<double, 2>> tractions;
        Eigen::MatrixXd conductance = Eigen::MatrixXd::Zero(n, n), rest = Eigen::MatrixXd::Zero(n, 2);
        for (const std::size_t i : family.ends) {
            const Joints::WaitingEnd& end = ends[i];
            const std::size_t part = parts_.joints.part_of_side(end.joint);
            if (const auto known = found.find(Key{end.side, part, end.end}); known != found.end()) {
                tractions.push_back({known->second.x, known->second.y});
            } else {
                const auto [xx, yy, xy] = criterion_->mean_stress(end.side, part);
                tractions.push_back({xx * end.normal.x + xy * end.normal.y, xy * end.normal.x + yy * end.normal.y});
            }
            const auto a = place(end.a), b = place(end.b);
            conductance(a, a) += end.weight;
            conductance(b, b) += end.weight;
            conductance(a, b) -= end.weight;
            conductance(b, a) -= end.weight;
            for (Eigen::Index c = 0; c < 2; ++c) {
                rest(a, c) -= end.weight * tractions.back()[static_cast<std::size_t>(c)];
                rest(b, c) += end.weight * tractions.back()[static_cast<std::size_t>(c)];
            }
        }
        for (Eigen::Index c = 0; c < 2; ++c) {
            double force = 0, whole = 0;
            bool held = false;
            for (const std::int32_t node : family.nodes) {
                const std::size_t dof = 2 * index(node) + static_cast<std::size_t>(c);
                force += force_[dof];
                whole += mass[dof];
                held = held || prescribed(dof);
            }
            for (Eigen::Index g = 0; g < n; ++g) {
                const std::size_t dof =
                    2 * index(family.nodes[static_cast<std::size_t>(g)]) + static_cast<std::size_t>(c);
                // a support moves its nodes alike, whatever the tractions
                rest(g, c) = held ? 0 : rest(g, c) + mass[dof] * force / whole - force_[dof];
            }
        }
        const Eigen::MatrixXd potential = conductance.completeOrthogonalDecomposition().solve(rest);
        for (std::size_t k = 0; k < family.ends.size(); ++k) {
            const Joints::WaitingEnd& end = ends[family.ends[k]];
            const auto a = place(end.a), b = place(end.b);
            const Vec2<double> traction{tractions[k][0] + potential(a, 0) - potential(b, 0),
                                        tractions[k][1] + potential(a, 1) - potential(b, 1)};
            const Joints::Start start =
                parts_.joints.wake(end, dot(traction, end.normal), dot(traction, end.along), own);
            offset_energy += start.energy;
            largest_overshoot_ = std::max(largest_overshoot_, start.overshoot);
        }
    }
    state.path.splitting += offset_energy;
}

}  // namespace gneiss
