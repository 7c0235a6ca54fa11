#pragma once
// What history.csv, probes.csv, reactions.csv and load_steps.csv hold: columns and rows.

#include <span>
#include <vector>

#include "fracture/cracking.hpp"
#include "io/output/csv_series.hpp"
#include "mesh/locate.hpp"
#include "model/energy_ledger.hpp"
#include "model/options.hpp"
#include "model/solid_system.hpp"
#include "system/integrator.hpp"

namespace gneiss {

/// The columns of history.csv.
/// @param cracks  with those of add_crack_columns()
std::vector<CsvColumn> history_columns(bool cracks = false);
/// What lumped models have to tell, in columns behind all others: "cavity.pressure".
void add_model_columns(const SolidSystem& system, std::vector<CsvColumn>& columns);
void add_model_columns(const SolidSystem& system, const State& state, std::vector<double>& row);
/// Length of edges that have failed (m, in the reference shape), number of fragments, number of nodes.
void add_crack_columns(const Cracking& cracking, const State& state, std::vector<double>& row);
/// One row of it, in the order of history_columns().
std::vector<double> history_row(double t, std::size_t step, double dt, const EnergyLedger& ledger);

/// The columns of load_steps.csv, where integrators report their steps one by one: time, step, trials thrown away, what
/// else the integrator counts, and why the last trial was thrown away.
std::vector<CsvColumn> step_columns(const Integrator& integrator);
/// The numbers of one row of it; StepReport::rejected comes last.
std::vector<double> step_row(const StepReport& step);

/// Probes: points that keep their place in the material.
class ProbeTable {
public:
    ProbeTable() = default;
    /// @param mesh  has to outlive the table, which follows it
    /// @throws InputError with every probe that lies outside the solid
    ProbeTable(const Mesh& mesh, const std::vector<ProbeOptions>& probes);

    bool empty() const { return probes_.empty(); }
    /// Columns: t, then for each probe u_x, u_y, v_x, v_y and the Cauchy stress of its sub-triangle; with a centre also
    /// u_r, u_t, v_r, v_t and the stresses in the same directions: r from the centre to the reference position, t at
    /// +90 degrees.
    std::vector<CsvColumn> columns() const;
    std::vector<double> row(const SolidSystem& system, const State& state) const;

private:
    const Mesh* mesh_ = nullptr;
    struct Probe {
        std::string name;
        MeshPoint point;
        bool radial;
        std::array<double, 2> direction;  ///< r, unit vector
    };
    std::vector<Probe> probes_;
};

/// Forces of supports, summed over each boundary with prescribed motion.
class ReactionTable {
public:
    ReactionTable() = default;
    /// @param constraints  those that `boundaries` make of the mesh, see make_constraints()
    ReactionTable(const Mesh& mesh, const std::vector<BoundaryOptions>& boundaries,
                  std::span<const Constraint> constraints);

    bool empty() const { return columns_.empty(); }
    std::size_t n_constraints() const { return column_of_.size(); }
    /// Columns: t, then R_x and R_y of each name in the order of the deck, where they are prescribed. A degree of
    /// freedom that two names share belongs to the first: the columns add up to all there is.
    std::vector<CsvColumn> columns() const;
    /// @param reactions  N, shape (constraints)
    std::vector<double> row(double t, std::span<const double> reactions) const;

private:
    std::vector<CsvColumn> columns_;
    std::vector<std::size_t> column_of_;  ///< shape (constraints)
};

}  // namespace gneiss
