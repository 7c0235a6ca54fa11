#include "app/threads.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "base/flush_denormals.hpp"

namespace gneiss {

std::string use_threads(int n) {
    const int cores = omp_get_num_procs();
    if (n > 0) omp_set_num_threads(n);
    flush_denormals();
    return n > cores ? fmt::format("{} threads on {} cores: they will wait for each other", n, cores) : "";
}

std::string threads_text() {
    const int n = omp_get_max_threads();
    return fmt::format("{} {}", n, n == 1 ? "thread" : "threads");
}

void wait_briefly(int n, char** argv) {
    if (n == 1 || (n == 0 && omp_get_max_threads() == 1)) return;
    if (std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT")) return;
    // Long enough for the moments between the loops of a step, tens of microseconds; libgomp's own 300000 is far
    // longer.
    if (::setenv("GOMP_SPINCOUNT", "2000", 1) != 0) return;
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    if (!error) ::execv(program.c_str(), argv);
    // Where that fails, the run is slower on a busy machine, and right all the same.
}

}  // namespace gneiss
