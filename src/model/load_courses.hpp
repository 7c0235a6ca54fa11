#pragma once
// The courses of all amplitudes of a case, found before the run.

#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "model/amplitude_course.hpp"
#include "model/options.hpp"

namespace gneiss {

struct LoadCourses {
    Courses loads, boundaries, lumped;  ///< null where an amplitude is constant or faulty
    std::vector<std::string> warnings;  ///< "[[load]] 2: amplitude: …"

    /// Those that there are.
    Courses all() const;
};

/// Looks at the amplitudes of every load, boundary and lumped model over the whole run, at the nodes that it acts on.
/// What is faulty is left to whoever makes the loads.
LoadCourses find_courses(const Mesh& mesh, const CaseOptions& options);

}  // namespace gneiss
