#include "support/amplification.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace gneiss::test {

Eigen::Matrix2d amplification(const MakeIntegrator& make, double omega, double interactions) {
    Eigen::Matrix2d matrix;
    for (int column = 0; column < 2; ++column) {
        OscillatorModel model;
        model.mass = Vector{{1, 1}};
        model.stiffness = omega * omega * Matrix::Identity(2, 2);
        model.interactions = interactions * model.stiffness;
        model.initial_u = Vector{{column == 0 ? 1.0 : 0.0, 0}};
        model.initial_v = Vector{{column == 1 ? omega : 0.0, 0}};
        model.bound = {1e-3 * omega, 0};  // a bound that lies, so that no step is refused
        const Oscillator system(model);
        State state = system.initial_state();
        const auto integrator = make(1.0);
        integrator->start(system, state, StartReason::fresh);
        integrator->advance(system, state, 1.0);
        matrix.col(column) << state.u[0], state.v[0] / omega;
    }
    return matrix;
}

double spectral_radius(const Eigen::Matrix2d& matrix) { return matrix.eigenvalues().cwiseAbs().maxCoeff(); }

double stability_limit(const MakeIntegrator& make, double largest, double least, double interactions) {
    const auto grows = [&](double omega) {
        return spectral_radius(amplification(make, omega, interactions)) > 1 + least;
    };
    constexpr int n = 500;
    double stable = 0, unstable = largest;
    for (int i = 1; i <= n && stable < unstable; ++i) {
        const double omega = largest * i / n;
        if (grows(omega)) {
            unstable = omega;
            break;
        }
        stable = omega;
    }
    for (int i = 0; i < 40; ++i) (grows(0.5 * (stable + unstable)) ? unstable : stable) = 0.5 * (stable + unstable);
    return stable;
}

double largest_under_damping(const std::function<std::unique_ptr<Integrator>()>& make) {
    double largest = 0;
    for (const double rate : {0.0, 0.2, 1.0, 4.0, 20.0})
        for (int kind = 0; kind < 3; ++kind) {
            OscillatorModel model;
            model.mass = Vector{{2, 2}};
            model.stiffness = 2 * Matrix{{9, 0}, {0, 1}};
            model.initial_u = Vector{{1, 0.3}};
            if (kind == 0) model.viscosity = 2 * rate * Matrix::Identity(2, 2);
            if (kind == 1) model.damping.mass_proportional = rate;
            if (kind == 2) model.damping.blocks = {{0, 2 * rate, 0.5 * rate, rate}};
            const Oscillator system(model);
            const auto integrator = make();
            State state = system.initial_state();
            integrator->start(system, state, StartReason::fresh);
            for (int step = 0; step < 4000; ++step) integrator->advance(system, state, state.t + 100);
            const double size = std::abs(state.u[0]) + std::abs(state.u[1]);
            largest = size <= largest ? largest : size;  // what is no number stays
        }
    return largest;
}

}  // namespace gneiss::test
