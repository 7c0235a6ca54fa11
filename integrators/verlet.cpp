#include "integrators/verlet.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/errors.hpp"
#include "base/parallel.hpp"

namespace gneiss {
namespace {

std::vector<double> symmetric(std::vector<double> first_ones) {
    double sum = 0;
    for (const double length : first_ones) sum += 2 * length;
    std::vector<double> all = first_ones;
    all.push_back(1 - sum);
    all.insert(all.end(), first_ones.rbegin(), first_ones.rend());
    return all;
}

/// Limits: of single steps exact, of compositions rounded down; the tests find them from the amplification.
const std::array<VerletComposition, 7>& compositions() {
    const double yoshida = 1 / (2 - std::cbrt(2.0)), suzuki = 1 / (4 - std::cbrt(4.0));
    static const std::array<VerletComposition, 7> all{
        {{"single", 2, {1}, {2, 1}},
         {"yoshida_3", 4, symmetric({yoshida}), {1.5734, 0.932}},
         {"suzuki_5", 4, symmetric({suzuki, suzuki}), {2.7209, 3.022}},
         {"mclachlan_5", 4, symmetric({0.28, 0.62546642846767004501}), {3.0181, 2.445}},
         {"yoshida_7",
          6,
          symmetric({0.78451361047755726382, 0.23557321335935813368, -1.17767998417887100695}),
          {2.2690, 1.61}},
         {"suzuki_umeno_15",
          8,
          symmetric({0.74167036435061295345, -0.40910082580003159400, 0.19075471029623837995, -0.57386247111608226666,
                     0.29906418130365592384, 0.33462491824529818378, 0.31529309239676659663}),
          {3.3932, 2.12}},
         {"sofroniou_spaletta_35",
          10,
          symmetric({0.07879572252168641926, 0.31309610341510852776, 0.02791838323507806611, -0.22959284159390709415,
                     0.13096206107716486317, -0.26973340565451071434, 0.07497334315589143567, 0.11199342399981020489,
                     0.36613344954622675119, -0.39910563013603589788, 0.10308739852747107732, 0.41143087395589023782,
                     -0.00486636058313526176, -0.39203335370863990645, 0.05194250296244964704, 0.05066509075992449634,
                     0.04967437063972987905}),
          {3.1410, 4.35}}}};
    return all;
}

const VerletComposition& find_composition(const std::string& name) {
    const auto& all = compositions();
    const auto found = std::ranges::find_if(all, [&](const VerletComposition& one) { return name == one.name; });
    if (found != all.end()) return *found;
    std::string allowed;
    for (const VerletComposition& one : all) allowed += (allowed.empty() ? "" : ", ") + std::string(one.name);
    throw InputError("integrator.composition", fmt::format("given `{}`, must be one of {}", name, allowed));
}

}  // namespace

std::span<const VerletComposition> verlet_compositions() { return compositions(); }

void Verlet::Options::validate() const {
    step.validate();
    find_composition(composition);
}

Verlet::Verlet(const Options& options)
    : ExplicitSubSteps(options.step, find_composition(options.composition).limit),
      options_(options),
      composition_(find_composition(options.composition)) {
    options_.validate();
}

void Verlet::check(const SemiDiscrete& system) const {
    if (composition_.goes_back() && system.irreversible())
        throw InputError("integrator.composition",
                         fmt::format("given `{}`, which takes steps back in time; damage, friction and restitution "
                                     "cannot be undone: take `single`",
                                     composition_.name));
}

void Verlet::allocate(const SemiDiscrete& system) {
    ExplicitSubSteps::allocate(system);
    if (options_.form == Form::position) middle_ = middle_before_ = next_;
}

void Verlet::take(const SemiDiscrete& system, const State& state, double dt, double t_end) {
    const State* from = &state;
    const std::size_t n = composition_.sub_steps.size();
    double reached = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const bool last = i + 1 == n;
        if (i > 0) from = &go_on();
        reached += composition_.sub_steps[i];
        const double h = composition_.sub_steps[i] * dt, t = last ? t_end : state.t + reached * dt;
        if (options_.form == Form::velocity)
            sub_step(system, *from, h, t, {});
        else
            position_form(system, state, *from, h, t, i == 0, last);
    }
}

void Verlet::position_form(const SemiDiscrete& system, const State& accepted, const State& from, double h, double t,
                           bool first, bool last) {
    State& to = next_;
    to.t = t;
    const std::size_t n = a_new_.size();
    const double half = 0.5 * h, t_middle = from.t + half;
    std::swap(middle_before_, middle_);
    middle_.t = t_middle;
    middle_.last_event = to.last_event;
    {
        const double *u = from.u.data(), *v = from.v.data(), *a = a_new_.data();
        double *u_middle = middle_.u.data(), *v_middle = middle_.v.data();
        parallel_ranges(n, [=](std::size_t begin, std::size_t end) {
#pragma omp simd
            for (std::size_t i = begin; i < end; ++i) {
                u_middle[i] = u[i] + half * v[i];
                v_middle[i] = v[i] + half * a[i];
            }
        });
    }
    motion_.evaluate(system, t_middle);
    motion_.put(system, middle_.u, middle_.v);
    std::ranges::copy(from.v, right_.begin());
    subtract_damping_rate(system, half, from.v, right_);
    motion_.evaluate(system, to.t);
    // z goes to the end of every sub-step: from middle to middle its update would be no symmetric step any more, and a
    // composition of order 4 of order 2.
    const auto constraints = system.constraints();
    const bool look_at_ends = !to.z.empty();
    const State& updated_at = first ? accepted : look_at_ends ? from : middle_before_;
    for (int k = 0; k < evaluations_; ++k) {
        if (k > 0)
            for (std::size_t i = 0; i < n; ++i) middle_.v[i] = 0.5 * (from.v[i] + to.v[i]);
        evaluate(system, updated_at, Trial::of(middle_), middle_);
        kick(system, half, h, to);
    }
    {
        const double *u_middle = middle_.u.data(), *v = from.v.data(), *v_to = to.v.data();
        double *u_to = to.u.data(), *a = a_new_.data();
        parallel_ranges(n, [=](std::size_t begin, std::size_t end) {
#pragma omp simd
            for (std::size_t i = begin; i < end; ++i) {
                u_to[i] = u_middle[i] + half * v_to[i];
                a[i] = (v_to[i] - v[i]) / h;
            }
        });
    }
    motion_.put(system, to.u, to.v);
    if (!constraints.empty()) {
        motion_.evaluate(system, t_middle);
        motion_.reactions(system, middle_.v, f_, reactions_new_);
    }
    std::ranges::copy(middle_.z, to.z.begin());
    std::ranges::copy(middle_.history, to.history.begin());
    reactions_before_.swap(reactions_new_);
    const bool remembers = look_at_ends || (last && !to.history.empty());
    if (remembers || (last && !constraints.empty())) {
        if (remembers)
            evaluate(system, middle_, Trial::of(to), to);
        else
            evaluate_for_balance(system, middle_, Trial::of(to), to);
        motion_.evaluate(system, to.t);
        motion_.reactions(system, to.v, f_, reactions_new_);
    }
    system.add_path_energies(from, to);
    for (std::size_t k = 0; k < constraints.size(); ++k)
        to.path.support_work += reactions_before_[k] * (to.u[constraints[k].dof] - from.u[constraints[k].dof]);
}

}  // namespace gneiss
