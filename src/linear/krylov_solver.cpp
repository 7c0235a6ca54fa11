#include <fmt/format.h>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <cmath>
#include <vector>

#include "linear/krylov.hpp"
#include "linear/linear_solver.hpp"

namespace gneiss {
namespace {

using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor, std::int64_t>;
using Vector = Eigen::Map<const Eigen::VectorXd>;

Vector as_vector(std::span<const double> x) { return {x.data(), static_cast<Eigen::Index>(x.size())}; }
Eigen::Map<Eigen::VectorXd> as_vector(std::span<double> x) { return {x.data(), static_cast<Eigen::Index>(x.size())}; }

class Preconditioner {
public:
    virtual ~Preconditioner() = default;
    virtual void compute(const Eigen::Map<const Rows>& a) = 0;
    virtual void apply(std::span<const double> r, std::span<double> z) const = 0;
    virtual std::size_t bytes(const SparsePattern& pattern) const = 0;  ///< once computed
};

class Diagonal final : public Preconditioner {
public:
    explicit Diagonal(bool positive) : positive_(positive) {}
    void compute(const Eigen::Map<const Rows>& a) override {
        inverse_.resize(a.rows());
        for (Eigen::Index i = 0; i < inverse_.size(); ++i) {
            inverse_[i] = a.coeff(i, i);
            if (positive_ && !(inverse_[i] > 0))
                throw NotPositiveDefinite(fmt::format(
                    "the matrix is not positive definite: entry {} of its diagonal is {:.3g}", i + 1, inverse_[i]));
            if (!(std::abs(inverse_[i]) > 0))
                throw SingularMatrix(fmt::format("entry {} of the diagonal is {}", i + 1, inverse_[i]));
        }
        inverse_ = inverse_.cwiseInverse();
    }
    void apply(std::span<const double> r, std::span<double> z) const override {
        as_vector(z) = inverse_.cwiseProduct(as_vector(r));
    }
    std::size_t bytes(const SparsePattern& pattern) const override { return pattern.n() * sizeof(double); }

private:
    bool positive_;
    Eigen::VectorXd inverse_;
};

/// An incomplete factorisation by Eigen.
template <class Factor>
class Incomplete : public Preconditioner {
public:
    void compute(const Eigen::Map<const Rows>& a) override {
        factor_.compute(a);
        if (factor_.info() != Eigen::Success)
            throw SingularMatrix("there is no incomplete factorisation of the matrix");
    }
    void apply(std::span<const double> r, std::span<double> z) const override {
        as_vector(z) = factor_.solve(as_vector(r));
    }

protected:
    static constexpr std::size_t bytes_per_entry = sizeof(double) + sizeof(std::int64_t);
    Factor factor_;
};

/// L L^T with as many entries as the matrix has: Lin and More, SIAM J. Sci. Comput. 21 (1999) 24-45. Where a pivot is
/// not positive the diagonal is raised: the preconditioner of an indefinite matrix is definite.
class IncompleteCholesky final
    : public Incomplete<Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::NaturalOrdering<std::int64_t>>> {
public:
    std::size_t bytes(const SparsePattern& pattern) const override {
        return (pattern.n_nonzero() + pattern.n()) / 2 * bytes_per_entry;
    }
};

/// L U with dropped entries: Saad, Numer. Linear Algebra Appl. 1 (1994) 387-402.
class IncompleteLu final : public Incomplete<Eigen::IncompleteLUT<double, std::int64_t>> {
public:
    IncompleteLu() {
        factor_.setDroptol(1e-4);
        factor_.setFillfactor(fill);
    }
    /// At most.
    std::size_t bytes(const SparsePattern& pattern) const override {
        return fill * pattern.n_nonzero() * bytes_per_entry;
    }

private:
    static constexpr int fill = 2;  ///< entries of the factors per entry of the matrix, at most
};

class KrylovSolver final : public LinearSolver {
public:
    KrylovSolver(Krylov::Method method, const LinearSolverOptions& options) : method_(method), options_(options) {
        const bool pcg = method == Krylov::Method::pcg;
        if (options.preconditioner == "diagonal")
            preconditioner_ = std::make_unique<Diagonal>(pcg);
        else if (pcg)
            preconditioner_ = std::make_unique<IncompleteCholesky>();
        else
            preconditioner_ = std::make_unique<IncompleteLu>();
    }

    std::string name() const override { return method_ == Krylov::Method::pcg ? "pcg" : "gmres"; }

    void analyse(const SparsePattern& pattern) override {
        pattern_ = pattern;
        krylov_ = std::make_unique<Krylov>(
            method_, pattern.n(),
            Krylov::Options{.tolerance = options_.tolerance, .most_iterations = options_.most_iterations});
    }

    void factorise(std::span<const double> values) override {
        values_ = values;
        const auto n = static_cast<Eigen::Index>(pattern_.n());
        preconditioner_->compute(Eigen::Map<const Rows>(n, n, static_cast<Eigen::Index>(pattern_.n_nonzero()),
                                                        pattern_.row_starts.data(), pattern_.columns.data(),
                                                        values.data()));
    }

    void solve(std::span<const double> b, std::span<double> x) override {
        krylov_->solve(
            [this](std::span<const double> in, std::span<double> out) { multiply(pattern_, values_, in, out); },
            [this](std::span<const double> r, std::span<double> z) { preconditioner_->apply(r, z); }, b, x);
    }

    std::size_t iterations() const override { return krylov_ ? krylov_->iterations() : 0; }
    std::size_t factor_bytes() const override { return preconditioner_->bytes(pattern_) + krylov_->bytes(); }
    double expected_factor_bytes() const override { return static_cast<double>(factor_bytes()); }

private:
    Krylov::Method method_;
    LinearSolverOptions options_;
    SparsePattern pattern_;
    std::span<const double> values_;
    std::unique_ptr<Preconditioner> preconditioner_;
    std::unique_ptr<Krylov> krylov_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_pcg(const LinearSolverOptions& options) {
    return std::make_unique<KrylovSolver>(Krylov::Method::pcg, options);
}
std::unique_ptr<LinearSolver> make_gmres(const LinearSolverOptions& options) {
    return std::make_unique<KrylovSolver>(Krylov::Method::gmres, options);
}

}  // namespace gneiss
