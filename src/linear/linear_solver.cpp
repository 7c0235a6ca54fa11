#include "linear/linear_solver.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <vector>

#include "base/parallel.hpp"

namespace gneiss {

void multiply(const SparsePattern& pattern, std::span<const double> values, std::span<const double> x,
              std::span<double> y) {
    parallel_ranges(y.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t row = first; row < last; ++row) {
            double sum = 0;
            for (auto k = static_cast<std::size_t>(pattern.row_starts[row]);
                 k < static_cast<std::size_t>(pattern.row_starts[row + 1]); ++k)
                sum += values[k] * x[static_cast<std::size_t>(pattern.columns[k])];
            y[row] = sum;
        }
    });
}

std::string singular_text(double pivot_ratio) {
    return fmt::format("the matrix is singular but for round-off: its smallest pivot is {:.1e} of its largest",
                       pivot_ratio);
}

namespace {

/// CHOLMOD as long as it can.
class SymmetricSolver final : public LinearSolver {
public:
    std::string name() const override { return "automatic"; }
    void analyse(const SparsePattern& pattern) override {
        pattern_ = pattern;
        last_ = nullptr;
        general_.reset();
        definite_->analyse(pattern);
    }
    void factorise(std::span<const double> values) override {
        last_ = nullptr;
        try {
            definite_->factorise(values);
            last_ = definite_.get();
        } catch (const NotPositiveDefinite&) {
            if (!general_) {
                auto general = make_umfpack();
                general->analyse(pattern_);
                general_ = std::move(general);
            }
            general_->factorise(values);
            last_ = general_.get();
        }
    }
    void solve(std::span<const double> b, std::span<double> x) override { last_->solve(b, x); }
    std::size_t factor_bytes() const override { return last_->factor_bytes(); }
    double expected_factor_bytes() const override { return definite_->expected_factor_bytes(); }
    bool indefinite() const override { return last_ != nullptr && last_ == general_.get(); }

private:
    SparsePattern pattern_;
    std::unique_ptr<LinearSolver> definite_ = make_cholmod(), general_;
    LinearSolver* last_ = nullptr;
};

}  // namespace

void LinearSolverOptions::check(std::vector<Problem>& problems) const {
    const auto need = [&](bool fine, const char* key, const std::string& message) {
        if (!fine) problems.push_back({std::string("integrator.") + key, message});
    };
    const std::array known{"automatic", "cholmod", "klu", "umfpack", "pcg", "gmres"};
    need(std::ranges::find(known, solver) != known.end(), "solver",
         fmt::format("given `{}`, must be one of {}", solver, fmt::join(known, ", ")));
    need(preconditioner == "incomplete" || preconditioner == "diagonal", "preconditioner",
         fmt::format("given `{}`, must be one of incomplete, diagonal", preconditioner));
    need(tolerance > 0 && tolerance <= 0.1, "linear_tolerance",
         fmt::format("given {}, must be in (0, 0.1]", tolerance));
    need(most_iterations >= 1, "most_linear_iterations", fmt::format("given {}, must be >= 1", most_iterations));
}

void LinearSolverOptions::check_symmetry(bool symmetric, std::vector<Problem>& problems) const {
    if (!symmetric && (solver == "cholmod" || solver == "pcg"))
        problems.push_back({"integrator.solver",
                            fmt::format("given `{}`, but the tangent is not symmetric: take {}", solver,
                                        solver == "pcg" ? "gmres or a direct solver" : "umfpack, klu or automatic")});
}

std::unique_ptr<LinearSolver> make_linear_solver(const LinearSolverOptions& options, bool symmetric) {
    std::vector<Problem> problems;
    options.check(problems);
    options.check_symmetry(symmetric, problems);
    if (!problems.empty()) throw InputError(problems);
    const std::string& name = options.solver;
    if (name == "automatic" && symmetric) return std::make_unique<SymmetricSolver>();
    if (name == "cholmod") return make_cholmod();
    if (name == "klu") return make_klu();
    if (name == "pcg") return make_pcg(options);
    if (name == "gmres") return make_gmres(options);
    return make_umfpack();
}

}  // namespace gneiss
