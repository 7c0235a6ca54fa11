#include "base/suggest.hpp"

#include <gtest/gtest.h>

namespace gneiss {
namespace {

TEST(Suggestion, Distance_CountsSlipsOfTheFinger) {
    EXPECT_EQ(edit_distance("density", "density"), 0u);
    EXPECT_EQ(edit_distance("Density", "density"), 0u);
    EXPECT_EQ(edit_distance("denisty", "density"), 1u);  // neighbours swapped
    EXPECT_EQ(edit_distance("desity", "density"), 1u);
    EXPECT_EQ(edit_distance("densityy", "density"), 1u);
    EXPECT_EQ(edit_distance("", "abc"), 3u);
    EXPECT_EQ(edit_distance("ca", "abc"), 3u);  // optimal string alignment, not the unrestricted distance 2
}

TEST(Suggestion, Nearest_OnlyNearNames_AreSuggested) {
    EXPECT_EQ(nearest("thikness", {"thickness", "element"}), "thickness");
    EXPECT_EQ(nearest("hoe", {"hole", "outer", "left_boundary"}), "hole");
    EXPECT_EQ(nearest("left-bundary", {"hole", "outer", "left_boundary"}), "left_boundary");
    EXPECT_EQ(nearest("top", {"hole", "outer"}), "");
    EXPECT_EQ(nearest("zzz", {"thickness", "element"}), "");
    EXPECT_EQ(nearest("q", {"E", "G"}), "");  // replacing the only letter is no slip
    EXPECT_EQ(nearest("x", {}), "");
}

TEST(Suggestion, Text_NamesTheNearestOrNothing) {
    EXPECT_EQ(suggestion("thikness", {"thickness", "element"}), ", did you mean `thickness`?");
    EXPECT_EQ(suggestion("zzz", {"thickness", "element"}), "");
}

}  // namespace
}  // namespace gneiss
