// Defaults: what a deck takes for a key that it leaves out is what the scheme takes by itself.

#include "app/scheme_options.hpp"

#include <gtest/gtest.h>

#include "contact/contact.hpp"
#include "materials/munjiza_hypoelastic.hpp"

namespace gneiss {
namespace {

template <class Scheme>
class SchemeOptions : public testing::Test {};

using Schemes = testing::Types<LinearSolver, CentralDifference, Verlet, NohBathe, GeneralizedAlpha, Bathe, Cvode,
                               Arkode, Mri, Ida, QuasiStatic, DynamicRelaxation>;
TYPED_TEST_SUITE(SchemeOptions, Schemes);

TYPED_TEST(SchemeOptions, DeckThatSaysNothing_TakesTheSchemesOwn) {
    IntegratorOptions deck;
    deck.type = "generalized_alpha";  // of those that GeneralizedAlpha has
    EXPECT_TRUE(options_of<TypeParam>(deck) == typename OptionsOf<TypeParam>::Type());
}

TEST(NewmarkOptions, DeckThatSaysNothing_IsMeanAcceleration) {
    IntegratorOptions deck;
    deck.type = "newmark";
    EXPECT_TRUE(options_of<GeneralizedAlpha>(deck).scheme == GeneralizedAlpha::Scheme());
}

TEST(NewtonOptions, AnyScheme_TakesAsManyIterations) {
    for (const char* type : {"generalized_alpha", "newmark", "hht_alpha"}) {
        IntegratorOptions deck;
        deck.type = type;
        EXPECT_EQ(options_of<GeneralizedAlpha>(deck).most_iterations, StageNewton::Options().most_iterations);
        deck.most_iterations = 7;
        EXPECT_EQ(options_of<GeneralizedAlpha>(deck).most_iterations, 7);
        EXPECT_EQ(options_of<Bathe>(deck).newton.most_iterations, 7);
    }
}

TEST(InterfaceTolerance, AnySchemeThatJudgesItsSteps_HasIt) {
    for (const char* type : {"generalized_alpha", "newmark", "hht_alpha"}) {
        IntegratorOptions deck;
        deck.type = type;
        deck.interface_tolerance = 3e-3;
        EXPECT_EQ(options_of<GeneralizedAlpha>(deck).interface_tolerance, 3e-3);
        EXPECT_EQ(options_of<Bathe>(deck).interface_tolerance, 3e-3);
    }
}

TEST(ContactDefaults, AreThoseOfADeck) {
    const Contact::Options own;
    const ContactOptions deck;
    EXPECT_EQ(own.friction, deck.friction);
    EXPECT_EQ(own.restitution, deck.restitution);
    EXPECT_EQ(own.tangential_factor, deck.tangential_factor);
}

TEST(StiffeningDefaults, AreThoseOfADeck) {
    const Stiffening own;
    const MaterialOptions::Stiffening deck;
    EXPECT_EQ(own.k, deck.k);
    EXPECT_EQ(own.p_ref, deck.p_ref);
    EXPECT_EQ(own.n, deck.n);
}

}  // namespace
}  // namespace gneiss
