#pragma once
// A solid as a semi-discrete system: element blocks, loads, boundaries, events  [FORMULATION 1].

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/amplitude_course.hpp"
#include "model/boundaries.hpp"
#include "model/element_forces.hpp"
#include "model/force_term.hpp"
#include "model/interaction.hpp"
#include "model/lumped_models.hpp"
#include "model/solid_tangent.hpp"
#include "system/semi_discrete.hpp"

namespace gneiss {

class SolidSystem final : public SemiDiscrete {
public:
    struct Parts {
        std::vector<std::unique_ptr<ElementBlock>> blocks;
        std::vector<std::unique_ptr<ForceTerm>> terms;
        std::vector<std::unique_ptr<Interaction>> interactions = {};
        std::vector<std::unique_ptr<LumpedModel>> models = {};
        ConstraintSet constraints;
        Damping damping;
        std::vector<double> initial_velocity;  ///< m/s, shape (2 n_nodes)
        Courses courses = {};                  ///< of all amplitudes that somebody has looked at
    };
    SolidSystem(const Mesh& mesh, Parts parts);
    SolidSystem(SolidSystem&&) = delete;  // the tangent refers to its parts

    Layout layout() const override;
    State initial_state() const override;
    std::span<const double> lumped_mass() const override { return mass_; }
    const Damping& damping() const override { return damping_; }
    std::span<const Constraint> constraints() const override { return constraints_.constraints(); }
    void constraint_values(double t, double last_event, std::span<double> values) const override;
    bool force_depends_on_velocity() const override { return elements_.viscous() || models_.depend_on_velocity(); }
    bool irreversible() const override { return interactions_.irreversible(); }
    void force(const State& accepted, const Trial& trial, std::span<double> f) const override;
    void force_and_update(const State& accepted, const Trial& trial, std::span<double> f, std::span<double> z,
                          std::span<double> history) const override;
    void force_on_arrival(const State& accepted, const Trial& trial, const Arrival& arrival, std::span<double> f,
                          std::span<double> z, std::span<double> history) const override;
    void external_force(const Trial& trial, std::span<double> f) const override;
    using SemiDiscrete::interaction_force;
    void interaction_force(const State& accepted, const Trial& trial, std::span<double> f,
                           std::span<double> history) const override;
    void internal_rate(const State& accepted, const Trial& trial, std::span<double> rate) const override;
    void internal_weights(std::span<double> weights) const override;
    double smallest_length() const override { return smallest_edge_; }
    /// Made when it is first asked for: an explicit run has no use for it. Not by two threads at once.
    const Tangent* tangent() const override;
    FrequencyBound frequency_bound(const State& accepted) const override;
    double bond_omega_squared(const State& accepted) const override;
    std::unique_ptr<Levels> levels(int most) const override;
    /// Without follower pressures, whose stiffness is small beside that of elements.
    void stiffness_bound(const State& accepted, const Trial& trial, std::span<double> bound) const override;
    StoredEnergies stored_energies(const State& state) const override;
    void add_path_energies(const State& from, State& to) const override;
    double longest_step(double t) const override;
    std::span<const double> load_peaks() const override { return load_peaks_; }
    std::span<const std::unique_ptr<Event>> events() const override { return events_; }

    const ElementForces& elements() const { return elements_; }
    const LumpedModels& models() const { return models_; }

    /// What stands around a solid.
    struct Surroundings {
        std::vector<std::unique_ptr<ForceTerm>> terms;
        ConstraintSet constraints;
        std::vector<Damping::Block> damping;
        std::vector<std::unique_ptr<LumpedModel>> models;  ///< as many as there were
    };
    /// Follows a mesh that has come apart, with an accepted state: a copy moves as its original did, and the mass of
    /// both is that of their elements. A tangent made before is gone.
    /// @param surroundings  made anew from the mesh; none: no copy has to do with them
    void follow(const Parting& parting, std::optional<Surroundings> surroundings, State& accepted);
    /// An interaction's part of an accepted state's history.
    std::span<double> history_of(const Interaction& interaction, State& accepted) const {
        return interactions_.part(interaction, accepted);
    }
    std::span<const double> history_of(const Interaction& interaction, const State& accepted) const {
        return interactions_.part(interaction, const_cast<State&>(accepted));
    }

    /// An event that goes before the interactions' own looks at the state.
    void add_event(std::unique_ptr<Event> event) { events_.insert(events_.begin() + 1, std::move(event)); }

    /// Forces of loads and lumped models on edges of elements, appended.
    void corner_forces(const State& state, std::vector<CornerForce>& forces) const;

    /// Values at every sub-triangle of every element, shape (n_elements, sub-triangles), in the mesh's order.
    std::vector<PointFields> point_fields(const State& state) const;
    /// The same for one element.
    std::vector<PointFields> point_fields(const State& state, std::int32_t element) const;

private:
    class Look;
    ElementForces elements_;
    std::size_t n_elements_;
    std::vector<std::unique_ptr<ForceTerm>> terms_;
    Interactions interactions_;
    LumpedModels models_;
    std::size_t n_mesh_dof_;  ///< in front of those of the models' points
    ConstraintSet constraints_;
    Damping damping_;
    std::vector<double> initial_velocity_;
    std::vector<double> mass_, own_mass_;  ///< own_mass_: scratch
    double smallest_edge_;
    std::vector<std::unique_ptr<Event>> events_;
    /// What is not of the elements; their force stands in f, and points have none yet.
    void add_rest(const State& accepted, const Trial& trial, std::span<double> f, std::span<double> z,
                  std::span<double> history) const;

    mutable std::vector<double> partial_;            ///< scratch of sums
    mutable std::unique_ptr<SolidTangent> tangent_;  ///< null before it is asked for
    Courses courses_;
    std::vector<double> load_peaks_;  ///< s, ascending
};

}  // namespace gneiss
