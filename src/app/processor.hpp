#pragma once
// Whether this processor has the instructions for which the program was compiled. What looks is compiled for any x86-64
// and uses no templates, of which the linker might take a copy from a file compiled otherwise; it runs before main.

#include <cstddef>

namespace gneiss {

/// Sets of instructions that the flags of this build let the compiler use, a bit each in the order of
/// instruction_set_name().
extern const unsigned compiled_for;
/// Those that the processor has on which this runs.
unsigned of_this_processor();
/// @return null behind the last one
const char* instruction_set_name(std::size_t bit);
/// What is told to somebody whose processor lacks these. @param[out] text  overwritten, ends with a line break
void tell_of_missing(unsigned lacking, char* text, std::size_t size);

}  // namespace gneiss
