#include "linear/krylov.hpp"

#include <fmt/format.h>
#include <sunlinsol/sunlinsol_pcg.h>
#include <sunlinsol/sunlinsol_spgmr.h>
#include <algorithm>
#include <cmath>
#include <exception>
#include <new>
#include <utility>
#include <vector>

#include "linear/linear_solver.hpp"
#include "linear/sundials_api.hpp"

namespace gneiss {
struct Krylov::Sundials {
    SilentContext context;
    std::vector<double> right, solution;  ///< of the whole system
    std::vector<double> b, x;             ///< of what is iterated
    N_Vector b_vector = nullptr, x_vector = nullptr;
    SUNLinearSolver solver = nullptr;

    // while a solve runs
    const Product* multiply = nullptr;
    const Product* precondition = nullptr;
    bool definite = false;  ///< wanted
    std::size_t kept = 1;   ///< iterations between restarts; 1 without
    std::exception_ptr failure;

    ~Sundials() {
        if (solver != nullptr) SUNLinSolFree(solver);
        for (N_Vector vector : {b_vector, x_vector})
            if (vector != nullptr) N_VDestroy(vector);
    }

    /// Exceptions must not pass through C.
    template <class Body>
    int guarded(Body body) {
        try {
            body();
            return 0;
        } catch (...) {
            failure = std::current_exception();
            return -1;
        }
    }
    static int times(void* data, N_Vector x, N_Vector y) {
        auto& self = *static_cast<Sundials*>(data);
        return self.guarded([&] {
            (*self.multiply)(values_of(x), values_of(y));
            if (!self.definite) return;
            const double curvature = N_VDotProd(x, y);
            if (!(curvature > 0) && N_VDotProd(x, x) > 0)
                throw NotPositiveDefinite(
                    "the matrix is not positive definite: conjugate gradients met a direction of "
                    "no or negative stiffness");
        });
    }
    static int solve_preconditioner(void* data, N_Vector r, N_Vector z, sunrealtype, int) {
        auto& self = *static_cast<Sundials*>(data);
        return self.guarded([&] { (*self.precondition)(values_of(r), values_of(z)); });
    }
};

Krylov::Krylov(Method method, std::size_t n, const Options& options)
    : method_(method), n_(n), options_(options), sundials_(std::make_unique<Sundials>()) {
    Sundials& s = *sundials_;
    for (auto* values : {&s.right, &s.solution, &s.b, &s.x}) values->resize(n);
    const auto length = static_cast<sunindextype>(n);
    s.b_vector = N_VMake_Serial(length, s.b.data(), s.context);
    s.x_vector = N_VMake_Serial(length, s.x.data(), s.context);
    if (s.b_vector == nullptr || s.x_vector == nullptr) throw std::bad_alloc();
    if (method == Method::pcg) {
        s.solver = SUNLinSol_PCG(s.x_vector, SUN_PREC_BOTH, static_cast<int>(options.most_iterations), s.context);
        s.definite = true;
    } else {
        s.kept = std::max<std::size_t>(std::min({options.restart, options.most_iterations, n}), 1);
        s.solver = SUNLinSol_SPGMR(s.x_vector, SUN_PREC_RIGHT, static_cast<int>(s.kept), s.context);
    }
    if (s.solver == nullptr) throw std::bad_alloc();
    SUNLinSolSetATimes(s.solver, &s, Sundials::times);
    SUNLinSolSetPreconditioner(s.solver, &s, nullptr, Sundials::solve_preconditioner);
    if (SUNLinSolInitialize(s.solver) != 0) throw std::bad_alloc();
}

Krylov::~Krylov() = default;

void Krylov::solve(const Product& multiply, const Product& precondition, std::span<const double> b,
                   std::span<double> x) {
    Sundials& s = *sundials_;
    std::ranges::copy(b, s.right.begin());
    std::ranges::copy(b, s.b.begin());
    std::ranges::fill(s.solution, 0.0);
    const double size = std::sqrt(N_VDotProd(s.b_vector, s.b_vector));
    if (!std::isfinite(size)) throw RecoverableError("the right side is not finite");
    s.multiply = &multiply;
    s.precondition = &precondition;
    const std::size_t before = iterations_;
    for (double left = size; left > 0;) {
        iterate(size, iterations_ - before);
        for (std::size_t i = 0; i < n_; ++i) s.solution[i] += s.x[i];
        if (!options_.exact) break;
        multiply(s.solution, s.b);
        for (std::size_t i = 0; i < n_; ++i) s.b[i] = s.right[i] - s.b[i];
        const double last = std::exchange(left, std::sqrt(N_VDotProd(s.b_vector, s.b_vector)));
        constexpr double rounding = 1.5;  // of the residual itself
        if (left <= rounding * options_.tolerance * size) break;
        if (!(left < 0.5 * last))
            throw RecoverableError(fmt::format(
                "{} comes no closer than {:.3g} of the right side: the matrix is singular but for round-off, "
                "or the tolerance, {:.3g}, is below it",
                name(), left / size, options_.tolerance));
    }
    std::ranges::copy(s.solution, x.begin());
}

void Krylov::iterate(double size, std::size_t spent) {
    Sundials& s = *sundials_;
    const auto give_up = [&](double left, std::size_t iterations) {
        throw RecoverableError(fmt::format(
            "{} is left with {:.3g} of the right side after {} iterations, asked for {:.3g}: take a larger tolerance, "
            "more iterations, another preconditioner or a direct solver",
            name(), left / size, iterations, options_.tolerance));
    };
    const std::size_t more = options_.most_iterations - spent;
    if (more < s.kept) give_up(std::sqrt(N_VDotProd(s.b_vector, s.b_vector)), spent);
    if (method_ == Method::pcg)
        SUNLinSol_PCGSetMaxl(s.solver, static_cast<int>(more));
    else
        SUNLinSol_SPGMRSetMaxRestarts(s.solver, static_cast<int>(more / s.kept - 1));
    std::ranges::fill(s.x, 0.0);
    SUNLinSolSetZeroGuess(s.solver, SUNTRUE);
    SUNLinSolSetup(s.solver, nullptr);
    const int flag = SUNLinSolSolve(s.solver, nullptr, s.x_vector, s.b_vector, options_.tolerance * size);
    const auto taken = static_cast<std::size_t>(SUNLinSolNumIters(s.solver));
    iterations_ += taken;
    if (s.failure) std::rethrow_exception(std::exchange(s.failure, nullptr));
    if (flag != 0) give_up(SUNLinSolResNorm(s.solver), spent + taken);
}

std::size_t Krylov::bytes() const {
    const std::size_t vectors = method_ == Method::pcg ? 4 + 4 : std::min(options_.restart, n_) + 3 + 4;
    return vectors * n_ * sizeof(double);
}

}  // namespace gneiss
