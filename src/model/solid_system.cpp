#include "model/solid_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "mesh/measure.hpp"
#include "model/element_levels.hpp"
#include "model/impedance.hpp"
#include "model/load_switch.hpp"

namespace gneiss {

/// Interactions look at the state; a tangent made before their couplings changed is of no use.
class SolidSystem::Look final : public Event {
public:
    explicit Look(SolidSystem& solid) : solid_(solid) {}
    std::string name() const override { return "interactions"; }
    std::optional<double> next_time(const State&) const override { return std::nullopt; }
    EventOutcome apply(State&) override { return EventOutcome::none; }
    bool watches() const override { return true; }
    bool stirred(const State& state) const override { return solid_.interactions_.stirred(state); }
    EventOutcome look(State& accepted) override { return outcome(solid_.interactions_.look(accepted)); }
    EventOutcome renew(const State& accepted) override { return outcome(solid_.interactions_.renew(accepted)); }

private:
    EventOutcome outcome(bool couplings_changed) {
        if (!couplings_changed || !solid_.tangent_) return EventOutcome::none;
        solid_.tangent_.reset();
        return EventOutcome::resize;
    }

    SolidSystem& solid_;
};

SolidSystem::SolidSystem(const Mesh& mesh, Parts parts)
    : elements_(std::move(parts.blocks), mesh),
      n_elements_(mesh.n_elements()),
      terms_(std::move(parts.terms)),
      interactions_(std::move(parts.interactions), elements_.n_history()),
      models_(std::move(parts.models), elements_.n_internal()),
      constraints_(std::move(parts.constraints)),
      damping_(std::move(parts.damping)),
      initial_velocity_(std::move(parts.initial_velocity)),
      mass_(elements_.lumped_mass()),
      smallest_edge_(mesh_size(mesh).smallest_edge),
      courses_(std::move(parts.courses)) {
    interactions_.take_chunks(elements_.chunk_of_node(), elements_.n_chunks());
    n_mesh_dof_ = mass_.size();
    models_.place_points(mesh.n_nodes());
    for (const LumpedModel::Point& point : models_.points()) mass_.insert(mass_.end(), 2, point.mass);
    std::vector<double> switches = constraints_.switch_times();
    const std::vector<double> of_models = models_.switch_times();
    switches.insert(switches.end(), of_models.begin(), of_models.end());
    for (const auto& term : terms_) {
        const std::vector<double> own = term->switch_times();
        switches.insert(switches.end(), own.begin(), own.end());
    }
    for (const auto& course : courses_) load_peaks_.insert(load_peaks_.end(), {course->largest_at, course->fastest_at});
    std::ranges::sort(load_peaks_);
    load_peaks_.erase(std::ranges::unique(load_peaks_).begin(), load_peaks_.end());
    events_.push_back(std::make_unique<LoadSwitch>(std::move(switches)));
    if (interactions_.watch()) events_.push_back(std::make_unique<Look>(*this));
}

Layout SolidSystem::layout() const {
    return {mass_.size(), elements_.n_internal() + models_.n_internal(),
            elements_.n_history() + interactions_.n_history()};
}

State SolidSystem::initial_state() const {
    State state;
    state.u.assign(mass_.size(), 0.0);
    state.v = initial_velocity_;
    state.v.resize(n_mesh_dof_);  // none given: all zero
    for (const LumpedModel::Point& point : models_.points())
        state.v.insert(state.v.end(), {point.velocity.x, point.velocity.y});
    state.z.resize(layout().n_internal);
    state.history.resize(layout().n_history);
    elements_.initial_memory(state.z, state.history);
    interactions_.initial_history(state.history);
    models_.initial_internal(state.z);
    if (elements_.viscous()) state.path.viscous_power = elements_.energies(state, Trial::of(state)).viscous_power;
    return state;
}

void SolidSystem::follow(const Parting& parting, std::optional<Surroundings> surroundings, State& accepted) {
    elements_.renumber(parting.mesh, parting.elements);
    const auto points = [this](std::vector<double>& nodal) {
        return nodal.begin() + static_cast<std::ptrdiff_t>(n_mesh_dof_);
    };
    const std::vector<double> point_mass(points(mass_), mass_.end());
    for (std::vector<double>* nodal : {&accepted.u, &accepted.v}) {
        const std::vector<double> of_points(points(*nodal), nodal->end());
        nodal->erase(points(*nodal), nodal->end());
        for (const NodeCopy& copy : parting.copies)
            for (std::size_t c = 0; c < 2; ++c)
                nodal->push_back(double{(*nodal)[2 * static_cast<std::size_t>(copy.original) + c]});
        nodal->insert(nodal->end(), of_points.begin(), of_points.end());
    }
    n_mesh_dof_ = 2 * parting.mesh.n_nodes();
    mass_.erase(mass_.end() - std::ssize(point_mass), mass_.end());
    mass_.resize(n_mesh_dof_);
    std::vector<bool> weighed(parting.mesh.n_nodes(), true);
    const auto n = static_cast<std::size_t>(parting.mesh.nodes_per_element());
    for (const NodeCopy& copy : parting.copies)
        for (const std::int32_t node : {copy.original, copy.copy}) {
            weighed[static_cast<std::size_t>(node)] = false;
            mass_[2 * static_cast<std::size_t>(node)] = mass_[2 * static_cast<std::size_t>(node) + 1] = 0;
        }
    own_mass_.resize(mass_.size());
    for (const std::int32_t e : parting.elements) {
        const std::span nodes(parting.mesh.element(static_cast<std::size_t>(e)), n);
        for (const std::int32_t node : nodes)
            for (std::size_t c = 0; c < 2; ++c) own_mass_[2 * static_cast<std::size_t>(node) + c] = 0;
        elements_.add_mass(e, own_mass_);
        for (const std::int32_t node : nodes) {
            const auto i = static_cast<std::size_t>(node);
            for (std::size_t c = 0; c < 2; ++c)
                if (!weighed[i]) mass_[2 * i + c] += own_mass_[2 * i + c];
        }
    }
    mass_.insert(mass_.end(), point_mass.begin(), point_mass.end());
    if (surroundings) {
        terms_ = std::move(surroundings->terms);
        constraints_ = std::move(surroundings->constraints);
        damping_.blocks = std::move(surroundings->damping);
        models_.replace(std::move(surroundings->models));
    }
    models_.place_points(parting.mesh.n_nodes());
    interactions_.follow(parting, accepted);
    tangent_.reset();
}

double SolidSystem::longest_step(double t) const {
    double longest = std::numeric_limits<double>::infinity();
    for (const auto& course : courses_) longest = std::min(longest, course->longest_step(t));
    return longest;
}

void SolidSystem::constraint_values(double t, double last_event, std::span<double> values) const {
    constraints_.values(t, last_event, values);
}

void SolidSystem::force(const State& accepted, const Trial& trial, std::span<double> f) const {
    elements_.force(accepted, trial, f, {}, {}, {&interactions_, nullptr});
    add_rest(accepted, trial, f, {}, {});
}

void SolidSystem::force_and_update(const State& accepted, const Trial& trial, std::span<double> f, std::span<double> z,
                                   std::span<double> history) const {
    elements_.force(accepted, trial, f, z, history, {&interactions_, nullptr});
    add_rest(accepted, trial, f, z, history);
}

void SolidSystem::force_on_arrival(const State& accepted, const Trial& trial, const Arrival& arrival,
                                   std::span<double> f, std::span<double> z, std::span<double> history) const {
    arrival.bring(n_mesh_dof_, f.size());
    elements_.force(accepted, trial, f, z, history, {&interactions_, &arrival});
    add_rest(accepted, trial, f, z, history);
}

void SolidSystem::add_rest(const State& accepted, const Trial& trial, std::span<double> f, std::span<double> z,
                           std::span<double> history) const {
    std::ranges::fill(f.subspan(n_mesh_dof_), 0.0);
    interactions_.add_force(accepted, trial, f, history);
    for (const auto& term : terms_) term->add_force(trial, f);
    models_.add_force(accepted, trial, f, z);
}

void SolidSystem::corner_forces(const State& state, std::vector<CornerForce>& forces) const {
    for (const auto& term : terms_) term->corner_forces(Trial::of(state), forces);
    models_.corner_forces(state, forces);
}

void SolidSystem::external_force(const Trial& trial, std::span<double> f) const {
    std::ranges::fill(f, 0.0);
    for (const auto& term : terms_) term->add_force(trial, f);
}

void SolidSystem::interaction_force(const State& accepted, const Trial& trial, std::span<double> f,
                                    std::span<double> history) const {
    std::ranges::fill(f, 0.0);
    if (!history.empty()) std::ranges::copy(accepted.history, history.begin());
    elements_.add_company_force(accepted, trial, f, history, interactions_);
    interactions_.add_force(accepted, trial, f, history);
}

void SolidSystem::internal_rate(const State& accepted, const Trial& trial, std::span<double> rate) const {
    elements_.internal_rate(accepted, trial, rate);
    models_.internal_rate(trial, rate);
}

void SolidSystem::internal_weights(std::span<double> weights) const {
    elements_.internal_weights(weights);
    std::ranges::fill(weights.subspan(elements_.n_internal()), 1.0);
}

const Tangent* SolidSystem::tangent() const {
    if (!tangent_)
        tangent_ = std::make_unique<SolidTangent>(elements_, terms_, interactions_, models_, mass_, damping_);
    return tangent_.get();
}

FrequencyBound SolidSystem::frequency_bound(const State& accepted) const {
    const ElementBlock::Rates rates = elements_.largest_rates(accepted);
    const double of_bonds = bond_omega_squared(accepted);
    return {std::sqrt(rates.omega_squared + of_bonds), rates.damping + models_.largest_rates(accepted, mass_).damping,
            of_bonds};
}

double SolidSystem::bond_omega_squared(const State& accepted) const {
    return interactions_.omega_squared(accepted, Trial::of(accepted), mass_) +
           models_.largest_rates(accepted, mass_).omega_squared;
}

std::unique_ptr<Levels> SolidSystem::levels(int most) const {
    std::vector<Problem> problems;
    if (!interactions_.empty())
        problems.push_back({"integrator.levels",
                            "joints and contact act at nodes of any level and need the shortest step: `mri` takes them "
                            "in steps of their own"});
    if (!models_.empty()) problems.push_back({"integrator.levels", "lumped models couple nodes of all levels"});
    if (!problems.empty()) throw InputError(problems);
    return ElementLevels::make(elements_, initial_state(), most);
}

void SolidSystem::stiffness_bound(const State& accepted, const Trial& trial, std::span<double> bound) const {
    elements_.stiffness_bound(accepted, trial, bound);
    std::ranges::fill(bound.subspan(n_mesh_dof_), 0.0);
    interactions_.add_stiffness_bound(accepted, trial, bound);
    models_.add_stiffness_bound(accepted, trial, bound);
}

StoredEnergies SolidSystem::stored_energies(const State& state) const {
    Trial trial = Trial::of(state);
    trial.v = {};
    const ElementBlock::Sums sums = elements_.energies(state, trial);
    StoredEnergies energies;
    energies.material = sums.stored;
    energies.stress_power = sums.stress_power;
    interactions_.add_stored(state, energies);
    energies.models = models_.stored_energy(state);
    return energies;
}

void SolidSystem::add_path_energies(const State& from, State& to) const {
    to.path = from.path;
    const Trial before = Trial::of(from);
    Trial after = Trial::of(to);
    after.last_event = from.last_event;  // the step ends before what switches at its end
    for (const auto& term : terms_) term->add_path_energies(before, after, to.path);
    interactions_.add_dissipated(from, to);
    models_.add_path_energies(from, before, to, after, to.path);
    if (!damping_.blocks.empty()) to.path.absorbing += absorbed_work(damping_.blocks, before, after);
    if (damping_.mass_proportional > 0) {
        const double sum = ordered_sum(mass_.size(), partial_, [&](std::size_t first, std::size_t last) {
            double part = 0;
            for (std::size_t i = first; i < last; ++i) part += mass_[i] * (from.v[i] + to.v[i]) * (to.u[i] - from.u[i]);
            return part;
        });
        to.path.damping += 0.5 * damping_.mass_proportional * sum;
    }
    if (elements_.viscous()) {
        to.path.viscous_power = elements_.energies(to, after).viscous_power;
        to.path.viscous += 0.5 * (from.path.viscous_power + to.path.viscous_power) * (to.t - from.t);
    }
}

std::vector<PointFields> SolidSystem::point_fields(const State& state, std::int32_t element) const {
    std::vector<PointFields> fields(static_cast<std::size_t>(elements_.n_sub_triangles()));
    elements_.point_fields(element, state, fields.data());
    return fields;
}

std::vector<PointFields> SolidSystem::point_fields(const State& state) const {
    const auto n_sub = static_cast<std::size_t>(elements_.n_sub_triangles());
    std::vector<PointFields> fields(n_elements_ * n_sub);
    for (std::size_t e = 0; e < n_elements_; ++e)
        elements_.point_fields(static_cast<std::int32_t>(e), state, fields.data() + e * n_sub);
    return fields;
}

}  // namespace gneiss
