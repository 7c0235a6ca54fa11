#pragma once
// Loads of a case against the stiffness of what they act on.

#include <span>
#include <string>
#include <vector>

#include "app/build_case.hpp"

namespace gneiss {

/// The largest that a load of the deck comes to over the run.
struct LoadPeak {
    std::string name;   ///< `[[load]] 1, pressure on "left"`
    std::string value;  ///< as it is given, with its unit: "1e+06 Pa"
    double stress = 0;  ///< that it brings about, Pa: of a body force over the extent of the mesh, of a nodal force
                        ///< over the shortest edge
    double over_modulus = 0;   ///< that, over the largest modulus of the elements it acts on
    double modulus = 0;        ///< Pa
    double x = 0, y = 0;       ///< where, m
    double shortest_time = 0;  ///< in which it rises, or half its period, s; 0: at once, or always there
};

/// @param modulus  largest one of the elements at each node, Pa, shape (n_nodes)
/// @param extent   longer side of the mesh, m; @param shortest_edge  m
std::vector<LoadPeak> load_peaks(const Case& built, std::span<const double> modulus, double extent,
                                 double shortest_edge);

/// Largest speed that supports and initial velocities prescribe, m/s.
double largest_prescribed_speed(const Case& built);

}  // namespace gneiss
