#include "fracture/cohesion_properties.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "base/errors.hpp"
#include "unit/fracture/loaded_point.hpp"

namespace gneiss {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::vector<std::string> messages(void (*validate)(const CohesionProperties<double>&),
                                  const CohesionProperties<double>& properties) {
    std::vector<std::string> found;
    try {
        validate(properties);
    } catch (const InputError& error) {
        for (const Problem& problem : error.problems()) found.push_back(problem.message);
    }
    return found;
}

TEST(CohesionProperties, OfARock_AreAccepted) {
    EXPECT_NO_THROW(validate_mixed_mode(rock_joint()));
    EXPECT_NO_THROW(validate_y_code(rock_joint()));
}

TEST(CohesionProperties, EachOutOfRange_IsRefusedByName) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    struct Case {
        double CohesionProperties<double>::*member;
        const char* name;
        double wrong;
    };
    for (const Case& c : {Case{&CohesionProperties<double>::tensile_strength, "tensile_strength", 0},
                          Case{&CohesionProperties<double>::cohesion, "cohesion", -1},
                          Case{&CohesionProperties<double>::tan_phi_initial, "tan_phi_initial", -0.1},
                          Case{&CohesionProperties<double>::tan_phi_residual, "tan_phi_residual", nan},
                          Case{&CohesionProperties<double>::fracture_energy_i, "fracture_energy_i", 0},
                          Case{&CohesionProperties<double>::fracture_energy_ii, "fracture_energy_ii", nan},
                          Case{&CohesionProperties<double>::penalty, "penalty", 0}}) {
        CohesionProperties<double> properties = rock_joint();
        properties.*c.member = c.wrong;
        for (const auto validate : {validate_mixed_mode, validate_y_code})
            EXPECT_THAT(messages(validate, properties),
                        testing::ElementsAre(AllOf(HasSubstr(c.name), HasSubstr("must be >"))));
    }
}

TEST(CohesionProperties, AllOutOfRange_AreRefusedAtOnce) {
    const CohesionProperties<double> nothing{0, 0, -1, -1, 0, 0, 0};
    EXPECT_EQ(messages(validate_mixed_mode, nothing).size(), 7u);
}

// B = f_t^2/(k G) reaches 2 at G = 1.5 J/m2 and 6 J/m2; Y-code's 3 G/f = 4 f/k at G = 4 J/m2 and 16 J/m2.
TEST(CohesionProperties, EnergyBelowTheElasticPart_IsRefusedWithWhatItMustExceed) {
    CohesionProperties<double> properties = rock_joint();
    properties.fracture_energy_i = 1.49;
    properties.fracture_energy_ii = 5.99;
    EXPECT_THAT(messages(validate_mixed_mode, properties),
                testing::ElementsAre(AllOf(HasSubstr("fracture_energy_i is 1.49"), HasSubstr("> 1.5 J/m2")),
                                     AllOf(HasSubstr("fracture_energy_ii is 5.99"), HasSubstr("> 6 J/m2"))));
    properties.fracture_energy_i = 1.51;
    properties.fracture_energy_ii = 6.01;
    EXPECT_THAT(messages(validate_mixed_mode, properties), testing::IsEmpty());
    EXPECT_THAT(messages(validate_y_code, properties),
                testing::ElementsAre(HasSubstr("> 4 J/m2"), HasSubstr("> 16 J/m2")));
}

TEST(CohesionLength, OfTheBranchingPlate_IsTenMillimetres) {
    EXPECT_NEAR(cohesion_length(3, 32e9, 3.08e6), 0.010120, 0.5e-6);  // VERIFICATION 16, to the digits shown
}

}  // namespace
}  // namespace gneiss
