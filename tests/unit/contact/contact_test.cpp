// Contact as an interaction: forces, tangents, energies, bounds, and what is refused.

#include "contact/contact.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <random>

#include "base/errors.hpp"
#include "model/rigid_motions.hpp"
#include "support/eps.hpp"
#include "support/one_thread.hpp"
#include "support/touching_solids.hpp"
#include "system/march.hpp"

namespace gneiss {
namespace {

using test::eps;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// A block of 1 m x 0.5 m on one of 2 m x 1 m with nodes elsewhere, a little askew.
Mesh stacked(bool compt, double gap = 1e-9) {
    Mesh below = test::rectangle(compt, 2, 1, {3, 2});
    test::distort(below, 0.25, 0.2, 3);
    Mesh above = test::rectangle(compt, 1, 0.5, {2, 2});
    test::distort(above, 0.12, 0.2, 5);
    return test::together(std::move(below), test::moved(std::move(above), 0.43, 1 + gap));
}

ContactOptions rough() {
    ContactOptions options;
    options.friction = 0.5;
    options.restitution = 0.8;
    options.tangential_factor = 0.7;
    options.skin = 0.5;
    return options;
}

class ContactOf : public testing::TestWithParam<bool> {
protected:
    test::Solid solid_of(const ContactOptions& options) { return test::touching_solid(stacked(GetParam()), options); }

    /// The upper body moved by (x, y), all nodes by up to `noise`, m.
    static State pressed(const test::Solid& solid, double x, double y, double noise, unsigned seed = 1) {
        State state = solid.system->initial_state();
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> uniform(-noise, noise);
        for (double& u : state.u) u = uniform(random);
        for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node) {
            if (solid.mesh.nodes[node][1] <= 1) continue;
            state.u[2 * node] += x;
            state.u[2 * node + 1] += y;
        }
        return state;
    }
    static State accepted(const test::Solid& solid, const State& from, State to) {
        std::vector<double> f(to.u.size()), z(to.z.size()), history(to.history.size());
        solid.system->force_and_update(from, Trial::of(to), f, z, history);
        to.history = history;
        to.path = from.path;
        solid.system->add_path_energies(from, to);
        return to;
    }
    /// Of contact alone: what the same solid without it lacks.
    std::vector<double> contact_force(const test::Solid& solid, const State& from, const State& at) const {
        const test::Solid without = test::make_solid(Mesh(solid.mesh), {});
        std::vector<double> f(at.u.size()), elastic(at.u.size());
        solid.system->force(from, Trial::of(at), f);
        without.system->force(from, Trial::of(at), elastic);
        for (std::size_t i = 0; i < f.size(); ++i) f[i] -= elastic[i];
        return f;
    }
};
INSTANTIATE_TEST_SUITE_P(Elements, ContactOf, testing::Bool(),
                         [](const auto& instance) { return std::string(instance.param ? "Compt" : "Cst"); });

TEST_P(ContactOf, Force_IsMinusTheGradientOfTheStoredEnergy) {
    const test::Solid solid = solid_of({.skin = 0.5});
    const State state = pressed(solid, 0.01, -0.006, 2e-3);
    const std::vector<double> f = contact_force(solid, state, state);
    double largest = 0;
    for (const double component : f) largest = std::max(largest, std::abs(component));
    ASSERT_GT(largest, 1e5);
    const double size = 1e-7;
    for (std::size_t i = 0; i < f.size(); ++i) {
        State plus = state, minus = state;
        plus.u[i] += size;
        minus.u[i] -= size;
        const double slope =
            (solid.system->stored_energies(plus).contact - solid.system->stored_energies(minus).contact) / (2 * size);
        // a central difference: kinks where a point enters or leaves, eps E / size
        EXPECT_NEAR(f[i], -slope, 1e-5 * largest) << i;
    }
}

TEST_P(ContactOf, Tangent_IsTheDerivativeOfTheForceWithHistory) {
    for (const ContactOptions& options : {ContactOptions{.skin = 0.5}, rough()}) {
        test::Solid solid = solid_of(options);
        State state = pressed(solid, 0.01, -0.006, 1e-3);
        if (options.friction > 0) {
            // some points stick, some slide, some unload
            state = accepted(solid, solid.system->initial_state(), state);
            State next = pressed(solid, 0.0102, -0.0058, 1e-3, 2);
            next.history = state.history;
            state = next;
        }
        apply_due_events(*solid.system, state);
        const Eigen::MatrixXd expected = test::dense_stiffness(*solid.system, state);
        const Eigen::MatrixXd matrix = test::dense(*solid.system->tangent(), state, Trial::of(state), {.stiffness = 1});
        EXPECT_LE((matrix - expected).cwiseAbs().maxCoeff(), 1e-6 * expected.cwiseAbs().maxCoeff());
        EXPECT_EQ(solid.system->tangent()->symmetric(), options.friction == 0);
    }
}

TEST_P(ContactOf, Momentum_ForcesAndMomentsAddUpToNothing) {
    const test::Solid solid = solid_of(rough());
    const State before = accepted(solid, solid.system->initial_state(), pressed(solid, 0.01, -0.006, 1e-3));
    const State state = pressed(solid, 0.0107, -0.0055, 1e-3, 2);
    const std::vector<double> f = contact_force(solid, before, state);
    double x = 0, y = 0, moment = 0, largest = 0;
    for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node) {
        const double fx = f[2 * node], fy = f[2 * node + 1];
        x += fx;
        y += fy;
        moment += (solid.mesh.nodes[node][0] + state.u[2 * node]) * fy -
                  (solid.mesh.nodes[node][1] + state.u[2 * node + 1]) * fx;
        largest = std::max(largest, std::abs(fy));
    }
    // hundreds of forces, elastic ones of 1e8 N/m times 1e-3 m taken off them
    EXPECT_GT(largest, 1e5);
    EXPECT_NEAR(x, 0, 1000 * eps * 1e7);
    EXPECT_NEAR(y, 0, 1000 * eps * 1e7);
    EXPECT_NEAR(moment, 0, 1000 * eps * 1e7);
}

