#pragma once
// From what a user says about lumped models to the models.

#include <memory>
#include <vector>

#include "mesh/mesh.hpp"
#include "model/amplitude_course.hpp"
#include "model/lumped_model.hpp"
#include "model/options.hpp"

namespace gneiss {

/// One model per entry, in the same order.
/// @param thickness  h, m, > 0
/// @param courses    of the entries' amplitudes
/// @throws InputError with every problem of every entry, `where` being "[[lumped]] 2" (counted from 1)
std::vector<std::unique_ptr<LumpedModel>> make_lumped(const Mesh& mesh, const std::vector<LumpedOptions>& options,
                                                      double thickness, const Courses& courses = {});

}  // namespace gneiss
