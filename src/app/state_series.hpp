#pragma once
// Whole states of a run in full precision, to be compared with those of another one: states.h5.

#include <filesystem>
#include <optional>
#include <vector>

#include "io/output/checkpoint.hpp"
#include "model/solid_system.hpp"

namespace gneiss {

/// One state, told in places that a mesh keeps as it comes apart: at the nodes of every element, in every sub-triangle.
struct StateSample {
    double t = 0;                      ///< s
    std::vector<double> displacement;  ///< m, shape (n_elements, nodes per element, 2)
    std::vector<double> velocity;      ///< m/s, same shape
    std::vector<double> stress;        ///< Cauchy's, xx, yy, xy, Pa, shape (n_elements, sub-triangles, 3)
};

/// What the places weigh, and where they are, in the reference shape.
struct SamplePlaces {
    std::vector<double> node_area;      ///< m2, shape (n_elements, nodes per element): sums up to the area of the solid
    std::vector<double> triangle_area;  ///< m2, shape (n_elements, sub-triangles)
    std::vector<double> node_at;        ///< m, shape (n_elements, nodes per element, 2)
    std::vector<double> triangle_at;    ///< centroids, m, shape (n_elements, sub-triangles, 2)
};

/// Collects samples; save() writes all of them.
class StateSeries {
public:
    /// @param mesh     has to outlive the series; only connectivity may change
    /// @param restart_time  those of an older series in the file that are not later are kept; none: a new series
    StateSeries(std::filesystem::path file, const Mesh& mesh, std::optional<double> restart_time);

    void add(const SolidSystem& system, const State& state);
    /// @throws IoError
    void save() const;

private:
    std::filesystem::path file_;
    const Mesh& mesh_;
    std::vector<StateSample> samples_;
};

/// A series that has been read.
struct SavedStates {
    SamplePlaces places;
    std::vector<StateSample> samples;  ///< by ascending time
};
/// @throws InputError if there is no such file, or it is damaged
SavedStates read_states(const std::filesystem::path& file);

}  // namespace gneiss
