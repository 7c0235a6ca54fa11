// Contact: what one evaluation of forces does. Candidates in packs, those in touch compressed, their forces in packs,
// then summed in the order of the pairs in touch: which pairs a search has kept beyond them does not move a bit.

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>

#include "base/dual.hpp"
#include "base/errors.hpp"
#include "base/index.hpp"
#include "base/parallel.hpp"
#include "contact/contact.hpp"

namespace gneiss {
namespace {

constexpr std::size_t n_dof = 2 * nodes_per_candidate;
constexpr std::size_t packs_per_range = 256;  ///< what a thread takes at a time

/// body(first, last) on ranges of packs, in threads.
template <class Body>
void ranges_of_packs(std::size_t n_packs, Body body) {
    const auto n_ranges = static_cast<std::ptrdiff_t>((n_packs + packs_per_range - 1) / packs_per_range);
#pragma omp parallel for schedule(static) if (n_ranges > 1)
    for (std::ptrdiff_t r = 0; r < n_ranges; ++r) {
        const std::size_t first = static_cast<std::size_t>(r) * packs_per_range;
        body(first, std::min(first + packs_per_range, n_packs));
    }
}

}  // namespace

void Contact::find_hits(std::span<const double> u) const {
    if (!coupled_) search_if_stale(u);
    const ContactorPoints& points = bodies_.points();
    const auto reference = bodies_.reference();
    x_.resize(reference.size());
    point_x_.resize(2 * points.size());
    parallel_ranges(x_.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) x_[i] = reference[i] + u[i];
    });
    parallel_ranges(points.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t p = first; p < last; ++p) {
            const std::size_t a = 2 * index(points.a[p]), b = 2 * index(points.b[p]);
            const double w = points.weight_b[p];
            point_x_[2 * p] = (1 - w) * x_[a] + w * x_[b];
            point_x_[2 * p + 1] = (1 - w) * x_[a + 1] + w * x_[b + 1];
        }
    });
    const std::size_t n_packs = candidates_.n_packs(), n = candidates_.pairs.size();
    const std::size_t n_ranges = (n_packs + packs_per_range - 1) / packs_per_range;
    if (found_.size() < n_ranges) found_.resize(n_ranges);
    ranges_of_packs(n_packs, [&](std::size_t first, std::size_t last) {
        auto& found = found_[first / packs_per_range];
        found.clear();
        for (std::size_t pack = first; pack < last; ++pack) {
            Vec2<Pack> point;
            std::array<Vec2<Pack>, 3> x;
            std::array<Pack, 3> rising;
            gather_pairs(point_x_.data(), &candidates_.points[pack * pack_width], point.x, point.y);
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t place = (3 * pack + k) * pack_width;
                gather_pairs(x_.data(), &candidates_.nodes[place], x[k].x, x[k].y);
                rising[k] = ones_where(candidates_.rising[3 * pack + k]);
            }
            std::uint64_t inside = lane_bits(contains(point, x, rising));
            for (; inside != 0; inside &= inside - 1) {
                const std::size_t candidate = pack * pack_width + static_cast<std::size_t>(std::countr_zero(inside));
                if (candidate < n) found.push_back(static_cast<std::int32_t>(candidate));
            }
        }
    });
    hits_.clear();
    for (std::size_t r = 0; r < n_ranges; ++r) hits_.insert(hits_.end(), found_[r].begin(), found_[r].end());
}

bool Contact::adjacent(std::int32_t triangle, std::int32_t other) const {
    for (const std::int32_t a : bodies_.triangles()[index(triangle)])
        for (const std::int32_t b : bodies_.triangles()[index(other)])
            if (a == b) return true;
    return false;
}

