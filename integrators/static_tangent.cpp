#include "integrators/static_tangent.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/largest.hpp"
#include "integrators/free_part.hpp"
#include "linear/bordered_solver.hpp"
#include "linear/krylov.hpp"

namespace gneiss {
namespace {

const Tangent& tangent_of(const SemiDiscrete& system) { return tangent_of(system, "quasi_static"); }

/// The free degrees of freedom alone.
FreeMatrix without_entries(const SemiDiscrete& system) {
    const std::vector<std::int64_t> starts(system.layout().n_dof + 1, 0);
    return FreeMatrix({starts, {}}, constrained_dofs(system));
}

class Assembled final : public StaticTangent {
public:
    Assembled(const SemiDiscrete& system, const LinearSolverOptions& options, SUNContext context)
        : StaticTangent(free_part(system, tangent_of(system)), context),
          tangent_(tangent_of(system)),
          values_(tangent_.n_nonzero()),
          solver_(make_linear_solver(options, tangent_.symmetric())) {
        if (n() > 0) solver_.analyse(free_.pattern());
    }

    void linearise(const State& accepted, const Trial& trial) override {
        accepted_ = &accepted;
        trial_ = trial;
        tangent_.assemble(accepted, trial, {.stiffness = 1}, values_);
        beside_ = tangent_.beside(accepted, trial, {.stiffness = 1});
    }
    void subtract_fixed(std::span<const double> x_fixed, std::span<double> right) override {
        free_.subtract_fixed(values_, x_fixed, right);
        free_.subtract_fixed(beside_, x_fixed, right);
    }
    void factorise() override {
        braced_ = false;
        free_.take_values(values_, free_values());
        try {
            solver_.factorise(free_values(), free_.take(beside_));
        } catch (const SingularMatrix&) {
            if (brace_ == 0) throw;
            braced_ = true;
            tangent_.assemble(*accepted_, trial_, {.mass = brace_, .stiffness = 1}, values_);
            free_.take_values(values_, free_values());
            solver_.factorise(free_values(), free_.take(beside_));
        }
    }
    void forget() override { solver_.forget(); }
    void solve(std::span<const double> b, std::span<double> x) override { solver_.solve(b, x); }
    void multiply(std::span<const double> x, std::span<double> y) override {
        gneiss::multiply(free_.pattern(), free_values(), x, y);
        free_.take(beside_).add_product(1, x, y);
    }
    bool indefinite() const override { return solver_.indefinite(); }
    std::size_t iterations() const override { return solver_.iterations(); }
    double bytes() const override {
        return static_cast<double>(values_.size() * sizeof(double) + free_.bytes()) +
               (n() > 0 ? solver_.expected_factor_bytes() : 0.0);
    }

private:
    std::span<double> free_values() { return {values_.data(), free_.pattern().n_nonzero()}; }

    const Tangent& tangent_;
    const State* accepted_ = nullptr;
    Trial trial_;                 ///< where K is taken
    std::vector<double> values_;  ///< of all degrees of freedom, or, once factorised, of the free ones in front
    LowRank beside_;              ///< of all degrees of freedom
    BorderedSolver solver_;
};

class MatrixFree final : public StaticTangent {
public:
    MatrixFree(const SemiDiscrete& system, const LinearSolverOptions& options, SUNContext context)
        : StaticTangent(without_entries(system), context),
          system_(system),
          definite_(options.solver == "pcg"),
          krylov_(definite_ ? Krylov::Method::pcg : Krylov::Method::gmres, n(),
                  {.tolerance = options.tolerance, .most_iterations = options.most_iterations, .exact = false}),
          fixed_(constrained_dofs(system)) {
        for (auto* values : {&u_, &v_, &moved_, &f_, &f_moved_, &inverse_diagonal_})
            values->resize(system.layout().n_dof);
    }

