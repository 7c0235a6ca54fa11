#include "app/build_case.hpp"

#include <gmock/gmock.h>

#include "base/errors.hpp"
#include "unit/app/square_case.hpp"

namespace gneiss {
namespace {

using test::square_options;
using testing::HasSubstr;

std::string error_of(const CaseOptions& options) {
    try {
        build_case(options);
    } catch (const InputError& error) {
        return error.what();
    }
    ADD_FAILURE() << "no InputError";
    return "";
}

TEST(BuildCase, Sound_HasEverything) {
    const Case built = build_case(square_options());
    EXPECT_EQ(built.mesh->n_elements(), 8u);
    EXPECT_EQ(built.system->layout().n_dof, 50u);
    EXPECT_EQ(built.integrator->name(), "central_difference");
    EXPECT_TRUE(built.probes.empty());
    EXPECT_TRUE(built.warnings.empty());
    EXPECT_GT(memory_estimate(built), 50 * sizeof(double));
}

TEST(BuildCase, Mistakes_OfEveryPart_ComeInOneList) {
    CaseOptions options = square_options();
    options.materials[0].regions = {"rock"};
    options.loads.emplace_back();
    options.loads[0].on = "lfet";
    options.boundaries.resize(2);
    options.boundaries[0].on = "rigth";
    options.boundaries[1].on = "nowhere";
    options.boundaries[1].kind = BoundaryOptions::Kind::absorbing;
    options.initial.emplace_back();
    options.initial[0].on = "slid";
    options.integrator.safety = 2;
    options.output.probes = {{"p", {9, 9}, {}}};
    const std::string error = error_of(options);
    for (const char* part :
         {"rock", "lfet", "rigth", "nowhere", "slid", "integrator.safety: given 2", "output.probes `p`: "})
        EXPECT_THAT(error, HasSubstr(part));
}

TEST(BuildCase, Multirate_WithoutInteractions_IsRefused) {
    CaseOptions options = square_options();
    options.integrator.type = "mri";
    options.integrator.dt = 1e-6;
    EXPECT_THAT(error_of(options), HasSubstr("integrator.type: `mri` takes joints and contact in short steps, and "
                                             "there are neither"));
    options.contact.method = ContactOptions::Method::potential;
    EXPECT_EQ(build_case(options).integrator->name(), "mri");
}

TEST(BuildCase, BadMaterial_AbsorbingBoundary_IsNotBlamed) {
    CaseOptions options = square_options();
    options.materials[0].regions = {"rock"};
    options.boundaries.emplace_back();
    options.boundaries[0].on = "left";
    options.boundaries[0].kind = BoundaryOptions::Kind::absorbing;
    const std::string error = error_of(options);
    EXPECT_THAT(error, HasSubstr("rock"));
    EXPECT_THAT(error, testing::Not(HasSubstr("boundary[0]")));
}

TEST(BuildCase, BadMesh_ComesAloneWithAllItsMistakes) {
    CaseOptions options = square_options();
    options.mesh.width = -1;
    options.mesh.cells = {0, 1};
    const std::string error = error_of(options);
    EXPECT_THAT(error, HasSubstr("width"));
    EXPECT_THAT(error, HasSubstr("cells"));
}

}  // namespace
}  // namespace gneiss
