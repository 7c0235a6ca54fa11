#pragma once
// Include it in a test of small systems: threads that wait for each other cost more than the work, above all on a busy
// machine.

#include <omp.h>

namespace gneiss::test {

inline const bool one_thread = (omp_set_num_threads(1), true);

}  // namespace gneiss::test
