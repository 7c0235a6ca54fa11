// A processor without the instructions of the build is told so, before one of them is met.

#include "app/processor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

namespace gneiss {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

std::string told(unsigned lacking, std::size_t size = 512) {
    std::array<char, 512> text{};
    tell_of_missing(lacking, text.data(), size);
    return text.data();
}

TEST(Processor, ThatRunsTheTests_HasWhatTheyWereCompiledFor) { EXPECT_EQ(compiled_for & ~of_this_processor(), 0u); }

TEST(Processor, CompilerMayUseAvx2_BuildAsksForIt) {
#ifdef __AVX2__
    EXPECT_NE(compiled_for & 1U << 1, 0u);
    EXPECT_STREQ(instruction_set_name(1), "AVX2");
#else
    EXPECT_EQ(compiled_for & 1U << 1, 0u);
#endif
}

TEST(Processor, LacksSome_TheyAreNamedAndNoOthers) {
    const std::string text = told(1U << 1 | 1U << 2);
    EXPECT_THAT(text, HasSubstr("with AVX2, FMA, which this one lacks"));
    EXPECT_THAT(text, Not(HasSubstr("BMI2")));
    EXPECT_THAT(text, EndsWith("\n"));
}

TEST(Processor, LittleRoom_TextIsCutNotWrittenBehindItsEnd) {
    for (std::size_t size = 1; size < 200; ++size) EXPECT_LT(told(~0U, size).size(), size);
}

}  // namespace
}  // namespace gneiss
