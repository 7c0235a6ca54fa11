#include "base/errors.hpp"

#include <gtest/gtest.h>

namespace gneiss {
namespace {

TEST(InputError, SeveralProblems_AreAllInTheMessage_OneLineEach) {
    const InputError error({{"case.toml:3:1", "unknown key `denisty`"}, {"", "no [[material]]"}, {"a.msh", "empty"}});
    EXPECT_STREQ(error.what(), "case.toml:3:1: unknown key `denisty`\nno [[material]]\na.msh: empty");
    ASSERT_EQ(error.problems().size(), 3u);
    EXPECT_EQ(error.problems()[0].where, "case.toml:3:1");
    EXPECT_EQ(error.problems()[2].message, "empty");
}

TEST(InputError, OneProblem_HasItsPlaceBeforeItsMessage) {
    EXPECT_STREQ(InputError("mesh.msh", "no triangles").what(), "mesh.msh: no triangles");
    EXPECT_STREQ(InputError("", "no triangles").what(), "no triangles");
}

TEST(RecoverableError, IsNoInputError_AndKeepsItsMessage) {
    try {
        throw RecoverableError("element 7, det F = -0.1");
    } catch (const InputError&) {
        FAIL() << "a solver would not retry";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "element 7, det F = -0.1");
    }
}

}  // namespace
}  // namespace gneiss
