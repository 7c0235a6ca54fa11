#include "cholesky.hpp"

#include "linear/linear_solver.hpp"

namespace gneiss::crosscheck {
namespace {

class Cholesky final : public DirectSolver {
public:
    void factorise(std::vector<std::int64_t> row_starts, std::vector<std::int64_t> columns,
                   const std::vector<double>& values) override {
        row_starts_ = std::move(row_starts);
        columns_ = std::move(columns);
        solver_->analyse({row_starts_, columns_});
        try {
            solver_->factorise(values);
        } catch (const SingularMatrix& error) {
            throw RecoverableError(std::string("the stiffness has no inverse, are there enough supports? ") +
                                   error.what());
        }
    }
    void solve(const double* b, double* x) override {
        const std::size_t n = row_starts_.size() - 1;
        solver_->solve({b, n}, {x, n});
    }

private:
    std::unique_ptr<LinearSolver> solver_ = make_cholmod();
    std::vector<std::int64_t> row_starts_, columns_;
};

}  // namespace

MakeSolver cholesky() {
    return [] { return std::make_unique<Cholesky>(); };
}

}  // namespace gneiss::crosscheck