    void linearise(const State& accepted, const Trial& trial) override {
        accepted_ = &accepted;
        t_ = trial.t;
        last_event_ = trial.last_event;
        std::ranges::copy(trial.u, u_.begin());
        std::ranges::copy(trial.v, v_.begin());
        const double h = system_.smallest_length();
        length_ = h * std::sqrt(std::numeric_limits<double>::epsilon() * (1 + largest_magnitude(u_) / h));
        evaluate(u_, f_);
        tangent_of(system_).assemble_diagonal(accepted, trial, {.stiffness = 1}, inverse_diagonal_);
    }
    void subtract_fixed(std::span<const double> x_fixed, std::span<double> right) override {
        const double scale = step(x_fixed);
        if (scale == 0) return;
        std::ranges::copy(u_, moved_.begin());
        for (std::size_t k = 0; k < fixed_.size(); ++k) moved_[fixed_[k]] += scale * x_fixed[k];
        evaluate(moved_, f_moved_);
        const auto free = free_.free();
        for (std::size_t i = 0; i < right.size(); ++i) right[i] += (f_moved_[free[i]] - f_[free[i]]) / scale;
    }
    void factorise() override {
        for (const std::size_t dof : free_.free()) {
            const double entry = inverse_diagonal_[dof];
            if (definite_ && !(entry > 0))
                throw NotPositiveDefinite(fmt::format(
                    "the matrix is not positive definite: its diagonal holds {:.3g} at node {}", entry, dof / 2 + 1));
            if (!(std::abs(entry) > 0))
                throw SingularMatrix(fmt::format("the diagonal of the matrix holds {} at node {}", entry, dof / 2 + 1));
            inverse_diagonal_[dof] = 1 / entry;
        }
    }
    void solve(std::span<const double> b, std::span<double> x) override {
        krylov_.solve([this](std::span<const double> in, std::span<double> out) { multiply(in, out); },
                      [this](std::span<const double> r, std::span<double> z) {
                          const auto free = free_.free();
                          for (std::size_t i = 0; i < z.size(); ++i) z[i] = inverse_diagonal_[free[i]] * r[i];
                      },
                      b, x);
    }
    void multiply(std::span<const double> x, std::span<double> y) override {
        const double scale = step(x);
        std::ranges::fill(y, 0.0);
        if (scale == 0) return;
        std::ranges::copy(u_, moved_.begin());
        const auto free = free_.free();
        for (std::size_t i = 0; i < x.size(); ++i) moved_[free[i]] += scale * x[i];
        evaluate(moved_, f_moved_);
        for (std::size_t i = 0; i < y.size(); ++i) y[i] = (f_[free[i]] - f_moved_[free[i]]) / scale;
    }
    std::size_t iterations() const override { return krylov_.iterations(); }
    std::size_t evaluations() const override { return evaluations_; }
    double bytes() const override {
        constexpr std::size_t vectors = 6;
        return static_cast<double>(vectors * u_.size() * sizeof(double) + free_.bytes() + krylov_.bytes());
    }

private:
    /// Factor that makes x a displacement small enough for a difference. Moved by d, the shortest edge h strains by d/h
    /// at most, which is the error of the difference; round-off of strains is eps (1 + |u|/h), over what x strains.
    /// They are equal, for an x that strains the edges, at d = h sqrt(eps (1 + |u|/h)); one that is smooth over L is
    /// worse off by L/h.
    double step(std::span<const double> x) const {
        const double largest = largest_magnitude(x);
        return largest > 0 ? length_ / largest : 0.0;
    }
    void evaluate(std::span<const double> u, std::span<double> f) {
        system_.force(*accepted_, {t_, last_event_, u, v_, {}}, f);
        ++evaluations_;
    }

    const SemiDiscrete& system_;
    bool definite_;  ///< K has to be
    Krylov krylov_;
    std::vector<std::size_t> fixed_;
    // where K is taken
    const State* accepted_ = nullptr;
    double t_ = 0, last_event_ = 0;
    double length_ = 0;  ///< of displacements in differences, m
    std::vector<double> u_, v_, f_, inverse_diagonal_;
    std::vector<double> moved_, f_moved_;
    std::size_t evaluations_ = 0;
};

}  // namespace

StaticTangent::StaticTangent(FreeMatrix free, SUNContext context)
    : free_(std::move(free)), matrix_(new_matrix(this, context)), linear_solver_(new_linear_solver(this, context)) {
    matrix_->ops->matvec = [](SUNMatrix matrix, N_Vector x, N_Vector y) {
        auto& self = *static_cast<StaticTangent*>(matrix->content);
        return self.guard_([&] { self.multiply(values_of(x), values_of(y)); });
    };
}

std::unique_ptr<StaticTangent> make_assembled_tangent(const SemiDiscrete& system, const LinearSolverOptions& options,
                                                      SUNContext context) {
    return std::make_unique<Assembled>(system, options, context);
}

void check_matrix_free(const LinearSolverOptions& options, std::vector<Problem>& problems) {
    if (!options.iterative())
        problems.push_back({"integrator.matrix_free", fmt::format("needs solver = \"pcg\" or \"gmres\": without a "
                                                                  "matrix `{}` has nothing to factorise",
                                                                  options.solver)});
    if (options.preconditioner != "diagonal")
        problems.push_back({"integrator.matrix_free",
                            "needs preconditioner = \"diagonal\": an incomplete factorisation needs the matrix"});
}

std::unique_ptr<StaticTangent> make_matrix_free_tangent(const SemiDiscrete& system, const LinearSolverOptions& options,
                                                        SUNContext context) {
    std::vector<Problem> problems;
    check_matrix_free(options, problems);
    options.check_symmetry(tangent_of(system).symmetric(), problems);
    if (!problems.empty()) throw InputError(problems);
    return std::make_unique<MatrixFree>(system, options, context);
}

}  // namespace gneiss
