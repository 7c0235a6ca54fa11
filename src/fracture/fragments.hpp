#pragma once
// The pieces that a solid has come apart into.

#include <functional>
#include <vector>

#include "base/vec2.hpp"
#include "mesh/inner_sides.hpp"
#include "model/element_forces.hpp"

namespace gneiss {

/// Elements that hold together.
struct Fragment {
    std::size_t n_elements = 0;
    double mass = 0;        ///< kg
    Vec2<double> centre;    ///< of mass, where it is now, m
    Vec2<double> velocity;  ///< of the centre, m/s
};

struct Fragments {
    std::vector<std::int32_t> of_element;  ///< number of the fragment of each element
    std::vector<Fragment> all;             ///< by the lowest number among their elements
};

/// @param broken  whether nothing holds an inner side any more, by its number
Fragments find_fragments(const Mesh& mesh, const InnerSides& inner, const std::function<bool(std::int32_t)>& broken,
                         const ElementForces& elements, const State& state);

/// How many there are: without their masses, for every row of a history.
std::size_t count_fragments(std::size_t n_elements, const InnerSides& inner,
                            const std::function<bool(std::int32_t)>& broken);

}  // namespace gneiss
