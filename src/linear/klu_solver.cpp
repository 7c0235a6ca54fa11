#include <fmt/format.h>
#include <klu.h>
#include <algorithm>
#include <new>
#include <span>
#include <vector>

#include "linear/linear_solver.hpp"
#include "linear/ordering.hpp"

namespace gneiss {
namespace {

/// KLU takes compressed columns: handed our rows, it factorises A^T, and solves with the transpose of that.
class Klu final : public LinearSolver {
public:
    Klu() {
        klu_l_defaults(&common_);
        common_.halt_if_singular = 1;
        common_.user_data = this;
        common_.user_order = order;
    }
    Klu(const Klu&) = delete;
    Klu& operator=(const Klu&) = delete;
    ~Klu() override { free_all(); }

    std::string name() const override { return "klu"; }

    void analyse(const SparsePattern& pattern) override {
        free_all();
        pattern_ = pattern;
        if (is_structurally_symmetric(pattern)) {
            common_.ordering = 3;  // by user_order
            common_.btf = 0;
        } else {
            common_.ordering = 0;  // minimum degree
            common_.btf = 1;
        }
        symbolic_ = klu_l_analyze(static_cast<SuiteSparse_long>(pattern.n()), starts(), columns(), &common_);
        check("its pattern");
    }

    void factorise(std::span<const double> values) override {
        auto* a = const_cast<double*>(values.data());
        if (numeric_ != nullptr) {
            // the old pivots serve as long as none vanishes and elimination does not blow the entries up
            constexpr double vanishing = 1e-12, growth = 1e-6;
            if (klu_l_refactor(starts(), columns(), a, symbolic_, numeric_, &common_) &&
                klu_l_rcond(symbolic_, numeric_, &common_) && common_.rcond > vanishing &&
                klu_l_rgrowth(starts(), columns(), a, symbolic_, numeric_, &common_) && common_.rgrowth > growth)
                return;
            klu_l_free_numeric(&numeric_, &common_);
        }
        numeric_ = klu_l_factor(starts(), columns(), a, symbolic_, &common_);
        check(fmt::format("column {}", common_.singular_col + 1));
        if (!klu_l_rcond(symbolic_, numeric_, &common_) || !(common_.rcond > smallest_pivot_ratio))
            throw SingularMatrix(singular_text(common_.rcond));
    }

    void solve(std::span<const double> b, std::span<double> x) override {
        if (x.data() != b.data()) std::ranges::copy(b, x.begin());
        klu_l_tsolve(symbolic_, numeric_, static_cast<SuiteSparse_long>(pattern_.n()), 1, x.data(), &common_);
    }

    void forget() override { klu_l_free_numeric(&numeric_, &common_); }

    /// A negative determinant: an odd number of negative eigenvalues.
    bool indefinite() const override {
        const std::span pivots(static_cast<const double*>(numeric_->Udiag), pattern_.n());
        const bool odd_pivots = std::ranges::count_if(pivots, [](double pivot) { return pivot < 0; }) % 2 == 1;
        return odd_pivots != (odd({numeric_->Pnum, pattern_.n()}) != odd({symbolic_->Q, pattern_.n()}));
    }

    std::size_t factor_bytes() const override {
        return static_cast<std::size_t>(bytes(static_cast<double>(numeric_->lnz + numeric_->unz)));
    }
    /// As long as pivots stay on the diagonal.
    double expected_factor_bytes() const override { return bytes(symbolic_->lnz + symbolic_->unz); }

private:
    /// Whether a permutation is made of an odd number of exchanges.
    static bool odd(std::span<const SuiteSparse_long> permutation) {
        std::vector<bool> seen(permutation.size(), false);
        std::size_t exchanges = 0;  // one less in each cycle than it has members
        for (std::size_t start = 0; start < permutation.size(); ++start) {
            if (seen[start]) continue;
            for (std::size_t i = start; !seen[i]; i = static_cast<std::size_t>(permutation[i])) {
                seen[i] = true;
                ++exchanges;
            }
            --exchanges;
        }
        return exchanges % 2 == 1;
    }
    double bytes(double entries) const {
        return entries * static_cast<double>(sizeof(double) + sizeof(SuiteSparse_long)) +
               static_cast<double>(pattern_.n() * 10 * sizeof(double));
    }
    /// For klu_l_analyze(). @return entries of L to be expected, 0 if there is no memory
    static SuiteSparse_long order(SuiteSparse_long n, SuiteSparse_long*, SuiteSparse_long*, SuiteSparse_long* unknowns,
                                  klu_l_common* common) {
        try {
            const Ordering ordering = fill_reducing_ordering(static_cast<const Klu*>(common->user_data)->pattern_);
            std::ranges::copy(ordering.unknowns, unknowns);
            return std::max(static_cast<SuiteSparse_long>(ordering.factor_entries), n);
        } catch (const std::bad_alloc&) {
            return 0;
        }
    }
    SuiteSparse_long* starts() const { return const_cast<SuiteSparse_long*>(pattern_.row_starts.data()); }
    SuiteSparse_long* columns() const { return const_cast<SuiteSparse_long*>(pattern_.columns.data()); }
    void check(const std::string& where) {
        if (common_.status == KLU_OK) return;
        if (common_.status == KLU_OUT_OF_MEMORY) throw std::bad_alloc();
        klu_l_free_numeric(&numeric_, &common_);
        throw SingularMatrix("the matrix is singular: " + where);
    }
    void free_all() {
        forget();
        klu_l_free_symbolic(&symbolic_, &common_);
    }

    klu_l_common common_{};
    SparsePattern pattern_;
    klu_l_symbolic* symbolic_ = nullptr;
    klu_l_numeric* numeric_ = nullptr;
};

}  // namespace

std::unique_ptr<LinearSolver> make_klu() { return std::make_unique<Klu>(); }

}  // namespace gneiss
