#include <fmt/format.h>
#include <umfpack.h>
#include <array>
#include <new>
#include <stdexcept>
#include <vector>

#include "linear/linear_solver.hpp"
#include "linear/ordering.hpp"

namespace gneiss {
namespace {

/// UMFPACK takes compressed columns: handed our rows, it factorises A^T, and solves with the transpose of that.
class Umfpack final : public LinearSolver {
public:
    Umfpack() {
        umfpack_dl_defaults(control_.data());
        control_[UMFPACK_IRSTEP] = 0;  // refinement needs the values again; Newton's method refines by itself
    }
    Umfpack(const Umfpack&) = delete;
    Umfpack& operator=(const Umfpack&) = delete;
    ~Umfpack() override { free_all(); }

    std::string name() const override { return "umfpack"; }

    void analyse(const SparsePattern& pattern) override {
        free_all();
        pattern_ = pattern;
        const auto n = static_cast<SuiteSparse_long>(pattern.n());
        // its own choice takes matrices of follower loads for unsymmetric ones: twice the fill
        const bool symmetric = is_structurally_symmetric(pattern);
        control_[UMFPACK_STRATEGY] = symmetric ? UMFPACK_STRATEGY_SYMMETRIC : UMFPACK_STRATEGY_AUTO;
        if (symmetric)
            check(umfpack_dl_qsymbolic(n, n, starts(), columns(), nullptr,
                                       fill_reducing_ordering(pattern).unknowns.data(), &symbolic_, control_.data(),
                                       info_.data()));
        else
            check(umfpack_dl_symbolic(n, n, starts(), columns(), nullptr, &symbolic_, control_.data(), info_.data()));
        scratch_.resize(5 * pattern.n());
        indices_.resize(pattern.n());
        x_.resize(pattern.n());
    }

    void factorise(std::span<const double> values) override {
        umfpack_dl_free_numeric(&numeric_);
        check(umfpack_dl_numeric(starts(), columns(), values.data(), symbolic_, &numeric_, control_.data(),
                                 info_.data()));
        if (!(info_[UMFPACK_RCOND] > smallest_pivot_ratio)) throw SingularMatrix(singular_text(info_[UMFPACK_RCOND]));
    }

    void solve(std::span<const double> b, std::span<double> x) override {
        check(umfpack_dl_wsolve(UMFPACK_At, starts(), columns(), nullptr, x_.data(), b.data(), numeric_,
                                control_.data(), info_.data(), indices_.data(), scratch_.data()));
        std::ranges::copy(x_, x.begin());
    }

    /// An upper bound, far above what a matrix of symmetric pattern needs.
    double expected_factor_bytes() const override {
        return info_[UMFPACK_NUMERIC_SIZE_ESTIMATE] * info_[UMFPACK_SIZE_OF_UNIT];
    }
    /// A negative determinant: an odd number of negative eigenvalues.
    bool indefinite() const override {
        double mantissa = 1, exponent = 0;
        umfpack_dl_get_determinant(&mantissa, &exponent, numeric_, nullptr);
        return mantissa < 0;
    }

    std::size_t factor_bytes() const override {
        return static_cast<std::size_t>(info_[UMFPACK_NUMERIC_SIZE] * info_[UMFPACK_SIZE_OF_UNIT]);
    }

private:
    const SuiteSparse_long* starts() const { return pattern_.row_starts.data(); }
    const SuiteSparse_long* columns() const { return pattern_.columns.data(); }
    static void check(SuiteSparse_long status) {
        if (status == UMFPACK_OK) return;
        if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
        if (status == UMFPACK_WARNING_singular_matrix) throw SingularMatrix("the matrix is singular: a pivot is zero");
        throw std::logic_error(fmt::format("UMFPACK answers {}", status));
    }
    void free_all() {
        umfpack_dl_free_numeric(&numeric_);
        umfpack_dl_free_symbolic(&symbolic_);
    }

    std::array<double, UMFPACK_CONTROL> control_{};
    std::array<double, UMFPACK_INFO> info_{};
    SparsePattern pattern_;
    void *symbolic_ = nullptr, *numeric_ = nullptr;
    std::vector<double> scratch_, x_;
    std::vector<SuiteSparse_long> indices_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_umfpack() { return std::make_unique<Umfpack>(); }

}  // namespace gneiss
