#pragma once
// The internal forces of all element blocks, summed over threads in an order that does not depend on their number.
//
// Blocks are cut into chunks of consecutive packs. The first chunk that touches a node owns it and adds straight to the
// node's entry of a workspace; every other chunk adds to a slot of its own behind the nodes. When all chunks are done,
// the slots are added node by node in ascending order of chunk. Inside a chunk elements add in ascending order.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "model/element_block.hpp"
#include "system/semi_discrete.hpp"

namespace gneiss {

class ElementForces {
public:
    /// @param blocks  at least one; every node of the mesh belongs to an element
    ElementForces(std::vector<std::unique_ptr<ElementBlock>> blocks, const Mesh& mesh);

    std::span<const std::unique_ptr<ElementBlock>> blocks() const { return blocks_; }
    std::size_t n_internal() const { return z_offset_.back(); }
    std::size_t n_history() const { return history_offset_.back(); }
    bool viscous() const;
    std::vector<double> lumped_mass() const;
    void initial_memory(std::span<double> z, std::span<double> history) const;

    /// @param[out] f  overwritten, N, shape (2 n_nodes)
    /// @param[out] z, history  overwritten if not empty
    /// @throws RecoverableError on an inverted element
    void force(const State& accepted, const Trial& trial, std::span<double> f, std::span<double> z = {},
               std::span<double> history = {}) const;
    void internal_rate(const State& accepted, const Trial& trial, std::span<double> rate) const;

    ElementBlock::Sums energies(const State& accepted, const Trial& trial) const;
    ElementBlock::Rates largest_rates(const State& accepted) const;
    /// Where block number `block` reads its part.
    ElementBlock::Evaluation evaluation(std::size_t block, const State& accepted, const Trial& trial) const;

private:
    struct Chunk {
        std::size_t block, first, last;  ///< packs [first, last) of a block
    };

    void plan();
    void reduce(std::span<double> f) const;
    [[noreturn]] void throw_inverted(std::size_t block, std::ptrdiff_t local, const ElementBlock::Evaluation& at,
                                     double t) const;

    std::vector<std::unique_ptr<ElementBlock>> blocks_;
    std::vector<std::size_t> z_offset_{0}, history_offset_{0};
    std::vector<Chunk> chunks_;
    std::size_t n_nodes_;
    std::vector<std::int64_t> labels_;  ///< of the mesh's elements, for messages

    // nodes that more than one chunk touches, ascending, and their slots by ascending chunk
    std::vector<std::int32_t> shared_nodes_;
    std::vector<std::size_t> slot_starts_;
    std::vector<std::int32_t> slots_;

    // scratch of one evaluation at a time
    mutable std::vector<double> workspace_;  ///< nodal pairs, then slots; all zero between evaluations
    mutable std::vector<std::ptrdiff_t> inverted_;
    mutable std::vector<ElementBlock::Sums> sums_;
    mutable std::vector<ElementBlock::Rates> rates_;
};

}  // namespace gneiss
