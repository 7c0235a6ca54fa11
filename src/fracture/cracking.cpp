#include "fracture/cracking.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "base/errors.hpp"
#include "fracture/envelope.hpp"

namespace gneiss {
namespace {

std::size_t index(std::int32_t number) { return static_cast<std::size_t>(number); }

/// The sub-triangle at a sub-edge of a side, in the order of side_nodes().
int sub_triangle_at(ElementKind kind, int side, std::size_t part) {
    // a composite's sides run corner, mid-side, corner; its sub-triangles 0 to 2 are those at its corners
    return kind == ElementKind::cst ? 0 : (side + static_cast<int>(part)) % 3;
}

void add_to_record(std::vector<double>& record, std::span<const std::int32_t> sides) {
    record.push_back(static_cast<double>(sides.size()));
    record.insert(record.end(), sides.begin(), sides.end());
}

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

std::span<const double> Cracking::history(const State& state) const {
    return parts_.solid.history_of(parts_.joints, const_cast<State&>(state));
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
    ++look_;
    Change change;
    if (!parts_.properties.empty()) change.opened = sides_beyond(accepted);
    if (parts_.come_apart) change.failed = parts_.come_apart(parts_.joints.sides_let_go(accepted, history(accepted)));
    if (change.opened.empty() && change.failed.empty()) return EventOutcome::none;
    if (!change.opened.empty() && !first_opening_) first_opening_ = accepted.t;
    accepted.path.splitting -=
        parts_.joints.hand_over(change.failed, accepted, parts_.solid.history_of(parts_.joints, accepted));
    part(change, accepted);
    wake_ends(accepted);
    return EventOutcome::resize;
}

void Cracking::part(const Change& change, State& state) {
    const std::vector<NodeCopy> copies = parts_.inner.open(change.opened);
    std::vector<std::int32_t> elements;
    for (const NodeCopy& copy : copies)
        for (const std::int32_t node : {copy.original, copy.copy}) {
            const auto at = parts_.inner.elements_at(node);
            elements.insert(elements.end(), at.begin(), at.end());
        }
    std::ranges::sort(elements);
    elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
    std::optional<SolidSystem::Surroundings> surroundings;
    if (parts_.surroundings && named(copies)) surroundings = parts_.surroundings(parts_.mesh);
    parts_.solid.follow({parts_.mesh, copies, elements, change.opened, change.failed}, std::move(surroundings), state);
    add_to_record(record_, change.opened);
    add_to_record(record_, change.failed);
    ++n_events_;
}

std::vector<double> Cracking::save() const {
    std::vector<double> saved{largest_overshoot_, first_opening_.value_or(-1)};
    saved.insert(saved.end(), record_.begin(), record_.end());
    return saved;
}

void Cracking::replay(const std::vector<double>& record) {
    State any = parts_.solid.initial_state();
    const auto bad = [] { return InputError("cracks", "of the checkpoint do not fit the mesh"); };
    const auto n_sides = static_cast<double>(parts_.inner.sides().size());
    if (record.size() < 2) throw bad();
    largest_overshoot_ = record[0];
    if (record[1] >= 0) first_opening_ = record[1];
    std::size_t next = 2;
    const auto take = [&] {
        if (!(next < record.size() && record[next] >= 0 && record[next] <= n_sides)) throw bad();
        const auto n = static_cast<std::size_t>(record[next++]);
        if (n > record.size() - next) throw bad();
        std::vector<std::int32_t> sides;
        for (std::size_t i = 0; i < n; ++i, ++next) {
            if (!(record[next] >= 0 && record[next] < n_sides)) throw bad();
            sides.push_back(static_cast<std::int32_t>(record[next]));
        }
        return sides;
    };
    while (next < record.size()) {
        Change change;
        change.opened = take();
        change.failed = take();
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

std::array<double, 3> Cracking::stress(const State& state, const ElementSide& side, std::size_t part) const {
    const ElementForces& elements = parts_.solid.elements();
    const std::size_t per_pack = static_cast<std::size_t>(elements.n_sub_triangles()) * 3 * pack_width;
    if (first_pack_.empty()) {
        first_pack_.push_back(0);
        for (const auto& block : elements.blocks()) first_pack_.push_back(first_pack_.back() + block->n_packs());
        seen_.assign(first_pack_.back(), -1);
        stresses_.resize(first_pack_.back() * per_pack);
    }
    const ElementForces::Place& place = elements.place(side.element);
    const std::size_t pack = index(place.local) / pack_width, lane = index(place.local) % pack_width;
    const std::size_t slot = first_pack_[index(place.block)] + pack;
    double* of_pack = stresses_.data() + slot * per_pack;
    if (seen_[slot] != look_) {
        seen_[slot] = look_;
        elements.blocks()[index(place.block)]->pack_stress(
            pack, elements.evaluation(index(place.block), state, Trial::of(state)), of_pack);
    }
    const auto sub = static_cast<std::size_t>(sub_triangle_at(parts_.mesh.kind, side.side, part));
    const double* xx = of_pack + 3 * sub * pack_width + lane;
    return {xx[0], xx[pack_width], xx[2 * pack_width]};
}

std::array<double, 3> Cracking::mean_stress(const State& state, std::int32_t side, std::size_t part) const {
    const InnerSide& inner = parts_.inner.sides()[index(side)];
    const std::size_t n_parts = side_nodes(parts_.mesh.kind, 0).size() - 1;
    const std::array<double, 3> left = stress(state, inner.left, part);
    const std::array<double, 3> right = stress(state, inner.right, n_parts - 1 - part);
    return {0.5 * (left[0] + right[0]), 0.5 * (left[1] + right[1]), 0.5 * (left[2] + right[2])};
}

std::vector<std::pair<std::int32_t, double>> Cracking::watched_sides(const State& state) const {
    const ElementForces& elements = parts_.solid.elements();
    candidates_.clear();
    looked_at_.resize(parts_.inner.sides().size(), -1);
    for (std::size_t b = 0; b < elements.blocks().size(); ++b) {
        const ElementBlock& block = *elements.blocks()[b];
        const auto beyond = elements.beyond(b, state);
        for (std::size_t pack = 0; pack < beyond.size(); ++pack) {
            if (beyond[pack] == 0) continue;
            const auto lanes = static_cast<unsigned>(beyond[pack]);
            for (std::size_t lane = 0; lane < pack_width; ++lane) {
                const std::size_t local = pack * pack_width + lane;
                if ((lanes >> lane & 1U) == 0 || local >= block.n_elements()) continue;
                for (int side = 0; side < 3; ++side) {
                    const std::int32_t s = parts_.inner.number({block.element(local), side});
                    if (s < 0 || parts_.inner.is_open(s) || looked_at_[index(s)] == look_) continue;
                    looked_at_[index(s)] = look_;
                    candidates_.push_back(s);
                }
            }
        }
    }
    std::vector<std::pair<std::int32_t, double>> found;
    for (const std::int32_t side : candidates_) {
        const ElementSide& left = parts_.inner.sides()[index(side)].left;
        const auto local = side_nodes(parts_.mesh.kind, left.side);
        const std::int32_t* nodes = parts_.mesh.element(index(left.element));
        const std::size_t n_parts = local.size() - 1;
        Vec2<double> traction{0, 0}, line{0, 0};  // times length
        for (std::size_t part = 0; part < n_parts; ++part) {
            const std::size_t a = index(nodes[local[part]]), b = index(nodes[local[part + 1]]);
            const Vec2<double> along{
                parts_.mesh.nodes[b][0] - parts_.mesh.nodes[a][0] + state.u[2 * b] - state.u[2 * a],
                parts_.mesh.nodes[b][1] - parts_.mesh.nodes[a][1] + state.u[2 * b + 1] - state.u[2 * a + 1]};
            const auto [xx, yy, xy] = mean_stress(state, side, part);
            traction = traction + Vec2<double>{xx * along.y - xy * along.x, xy * along.y - yy * along.x};
            line = line + along;
        }
        const double length = std::hypot(line.x, line.y);
        const Vec2<double> t{line.x / length, line.y / length}, n{t.y, -t.x};
        const CohesionProperties<double>& p = parts_.properties[n_parts * index(side)];
        found.emplace_back(side, envelope_index(p, dot(traction, n) / length, dot(traction, t) / length));
    }
    return found;
}

std::vector<std::int32_t> Cracking::sides_beyond(const State& state) {
    std::vector<std::int32_t> beyond;
    for (const auto& [side, index_of_side] : watched_sides(state)) {
        if (!(index_of_side >= 1)) continue;
        beyond.push_back(side);
        largest_overshoot_ = std::max(largest_overshoot_, std::sqrt(index_of_side) - 1);
    }
    std::ranges::sort(beyond);
    return beyond;
}

double Cracking::indicator(const State& state) const {
    ++look_;
    double largest = 0;
    for (const auto& [side, index_of_side] : watched_sides(state)) largest = std::max(largest, index_of_side);
    return std::sqrt(largest) - 1;
}

void Cracking::wake_ends(State& state) {
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
    double offset_energy = 0;
    for (const Family& family : families(ends)) {
        const auto n = static_cast<Eigen::Index>(family.nodes.size());
        const auto place = [&](std::int32_t node) {
            return std::ranges::find(family.nodes, node) - family.nodes.begin();
        };
        // tractions of the stresses on both sides, and what they leave each copy to be short of
        std::vector<std::array<double, 2>> tractions;
        Eigen::MatrixXd conductance = Eigen::MatrixXd::Zero(n, n), rest = Eigen::MatrixXd::Zero(n, 2);
        for (const std::size_t i : family.ends) {
            const Joints::WaitingEnd& end = ends[i];
            const auto [xx, yy, xy] = mean_stress(state, end.side, parts_.joints.part_of_side(end.joint));
            tractions.push_back({xx * end.normal.x + xy * end.normal.y, xy * end.normal.x + yy * end.normal.y});
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
            offset_energy += parts_.joints.wake(end, dot(traction, end.normal), dot(traction, end.along), own);
        }
    }
    state.path.splitting += offset_energy;
}

}  // namespace gneiss
