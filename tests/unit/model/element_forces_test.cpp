// Packs, blocks, chunks and threads against the plain assembly of scalar_reference.hpp, for every law, element and
// sampling.

#include "model/element_forces.hpp"

#include <gmock/gmock.h>
#include <omp.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "base/errors.hpp"
#include "mesh/measure.hpp"
#include "support/eps.hpp"
#include "support/one_thread.hpp"
#include "support/small_solids.hpp"
#include "unit/model/scalar_reference.hpp"

namespace gneiss {
namespace {

using test::eps;
using testing::HasSubstr;

constexpr double modulus = 3e9, sub_edge = 0.05;

struct ForceChoice {
    const char* name;
    bool compt;
    Volumetric volumetric;
    Plane plane;
    LawKind law;
    Form form;
    StressMap map;
};

constexpr auto munjiza = LawKind::munjiza, neo = LawKind::neo_hookean;
constexpr auto hyper = Form::hyper, hypo = Form::hypo;
constexpr auto conjugate = StressMap::conjugate, direct = StressMap::direct;
constexpr auto mean = Volumetric::mean, centre = Volumetric::centre;

const ForceChoice force_choices[] = {
    {"CstHyperConjugate", false, mean, Plane::strain, munjiza, hyper, conjugate},
    {"CstHyperDirect", false, mean, Plane::strain, munjiza, hyper, direct},
    {"CstHypoConjugate", false, mean, Plane::strain, munjiza, hypo, conjugate},
    {"CstHypoDirect", false, mean, Plane::strain, munjiza, hypo, direct},
    {"CstNeoHookeanStrain", false, mean, Plane::strain, neo, hyper, conjugate},
    {"CstNeoHookeanStress", false, mean, Plane::stress, neo, hyper, conjugate},
    {"ComptHyperConjugate", true, mean, Plane::strain, munjiza, hyper, conjugate},
    {"ComptHyperDirect", true, mean, Plane::strain, munjiza, hyper, direct},
    {"ComptHypoConjugate", true, mean, Plane::strain, munjiza, hypo, conjugate},
    {"ComptHypoDirect", true, mean, Plane::strain, munjiza, hypo, direct},
    {"ComptNeoHookeanStrain", true, mean, Plane::strain, neo, hyper, conjugate},
    {"ComptNeoHookeanStress", true, mean, Plane::stress, neo, hyper, conjugate},
    {"ComptCentreHyperDirect", true, centre, Plane::strain, munjiza, hyper, direct},
    {"ComptCentreHypoDirect", true, centre, Plane::strain, munjiza, hypo, direct},
};

/// Two materials in two regions that interlock; left half of straight composites, right half distorted. Several chunks
/// in each block, and no block that fills its packs.
class ElementForcesOf : public testing::TestWithParam<ForceChoice> {
protected:
    ElementForcesOf() : mesh_(test::rectangle(GetParam().compt, 3.2, 2.5, {32, 25})) {
        Mesh distorted = mesh_;
        test::distort(distorted, sub_edge, 0.2, 11);
        for (std::size_t node = 0; node < mesh_.n_nodes(); ++node)
            if (mesh_.nodes[node][0] > 1.7) mesh_.nodes[node] = distorted.nodes[node];
        mesh_.region_names = {"hard", "soft"};
        for (std::size_t e = 0; e < mesh_.n_elements(); ++e) mesh_.region[e] = (e / 7) % 3 == 0 ? 1 : 0;

        solid_.compt = GetParam().compt;
        solid_.plane = GetParam().plane;
        solid_.volumetric = GetParam().volumetric;
        solid_.thickness = 0.7;
        for (const double part : {1.0, 0.1}) {
            MaterialOptions material;
            material.regions = {mesh_.region_names[materials_.size()]};
            material.law = GetParam().law;
            material.form = GetParam().form;
            material.stress_map = GetParam().map;
            material.density = 2650 * part;
            material.constants = {part * modulus, 2.1 * part * modulus, 1.3 * part * modulus, 0.9 * part * modulus};
            material.shear_modulus = 0.6 * part * modulus;
            material.lame_lambda = part * modulus;
            material.axes.angle = Formula("0.3 + x*y");
            if (material.form == Form::hypo) material.stiffening = {2, 0.05 * modulus, 0.5};
            material.shear_viscosity = 1e4 * part;
            material.bulk_viscosity = 2e4 * part;
            materials_.push_back(material);
        }
        forces_ = std::make_unique<ElementForces>(make_blocks(mesh_, solid_, materials_), mesh_);
        for (const auto& block : forces_->blocks())
            for (std::size_t local = 0; local < block->n_elements(); ++local) {
                const auto e = static_cast<std::size_t>(block->element(local));
                angle_.resize(std::max(angle_.size(), e + 1));
                angle_[e] = block->axis_angle(local);
            }
        for (std::size_t e = 0; e < mesh_.n_elements(); ++e)
            reference_.push_back(test::scalar_element(mesh_, e, angle_[e], solid_,
                                                      materials_[static_cast<std::size_t>(mesh_.region[e])]));
        state_.u.assign(2 * mesh_.n_nodes(), 0.0);
        state_.v.assign(2 * mesh_.n_nodes(), 0.0);
        state_.z.resize(forces_->n_internal());
        state_.history.resize(forces_->n_history());
        forces_->initial_memory(state_.z, state_.history);
    }
    ~ElementForcesOf() override { omp_set_num_threads(1); }

