#pragma once
// Prescribed motion: which degrees of freedom, and their values against time.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "mesh/mesh.hpp"
#include "model/amplitude.hpp"
#include "model/amplitude_course.hpp"
#include "model/options.hpp"
#include "system/semi_discrete.hpp"

namespace gneiss {

/// The prescribed degrees of freedom of a solid; each value is a pattern in space times an amplitude.
class ConstraintSet {
public:
    /// Degrees of freedom that share an amplitude.
    struct Group {
        struct Entry {
            std::size_t position;  ///< in constraints()
            double pattern;        ///< value at amplitude 1, m or m/s
            double x, y;           ///< reference position of the node, m
        };
        Amplitude amplitude;
        std::vector<Entry> entries;
    };

    ConstraintSet() = default;
    /// @param constraints  by ascending degree of freedom, each once
    /// @param groups       every position of `constraints` once
    ConstraintSet(std::vector<Constraint> constraints, std::vector<Group> groups);

    /// By ascending degree of freedom.
    std::span<const Constraint> constraints() const { return constraints_; }

    /// Prescribed values at time t, m for displacements and m/s for velocities; jumps as in Amplitude.
    /// @param[out] out  overwritten, shape (constraints)
    void values(double t, double last_event, std::span<double> out) const;

    /// Instants of jumps and kinks, ascending, s.
    std::vector<double> switch_times() const;

private:
    std::vector<Constraint> constraints_;
    std::vector<Group> groups_;
};

/// Entries of kind `displacement` and `velocity`; those of kind `absorbing` are left to absorbing_edges(). A degree of
/// freedom may be prescribed twice with the same kind and value.
/// @throws InputError with every problem of every entry, `where` being "[[boundary]] 2" (counted from 1): unknown
/// names, faulty formulas and amplitudes, an entry that prescribes no component, a displacement other than zero that
/// jumps (it would ask for an infinite velocity), two entries that prescribe different motions of one degree of freedom
/// @param courses  of the entries' amplitudes
ConstraintSet make_constraints(const Mesh& mesh, const std::vector<BoundaryOptions>& options,
                               const Courses& courses = {});

/// The edges of all absorbing entries, each once, in the order of the entries.
/// @throws InputError as above for names that are no boundary
std::vector<BoundaryEdge> absorbing_edges(const Mesh& mesh, const std::vector<BoundaryOptions>& options);

}  // namespace gneiss