double Contact::match(std::span<const double> history) const {
    if (!remembers_) return 0;
    slots_.assign(hits_.size(), -1);
    known_.assign(hits_.size(), 0);
    const std::size_t n_points = points_.size();
    const AcceptedMemory memory(history, n_points);
    std::array<const double*, contact_slots> before;  // triangles
    for (std::size_t s = 0; s < contact_slots; ++s) before[s] = memory.triangles(s).data();
    const auto in_use = [&](std::size_t point) {
        bool any = false;
        for (std::size_t s = 0; s < contact_slots; ++s) any |= before[s][point] >= 0;
        return any;
    };
    const auto pair_at = [&](std::size_t hit) { return candidates_.pairs[index(hits_[hit])]; };
    double released = 0;
    std::size_t last = 0;
    for (std::size_t point = 0; point < n_points; ++point) {
        const std::size_t first = last;
        while (last < hits_.size() && index(pair_at(last).point) == point) ++last;
        if (!in_use(point)) {
            for (std::size_t hit = first; hit < std::min(last, first + contact_slots); ++hit)
                slots_[hit] = static_cast<std::int8_t>(hit - first);
            continue;
        }
        std::array<bool, contact_slots> taken{}, kept{};
        const auto take = [&](std::size_t hit, std::size_t slot, bool known) {
            slots_[hit] = static_cast<std::int8_t>(slot);
            known_[hit] = known;
            taken[slot] = true;
            kept[slot] = known;
        };
        // the same triangle, else one at it, else a slot whose body the point has left
        std::size_t n_left = last - first;
        const auto for_each_choice = [&](auto good, bool known) {
            if (n_left == 0) return;
            for (std::size_t hit = first; hit < last; ++hit)
                for (std::size_t s = 0; s < contact_slots && slots_[hit] < 0; ++s)
                    if (!taken[s] && good(static_cast<std::int32_t>(before[s][point]), pair_at(hit).triangle)) {
                        take(hit, s, known);
                        --n_left;
                    }
        };
        for_each_choice([](std::int32_t old, std::int32_t now) { return old == now; }, true);
        for_each_choice([&](std::int32_t old, std::int32_t now) { return old >= 0 && adjacent(old, now); }, true);
        for_each_choice([](std::int32_t, std::int32_t) { return true; }, false);
        for (std::size_t s = 0; s < contact_slots; ++s) {
            const auto triangle = static_cast<std::int32_t>(before[s][point]);
            if (triangle < 0 || kept[s]) continue;
            const double normal = stiffness_of({static_cast<std::int32_t>(point), triangle});
            const ContactLaw<double> law{normal, options_.tangential_factor * normal, options_.friction, 1.0};
            released += released_energy(law, memory.at(point, s));
        }
    }
    return released;
}

double Contact::stiffness_of(const ContactCandidate& pair) const {
    const PointConstants& point = points_[index(pair.point)];
    return point.area / (point.layer + targets_[index(pair.triangle)].layer);
}

LoadedPairs Contact::load(std::size_t pack, std::span<const double> history) const {
    std::array<PairNumber, pack_width> triangles, points, memories;
    alignas(pack_alignment) std::array<double, pack_width> known, held;
    PairNumber* nodes = &hit_nodes_[pack * nodes_per_candidate * pack_width];
    const ContactorPoints& all = bodies_.points();
    const AcceptedMemory memory(history, all.size());
    for (std::size_t lane = 0; lane < pack_width; ++lane) {
        const std::size_t hit = std::min(pack * pack_width + lane, hits_.size() - 1);
        const ContactCandidate& pair = candidates_.pairs[index(hits_[hit])];
        const auto& triangle = bodies_.triangles()[index(pair.triangle)];
        nodes[lane] = {all.a[index(pair.point)]};
        nodes[pack_width + lane] = {all.b[index(pair.point)]};
        for (std::size_t k = 0; k < 3; ++k) nodes[(k + 2) * pack_width + lane] = {triangle[k]};
        triangles[lane] = {pair.triangle * static_cast<std::int32_t>(TargetConstants::n_pairs)};
        points[lane] = {pair.point * static_cast<std::int32_t>(PointConstants::n_pairs)};
        if (!remembers_) continue;
        known[lane] = known_[hit];
        held[lane] = slots_[hit] >= 0 ? 1.0 : 0.0;
        memories[lane] = {
            static_cast<std::int32_t>(known_[hit] != 0 ? memory.pair_of(index(pair.point), index(slots_[hit])) : 0)};
    }
    LoadedPairs pairs;
    const std::array<Vec2<Pack>*, nodes_per_candidate> at{&pairs.a, &pairs.b, &pairs.x[0], &pairs.x[1], &pairs.x[2]};
    for (std::size_t k = 0; k < nodes_per_candidate; ++k)
        gather_pairs(x_.data(), nodes + k * pack_width, at[k]->x, at[k]->y);
    for (std::size_t k = 0; k < 3; ++k)
        gather_pairs(bodies_.reference().data(), nodes + (k + 2) * pack_width, pairs.target.reference[k].x,
                     pairs.target.reference[k].y);
    const double* constants = targets_.front().nodal.data();
    Pack layer, area, other_layer, unused;
    gather_pairs(constants, triangles.data(), pairs.target.nodal[0], pairs.target.nodal[1]);
    gather_pairs(constants + 2, triangles.data(), pairs.target.nodal[2], pairs.target.bubble);
    gather_pairs(constants + 4, triangles.data(), pairs.target.reach, layer);
    gather_pairs(&points_.front().weight_b, points.data(), pairs.weight_b, area);
    gather_pairs(&points_.front().layer, points.data(), other_layer, unused);
    const Pack normal = area / (layer + other_layer);
    const double returned = options_.restitution * options_.restitution;
    pairs.law = {normal, options_.tangential_factor * normal, Pack(0.0), Pack(1.0)};
    if (!remembers_) return pairs;

    const auto is_held = Pack::load_aligned(held.data()) > Pack(0.5);
    pairs.law.friction = choose(is_held, Pack(options_.friction), Pack(0.0));
    pairs.law.returned = choose(is_held, Pack(returned), Pack(1.0));
    pairs.old.in_touch = Pack::load_aligned(known.data());
    const auto is_known = pairs.old.in_touch > Pack(0.5);
    if (!any_lane(is_known)) return pairs;
    const double* members = memory.pairs();
    gather_pairs(members, memories.data(), pairs.old.anchor.x, pairs.old.anchor.y);
    gather_pairs(members + 2, memories.data(), pairs.old.slip.x, pairs.old.slip.y);
    gather_pairs(members + 4, memories.data(), pairs.old.slip_limit, pairs.old.deepest);
    gather_pairs(members + 6, memories.data(), pairs.old.rest, unused);
    for (Pack* member : {&pairs.old.anchor.x, &pairs.old.anchor.y, &pairs.old.slip.x, &pairs.old.slip.y,
                         &pairs.old.slip_limit, &pairs.old.deepest, &pairs.old.rest})
        *member = choose(is_known, *member, Pack(0.0));
    return pairs;
}