    /// A smooth motion with strains up to `strain` that vary, plus noise; small enough for series in the first third.
    std::vector<double> motion(double strain, unsigned seed) const {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> noise(-1, 1);
        std::vector<double> u(2 * mesh_.n_nodes());
        for (std::size_t node = 0; node < mesh_.n_nodes(); ++node) {
            const auto& [x, y] = mesh_.nodes[node];
            const double here = strain * (x < 1 ? 0.01 : 0.01 + 0.45 * (x - 1));
            u[2 * node] = here * (std::sin(1.5 * y) - 0.6 * x + 0.1 * sub_edge * noise(random));
            u[2 * node + 1] = here * (0.7 * std::cos(2 * x) + 0.4 * y * x + 0.1 * sub_edge * noise(random));
        }
        return u;
    }
    Trial trial(const std::vector<double>& u, const std::vector<double>& v) const { return {0.5, 0, u, v, {}}; }

    std::vector<double> expected_force(const std::vector<double>& u, const std::vector<double>& v, bool accept) {
        std::vector<double> f(u.size(), 0.0);
        for (const auto& element : reference_) element->add_force(u, v, accept, f);
        return f;
    }
    /// Strains are known to eps (|H| + |u|/h), |u| <= 3 strain m; a node takes forces M h of up to 24 sub-triangles.
    double force_tolerance(double strain) const { return 64 * eps * (1 + 3 / sub_edge) * strain * modulus * sub_edge; }

    void expect_near(const std::vector<double>& found, const std::vector<double>& expected, double tolerance) const {
        double largest = 0;
        for (std::size_t i = 0; i < expected.size(); ++i)
            largest = std::max(largest, std::abs(found[i] - expected[i]) / tolerance);
        EXPECT_LE(largest, 1);
    }

