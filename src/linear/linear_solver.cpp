#include "linear/linear_solver.hpp"

#include <fmt/format.h>

namespace gneiss {

std::string singular_text(double pivot_ratio) {
    return fmt::format("the matrix is singular but for round-off: its smallest pivot is {:.1e} of its largest",
                       pivot_ratio);
}

}  // namespace gneiss
