// Contact on a mesh that comes apart: after every side that fails it is what it would be had it started there.

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "contact/contact.hpp"
#include "support/one_thread.hpp"
#include "support/touching_solids.hpp"

namespace gneiss {
namespace {

Contact::Options rough_and_bouncing() { return {.friction = 0.5, .restitution = 0.8, .skin = 0.05}; }

constexpr double cap = 3;

std::vector<double> layers_of(const Mesh& mesh) { return std::vector<double>(mesh.n_elements(), 1e-10); }

State displaced(std::size_t n_nodes, double size, unsigned seed) {
    State state;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-size, size);
    state.u.resize(2 * n_nodes);
    for (double& u : state.u) u = uniform(random);
    return state;
}

struct Evaluation {
    std::vector<double> f, history;
};
Evaluation evaluate(const Contact& contact, const State& state, const std::vector<double>& history) {
    Evaluation result{std::vector<double>(state.u.size()), std::vector<double>(history.size())};
    contact.add_force(Trial::of(state), history, result.f, result.history);
    return result;
}
double stored(const Contact& contact, const State& state, const std::vector<double>& history) {
    StoredEnergies energies;
    contact.add_stored(Trial::of(state), history, energies);
    return energies.contact;
}

class FollowOf : public testing::TestWithParam<bool> {
protected:
    Mesh mesh = [] {
        Mesh made = test::rectangle(GetParam(), 2, 1, {3, 2});
        test::distort(made, 0.25, 0.2, 3);
        return made;
    }();
    /// Sides in a random order.
    static std::vector<std::int32_t> shuffled(std::size_t n) {
        std::vector<std::int32_t> sides(n);
        std::iota(sides.begin(), sides.end(), 0);
        std::ranges::shuffle(sides, std::mt19937(5));
        return sides;
    }
};
INSTANTIATE_TEST_SUITE_P(Elements, FollowOf, testing::Bool(),
                         [](const auto& instance) { return std::string(instance.param ? "Compt" : "Cst"); });

TEST_P(FollowOf, JointsFailOneByOne_AsIfStartedThere) {
    InnerSides sides(mesh);
    const std::vector<std::int32_t> order = shuffled(sides.sides().size());
    sides.open(order);
    const State state = displaced(mesh.n_nodes(), 2e-3, 1), later = displaced(mesh.n_nodes(), 2e-3, 2);
    Contact contact({mesh, sides.original_of()}, layers_of(mesh), cap, rough_and_bouncing());
    std::vector<double> history(contact.n_history());
    contact.initial_history(history);
    EXPECT_EQ(stored(contact, state, history), 0) << "what is bonded does not touch";
    std::vector<std::int32_t> failed;
    for (const std::int32_t side : order) {
        PathEnergies energies;
        const double before = stored(contact, state, history);
        contact.follow({mesh, {}, {}, {}, std::span(&side, 1)}, state, history, energies);
        failed.push_back(side);
        ASSERT_EQ(history.size(), contact.n_history());
        EXPECT_DOUBLE_EQ(energies.splitting, stored(contact, state, history) - before);

        Contact fresh({mesh, sides.original_of(), failed}, layers_of(mesh), cap, rough_and_bouncing());
        std::vector<double> none(fresh.n_history());
        ASSERT_EQ(none.size(), history.size());
        fresh.initial_history(none);
        contact.look(state);
        EXPECT_EQ(evaluate(contact, state, none).f, evaluate(fresh, state, none).f);
        history = evaluate(contact, later, evaluate(contact, state, history).history).history;
        history = evaluate(contact, state, history).history;
    }
    EXPECT_GT(stored(contact, state, history), 0);
}

TEST_P(FollowOf, NodesSplitAsSidesFail_AsIfStartedThere) {
    InnerSides sides(mesh);
    const std::size_t n_nodes = mesh.n_nodes();
    Contact contact({mesh}, layers_of(mesh), cap, rough_and_bouncing());
    std::vector<double> history(contact.n_history());
    contact.initial_history(history);
    std::vector<std::int32_t> failed;
    State state = displaced(n_nodes, 0, 1);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-2e-3, 2e-3);
    std::size_t n_touching = 0;
    for (const std::int32_t side : shuffled(sides.sides().size())) {
        const std::vector<NodeCopy> more = sides.open(std::span(&side, 1));
        failed.push_back(side);
        for (const NodeCopy& copy : more)
            for (const std::size_t component : {0, 1})
                state.u.push_back(double{state.u[2 * static_cast<std::size_t>(copy.original) + component]});
        PathEnergies energies;
        contact.follow({mesh, more, {}, {}, std::span(&side, 1)}, state, history, energies);
        const Contact fresh({mesh, sides.original_of(), failed}, layers_of(mesh), cap, rough_and_bouncing());
        std::vector<double> none(fresh.n_history());
        ASSERT_EQ(none.size(), history.size());
        fresh.initial_history(none);
        for (double& u : state.u) u = uniform(random);
        const Evaluation now = evaluate(contact, state, none);
        EXPECT_EQ(now.f, evaluate(fresh, state, none).f);
        n_touching += std::ranges::any_of(now.f, [](double f) { return f != 0; });
        history = evaluate(contact, state, history).history;
    }
    EXPECT_GT(n_touching, failed.size() / 2);
}