    Mesh mesh_;
    SolidOptions solid_;
    std::vector<MaterialOptions> materials_;
    std::unique_ptr<ElementForces> forces_;
    std::vector<double> angle_;
    std::vector<std::unique_ptr<test::ScalarElement>> reference_;
    State state_;
};

TEST_P(ElementForcesOf, Path_ForcesMemoryAndEnergies_AreThoseOfTheScalarElements) {
    for (const double strain : {0.05, 0.1}) {
        const std::vector<double> u = motion(strain, 5), v = motion(10 * strain, 9);
        const std::vector<double> expected = expected_force(u, v, true);
        std::vector<double> f(u.size(), 1e300), z(state_.z.size()), history(state_.history.size());  // f is overwritten
        forces_->force(state_, trial(u, v), f);
        expect_near(f, expected, force_tolerance(strain));
        std::fill(f.begin(), f.end(), 0.0);
        forces_->force(state_, trial(u, v), f, z, history);
        expect_near(f, expected, force_tolerance(strain));

        state_.u = u;
        state_.z = z;
        state_.history = history;
        double stored = 0, stress_power = 0, viscous_power = 0;
        for (const auto& element : reference_) {
            stored += element->stored_energy(u);
            stress_power += element->stress_power();
            viscous_power += element->viscous_power(u, v);
        }
        const ElementBlock::Sums sums = forces_->energies(state_, trial(u, v));
        const double scale = 1e3 * eps;  // thousands of terms of one sign
        EXPECT_NEAR(sums.stored, stored, scale * stored);
        EXPECT_NEAR(sums.stress_power, stress_power, 10 * scale * modulus * strain * strain);
        EXPECT_NEAR(sums.viscous_power, viscous_power, scale * viscous_power);
        EXPECT_GT(viscous_power, 0);
        EXPECT_GT(stored + stress_power, 0);
    }
}

TEST_P(ElementForcesOf, Memory_OfEverySubTriangle_IsThatOfTheScalarElements) {
    if (forces_->n_internal() == 0) GTEST_SKIP() << "no internal variables";
    const std::vector<double> u = motion(0.05, 5), v(u.size(), 0.0);
    expected_force(u, v, true);
    std::vector<double> f(u.size()), z(state_.z.size()), history(state_.history.size());
    forces_->force(state_, trial(u, v), f, z, history);
    // z of a block: (packs, sub-triangles, variables, lanes)
    std::size_t offset = 0;
    double largest = 0;
    for (const auto& block : forces_->blocks()) {
        const std::size_t per_element = block->n_internal() / (block->n_packs() * pack_width);
        for (std::size_t local = 0; local < block->n_elements(); ++local) {
            const std::vector<double> expected =
                reference_[static_cast<std::size_t>(block->element(local))]->internal();
            ASSERT_EQ(expected.size(), per_element);
            for (std::size_t k = 0; k < per_element; ++k) {
                const std::size_t place = (local / pack_width * per_element + k) * pack_width + local % pack_width;
                largest = std::max(largest, std::abs(z[offset + place] - expected[k]));
            }
        }
        offset += block->n_internal();
    }
    EXPECT_EQ(offset, z.size());
    EXPECT_LE(largest, 64 * eps * (1 + 3 / sub_edge) * 0.05 * modulus);
}

TEST_P(ElementForcesOf, Threads_AnyNumber_GiveTheSameBits) {
    const std::vector<double> u = motion(0.1, 5), v = motion(1, 9);
    std::vector<double> first_f, first_z, first_history;
    ElementBlock::Sums first_sums;
    for (const int threads : {1, 2, 3}) {
        omp_set_num_threads(threads);
        std::vector<double> f(u.size()), z(state_.z.size()), history(state_.history.size());
        forces_->force(state_, trial(u, v), f, z, history);
        const ElementBlock::Sums sums = forces_->energies(state_, trial(u, v));
        if (threads == 1) {
            first_f = f;
            first_z = z;
            first_history = history;
            first_sums = sums;
            continue;
        }
        EXPECT_EQ(f, first_f) << threads;
        EXPECT_EQ(z, first_z) << threads;
        EXPECT_EQ(history, first_history) << threads;
        EXPECT_EQ(sums.stored, first_sums.stored) << threads;
        EXPECT_EQ(sums.stress_power, first_sums.stress_power) << threads;
        EXPECT_EQ(sums.viscous_power, first_sums.viscous_power) << threads;
    }
}

TEST_P(ElementForcesOf, GivenInternalVariables_ThoseOfTheUpdate_GiveTheSameForces) {
    if (forces_->n_internal() == 0) GTEST_SKIP() << "no internal variables";
    const std::vector<double> u = motion(0.05, 5), v = motion(1, 9);
    std::vector<double> step(u.size()), given(u.size()), z(state_.z.size()), history(state_.history.size());
    forces_->force(state_, trial(u, v), step, z, history);
    Trial with_z = trial(u, v);
    with_z.z = z;
    forces_->force(state_, with_z, given);
    expect_near(given, step, force_tolerance(0.05));
    // and they are what counts: without them a hypo-elastic solid has no stress
    std::fill(z.begin(), z.end(), 0.0);
    std::vector<double> still(u.size(), 0.0);
    if (GetParam().form == Form::hypo) {
        with_z.v = still;
        forces_->force(state_, with_z, given);
        expect_near(given, still, force_tolerance(0.05));
    }
}

TEST_P(ElementForcesOf, InternalRate_AlongAMotion_IsTheDerivativeOfTheUpdate) {
    if (forces_->n_internal() == 0) GTEST_SKIP() << "no internal variables";
    const std::vector<double> u = motion(0.05, 5), v = motion(1, 9);
    std::vector<double> f(u.size()), z(state_.z.size()), history(state_.history.size()), rate(z.size());
    forces_->force(state_, trial(u, v), f, z, history);
    state_.u = u;
    state_.z = z;
    state_.history = history;
    Trial here = trial(u, v);
    here.z = z;
    forces_->internal_rate(state_, here, rate);

    const double dt = 1e-5;  // strains move by 1e-5; moduli have a kink where p passes 0: order 1 there
    std::vector<double> plus(z.size()), minus(z.size()), moved(u.size());
    const auto update = [&](double step, std::vector<double>& to) {
        for (std::size_t i = 0; i < u.size(); ++i) moved[i] = u[i] + step * v[i];
        forces_->force(state_, trial(moved, v), f, to, history);
    };
    update(dt, plus);
    update(-dt, minus);
    double largest = 0, size = 0;
    for (std::size_t i = 0; i < z.size(); ++i) {
        largest = std::max(largest, std::abs((plus[i] - minus[i]) / (2 * dt) - rate[i]));
        size = std::max(size, std::abs(rate[i]));
    }
    EXPECT_LE(largest, 2e-5 * size);
    EXPECT_GT(size, 0.01 * modulus);
}

TEST_P(ElementForcesOf, Mass_OfAllNodes_IsThatOfTheSolid) {
    const std::vector<double> mass = forces_->lumped_mass();
    double x = 0, y = 0, area[2] = {0, 0};
    const std::vector<double> areas = element_areas(mesh_);
    for (std::size_t e = 0; e < areas.size(); ++e) area[mesh_.region[e]] += areas[e];
    for (std::size_t node = 0; node < mesh_.n_nodes(); ++node) {
        x += mass[2 * node];
        y += mass[2 * node + 1];
        EXPECT_GT(mass[2 * node], 0);
    }
    const double expected = 0.7 * 2650 * (area[0] + 0.1 * area[1]);
    EXPECT_NEAR(x, expected, 1e3 * eps * expected);
    EXPECT_EQ(x, y);
}

TEST_P(ElementForcesOf, InvertedElement_Anywhere_IsReportedAndLeavesNoTrace) {
    const std::vector<double> u = motion(0.02, 5), v(u.size(), 0.0);
    std::vector<double> before(u.size()), after(u.size());
    forces_->force(state_, trial(u, v), before);
    std::mt19937 random(2);
    std::uniform_int_distribution<std::size_t> any(0, mesh_.n_elements() - 1);
    for (int n = 0; n < 20; ++n) {
        // fold sub-triangle 1 over: its first node goes to the far side of the other two
        const std::size_t e = any(random);
        const int nodes_per_element = mesh_.nodes_per_element();
        const auto node = static_cast<std::size_t>(mesh_.element(e)[0]);
        const auto next = static_cast<std::size_t>(mesh_.element(e)[1]);
        const auto last = static_cast<std::size_t>(mesh_.element(e)[nodes_per_element - 1]);
        std::vector<double> folded = u;
        for (std::size_t c = 0; c < 2; ++c)
            folded[2 * node + c] = 1.2 * (mesh_.nodes[next][c] + mesh_.nodes[last][c] - 2 * mesh_.nodes[node][c]);
        try {
            forces_->force(state_, trial(folded, v), after);
            FAIL() << "element " << e << " was folded over";
        } catch (const RecoverableError& error) {
            const std::string message = error.what();
            EXPECT_THAT(message, HasSubstr("is inverted at t = 0.5 s: sub-triangle "));
            EXPECT_THAT(message, HasSubstr(", det F = -"));
            // the element that is named has the node that went astray
            const std::int64_t label = std::stoll(message.substr(std::string("element ").size()));
            bool named = false;
            for (std::size_t k = 0; k < mesh_.n_elements(); ++k)
                for (int i = 0; i < nodes_per_element; ++i)
                    named |= mesh_.element_labels[k] == label && static_cast<std::size_t>(mesh_.element(k)[i]) == node;
            EXPECT_TRUE(named) << message;
        }
        forces_->force(state_, trial(u, v), after);
        EXPECT_EQ(after, before);
    }
}

TEST_P(ElementForcesOf, NotANumber_InADisplacement_IsReportedAsInverted) {
    std::vector<double> u = motion(0.02, 5), v(u.size(), 0.0), f(u.size());
    u[77] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(forces_->force(state_, trial(u, v), f), RecoverableError);
}

INSTANTIATE_TEST_SUITE_P(EveryLawElementAndSampling, ElementForcesOf, testing::ValuesIn(force_choices),
                         [](const auto& choice) { return std::string(choice.param.name); });

}  // namespace
}  // namespace gneiss
