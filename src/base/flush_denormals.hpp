#pragma once
// Ahead of a wave front velocities decay through the denormal numbers, which processors handle a hundred times slower.

#include <pmmintrin.h>
#include <xmmintrin.h>

namespace gneiss {

/// Lets every thread of the pool treat numbers below 1e-308 as zero, in the same way: bits stay independent of the
/// number of threads. Call once, after the number of threads has been set.
inline void flush_denormals() {
#pragma omp parallel
    {
        _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
        _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    }
}

}  // namespace gneiss