/// Two bodies, the upper one 2 mm inside the lower one, all of whose sides are open while nothing has failed.
class Bonded : public testing::TestWithParam<bool> {
protected:
    std::int32_t n_lower = 0;  ///< nodes of the lower body
    const Mesh whole = [this] {
        Mesh lower = test::rectangle(GetParam(), 2, 1, {3, 2}), upper = test::rectangle(GetParam(), 1, 1, {2, 2});
        test::distort(lower, 0.25, 0.2, 3);
        n_lower = static_cast<std::int32_t>(lower.n_nodes());
        return test::together(std::move(lower), test::moved(std::move(upper), 0.53, 0.998));
    }();
    Mesh mesh = whole;
    InnerSides sides = InnerSides(mesh);
    std::vector<std::int32_t> all = [this] {
        std::vector<std::int32_t> numbers(sides.sides().size());
        std::iota(numbers.begin(), numbers.end(), 0);
        sides.open(numbers);
        return numbers;
    }();
    /// Joints opened and closed by up to 0.4 mm.
    State state = displaced(mesh.n_nodes(), 2e-4, 7);

    static Contact::Options coming_apart() {
        Contact::Options options = rough_and_bouncing();
        options.comes_apart = true;
        return options;
    }
    /// The history that contact has in this state when nothing has been before.
    std::vector<double> touched(const Contact& contact) const {
        std::vector<double> history(contact.n_history());
        contact.initial_history(history);
        return evaluate(contact, state, history).history;
    }
};
INSTANTIATE_TEST_SUITE_P(Elements, Bonded, testing::Bool(),
                         [](const auto& instance) { return std::string(instance.param ? "Compt" : "Cst"); });

TEST_P(Bonded, JointsThatGiveALittle_PressAsOneBodyAtTheirMeans) {
    const Contact parted({mesh, sides.original_of()}, layers_of(mesh), cap, rough_and_bouncing());
    const Contact one({whole}, layers_of(whole), cap, rough_and_bouncing());
    State mean;
    mean.u.assign(2 * whole.n_nodes(), 0.0);
    std::vector<double> n_copies(whole.n_nodes(), 0.0);
    const auto original = [&](std::size_t node) { return static_cast<std::size_t>(sides.original_of()[node]); };
    for (std::size_t node = 0; node < mesh.n_nodes(); ++node) ++n_copies[original(node)];
    for (std::size_t i = 0; i < state.u.size(); ++i)
        mean.u[2 * original(i / 2) + i % 2] += state.u[i] / n_copies[original(i / 2)];
    std::vector<double> history(one.n_history());
    one.initial_history(history);
    const std::vector<double> expected = evaluate(one, mean, history).f, given = evaluate(parted, state, history).f;
    std::vector<double> summed(expected.size(), 0.0);
    for (std::size_t i = 0; i < given.size(); ++i) summed[2 * original(i / 2) + i % 2] += given[i];
    const double largest = std::abs(*std::ranges::max_element(expected, {}, [](double f) { return std::abs(f); }));
    ASSERT_GT(largest, 1e4);
    constexpr double round_off = 1e-10;  // of depths of 1 mm at places of 1 m
    for (std::size_t i = 0; i < summed.size(); ++i) EXPECT_NEAR(summed[i], expected[i], round_off * largest) << i;
    EXPECT_NEAR(stored(parted, state, history), stored(one, mean, history), round_off * stored(one, mean, history));
}

