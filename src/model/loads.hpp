#pragma once
// From what a user says about loads to the force terms that act  [FORMULATION 8].

#include <memory>
#include <vector>

#include "mesh/mesh.hpp"
#include "model/amplitude_course.hpp"
#include "model/force_term.hpp"
#include "model/options.hpp"

namespace gneiss {

/// One force term per entry, in the same order.
/// @param thickness  h, m, > 0
/// @param courses    of the entries' amplitudes
/// @throws InputError with every problem of every entry, `where` being "[[load]] 2" (counted from 1): unknown names,
/// faulty formulas, values that are not finite at a node, faulty amplitudes
std::vector<std::unique_ptr<ForceTerm>> make_loads(const Mesh& mesh, const std::vector<LoadOptions>& options,
                                                   double thickness, const Courses& courses = {});

}  // namespace gneiss
