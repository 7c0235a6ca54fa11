// Compiled with the flags of the project: a constant, no code.

#include "app/processor.hpp"

namespace gneiss {

extern constinit const unsigned compiled_for = 0
#ifdef __AVX__
                                               | 1U << 0
#endif
#ifdef __AVX2__
                                               | 1U << 1
#endif
#ifdef __FMA__
                                               | 1U << 2
#endif
#ifdef __BMI2__
                                               | 1U << 3
#endif
#ifdef __AVX512F__
                                               | 1U << 4
#endif
#ifdef __AVX512VL__
                                               | 1U << 5
#endif
    ;

}  // namespace gneiss