TEST_P(Bonded, Tangent_IsThatOfDifferences) {
    Contact::Options elastic = rough_and_bouncing();
    elastic.restitution = 1;  // otherwise the force has a kink where it is now
    const Contact contact({mesh, sides.original_of()}, layers_of(mesh), cap, elastic);
    const std::vector<double> history = touched(contact);
    const auto couplings = contact.couplings();
    std::vector<ForceTerm::Stiffness> blocks(couplings.size());
    contact.stiffness(Trial::of(state), history, blocks);
    const std::size_t n = state.u.size();
    std::vector<double> along(n), predicted(n, 0.0);
    std::mt19937 random(9);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (double& value : along) value = uniform(random);
    for (std::size_t k = 0; k < couplings.size(); ++k) {
        const auto a = 2 * static_cast<std::size_t>(couplings[k][0]), b = 2 * static_cast<std::size_t>(couplings[k][1]);
        predicted[a] += blocks[k].xx * along[b] + blocks[k].xy * along[b + 1];
        predicted[a + 1] += blocks[k].yx * along[b] + blocks[k].yy * along[b + 1];
    }
    constexpr double way =
        1e-7;  // small against depths of 1 mm, so that curvature is; round-off then is 1e-9 of the force
    State more = state, less = state;
    for (std::size_t i = 0; i < n; ++i) {
        more.u[i] += way * along[i];
        less.u[i] -= way * along[i];
    }
    const std::vector<double> f_more = evaluate(contact, more, history).f, f_less = evaluate(contact, less, history).f;
    const double largest = std::abs(*std::ranges::max_element(predicted, {}, [](double f) { return std::abs(f); }));
    ASSERT_GT(largest, 1e6);
    for (std::size_t i = 0; i < n; ++i)
        EXPECT_NEAR((f_more[i] - f_less[i]) / (2 * way), predicted[i], 1e-5 * largest) << i;
}

TEST_P(Bonded, WhatOverlapsAsItFails_IsNotPushedApart) {
    Contact contact({mesh, sides.original_of()}, layers_of(mesh), cap, coming_apart());
    std::vector<double> history = touched(contact);
    const double before = stored(contact, state, history);
    ASSERT_GT(before, 0);
    PathEnergies energies;
    contact.follow({mesh, {}, {}, {}, all}, state, history, energies);
    const double after = stored(contact, state, history);
    EXPECT_DOUBLE_EQ(energies.splitting, after - before);
    EXPECT_LE(after, before) << "coming apart gives no energy";
    ASSERT_GT(contact.overlaps(state.u, 1e-5).size(), 20u) << "the joints had closed";

    // nothing moves: nothing changes; what then presses further stores energy from there on
    history = evaluate(contact, state, history).history;
    EXPECT_NEAR(stored(contact, state, history), after, 1e-9 * before);
    State closer = state;
    for (std::size_t node = 0; node < mesh.n_nodes(); ++node)
        if (sides.original_of()[node] >= n_lower) closer.u[2 * node + 1] -= 1e-4;
    EXPECT_GT(stored(contact, closer, history), after);
}

TEST_P(Bonded, WhatFailsElsewhere_ChangesNoForce_AndNothingIsBookedTwice) {
    // sides of the upper body that do not come near the lower one
    Contact contact({mesh, sides.original_of()}, layers_of(mesh), cap, coming_apart());
    std::vector<double> history = touched(contact);
    for (double& u : state.u) u *= 1.05;  // springs are drawn
    const Evaluation before = evaluate(contact, state, history);
    history = before.history;
    const auto is_high = [&](std::int32_t side) {
        const ElementSide& left = sides.sides()[static_cast<std::size_t>(side)].left;
        const std::int32_t* nodes = whole.element(static_cast<std::size_t>(left.element));
        return std::ranges::all_of(side_nodes(whole.kind, left.side),
                                   [&](int k) { return whole.nodes[static_cast<std::size_t>(nodes[k])][1] > 1.4; });
    };
    std::vector<std::int32_t> high;
    std::ranges::copy_if(all, std::back_inserter(high), is_high);
    ASSERT_GE(high.size(), 4u);
    PathEnergies energies;
    contact.follow({mesh, {}, {}, {}, high}, state, history, energies);
    const Evaluation after = evaluate(contact, state, history);
    const double largest = std::abs(*std::ranges::max_element(before.f, {}, [](double f) { return std::abs(f); }));
    for (std::size_t node = 0; node < mesh.n_nodes(); ++node)
        for (const std::size_t i : {2 * node, 2 * node + 1})
            if (sides.original_of()[node] < n_lower) {
                EXPECT_NEAR(after.f[i], before.f[i], 1e-9 * largest);
            }
    // friction and restitution: the state is the same, so is what has been lost
    EXPECT_NEAR(after.history[0], history[0], 1e-9 * stored(contact, state, history));
    EXPECT_NEAR(after.history[1], history[1], 1e-9 * stored(contact, state, history));
}

