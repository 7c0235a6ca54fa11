#pragma once
// How many threads compute, and how they wait for each other.

#include <string>

namespace gneiss {

/// Sets the number of threads of what follows, and lets all of them treat denormal numbers alike.
/// @param n  0: as many as there are cores
/// @return a warning if these are more than the machine has cores, else empty
std::string use_threads(int n);

/// "1 thread", "2 threads".
std::string threads_text();

/// Makes threads that wait for the others give up their core after some microseconds, instead of milliseconds: where
/// other programs want the cores too, two threads are else several times slower than one (docs/decisions/008). The
/// OpenMP runtime reads this from the environment before main() begins, therefore the program starts itself anew, once.
/// Does nothing if only one thread is wanted, or if the user has set OMP_WAIT_POLICY or GOMP_SPINCOUNT.
/// @param n     as in use_threads()
/// @param argv  of main()
void wait_briefly(int n, char** argv);

}  // namespace gneiss
