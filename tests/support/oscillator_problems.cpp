#include "support/oscillator_problems.hpp"

#include <cmath>

namespace gneiss::test {

OscillatorModel two_nodes() {
    OscillatorModel model;
    model.mass = Vector{{2.0, 2.0, 0.7, 0.7}};
    model.stiffness = Matrix{{60, -9, -25, 4}, {-9, 50, 3, -20}, {-25, 3, 32, -5}, {4, -20, -5, 41}};
    model.initial_u = Vector{{0.1, -0.2, 0.15, 0.05}};
    model.initial_v = Vector{{0.5, 0.3, -1.0, 0.4}};
    return model;
}

Vector smooth_load(double t, bool) {
    return Vector{{10 * std::sin(3 * t), 5 * t, -4 * std::cos(5 * t), 8 * std::exp(-t)}};
}

PrescribedMotion moving(std::size_t dof, Constraint::Kind kind, double start) {
    const double amplitude = 0.2, omega = 4;
    return {{dof, kind},
            [=](double t) { return start + amplitude * std::sin(omega * t); },
            [=](double t) { return amplitude * omega * std::cos(omega * t); },
            [=](double t) { return -amplitude * omega * omega * std::sin(omega * t); }};
}

void PrintTo(const OscillatorProblem& problem, std::ostream* out) { *out << problem.name; }

double distance(const State& p, const State& q) {
    const auto squared = [](const std::vector<double>& a, const std::vector<double>& b) {
        return (Oscillator::vector(a) - Oscillator::vector(b)).squaredNorm();
    };
    double sum = squared(p.u, q.u) + squared(p.v, q.v) / 25;
    if (!p.z.empty()) sum += squared(p.z, q.z) / 400;
    return std::sqrt(sum);
}

State march_oscillator(const Oscillator& system, Integrator& integrator, std::size_t* n_steps) {
    State state = system.initial_state();
    March march;
    march.t_end = oscillator_end;
    march.next_stop = [](double t) { return t < 0.4 ? 0.4 : t < 1.2 ? 1.2 : oscillator_end; };
    march.after_step = [&](const StepReport& step) {
        if (n_steps != nullptr) *n_steps += step.n_steps;
        return true;
    };
    march.run(system, integrator, state, false);
    return state;
}

const std::vector<OscillatorProblem>& oscillator_problems() {
    static const std::vector<OscillatorProblem> all{
        {"Undamped", [] { return two_nodes(); }},
        {"Loaded",
         [] {
             OscillatorModel model = two_nodes();
             model.load = smooth_load;
             return model;
         }},
        {"MassDamping",
         [] {
             OscillatorModel model = two_nodes();
             model.damping.mass_proportional = 1.5;
             return model;
         }},
        {"AbsorbingBlocks",
         [] {
             OscillatorModel model = two_nodes();
             model.damping.blocks = {{0, 3.0, 1.2, 5.0}, {1, 2.0, -0.8, 1.0}};
             return model;
         }},
        {"ForceJumpAtAnEvent",
         [] {
             OscillatorModel model = two_nodes();
             model.switch_time = 0.8;
             model.load = [](double t, bool switched) {
                 return Vector(smooth_load(t, switched) + (switched ? 40.0 : 0.0) * Vector{{1, -1, 0.5, 2}});
             };
             return model;
         }},
        {"InternalVariables",
         [] {
             OscillatorModel model = two_nodes();
             model.maxwell = Matrix{{1, 0, -1, 0}, {0.5, 1, 0, -1}, {0, 0, 1, 1}};
             model.maxwell_stiffness = 20;
             model.relaxation_time = 0.4;
             return model;
         }},
        {"Viscous",
         [] {
             OscillatorModel model = two_nodes();
             model.viscosity = Matrix{{3, -1, -1, 0}, {-1, 2, 0, 0}, {-1, 0, 2, 0.5}, {0, 0, 0.5, 1}};
             return model;
         }},
        {"PrescribedDisplacement",
         [] {
             OscillatorModel model = two_nodes();
             model.prescribed = {moving(1, Constraint::Kind::displacement, -0.2)};
             return model;
         }},
        {"PrescribedVelocity",
         [] {
             OscillatorModel model = two_nodes();
             model.prescribed = {moving(2, Constraint::Kind::velocity, 0.15)};
             return model;
         }},
        {"ViscousWithMovingSupports",
         [] {
             OscillatorModel model = two_nodes();
             model.viscosity = Matrix{{3, -1, -1, 0}, {-1, 2, 0, 0}, {-1, 0, 2, 0.5}, {0, 0, 0.5, 1}};
             model.prescribed = {moving(0, Constraint::Kind::displacement, 0.1),
                                 moving(3, Constraint::Kind::velocity, 0.05)};
             return model;
         }},
        {"AbsorbingNodeWithOneComponentPrescribed",
         [] {
             OscillatorModel model = two_nodes();
             model.damping.blocks = {{0, 3.0, 1.2, 5.0}, {1, 2.0, -0.8, 1.0}};
             model.prescribed = {moving(0, Constraint::Kind::velocity, 0.1),
                                 moving(3, Constraint::Kind::displacement, 0.05)};
             return model;
         }},
        {"EverythingAtOnce", [] {
             OscillatorModel model = two_nodes();
             model.damping.mass_proportional = 0.8;
             model.damping.blocks = {{0, 3.0, 1.2, 5.0}};
             model.switch_time = 0.8;
             model.load = [](double t, bool switched) {
                 return Vector(smooth_load(t, switched) + (switched ? 40.0 : 0.0) * Vector{{1, -1, 0.5, 2}});
             };
             model.maxwell = Matrix{{1, 0, -1, 0}, {0, 1, 0, -1}};
             model.maxwell_stiffness = 20;
             model.relaxation_time = 0.4;
             model.viscosity = Matrix{{1, 0, -1, 0}, {0, 1, 0, -1}, {-1, 0, 1, 0}, {0, -1, 0, 1}};
             model.prescribed = {moving(3, Constraint::Kind::displacement, 0.05)};
             return model;
         }}};
    return all;
}

}  // namespace gneiss::test