TEST(FormerPoints, OfACopiedNode_AreThatNode_WithThePartOfTheLengthThatWasThere) {
    // edges 0-1 and 1-2 of length 1; then node 1 is copied to 3, and an edge 3-4 of length 2 comes beside them
    const std::vector<Point2> before{{0, 0}, {1, 0}, {2, 0}}, after{{0, 0}, {1, 0}, {2, 0}, {1, 0}, {1, -2}};
    const std::vector<BoundaryEdge> old_edges{{0, 1, 0}, {1, 2, 0}}, edges{{0, 1, 0}, {3, 2, 0}, {3, 4, 0}};
    const ContactorPoints old = contactor_points(old_edges, before), now = contactor_points(edges, after);
    const std::vector<FormerPoint> former = former_points(old, now);
    ASSERT_EQ(former.size(), now.size());
    for (std::size_t p = 0; p < now.size(); ++p) {
        const bool is_node = now.a[p] == now.b[p];
        const std::int32_t node = now.a[p];
        if (is_node && node == 4) {
            EXPECT_EQ(former[p].point, -1);
        } else if (is_node) {
            EXPECT_EQ(old.a[static_cast<std::size_t>(former[p].point)], node == 3 ? 1 : node);
            // 1/6 of 1 beside 1/6 of 2
            EXPECT_NEAR(former[p].share, node == 3 ? 1.0 / 3 : 1.0, 1e-15);
        }
    }
    // the lengths that were there add up to those of the old points
    double kept = 0, had = 0;
    for (std::size_t p = 0; p < now.size(); ++p) kept += former[p].share * now.length[p];
    for (const double length : old.length) had += length;
    EXPECT_NEAR(kept, had, 1e-15);
}

TEST_P(Bonded, SideThatStandsAlone_ComesApartWithItsNeighbour) {
    const Contact contact({mesh, sides.original_of()}, layers_of(mesh), cap, rough_and_bouncing());
    const ContactBodies& bodies = contact.bodies();
    EXPECT_EQ(bodies.come_apart(all), all);
    const auto at = [&](double x, double y) {
        return [this, x, y](const InnerSide& side) {
            const auto local = side_nodes(whole.kind, side.left.side);
            const std::int32_t* nodes = whole.element(static_cast<std::size_t>(side.left.element));
            return std::ranges::any_of(local, [&](int k) {
                const auto& place = whole.nodes[static_cast<std::size_t>(nodes[k])];
                return std::hypot(place[0] - x, place[1] - y) < 1e-12;
            });
        };
    };
    // around the node in the middle of the upper body
    std::vector<std::int32_t> around;
    for (const std::int32_t side : all)
        if (at(1.03, 1.498)(sides.sides()[static_cast<std::size_t>(side)])) around.push_back(side);
    ASSERT_GE(around.size(), 4u);
    const std::vector<std::int32_t> alone{around[0]}, two{around[0], around[2]};
    EXPECT_EQ(bodies.come_apart(alone), GetParam() ? alone : std::vector<std::int32_t>{});
    EXPECT_EQ(bodies.come_apart(two), two);
}

TEST(ContactBodies, SideThatFailsWhereItsFacesHaveANodeInCommon_StaysBondedThere) {
    // two cells of composites; the side between them comes apart at its lower end last
    Mesh mesh = test::rectangle(true, 2, 1, {2, 1});
    const Mesh whole = mesh;
    InnerSides sides(mesh);
    std::int32_t middle = -1;
    std::vector<SideNode> upper, lower;
    for (std::int32_t s = 0; s < static_cast<std::int32_t>(sides.sides().size()); ++s) {
        const ElementSide& left = sides.sides()[static_cast<std::size_t>(s)].left;
        const auto local = side_nodes(whole.kind, left.side);
        const auto at = [&](std::size_t place) {
            return whole
                .nodes[static_cast<std::size_t>(whole.element(static_cast<std::size_t>(left.element))[local[place]])];
        };
        if (at(0)[0] != 1 || at(2)[0] != 1) continue;
        middle = s;
        for (std::size_t place = 0; place < local.size(); ++place)
            (at(place)[1] > 0 ? upper : lower).push_back({s, static_cast<std::int32_t>(place)});
    }
    ASSERT_EQ(upper.size(), 2u);
    ASSERT_EQ(lower.size(), 1u);
    Contact contact({mesh}, layers_of(mesh), cap, rough_and_bouncing());
    std::vector<double> history(contact.n_history());
    contact.initial_history(history);
    const std::size_t n_edges = contact.bodies().points().of_edge.size();
    const auto follow = [&](const std::vector<SideNode>& ends, std::span<const std::int32_t> failed) {
        const std::vector<NodeCopy> copies = sides.open(ends);
        EXPECT_EQ(copies.size(), ends.size());
        PathEnergies energies;
        contact.follow({mesh, copies, {}, {}, failed}, displaced(mesh.n_nodes(), 0, 1), history, energies);
        EXPECT_EQ(contact.bodies().n_nodes(), mesh.n_nodes());
        for (std::size_t node = 0; node < mesh.n_nodes(); ++node)
            EXPECT_EQ(contact.bodies().held(static_cast<std::int32_t>(node)).size(), 1u);
        EXPECT_EQ(contact.bodies().points().of_edge.size(), n_edges + 4) << "two sub-edges of each face";
    };
    follow(upper, std::span(&middle, 1));
    follow(lower, {});
}

}  // namespace
}  // namespace gneiss
