#pragma once
// The elements of a solid in levels, pack by pack: a pack stands the step of its stiffest element.
//
// Levels are chosen once, in the state at t = 0, such that the shortest step is 2^-finest of the longest one. A layer
// of packs around a level takes its steps too, and packs that share a node are at most one level apart: without that
// local steps are unstable beside large elements that are near their own limit (docs/decisions/022). What deformation
// does to frequencies is for bound() to tell.
//
// A level works in the chunks of ElementForces, with the local numbers of their nodes, but gathers and scatters only
// the nodes of its own packs. Sums over chunks have the same bits for any number of threads, as there.

#include <memory>
#include <span>
#include <vector>

#include "model/element_forces.hpp"
#include "system/levels.hpp"
#include "system/semi_discrete.hpp"

namespace gneiss {

class ElementLevels final : public Levels {
public:
    /// @param most  levels, >= 1
    /// @return null if local steps would save nothing worth having
    static std::unique_ptr<ElementLevels> make(const ElementForces& elements, const State& initial, int most);

    int finest() const override { return static_cast<int>(levels_.size()); }
    std::size_t n_elements(int level) const override { return n_elements_[static_cast<std::size_t>(level)]; }
    std::span<const std::int32_t> nodes(int level) const override { return of(level).nodes; }
    void force(int level, const State& accepted, const Trial& trial, std::span<const double> u,
               std::span<double> f) const override;
    FrequencyBound bound(const State& accepted) const override;

private:
    ElementLevels(const ElementForces& elements, const std::vector<std::vector<int>>& level_of_pack, int finest);

    /// A node of a piece.
    struct PieceNode {
        std::int32_t local;     ///< number in the chunk
        std::int32_t position;  ///< in nodes(level)
        std::int32_t slot;      ///< of the piece's part of its force; -1: no other piece has it
    };
    /// What a chunk has of a level.
    struct Piece {
        std::size_t block, n_chunk_nodes;
        std::size_t first_run, last_run, first_node, last_node;
    };
    struct Level {
        std::vector<std::int32_t> nodes;
        std::vector<Piece> pieces;
        std::vector<PackRange> runs;  ///< of packs
        std::vector<PieceNode> piece_nodes;
        // nodes that several pieces have, and where their slots begin; by ascending piece
        std::vector<std::int32_t> shared;
        std::vector<std::size_t> slot_starts;
    };
    const Level& of(int level) const { return levels_[static_cast<std::size_t>(level - 1)]; }
    void add_level(int level, const std::vector<std::vector<int>>& level_of_pack);
    void share_nodes(Level& level);
    /// Of one piece, with its forces left in f and slots.
    std::ptrdiff_t add_piece(const Level& level, const Piece& piece, const ElementBlock::Evaluation& at,
                             std::span<const double> u, std::span<double> f, double* scratch) const;

    const ElementForces& elements_;
    std::vector<Level> levels_;  ///< 1 to finest()
    std::vector<std::size_t> n_elements_;
    /// All packs in runs of one level, and that level.
    struct Run {
        PackRange packs;
        int level;
    };
    std::vector<Run> runs_;

    // scratch of one evaluation at a time
    mutable std::vector<double> slot_forces_;
    mutable std::vector<std::vector<double>> scratch_;  ///< of each thread: u, f and v of a chunk's nodes
    mutable std::vector<std::ptrdiff_t> inverted_;
    mutable std::vector<ElementBlock::Rates> rates_;
};

}  // namespace gneiss
