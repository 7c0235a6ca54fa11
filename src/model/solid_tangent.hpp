#pragma once
// The tangent of a solid as a matrix of compressed rows: elements, loads, masses, damping.
//
// Chunks of packs that touch no common node have one colour; colours are assembled one after the other, the chunks of
// one colour in parallel. An entry is thus summed in the order of the colours, for any number of threads.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "model/element_forces.hpp"
#include "model/force_term.hpp"
#include "system/semi_discrete.hpp"

namespace gneiss {

class SolidTangent final : public Tangent {
public:
    /// The arguments have to outlive the tangent.
    SolidTangent(const ElementForces& elements, std::span<const std::unique_ptr<ForceTerm>> terms,
                 std::span<const double> lumped_mass, const Damping& damping);

    bool symmetric() const override { return symmetric_; }
    std::size_t n_nonzero() const override { return 4 * neighbours_.size(); }
    MatrixPattern pattern() const override;
    void assemble(const State& accepted, const Trial& trial, const Factors& factors,
                  std::span<double> values) const override;

private:
    void plan_pattern();
    void plan_chunks();
    void plan_terms();
    /// Where the 2 x 2 block of two nodes begins: the rows of a node stand one behind the other, a pair per neighbour.
    PairNumber place(std::int32_t row_node, std::int32_t column_node) const;

    const ElementForces& elements_;
    std::span<const std::unique_ptr<ForceTerm>> terms_;
    std::span<const double> mass_;
    const Damping& damping_;
    bool symmetric_;

    std::vector<std::int32_t> neighbours_;         ///< nodes with which a node shares an element, itself among them
    std::vector<std::int32_t> neighbour_starts_;   ///< shape (nodes + 1)
    std::vector<std::int32_t> row_pairs_;          ///< pairs of entries in either row of a node: its neighbours
    std::vector<std::vector<PairNumber>> blocks_;  ///< ElementBlock::MatrixPlaces::blocks of each block
    std::vector<PackRange> chunks_;                ///< by colour
    std::vector<std::size_t> colour_starts_;       ///< in chunks_
    std::vector<PairNumber> diagonal_;             ///< place of each node's own 2 x 2 block
    std::vector<std::vector<PairNumber>> term_places_;
    mutable std::vector<ForceTerm::Stiffness> term_stiffness_;  ///< scratch
    std::vector<std::vector<std::array<std::int32_t, 2>>> couplings_;
};

}  // namespace gneiss
