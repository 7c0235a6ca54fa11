#include "integrators/lanczos.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <vector>

namespace gneiss {
namespace {

using Vector = Eigen::VectorXd;

constexpr int most_iterations = 60;
constexpr double enough = 0.01;  ///< residual of the largest Ritz value, relative

/// x -> M^-1/2 K M^-1/2 x at a state, K = -df/du by central differences.
class ScaledStiffness {
public:
    ScaledStiffness(const SemiDiscrete& system, const State& state)
        : system_(system),
          state_(state),
          scale_(static_cast<Eigen::Index>(state.u.size())),
          u_(state.u),
          plus_(state.u.size()),
          minus_(state.u.size()) {
        const auto mass = system.lumped_mass();
        for (std::size_t i = 0; i < mass.size(); ++i) scale_[static_cast<Eigen::Index>(i)] = 1 / std::sqrt(mass[i]);
        for (const Constraint& constraint : system.constraints()) scale_[static_cast<Eigen::Index>(constraint.dof)] = 0;
    }

    Vector random() const {
        // any start with a share in the highest modes does
        Vector x(scale_.size());
        std::uint64_t seed = 1;
        for (double& value : x) {
            seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
            value = static_cast<double>(seed >> 11) * 0x1p-53 - 0.5;
        }
        for (Eigen::Index i = 0; i < x.size(); ++i)
            if (scale_[i] == 0) x[i] = 0;
        return x.normalized();
    }

    Vector operator()(const Vector& x) {
        const Vector direction = scale_.cwiseProduct(x);
        // a step that strains an element by about 1e-6, where truncation and round-off are both small
        const double size = 1e-6 * displacement_scale_ / std::max(direction.lpNorm<Eigen::Infinity>(), 1e-300);
        evaluate(direction, size, plus_);
        evaluate(direction, -size, minus_);
        Vector y(x.size());
        for (Eigen::Index i = 0; i < y.size(); ++i)
            y[i] = -scale_[i] * (plus_[static_cast<std::size_t>(i)] - minus_[static_cast<std::size_t>(i)]) / (2 * size);
        return y;
    }

    /// Length over which the difference is taken, m.
    void set_displacement_scale(double scale) { displacement_scale_ = scale; }

private:
    void evaluate(const Vector& direction, double size, std::vector<double>& f) {
        for (std::size_t i = 0; i < u_.size(); ++i)
            u_[i] = state_.u[i] + size * direction[static_cast<Eigen::Index>(i)];
        system_.force(state_, {state_.t, state_.last_event, u_, state_.v, {}}, f);
    }

    const SemiDiscrete& system_;
    const State& state_;
    Vector scale_;
    std::vector<double> u_, plus_, minus_;
    double displacement_scale_ = 1;
};

}  // namespace

double lanczos_frequency_bound(const SemiDiscrete& system, const State& state) {
    ScaledStiffness stiffness(system, state);
    stiffness.set_displacement_scale(system.smallest_length());
    Vector q = stiffness.random(), before = Vector::Zero(q.size());
    double beta = 0, bound = 0;
    std::vector<double> diagonal, off_diagonal;
    for (int k = 0; k < most_iterations; ++k) {
        Vector r = stiffness(q) - beta * before;
        const double alpha = q.dot(r);
        r -= alpha * q;
        diagonal.push_back(alpha);
        beta = r.norm();

        const auto n = static_cast<Eigen::Index>(diagonal.size());
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
        ritz.computeFromTridiagonal(Eigen::Map<const Vector>(diagonal.data(), n),
                                    Eigen::Map<const Vector>(off_diagonal.data(), n - 1));
        const double largest = ritz.eigenvalues()[n - 1];
        const double residual = beta * std::abs(ritz.eigenvectors()(n - 1, n - 1));
        bound = largest + residual;
        if (residual <= enough * largest || !(beta > 0)) break;
        off_diagonal.push_back(beta);
        before = q;
        q = r / beta;
    }
    return std::sqrt(bound);
}

}  // namespace gneiss