TEST_P(ContactOf, Threads_TheSameBits) {
    const test::Solid solid = solid_of(rough());
    const State before = accepted(solid, solid.system->initial_state(), pressed(solid, 0.01, -0.006, 1e-3));
    const State state = pressed(solid, 0.0107, -0.0055, 1e-3, 2);
    const std::vector<double> one = contact_force(solid, before, state);
    omp_set_num_threads(2);
    const std::vector<double> two = contact_force(solid, before, state);
    omp_set_num_threads(1);
    EXPECT_EQ(one, two);
}

TEST_P(ContactOf, RoughCycle_WorkIsWhatIsStoredAndDissipated) {
    const test::Solid solid = solid_of(rough());
    State state = solid.system->initial_state();
    // down, along, up: work of the contact forces along the path by the trapezoidal rule
    double work = 0;
    std::vector<double> f = contact_force(solid, state, state);
    constexpr int n = 1500;
    for (int i = 1; i <= n; ++i) {
        const double s = static_cast<double>(i) / n;
        const double y = -4e-3 * std::sin(3.14159265 * s), x = 6e-3 * s * s;
        const State next = accepted(solid, state, pressed(solid, x, y, 0));
        const std::vector<double> now = contact_force(solid, state, next);
        for (std::size_t k = 0; k < f.size(); ++k) work -= 0.5 * (f[k] + now[k]) * (next.u[k] - state.u[k]);
        f = now;
        state = next;
    }
    EXPECT_GT(state.path.friction, 0);
    EXPECT_GT(state.path.contact, 0);
    const double gone = state.path.friction + state.path.contact;
    EXPECT_NEAR(work, gone + solid.system->stored_energies(state).contact, 5e-3 * gone);
}

TEST_P(ContactOf, FrequencyBound_IsAboveTheHighestFrequency) {
    const test::Solid solid = solid_of({.skin = 0.5});
    const State state = pressed(solid, 0.01, -0.003, 0);
    const double bound = solid.system->frequency_bound(state).omega;
    const double exact = test::dense_frequencies(*solid.system, state).maxCoeff();
    EXPECT_GE(bound, exact);
    EXPECT_LE(bound, 2 * exact);
}

TEST_P(ContactOf, FarFromTheSearch_ForcesAreThoseOfPairsSearchedThere) {
    const Contact* contact = nullptr;
    ContactOptions options = rough();
    options.skin = 0.1;
    const test::Solid solid = test::touching_solid(stacked(GetParam()), options, {}, &contact);
    const State start = solid.system->initial_state(), far = pressed(solid, 0.4, -0.004, 1e-3);
    std::vector<double> late(far.u.size()), fresh(far.u.size());
    const std::size_t before = contact->n_searches();
    solid.system->force(start, Trial::of(far), late);
    EXPECT_EQ(contact->n_searches(), before + 1);
    ASSERT_GT(contact->n_touching(), 0U);
    renew_events(*solid.system, far);
    solid.system->force(start, Trial::of(far), fresh);
    EXPECT_EQ(late, fresh);
    // and back: what was searched for far away is no more of use here
    const State near = pressed(solid, 0, -0.004, 1e-3);
    solid.system->force(start, Trial::of(near), late);
    renew_events(*solid.system, near);
    solid.system->force(start, Trial::of(near), fresh);
    EXPECT_EQ(late, fresh);
}

