#include <cholmod.h>
#include <fmt/format.h>
#include <omp.h>
#include <algorithm>
#include <array>
#include <new>

#include "linear/linear_solver.hpp"
#include "linear/ordering.hpp"

namespace gneiss {
namespace {

/// While it lives OpenMP makes no threads. CHOLMOD asks for four, however many the program was given; on two busy cores
/// they spend half the time waiting for each other.
class OneThread {
public:
    OneThread() { omp_set_max_active_levels(0); }
    OneThread(const OneThread&) = delete;
    OneThread& operator=(const OneThread&) = delete;
    ~OneThread() { omp_set_max_active_levels(levels_); }

private:
    int levels_ = omp_get_max_active_levels();
};

class Cholmod final : public LinearSolver {
public:
    Cholmod() {
        cholmod_l_start(&common_);
        common_.print = 0;
        common_.quick_return_if_not_posdef = 1;
        common_.final_ll = 1;  // L D L^T would go on past negative pivots
        common_.nmethods = 1;
        common_.method[0].ordering = CHOLMOD_GIVEN;
        // Supernodes are merged less eagerly than by default (0.8, 0.1, 0.05): a tenth less memory, a tenth more time
        // to factorise.
        const std::array<std::size_t, 3> columns{2, 8, 32};
        const std::array<double, 3> zeros{0.2, 0.02, 0.01};
        std::ranges::copy(columns, common_.nrelax);
        std::ranges::copy(zeros, common_.zrelax);
    }
    Cholmod(const Cholmod&) = delete;
    Cholmod& operator=(const Cholmod&) = delete;
    ~Cholmod() override {
        cholmod_l_free_factor(&factor_, &common_);
        for (cholmod_dense** dense : {&x_, &y_, &e_}) cholmod_l_free_dense(dense, &common_);
        cholmod_l_finish(&common_);
    }

    std::string name() const override { return "cholmod"; }

    void analyse(const SparsePattern& pattern) override {
        pattern_ = pattern;
        cholmod_l_free_factor(&factor_, &common_);
        cholmod_sparse a = matrix(nullptr);
        Ordering ordering = fill_reducing_ordering(pattern);
        factor_ = cholmod_l_analyze_p(&a, ordering.unknowns.data(), nullptr, 0, &common_);
        if (factor_ == nullptr) throw std::bad_alloc();
        cholmod_l_free_work(&common_);  // a factorisation needs less of it
    }

    void factorise(std::span<const double> values) override {
        const OneThread one_thread;
        cholmod_sparse a = matrix(values.data());
        cholmod_l_factorize(&a, factor_, &common_);
        if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
        if (common_.status == CHOLMOD_NOT_POSDEF || factor_->minor < factor_->n)
            throw NotPositiveDefinite(fmt::format("the matrix is not positive definite: pivot {} of {} is not",
                                                  factor_->minor + 1, factor_->n));
        const double ratio = cholmod_l_rcond(factor_, &common_);
        if (!(ratio > smallest_pivot_ratio)) throw SingularMatrix(singular_text(ratio));
    }

    void solve(std::span<const double> b, std::span<double> x) override {
        const OneThread one_thread;
        cholmod_dense right{};
        right.nrow = right.nzmax = right.d = b.size();
        right.ncol = 1;
        right.x = const_cast<double*>(b.data());  // read only, by CHOLMOD's word
        right.xtype = CHOLMOD_REAL;
        right.dtype = CHOLMOD_DOUBLE;
        // x, y and e are kept: further solves allocate nothing
        if (!cholmod_l_solve2(CHOLMOD_A, factor_, &right, nullptr, &x_, nullptr, &y_, &e_, &common_))
            throw std::bad_alloc();
        std::copy_n(static_cast<const double*>(x_->x), x.size(), x.begin());
    }

    std::size_t factor_bytes() const override { return bytes(factor_->nzmax); }
    /// The analysis knows the factor exactly.
    double expected_factor_bytes() const override {
        return static_cast<double>(bytes(static_cast<std::size_t>(common_.lnz)));
    }

private:
    /// @param entries  of a factor without supernodes
    std::size_t bytes(std::size_t entries) const {
        const auto& l = *factor_;
        const std::size_t numbers = l.is_super ? l.xsize : entries;
        const std::size_t indices = l.is_super ? l.ssize + 3 * l.nsuper : entries + 3 * l.n;
        return numbers * sizeof(double) + (indices + l.n) * sizeof(SuiteSparse_long);
    }
    /// The upper triangle of the compressed columns is the lower one of the rows.
    cholmod_sparse matrix(const double* values) const {
        cholmod_sparse a{};
        a.nrow = a.ncol = pattern_.n();
        a.nzmax = pattern_.n_nonzero();
        a.p = const_cast<std::int64_t*>(pattern_.row_starts.data());
        a.i = const_cast<std::int64_t*>(pattern_.columns.data());
        a.x = const_cast<double*>(values);
        a.stype = 1;
        a.itype = CHOLMOD_LONG;
        a.xtype = values == nullptr ? CHOLMOD_PATTERN : CHOLMOD_REAL;
        a.dtype = CHOLMOD_DOUBLE;
        a.sorted = a.packed = 1;
        return a;
    }

    cholmod_common common_{};
    SparsePattern pattern_;
    cholmod_factor* factor_ = nullptr;
    cholmod_dense *x_ = nullptr, *y_ = nullptr, *e_ = nullptr;
};

}  // namespace

std::unique_ptr<LinearSolver> make_cholmod() { return std::make_unique<Cholmod>(); }

}  // namespace gneiss
