#include "io/output/matrix_market.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <iterator>

#include "io/output/atomic_file.hpp"

namespace gneiss {

void write_matrix_market(const std::filesystem::path& path, const CompressedRows& matrix, const std::string& comment) {
    const std::size_t n = matrix.row_starts.size() - 1;
    std::string entries;
    std::size_t n_entries = 0;
    for (std::size_t row = 0; row < n; ++row) {
        const auto first = static_cast<std::size_t>(matrix.row_starts[row]);
        const auto last = static_cast<std::size_t>(matrix.row_starts[row + 1]);
        for (std::size_t k = first; k < last; ++k) {
            const auto column = static_cast<std::size_t>(matrix.columns[k]);
            if (matrix.values[k] == 0) continue;
            fmt::format_to(std::back_inserter(entries), FMT_COMPILE("{} {} {}\n"), row + 1, column + 1,
                           matrix.values[k]);
            ++n_entries;
        }
    }
    write_atomically(path, fmt::format("%%MatrixMarket matrix coordinate real general\n% {}\n{} {} {}\n{}", comment, n,
                                       n, n_entries, entries));
}

}  // namespace gneiss