TEST_P(ContactOf, FarFromTheSearch_WhereATangentIsWanted_IsRefused_UntilLookedAt) {
    const test::Solid solid = solid_of({.skin = 0.1});
    solid.system->tangent();
    State state = pressed(solid, 0.1, 0, 0);
    std::vector<double> f(state.u.size());
    try {
        solid.system->force(state, Trial::of(state), f);
        FAIL();
    } catch (const RecoverableError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("contact.skin"), HasSubstr("t = 0 s")));
    }
    apply_due_events(*solid.system, state);
    solid.system->force(state, Trial::of(state), f);
}

TEST_P(ContactOf, TooDeep_NamesThePair) {
    const test::Solid solid = solid_of({.potential_cap = 0.1, .skin = 0.5});
    State state = pressed(solid, 0, -0.22, 0);
    apply_due_events(*solid.system, state);
    std::vector<double> f(state.u.size());
    try {
        solid.system->force(state, Trial::of(state), f);
        FAIL();
    } catch (const RecoverableError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("is deeper in element"), HasSubstr("t = 0 s")));
    }
}

TEST_P(ContactOf, OverlappingStart_IsBadInput) {
    try {
        test::touching_solid(stacked(GetParam(), -1e-3), {});
        FAIL();
    } catch (const InputError& error) {
        ASSERT_FALSE(error.problems().empty());
        EXPECT_THAT(error.problems()[0].message,
                    AllOf(HasSubstr("bodies overlap at the start"), HasSubstr("0.001 m deep in element")));
        EXPECT_LE(error.problems().size(), 11u);
    }
}

TEST(ContactAlone, OneBody_DoesNotTouchItself) {
    const Contact* contact = nullptr;
    const test::Solid solid = test::touching_solid(test::rectangle(true, 2, 1, {4, 2}), {.skin = 0.5}, {}, &contact);
    const std::vector<double> at_rest(2 * contact->bodies().n_mesh_nodes(), 0.0);
    EXPECT_TRUE(contact->overlaps(at_rest, 0).empty());
}

TEST(ContactPlaces, BodyThatContactAloneHolds_IsFreeAlongItsFace) {
    for (const double gap : {1e-9, 1e-3, 0.3}) {
        const Contact* contact = nullptr;
        const test::Solid solid = test::touching_solid(stacked(false, gap), {.skin = 0.1}, {}, &contact);
        std::vector<Constraint> fixed;
        for (std::size_t node = 0; node < solid.mesh.n_nodes(); ++node)
            if (solid.mesh.nodes[node][1] < 0.01)
                for (const std::size_t c : {0, 1}) fixed.push_back({2 * node + c, Constraint::Kind::displacement});
        const auto left = [&](bool rough) {
            std::vector<Touch> touches;
            for (const ContactPlace& place : contact->places(std::vector<double>(2 * solid.mesh.n_nodes(), 0.0)))
                touches.push_back({place.node, place.other, place.at, {place.normal.x, place.normal.y}, rough});
            EXPECT_EQ(touches.empty(), gap > 0.1);
            const auto parts = free_parts(solid.mesh, fixed, {}, touches);
            return parts.empty() ? std::vector<std::string>{} : parts[0].motions;
        };
        if (gap > 0.1) {
            EXPECT_EQ(left(false).size(), 3U) << "too far away to be held";
        } else {
            EXPECT_EQ(left(false), std::vector<std::string>{"translation in x"});
            EXPECT_EQ(left(true).size(), 0U);
        }
    }
}

TEST(ContactSearch, TakenUpInFlight_SearchesNoMoreOftenThanBefore) {
    // a step moves the upper square by a twentieth of the skin: a search every ten steps, less one for what comes next
    // where a tangent is wanted
    const Contact* contact = nullptr;
    ContactOptions options;
    options.skin = 0.2;
    const Mesh mesh =
        test::together(test::rectangle(false, 1, 1, {1, 1}), test::moved(test::rectangle(false, 1, 1, {1, 1}), 0, 2));
    test::Solid solid = test::touching_solid(mesh, options, {}, &contact);
    const double step_length = 0.05 * contact->options().skin;
    State state = solid.system->initial_state();
    solid.system->tangent();
    const auto fly = [&](int steps) {
        const std::size_t before = contact->n_searches();
        for (int step = 0; step < steps; ++step) {
            state.t += 1e-4;
            for (std::size_t i = 1; i < state.u.size(); i += 2)
                state.u[i] += mesh.nodes[i / 2][1] > 1.5 ? step_length : 0.0;
            apply_due_events(*solid.system, state);
        }
        return contact->n_searches() - before;
    };
    state.t = 5;  // a run that has been under way for long
    renew_events(*solid.system, state);
    const std::size_t first = fly(100);
    EXPECT_LE(first, 15U);
    EXPECT_GE(first, 9U);
    renew_events(*solid.system, state);
    EXPECT_LE(fly(100), first + 1);
}

}  // namespace
}  // namespace gneiss
