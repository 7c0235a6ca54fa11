#pragma once
// How an amplitude runs over a whole run: where it jumps and bends, and how long a step may be to see it.
//
// An error estimate sees what a step evaluates. In a solid at rest it sees nothing, steps grow, and a pulse between two
// instants of evaluation is never noticed. So an expression is looked at before the run: where a comparison in it
// changes its mind, where an abs, min, max, sign or rint bends or jumps, and where samples find a jump of the whole of
// it, steps end; elsewhere it is sampled until straight lines between samples follow it, and no step may be longer than
// such a line.

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/vec2.hpp"
#include "model/options.hpp"

namespace gneiss {

struct AmplitudeCourse {
    /// An instant at which an expression jumps or bends.
    struct Switch {
        double before, after;  ///< the last instant before it and the first one after it that a double can be, s
        double time;           ///< of its event: one of those or between them, s
        bool jumps;            ///< false: bends
    };
    /// A part of time within which no step may be longer than this.
    struct Stretch {
        double begin, end;  ///< s
        double longest;     ///< s
    };
    std::vector<Switch> switches;  ///< of expressions alone; ascending, apart from each other
    /// For each place that was looked at, ascending; between stretches the amplitude keeps its value.
    std::vector<std::vector<Stretch>> stretches;
    double largest_at = 0;              ///< where it is largest in magnitude, s
    double fastest_at = 0;              ///< where it varies fastest, s
    std::vector<std::string> warnings;  ///< what a user should know of it

    /// The longest step from t that passes over no stretch unseen, s; may be infinite.
    double longest_step(double t) const;
};

/// @param until   end of the run, s, > 0
/// @param places  reference positions that the amplitude acts at, m, one at least
/// @throws InputError for a faulty amplitude
AmplitudeCourse course_of(const AmplitudeOptions& amplitude, double until, std::span<const Vec2<double>> places);

/// The courses of the amplitudes of a list of loads, boundaries or models, one each; null where nobody has looked.
/// Those of a list that is shorter are null.
using Courses = std::vector<std::shared_ptr<const AmplitudeCourse>>;
inline std::shared_ptr<const AmplitudeCourse> course_at(const Courses& courses, std::size_t entry) {
    return entry < courses.size() ? courses[entry] : nullptr;
}

}  // namespace gneiss
