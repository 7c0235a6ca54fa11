#pragma once
// The lumped models of a solid, one behind the other, with their parts of z and their points behind the nodes.

#include <memory>
#include <span>
#include <vector>

#include "model/lumped_model.hpp"

namespace gneiss {

class LumpedModels {
public:
    LumpedModels() = default;
    /// @param z_offset  of the first one in z
    LumpedModels(std::vector<std::unique_ptr<LumpedModel>> all, std::size_t z_offset);

    bool empty() const { return all_.empty(); }
    std::size_t size() const { return all_.size(); }
    const LumpedModel& operator[](std::size_t i) const { return *all_[i]; }
    std::size_t n_internal() const { return starts_.back() - starts_.front(); }
    /// Points stand behind `n_nodes` nodes of the mesh, in the order of the models.
    void place_points(std::size_t n_nodes);
    std::vector<LumpedModel::Point> points() const;
    /// The same models on a mesh that has come apart: what they remember is not in them.
    void replace(std::vector<std::unique_ptr<LumpedModel>> all);

    void initial_internal(std::span<double> z) const;
    bool depend_on_velocity() const;
    /// @param[out] z  whole z that accepting the trial would leave; empty: not wanted
    void add_force(const State& accepted, const Trial& trial, std::span<double> f, std::span<double> z) const;
    void corner_forces(const State& state, std::vector<CornerForce>& forces) const;
    void internal_rate(const Trial& trial, std::span<double> rate) const;

    void stiffness(std::size_t i, const State& accepted, const Trial& trial,
                   std::span<ForceTerm::Stiffness> df_du) const;
    void velocity_stiffness(std::size_t i, const State& accepted, const Trial& trial,
                            std::span<ForceTerm::Stiffness> df_dv) const;
    LowRank dyads(const State& accepted, const Trial& trial, double scale) const;

    LumpedModel::Rates largest_rates(const State& accepted, std::span<const double> lumped_mass) const;
    void add_stiffness_bound(const State& accepted, const Trial& trial, std::span<double> bound) const;

    double stored_energy(const State& state) const;
    void add_path_energies(const State& from, const Trial& before, const State& to, const Trial& after,
                           PathEnergies& energies) const;
    std::vector<double> switch_times() const;
    /// Of all of them; "cavity.pressure".
    std::vector<LumpedModel::Quantity> quantities(const State& state) const;

private:
    /// The trial with model i's own z, taken over from the accepted state or brought up to date.
    class Seen;

    std::vector<std::unique_ptr<LumpedModel>> all_;
    std::vector<std::size_t> starts_{0};  ///< in z, shape (size + 1)
};

}  // namespace gneiss
