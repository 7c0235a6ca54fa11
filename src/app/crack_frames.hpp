#pragma once
// What a run tells of its cracks: cracks.pvd with the edges, fragments.csv, and two columns of history.csv.

#include <filesystem>
#include <optional>

#include "fracture/cracking.hpp"
#include "fracture/fragments.hpp"
#include "io/output/csv_series.hpp"
#include "io/output/field_series.hpp"

namespace gneiss {

/// Fragments of a solid as its cracks have left it.
Fragments find_fragments(const Cracking& cracking, const State& state);
std::size_t count_fragments(const Cracking& cracking, const State& state);

/// Edges that have begun to soften, as lines in the reference shape: displacement of their middle line, and of each
/// damage (0 to 1, of its less damaged end), opening and slip (m, means), mode (1 opening, 0 sliding, where it failed
/// or as it is), dissipated energy (J/m2, by fracture and by friction), time of failure (s; nan where it has not
/// failed), fracture energies (J/m2) and penalty (Pa/m), number of the inner side. As point data, whose points are the
/// ends of one edge each: end_damage, end_opening, end_slip (m), end_dissipated_fracture_i and _ii (J/m2, in opening
/// and in sliding), end_tensile_strength and end_cohesion (Pa; of extrinsic ends those at which they were found to
/// open). And the fragments: elements, mass, centre, velocity.
class CrackFrames {
public:
    /// @param restart_time  as in FieldSeries
    CrackFrames(const std::filesystem::path& folder, const Cracking& cracking, std::optional<double> restart_time,
                VtuData data = VtuData::raw);

    void write(const State& state, std::size_t step);
    void flush() { fragments_.flush(); }

private:
    const Cracking& cracking_;
    FieldSeries series_;
    CsvSeries fragments_;
};

}  // namespace gneiss
