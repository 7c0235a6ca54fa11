#pragma once
// Linear systems by products with the matrix alone: conjugate gradients and restarted GMRES, as SUNDIALS has them.

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace gneiss {

class Krylov {
public:
    enum class Method {
        pcg,   ///< conjugate gradients: symmetric positive definite matrices
        gmres  ///< generalized minimal residuals, preconditioned from the right, restarted
    };
    struct Options {
        double tolerance = 1e-8;              ///< residual over right side, Euclidean norms, (0, 0.1]
        std::size_t most_iterations = 10000;  ///< of one solve, >= 1; GMRES rounds it down to whole restarts
        bool exact = true;                    ///< the products are, so that residuals can be told by them
        std::size_t restart = 50;             ///< vectors that GMRES keeps, >= 1
    };
    /// y = A x, or an approximation of x = A^-1 y as a preconditioner.
    using Product = std::function<void(std::span<const double> x, std::span<double> y)>;

    /// @param n  unknowns
    Krylov(Method method, std::size_t n, const Options& options);
    ~Krylov();

    /// Solves A x = b from x = 0. What these methods carry along as the residual may have lost touch with it (a poor
    /// preconditioner, a matrix near singular): where products are exact, b - A x is looked at, and solved for again.
    /// @param precondition  symmetric positive definite for `pcg`
    /// @param[out] x        shape (n); may be b itself
    /// @throws NotPositiveDefinite  `pcg`, if it meets a direction of no or negative curvature
    /// @throws RecoverableError     if it does not get there; what the products throw goes through
    void solve(const Product& multiply, const Product& precondition, std::span<const double> b, std::span<double> x);

    /// Of all solves so far.
    std::size_t iterations() const { return iterations_; }
    std::size_t bytes() const;  ///< of the vectors it keeps

private:
    struct Sundials;

    const char* name() const { return method_ == Method::pcg ? "pcg" : "gmres"; }
    /// SUNDIALS' iterations for the residual at hand.
    /// @param size   of the whole right side
    /// @param spent  iterations of this solve before
    void iterate(double size, std::size_t spent);

    Method method_;
    std::size_t n_;
    Options options_;
    std::size_t iterations_ = 0;
    std::unique_ptr<Sundials> sundials_;
};

}  // namespace gneiss
