#include "linear/ordering.hpp"

#include <cholmod.h>
#include <malloc.h>
#include <algorithm>
#include <memory>
#include <new>

namespace gneiss {
namespace {

/// Nodes from which on nested dissection is worth its time.
constexpr std::size_t many = 5000;

/// Unknowns with equal rows as one node of a graph.
struct NodeGraph {
    std::vector<std::int64_t> first;            ///< unknown of each node, and n behind them
    std::vector<std::int64_t> starts, columns;  ///< neighbours, without the node itself

    explicit NodeGraph(const SparsePattern& pattern) {
        std::vector<std::int64_t> node_of(pattern.n());
        const auto row = [&](std::size_t i) {
            return pattern.columns.subspan(static_cast<std::size_t>(pattern.row_starts[i]),
                                           static_cast<std::size_t>(pattern.row_starts[i + 1] - pattern.row_starts[i]));
        };
        for (std::size_t i = 0; i < pattern.n(); ++i) {
            if (i == 0 || !std::ranges::equal(row(i - 1), row(i))) first.push_back(static_cast<std::int64_t>(i));
            node_of[i] = static_cast<std::int64_t>(first.size()) - 1;
        }
        starts.push_back(0);
        for (std::size_t node = 0; node < first.size(); ++node) {
            std::int64_t last = -1;
            for (const std::int64_t column : row(static_cast<std::size_t>(first[node]))) {
                const std::int64_t other = node_of[static_cast<std::size_t>(column)];
                if (other != last && other != static_cast<std::int64_t>(node)) columns.push_back(other);
                last = other;
            }
            starts.push_back(static_cast<std::int64_t>(columns.size()));
        }
        first.push_back(static_cast<std::int64_t>(pattern.n()));
    }
    std::size_t n() const { return first.size() - 1; }
};

}  // namespace

bool is_structurally_symmetric(const SparsePattern& pattern) {
    // row by row, the mirror images of column i's entries come in the order of their rows
    std::vector<std::int64_t> next(pattern.row_starts.begin(), pattern.row_starts.end() - 1);
    for (std::size_t i = 0; i < pattern.n(); ++i) {
        bool diagonal = false;
        for (auto k = static_cast<std::size_t>(pattern.row_starts[i]);
             k < static_cast<std::size_t>(pattern.row_starts[i + 1]); ++k) {
            const auto j = static_cast<std::size_t>(pattern.columns[k]);
            const std::int64_t mirror = next[j]++;
            if (mirror == pattern.row_starts[j + 1] ||
                pattern.columns[static_cast<std::size_t>(mirror)] != static_cast<std::int64_t>(i))
                return false;
            diagonal = diagonal || i == j;
        }
        if (!diagonal) return false;
    }
    return true;
}

namespace {

Ordering ordering_of_nodes(const SparsePattern& pattern) {
    NodeGraph graph(pattern);
    cholmod_common common;
    cholmod_l_start(&common);
    const std::unique_ptr<cholmod_common, void (*)(cholmod_common*)> finish(
        &common, [](cholmod_common* c) { cholmod_l_finish(c); });
    common.print = 0;
    common.nmethods = 1;
    common.method[0].ordering = graph.n() < many ? CHOLMOD_AMD : CHOLMOD_METIS;
    common.postorder = 1;
    cholmod_sparse a{};
    a.nrow = a.ncol = graph.n();
    a.nzmax = graph.columns.size();
    a.p = graph.starts.data();
    a.i = graph.columns.data();
    a.stype = 1;
    a.itype = CHOLMOD_LONG;
    a.xtype = CHOLMOD_PATTERN;
    a.sorted = a.packed = 1;
    cholmod_factor* factor = cholmod_l_analyze(&a, &common);
    if (factor == nullptr) throw std::bad_alloc();
    const double unknowns_per_node = static_cast<double>(pattern.n()) / static_cast<double>(graph.n());
    Ordering ordering;
    ordering.factor_entries = common.lnz * unknowns_per_node * unknowns_per_node;
    ordering.unknowns.reserve(pattern.n());
    const auto* nodes = static_cast<const SuiteSparse_long*>(factor->Perm);
    for (std::size_t k = 0; k < graph.n(); ++k) {
        const auto node = static_cast<std::size_t>(nodes[k]);
        for (std::int64_t unknown = graph.first[node]; unknown < graph.first[node + 1]; ++unknown)
            ordering.unknowns.push_back(unknown);
    }
    cholmod_l_free_factor(&factor, &common);
    return ordering;
}

}  // namespace

Ordering fill_reducing_ordering(const SparsePattern& pattern) {
    Ordering ordering = ordering_of_nodes(pattern);
#ifdef __GLIBC__
    malloc_trim(
        0);  // METIS' small arrays go back to the system, which the C library would not do: 50 bytes per unknown
#endif
    return ordering;
}

}  // namespace gneiss
