// The table [integrator]: every scheme's keys.

#include "base/scheme_defaults.hpp"
#include "io/deck/choices.hpp"
#include "io/deck/keys.hpp"
#include "io/deck/sections.hpp"

namespace gneiss::deck {
namespace {

/// Keys that fit the scheme and yet have no effect beside others of its keys, and those that are missing.
void check_integrator(TableReader& table, IntegratorOptions& out) {
    using I = IntegratorOptions;
    const I usual;
    const auto idle = [&](std::string_view key, auto I::*member, std::vector<std::string_view> deciders,
                          const std::string& reason) {
        if (!table.given(key) || table.failed(key) || out.*member == usual.*member) return;
        deciders.push_back("type");
        const std::string why = "it has no effect: " + reason;
        if (!table.leave_out(key, deciders, why)) table.problem(key, why + std::string(swap_way_out));
        out.*member = usual.*member;
    };
    if ((out.type == "generalized_alpha" || out.type == "newmark" || out.type == "hht_alpha") && !out.adaptive) {
        const std::string fixed = "steps are fixed without `adaptive = true`";
        idle("rtol", &I::rtol, {"adaptive"}, fixed);
        idle("displacement_scale", &I::displacement_scale, {"adaptive"}, fixed);
        idle("longest", &I::longest, {"adaptive"}, fixed);
    }
    const auto idle_solver = [&](std::string_view decider, const std::string& with) {
        const std::string reason = fmt::format("with {}, no linear systems are solved", with);
        idle("solver", &I::solver, {decider}, reason);
        idle("preconditioner", &I::preconditioner, {decider, "solver"}, reason);
        idle("linear_tolerance", &I::linear_tolerance, {decider, "solver"}, reason);
        idle("most_linear_iterations", &I::most_linear_iterations, {decider, "solver"}, reason);
    };
    if ((out.type == "bathe" || out.type == "mri") && !table.given("dt") && !table.failed("dt"))
        table.problem("dt", fmt::format("missing, must be a number > 0 s: `{}` takes fixed steps", out.type));
    if (out.type == "cvode" && out.functional) idle_solver("iteration", "iteration = \"functional\"");
    if (out.type == "arkode" && is_explicit_table(out.table))
        idle_solver("table", fmt::format("table = \"{}\"", out.table));
}

}  // namespace

const Section<IntegratorOptions>& integrator_section() {
    using I = IntegratorOptions;
    using Types = std::vector<Condition>;
    const Types explicit_ones{{"type", {"central_difference", "verlet", "noh_bathe"}}}, verlet{{"type", {"verlet"}}},
        newmark{{"type", {"newmark"}}}, cvode{{"type", {"cvode"}}},
        statics{{"type", {"quasi_static", "dynamic_relaxation"}}},
        alphas{{"type", {"generalized_alpha", "newmark", "hht_alpha"}}}, multistep{{"type", {"cvode", "ida"}}},
        stepped{{"type",
                 {"central_difference", "verlet", "noh_bathe", "generalized_alpha", "newmark", "hht_alpha", "bathe",
                  "arkode", "mri"}}},
        first_order{{"type", {"cvode", "arkode", "mri", "ida"}}},
        controlled{{"type", {"generalized_alpha", "newmark", "hht_alpha", "cvode", "arkode", "mri", "ida"}}},
        balanced{
            {"type", {"quasi_static", "dynamic_relaxation", "generalized_alpha", "newmark", "hht_alpha", "bathe"}}},
        limited{{"type",
                 {"quasi_static", "dynamic_relaxation", "generalized_alpha", "newmark", "hht_alpha", "cvode", "arkode",
                  "ida"}}},
        iterative{{"solver", {"pcg", "gmres"}}},
        solved{
            {"type", {"quasi_static", "generalized_alpha", "newmark", "hht_alpha", "bathe", "cvode", "arkode", "ida"}}};
    static const std::string usual_iterations =
        fmt::format("in a step; 0: {} of Newton's method, {} of dynamic relaxation", scheme_defaults::newton_iterations,
                    scheme_defaults::relaxation_iterations);
    static const Section<I> section{
        {choice("type", &I::type, integrators, {.meaning = "time integration scheme"}),
         number("safety", &I::safety,
                {.range = half_open(0, 1),
                 .only_for = explicit_ones,
                 .meaning = "part of the critical step that is taken"}),
         choice("bound", &I::lanczos, step_bounds,
                {.only_for = explicit_ones, .meaning = "how the critical step is found"}),
         integer("levels", &I::levels,
                 {.range = closed(1, 6),
                  .only_for = {{"type", {"central_difference"}}},
                  .meaning = "most lengths of local steps, each half of the one before: small elements take shorter "
                             "ones than the rest; 1: one step for all"}),
         number(
             "dt", &I::dt,
             {.unit = "s",
              .range = at_least(0),
              .only_for = stepped,
              .meaning = "fixed step. 0: explicit schemes take `safety` times the critical step, renewed as the mesh "
                         "deforms; arkode takes steps from its error estimate; generalized_alpha, newmark and "
                         "hht_alpha need `adaptive`, where this is the first step; bathe and mri, of its long steps, "
                         "need it"}),
         choice("form", &I::position_form, verlet_forms,
                {.only_for = verlet, .meaning = "where in a sub-step forces are taken"}),
         choice(
             "composition", &I::composition, verlet_compositions,
             {.only_for = verlet, .meaning = "sub-steps that a step is made of; above order 2 some go back in time"}),
         number("split", &I::split,
                {.range = closed(0.5, 0.7),
                 .only_for = {{"type", {"noh_bathe"}}},
                 .meaning = "first sub-step over the step; 0.5: no damping"}),
         number("rho_inf", &I::rho_inf,
                {.range = closed(0, 1),
                 .only_for = {{"type", {"generalized_alpha", "bathe"}}},
                 .meaning = "part of the highest frequencies' amplitude that a step leaves; 1: no damping"}),
         number("beta", &I::beta,
                {.range = half_open(0, 2), .only_for = newmark, .meaning = "1/4: mean acceleration; 1/6: linear"}),
         number("gamma", &I::gamma,
                {.range = closed(0.5, 2), .only_for = newmark, .meaning = "above 1/2: damped, and of order 1"}),
         number("alpha", &I::alpha,
                {.range = closed(0, 1.0 / 3),
                 .only_for = {{"type", {"hht_alpha"}}},
                 .meaning = "weight of the last state in the stage at which forces are taken; 0: no damping"}),
         number(
             "interface_tolerance", &I::interface_tolerance,
             {.range = half_open(0, 1),
              .only_for = {{"type", {"generalized_alpha", "newmark", "hht_alpha", "bathe"}}},
              .meaning = "most energy that a step may make or lose at joints and contact, over the largest of the run; "
                         "beyond, it is taken again, shorter. Slow runs that are to be damped, `rho_inf` = 0, are well "
                         "served by 1e-3; 1: steps are never taken again for this"}),
         boolean("adaptive", &I::adaptive, {.only_for = alphas, .meaning = "steps from an error estimate, to `rtol`"}),
         choice("method", &I::adams, multistep_methods, {.only_for = cvode, .meaning = "family of formulas"}),
         choice("iteration", &I::functional, iterations,
                {.only_for = cvode, .meaning = "how the nonlinear system of a step is solved"}),
         boolean("stability_detection", &I::stability_detection,
                 {.only_for = cvode,
                  .meaning = "lowers the order of `bdf` where SUNDIALS finds its orders 3 to 5 unstable; on undamped "
                             "vibration it finds little, and a smaller `rtol` helps more for fewer steps"}),
         choice("table", &I::table, runge_kutta_tables,
                {.only_for = {{"type", {"arkode"}}},
                 .meaning = "coefficients, as SUNDIALS names them: stages, embedded order, order"}),
         choice("slow_table", &I::slow_table, multirate_tables,
                {.only_for = {{"type", {"mri"}}}, .meaning = "coefficients of the long steps, as SUNDIALS names them"}),
         integer("max_order", &I::max_order,
                 {.range = closed(0, 12),
                  .only_for = multistep,
                  .meaning = "highest order: `bdf` and ida up to 5, `adams` up to 12; 0: that"}),
         number("rtol", &I::rtol,
                {.range = half_open(0, 0.1),
                 .only_for = controlled,
                 .meaning = "error of a step, of mri a short one, over the scale of displacement, velocity, stress; "
                            "root mean square"}),
         number("displacement_scale", &I::displacement_scale,
                {.unit = "m",
                 .range = at_least(0),
                 .only_for = controlled,
                 .meaning = "what errors of displacement are measured against; 0: the largest so far"}),
         number("velocity_scale", &I::velocity_scale,
                {.unit = "m/s", .range = at_least(0), .only_for = first_order, .meaning = "the same of velocity"}),
         number("stress_scale", &I::stress_scale,
                {.unit = "Pa",
                 .range = at_least(0),
                 .only_for = first_order,
                 .meaning = "the same of the stresses that hypo-elastic materials carry"}),
         number("tolerance", &I::tolerance,
                {.range = half_open(0, 0.01),
                 .only_for = balanced,
                 .meaning = "largest force out of balance over the largest force of the step"}),
         integer("most_iterations", &I::most_iterations,
                 {.range = at_least(0), .only_for = balanced, .meaning = usual_iterations}),
         number("step", &I::step,
                {.unit = "s",
                 .range = at_least(0),
                 .only_for = statics,
                 .meaning = "first load step; 0: up to the next frame, checkpoint, kink of a load, or the end"}),
         number("longest", &I::longest,
                {.unit = "s", .range = at_least(0), .only_for = limited, .meaning = "longest step; 0: no limit"}),
         number("shortest", &I::shortest,
                {.range = open_between(0, 1),
                 .only_for = statics,
                 .meaning = "load step, as a part of the first one, at which a run gives up"}),
         choice("solver", &I::solver, linear_solvers, {.only_for = solved, .meaning = "of the linear systems"}),
         choice("preconditioner", &I::preconditioner, preconditioners,
                {.only_for = iterative, .meaning = "what makes iterations few"}),
         number("linear_tolerance", &I::linear_tolerance,
                {.range = half_open(0, 0.1),
                 .only_for = iterative,
                 .meaning = "residual over right side, Euclidean norms"}),
         integer("most_linear_iterations", &I::most_linear_iterations,
                 {.range = at_least(1), .only_for = iterative, .meaning = "in one linear system, at which it fails"}),
         boolean(
             "matrix_free", &I::matrix_free,
             {.only_for = {{"type", {"quasi_static"}}},
              .meaning = "pcg and gmres with the diagonal as preconditioner: no matrix is kept, products with it are "
                         "differences of forces, good to seven digits or so"})},
        check_integrator,
        true};
    return section;
}

}  // namespace gneiss::deck
