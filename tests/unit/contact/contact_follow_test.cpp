// Contact on a mesh that comes apart: after every side that fails it is what it would be had it started there.

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "contact/contact.hpp"
#include "support/one_thread.hpp"
#include "support/small_solids.hpp"

namespace gneiss {
namespace {

Contact::Options rough() { return {.friction = 0.5, .restitution = 0.8, .skin = 0.05}; }

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
    Contact contact({mesh, sides.original_of()}, layers_of(mesh), cap, rough());
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

        Contact fresh({mesh, sides.original_of(), failed}, layers_of(mesh), cap, rough());
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
    Contact contact({mesh}, layers_of(mesh), cap, rough());
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
        const Contact fresh({mesh, sides.original_of(), failed}, layers_of(mesh), cap, rough());
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

}  // namespace
}  // namespace gneiss
