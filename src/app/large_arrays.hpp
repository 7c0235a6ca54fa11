#pragma once
// Memory of arrays that were large goes back to the system.

#include <malloc.h>

namespace gneiss {

/// Keeps the C library from handing out arrays of 256 kB and more from its heap: once one of them has been freed it
/// does so for all up to 32 MB, and what lies free between those that stay is lost (8 % of a static run). Call once.
inline void return_large_arrays() {
#ifdef M_MMAP_THRESHOLD
    mallopt(M_MMAP_THRESHOLD, 1 << 18);
#endif
}

}  // namespace gneiss
