#pragma once
// What a .vtu frame of a run holds.

#include <filesystem>
#include <optional>

#include "io/output/field_series.hpp"
#include "model/solid_system.hpp"

namespace gneiss {

/// At nodes: displacement, velocity, speed. In every sub-triangle: Cauchy stress (six components, with that across the
/// plane) and Munjiza stress, stretches, current axes; number of the element and of its region.
class FieldFrames {
public:
    /// @param mesh  has to outlive the frames; they follow it
    /// @param restart_time  as in FieldSeries
    FieldFrames(const std::filesystem::path& folder, const Mesh& mesh, std::optional<double> restart_time,
                VtuData data = VtuData::raw);

    void write(const SolidSystem& system, const State& state, std::size_t step);

private:
    const Mesh& mesh_;
    std::size_t n_nodes_;  ///< of the last frame: it grows where cracks open
    FieldSeries series_;
};

}  // namespace gneiss
