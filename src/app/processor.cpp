#include "app/processor.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstring>

namespace gneiss {
namespace {

constexpr const char* names[] = {"AVX", "AVX2", "FMA", "BMI2", "AVX-512F", "AVX-512VL"};
constexpr std::size_t n_names = sizeof(names) / sizeof(names[0]);

/// Before any other initialisation of the program.
[[gnu::constructor(101)]] void look_at_processor() {
    const unsigned lacking = compiled_for & ~of_this_processor();
    if (lacking == 0) return;
    char text[512];
    tell_of_missing(lacking, text, sizeof(text));
    [[maybe_unused]] const auto written = write(STDERR_FILENO, text, std::strlen(text));
    _exit(3);
}

}  // namespace

unsigned of_this_processor() {
    __builtin_cpu_init();
    const auto bit = [](bool there, unsigned k) { return static_cast<unsigned>(there) << k; };
    return bit(__builtin_cpu_supports("avx") != 0, 0) | bit(__builtin_cpu_supports("avx2") != 0, 1) |
           bit(__builtin_cpu_supports("fma") != 0, 2) | bit(__builtin_cpu_supports("bmi2") != 0, 3) |
           bit(__builtin_cpu_supports("avx512f") != 0, 4) | bit(__builtin_cpu_supports("avx512vl") != 0, 5);
}

const char* instruction_set_name(std::size_t bit) { return bit < n_names ? names[bit] : nullptr; }

void tell_of_missing(unsigned lacking, char* text, std::size_t size) {
    int n = std::snprintf(text, size, "gneiss: error: this program was compiled for a processor with");
    const char* separator = " ";
    for (std::size_t k = 0; k < n_names; ++k) {
        if ((lacking >> k & 1U) == 0 || n < 0 || static_cast<std::size_t>(n) >= size) continue;
        n += std::snprintf(text + n, size - static_cast<std::size_t>(n), "%s%s", separator, names[k]);
        separator = ", ";
    }
    if (n > 0 && static_cast<std::size_t>(n) < size)
        std::snprintf(
            text + n, size - static_cast<std::size_t>(n),
            ", which this one lacks; build it here (README.md), or with the value of GNEISS_ARCH that fits\n");
}

}  // namespace gneiss