std::size_t Contact::respond(std::span<const double> history, std::span<double> updated) const {
    const std::size_t n_packs = padded(hits_.size()) / pack_width;
    hit_nodes_.resize(n_packs * nodes_per_candidate * pack_width);
    forces_.resize(n_packs * n_dof * pack_width);
    for (AlignedDoubles* energy : {&stored_, &slid_, &lost_}) energy->resize(n_packs * pack_width);
    std::size_t deep = std::numeric_limits<std::size_t>::max();
#pragma omp parallel for schedule(static, packs_per_range) reduction(min : deep) if (n_packs > packs_per_range)
    for (std::ptrdiff_t p = 0; p < static_cast<std::ptrdiff_t>(n_packs); ++p) {
        const auto pack = static_cast<std::size_t>(p), first = pack * pack_width;
        const LoadedPairs pairs = load(pack, history);
        const auto response = remembers_ ? pairs.respond(pairs.a, pairs.b, pairs.x)
                                         : pairs.respond<Tangential::none>(pairs.a, pairs.b, pairs.x);
        if (any_lane(response.too_deep))
            deep = std::min(deep, first + static_cast<std::size_t>(std::countr_zero(lane_bits(response.too_deep))));
        const auto forces = nodal_forces(response, pairs.weight_b);
        double* to = &forces_[pack * n_dof * pack_width];
        for (std::size_t k = 0; k < nodes_per_candidate; ++k) {
            forces[k].x.store_aligned(to + 2 * k * pack_width);
            forces[k].y.store_aligned(to + (2 * k + 1) * pack_width);
        }
        const std::size_t n_lanes = std::min(pack_width, hits_.size() - first);
        for (std::size_t lane = n_lanes; lane < pack_width; ++lane)
            for (std::size_t k = 0; k < n_dof; ++k) to[k * pack_width + lane] = 0;
        (response.stored_normal + response.stored_tangential).store_aligned(&stored_[first]);
        response.dissipated_friction.store_aligned(&slid_[first]);
        response.dissipated_normal.store_aligned(&lost_[first]);
        if (updated.empty()) continue;
        const Memory memory(updated, bodies_.points().size());
        const auto& next = response.next;
        alignas(pack_alignment) std::array<std::array<double, pack_width>, 7> members;
        const std::array<const Pack*, 7> rows{&next.anchor.x,   &next.anchor.y, &next.slip.x, &next.slip.y,
                                              &next.slip_limit, &next.deepest,  &next.rest};
        for (std::size_t k = 0; k < rows.size(); ++k) rows[k]->store_aligned(members[k].data());
        for (std::size_t lane = 0; lane < n_lanes; ++lane) {
            if (slots_[first + lane] < 0) continue;
            const ContactCandidate& pair = candidates_.pairs[index(hits_[first + lane])];
            memory.set(index(pair.point), index(slots_[first + lane]), pair.triangle,
                       {1.0,
                        {members[0][lane], members[1][lane]},
                        {members[2][lane], members[3][lane]},
                        members[4][lane],
                        members[5][lane],
                        members[6][lane]});
        }
    }
    return deep;
}

