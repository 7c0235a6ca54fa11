#pragma once
// From a deck to small-strain elasticity, with gneiss's own mesh, names, constants, axes and values.

#include <string>
#include <vector>

#include "elasticity.hpp"
#include "mesh/mesh.hpp"
#include "model/options.hpp"

namespace gneiss::crosscheck {

struct ElasticCase {
    std::vector<Vector> nodes;             ///< of the deck's mesh, m, in its order: the first of problem.nodes
    std::size_t n_sub_triangles;           ///< of the deck's mesh; problem.stress_at are their centroids
    std::vector<std::string> probe_names;  ///< problem.displacement_at are where they stand
    bool composites_are_cells;             ///< false: sub-triangles are, divided further by `refine`
    Elasticity problem;
};

/// The loads and prescribed displacements are those of run.t_end, pressures act on the initial shape, and material axes
/// are those at the centroid of each cell. For p1 the cells are the sub-triangles, CST of the same nodes. For p2 and
/// taylor_hood they are the composites, the mid-side nodes carrying the quadratic part; on meshes with curved sides the
/// sub-triangles.
/// @param refine  how often cells are cut into four; loads and supports on boundaries go along, named nodes do not
///                multiply
/// @throws InputError with everything that is wrong with the deck's mesh, or else with what the deck puts on it, or
/// what
///         is no small-strain elasticity
ElasticCase elastic_case(const CaseOptions& options, Element element, int refine);

}  // namespace gneiss::crosscheck
