#pragma once
// The tangent of a solid as a matrix of compressed rows: elements, loads, interactions, masses, damping.
//
// Chunks of packs that touch no common node have one colour; colours are assembled one after the other, the chunks of
// one colour in parallel. An entry is thus summed in the order of the colours, for any number of threads.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "model/element_forces.hpp"
#include "model/force_term.hpp"
#include "model/interaction.hpp"
#include "model/lumped_models.hpp"
#include "system/semi_discrete.hpp"

namespace gneiss {

class SolidTangent final : public Tangent {
public:
    /// The arguments have to outlive the tangent.
    SolidTangent(const ElementForces& elements, std::span<const std::unique_ptr<ForceTerm>> terms,
                 const Interactions& interactions, const LumpedModels& models, std::span<const double> lumped_mass,
                 const Damping& damping);

    bool symmetric() const override { return symmetric_; }
    std::size_t n_nonzero() const override { return 4 * places().neighbours.size(); }
    MatrixPattern pattern() const override;
    void assemble(const State& accepted, const Trial& trial, const Factors& factors,
                  std::span<double> values) const override;
    void assemble_diagonal(const State& accepted, const Trial& trial, const Factors& factors,
                           std::span<double> diagonal) const override;
    LowRank beside(const State& accepted, const Trial& trial, const Factors& factors) const override {
        return models_.dyads(accepted, trial, factors.stiffness);
    }

private:
    /// Where everything stands in the matrix: the rows of a node one behind the other, a pair of entries per neighbour.
    struct Places {
        std::vector<std::int32_t> neighbours;         ///< nodes that a node is coupled with, itself among them
        std::vector<std::int32_t> neighbour_starts;   ///< shape (nodes + 1)
        std::vector<std::int32_t> row_pairs;          ///< pairs of entries in either row of a node: its neighbours
        std::vector<std::vector<PairNumber>> blocks;  ///< ElementBlock::MatrixPlaces::blocks of each block
        std::vector<PairNumber> diagonal;             ///< each node's own 2 x 2 block
        std::vector<std::vector<PairNumber>>
            terms;  ///< what each term couples, and each interaction and model behind them

        /// Where the 2 x 2 block of two nodes begins.
        PairNumber of(std::int32_t row_node, std::int32_t column_node) const;
    };

    void plan_chunks();
    void plan_pattern(Places& places) const;
    void plan_terms(Places& places) const;
    /// Made when they are first asked for: the diagonal alone has no use for them.
    const Places& places() const;
    /// Adds the elements' part, colour by colour.
    template <class BlockPlaces>
    void add_elements(const State& accepted, const Trial& trial, const Factors& factors, BlockPlaces block_places,
                      double* values) const;
    /// Of a term, or, behind them, of an interaction, or of a model.
    std::span<const ForceTerm::Stiffness> stiffness(std::size_t term, const State& accepted, const Trial& trial) const;
    /// Calls body(term, factor, derivatives) for what terms, interactions and models add, -factor df/d(u or v).
    template <class Body>
    void for_each_term(const State& accepted, const Trial& trial, const Factors& factors, Body body) const;

    const ElementForces& elements_;
    std::span<const std::unique_ptr<ForceTerm>> terms_;
    const Interactions& interactions_;
    const LumpedModels& models_;
    std::span<const double> mass_;
    const Damping& damping_;
    bool symmetric_;

    std::vector<PackRange> chunks_;                                    ///< by colour
    std::vector<std::size_t> colour_starts_;                           ///< in chunks_
    mutable std::vector<ForceTerm::Stiffness> term_stiffness_;         ///< scratch
    std::vector<std::vector<std::array<std::int32_t, 2>>> couplings_;  ///< of terms, of interactions, of models
    mutable std::unique_ptr<Places> places_;
};

}  // namespace gneiss