void Contact::add_force(const Trial& trial, std::span<const double> history, std::span<double> f,
                        std::span<double> updated) const {
    const double limit = 0.5 * options_.skin;
    const auto u = bonded(trial.u);
    if (const double moved = coupled_ ? largest_motion(u, searched_) : 0; !(moved <= limit))
        throw RecoverableError(fmt::format(
            "contact at t = {:.9g} s: a node has moved {:.3g} m since pairs were searched, further than half "
            "of contact.skin, {:.3g} m",
            trial.t, moved, limit));
    find_hits(u);
    const double released = match(history);
    if (!updated.empty()) Memory(updated, bodies_.points().size()).free_all();
    if (const std::size_t deep = respond(history, updated); deep < hits_.size()) refuse_deep(trial, deep);
    std::span<double> on_bonded = f;
    if (!bodies_.whole()) {
        f_.assign(2 * bodies_.n_nodes(), 0.0);
        on_bonded = f_;
    }
    const std::size_t n_packs = padded(hits_.size()) / pack_width;
    for (std::size_t pack = 0; pack < n_packs; ++pack)
        for (std::size_t k = 0; k < nodes_per_candidate; ++k) {
            const double* force = &forces_[(pack * n_dof + 2 * k) * pack_width];
            scatter_add_pairs(on_bonded.data(), &hit_nodes_[(pack * nodes_per_candidate + k) * pack_width],
                              Pack::load_aligned(force), Pack::load_aligned(force + pack_width));
        }
    if (!bodies_.whole() && !hits_.empty()) bodies_.spread(f_, f);
    if (updated.empty()) return;
    double slid = released, lost = 0;
    for (std::size_t hit = 0; hit < hits_.size(); ++hit) {
        slid += slid_[hit];
        lost += lost_[hit];
    }
    const AcceptedMemory before(history, points_.size());
    const Memory after(updated, points_.size());
    after.friction() = before.friction() + slid;
    after.restitution() = before.restitution() + lost;
}

double Contact::stored(std::span<const double> u, std::span<const double> history) const {
    find_hits(u);
    match(history);
    respond(history, {});
    double sum = 0;
    for (std::size_t hit = 0; hit < hits_.size(); ++hit) sum += stored_[hit];
    return sum;
}

void Contact::stiffness(const Trial& trial, std::span<const double> history,
                        std::span<ForceTerm::Stiffness> df_du) const {
    using D = Dual<static_cast<int>(n_dof), Pack>;
    std::ranges::fill(df_du, ForceTerm::Stiffness{0, 0, 0, 0});
    find_hits(bonded(trial.u));
    match(history);
    const std::size_t n_packs = padded(hits_.size()) / pack_width;
    hit_nodes_.resize(n_packs * nodes_per_candidate * pack_width);
    ranges_of_packs(n_packs, [&](std::size_t first, std::size_t last) {
        std::vector<Held> nodes;
        for (std::size_t pack = first; pack < last; ++pack) {
            const LoadedPairs pairs = load(pack, history);
            const std::array<Vec2<Pack>, nodes_per_candidate> at{pairs.a, pairs.b, pairs.x[0], pairs.x[1], pairs.x[2]};
            std::array<Vec2<D>, nodes_per_candidate> moved;
            for (int k = 0; k < static_cast<int>(nodes_per_candidate); ++k)
                moved[static_cast<std::size_t>(k)] = {D::variable(at[static_cast<std::size_t>(k)].x, 2 * k),
                                                      D::variable(at[static_cast<std::size_t>(k)].y, 2 * k + 1)};
            const auto f = nodal_forces(pairs.respond(moved[0], moved[1], std::array{moved[2], moved[3], moved[4]}),
                                        pairs.weight_b);
            for (std::size_t lane = 0; lane < pack_width && pack * pack_width + lane < hits_.size(); ++lane) {
                const std::size_t candidate = index(hits_[pack * pack_width + lane]);
                ForceTerm::Stiffness* to = &df_du[first_coupling_[candidate]];
                held_by(candidates_.pairs[candidate], nodes);
                for (const Held& a : nodes)
                    for (const Held& b : nodes) {
                        const double share = a.share * b.share;
                        const auto &fx = f[a.local].x.derivative, &fy = f[a.local].y.derivative;
                        *to++ = {share * fx[2 * b.local].get(lane), share * fx[2 * b.local + 1].get(lane),
                                 share * fy[2 * b.local].get(lane), share * fy[2 * b.local + 1].get(lane)};
                    }
            }
        }
    });
}

void Contact::refuse_deep(const Trial& trial, std::size_t hit) const {
    const ContactCandidate& pair = candidates_.pairs[index(hits_[hit])];
    const auto nodes = nodes_of(pair);
    const std::int64_t a = bodies_.node_label(nodes[0]), b = bodies_.node_label(nodes[1]);
    throw RecoverableError(fmt::format(
        "contact at t = {:.9g} s: {} at ({:.6g}, {:.6g}) m is deeper in element {} than the {:.3g} m that push it out; "
        "a larger contact.penalty overlaps less",
        trial.t, a == b ? fmt::format("node {}", a) : fmt::format("the edge of nodes {} and {}", a, b),
        point_x_[2 * index(pair.point)], point_x_[2 * index(pair.point) + 1], bodies_.element_label(pair.triangle),
        targets_[index(pair.triangle)].reach));
}

}  // namespace gneiss
