#pragma once
// Solids of a few elements, and their dense matrices.

#include <Eigen/Dense>
#include <array>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "linear/linear_solver.hpp"
#include "mesh/make_mesh.hpp"
#include "model/impedance.hpp"
#include "model/initial_conditions.hpp"
#include "model/loads.hpp"
#include "model/make_blocks.hpp"
#include "model/make_lumped.hpp"
#include "model/solid_system.hpp"

namespace gneiss::test {

/// Inner nodes of a rectangle are moved by up to `part` of a sub-edge in either direction; mid-side nodes as well.
void distort(Mesh& mesh, double sub_edge, double part, unsigned seed);

Mesh rectangle(bool compt, double width, double height, std::array<int, 2> cells,
               MeshOptions::Pattern pattern = MeshOptions::Pattern::alternating);

/// Columns of cells of these widths, from `narrowest` times `growth` to one column from the other.
Mesh graded(bool compt, std::array<int, 2> cells, double narrowest, double growth, double height);

/// Bedded rock of set (22), (23): nu = 0.25, beta twice as stiff as alpha.
MaterialOptions rock(double axis_angle = 0.4);

/// A solid with everything it is made of. The mesh lives here because messages and fields need its numbers.
struct Solid {
    Mesh mesh;
    std::unique_ptr<SolidSystem> system;
};

struct SolidDescription {
    SolidOptions solid;
    std::vector<MaterialOptions> materials{rock()};
    std::vector<LoadOptions> loads;
    std::vector<BoundaryOptions> boundaries;
    std::vector<InitialOptions> initial;
    double mass_damping = 0;
    std::vector<LumpedOptions> lumped = {};
};

/// As the program builds it, absorbing boundaries included.
/// @param add  adds parts that a description has no words for
Solid make_solid(Mesh mesh, const SolidDescription& what, const std::function<void(SolidSystem::Parts&)>& add = {});

/// 2 m x 1 m, distorted, a dozen composites of bedded rock (or the CST on the same nodes).
Solid distorted_solid(bool compt, const SolidDescription& what = {});

Eigen::MatrixXd dense(const SparsePattern& pattern, std::span<const double> values);

/// An assembled tangent, with what stands beside it.
Eigen::MatrixXd dense(const Tangent& tangent, const State& accepted, const Trial& trial,
                      const Tangent::Factors& factors);

/// K = -df/du at an accepted state by central differences of 1e-6 of an edge: relative error about 1e-9.
Eigen::MatrixXd dense_stiffness(const SemiDiscrete& system, const State& state);

/// Natural frequencies, ascending, rad/s, of the symmetric part of K against M; prescribed motion is not looked at.
Eigen::VectorXd dense_frequencies(const SemiDiscrete& system, const State& state);

}  // namespace gneiss::test
