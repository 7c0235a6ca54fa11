#pragma once
// The internal forces of all element blocks, summed over threads in an order that does not depend on their number.
//
// Blocks are cut into chunks of consecutive packs. A chunk works on copies of its nodes' displacements and forces,
// small enough for the nearest cache, and adds its elements in ascending order. A node that only one chunk touches then
// has its force; of a node that several chunks touch, each chunk leaves its part in a slot, and the slots are added in
// ascending order of chunk.
//
// A chunk whose nodes follow each other and that shares none (meshes with joints on every edge) works on them in place.
// Right before its elements their displacements are brought; right behind them come the joints inside the chunk.

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "model/element_block.hpp"
#include "model/interaction.hpp"
#include "system/semi_discrete.hpp"

namespace gneiss {

class ElementForces {
public:
    /// @param blocks  at least one; every node of the mesh belongs to an element
    /// @param mesh    has to outlive this
    ElementForces(std::vector<std::unique_ptr<ElementBlock>> blocks, const Mesh& mesh);

    std::span<const std::unique_ptr<ElementBlock>> blocks() const { return blocks_; }
    std::size_t n_internal() const { return z_offset_.back(); }
    /// The blocks' own, then what they tell of their watches.
    std::size_t n_history() const { return watch_offset_.back(); }
    /// Evaluation::beyond of a block in an accepted state; empty: it is not watched.
    std::span<const double> beyond(std::size_t block, const State& accepted) const {
        return std::span(accepted.history)
            .subspan(watch_offset_[block], watch_offset_[block + 1] - watch_offset_[block]);
    }
    /// Follows a mesh in which these elements have other nodes than before.
    void renumber(const Mesh& mesh, std::span<const std::int32_t> elements);
    bool viscous() const;
    std::vector<double> lumped_mass() const;
    void add_mass(std::int32_t element, std::span<double> mass) const;
    void point_fields(std::int32_t element, const State& state, PointFields* fields) const;
    /// Block, and number in it, of an element of the mesh.
    struct Place {
        std::int32_t block, local;
    };
    const Place& place(std::int32_t element) const { return place_[static_cast<std::size_t>(element)]; }
    int n_sub_triangles() const { return blocks_.front()->n_sub_triangles(); }
    void initial_memory(std::span<double> z, std::span<double> history) const;

    std::size_t n_chunks() const { return chunks_.size(); }
    /// The chunk that alone has a node, -1: several have it; shape (n_nodes).
    std::vector<std::int32_t> chunk_of_node() const;

    const PackRange& packs_of(std::size_t chunk) const { return chunks_[chunk]; }
    /// Of a chunk, in the order of its local numbers.
    std::span<const std::int32_t> nodes_of_chunk(std::size_t chunk) const {
        return std::span(chunk_nodes_)
            .subspan(chunks_[chunk].first_node, chunks_[chunk].last_node - chunks_[chunk].first_node);
    }
    /// An element for messages: what the mesh calls it, where it is, its region.
    std::string description(std::size_t block, std::ptrdiff_t local) const;

    /// What goes with the elements, chunk by chunk.
    struct Company {
        const Interactions* interactions = nullptr;  ///< add their forces inside a chunk behind its elements
        const Arrival* arrival = nullptr;            ///< brings the trial's displacements; null: they are there
    };
    /// @param[out] f  overwritten, N, shape (2 n_nodes)
    /// @param[out] z, history  overwritten if not empty
    /// @throws RecoverableError on an inverted element
    void force(const State& accepted, const Trial& trial, std::span<double> f, std::span<double> z = {},
               std::span<double> history = {}, const Company& company = {nullptr, nullptr}) const;
    /// What interactions add inside chunks, without the elements.
    /// @param[out] history  their part overwritten if not empty
    void add_company_force(const State& accepted, const Trial& trial, std::span<double> f, std::span<double> history,
                           const Interactions& interactions) const;
    void internal_weights(std::span<double> weights) const;
    void internal_rate(const State& accepted, const Trial& trial, std::span<double> rate) const;

    ElementBlock::Sums energies(const State& accepted, const Trial& trial) const;
    ElementBlock::Rates largest_rates(const State& accepted) const;
    /// SemiDiscrete::stiffness_bound().
    void stiffness_bound(const State& accepted, const Trial& trial, std::span<double> bound) const;
    /// Where block number `block` reads its part.
    ElementBlock::Evaluation evaluation(std::size_t block, const State& accepted, const Trial& trial) const;

private:
    struct Chunk : PackRange {
        // its nodes in chunk_nodes_: first those that no other chunk touches, then the shared ones, with slots
        std::size_t first_node = 0, first_shared = 0, last_node = 0;
        std::size_t first_slot = 0;  ///< of the shared ones, in chunk_slots_
        bool in_a_row = false;       ///< its nodes follow each other, and no other chunk touches them: needs no copies
    };

    /// The nodes of a chunk, into nodes_of_chunk_.
    void list_nodes(std::size_t chunk);
    void plan();
    /// body(number, chunk) for every chunk, in parallel.
    template <class Body>
    void for_each_chunk(Body body) const;
    std::pair<std::span<const std::int32_t>, std::span<PairBytes>> nodes_of(const Chunk& chunk);
    /// Nodal sums of what add(block, first pack, last pack, local nodes) adds.
    /// @return what add() returned first that was not ElementBlock::none
    template <class Add>
    std::ptrdiff_t chunk_sum(const Chunk& chunk, const ElementBlock::Evaluation& at, std::span<double> f,
                             Add add) const;
    void prefetch_nodes(std::size_t first, std::size_t last, const double* u, std::span<double> f) const;
    void prepare_scratch() const;
    void add_shared(std::span<double> f) const;
    [[noreturn]] void throw_inverted(std::size_t block, std::ptrdiff_t local, const ElementBlock::Evaluation& at,
                                     double t) const;

    std::vector<std::unique_ptr<ElementBlock>> blocks_;
    std::vector<std::size_t> z_offset_{0}, history_offset_{0}, watch_offset_;
    std::vector<Place> place_;  ///< of each element of the mesh
    std::vector<Chunk> chunks_;
    std::size_t n_nodes_;
    bool far_;  ///< nodal values come from beyond the second-level cache
    const Mesh& mesh_;

    std::vector<std::vector<std::int32_t>> nodes_of_chunk_;  ///< ascending
    std::vector<std::int32_t> chunk_nodes_;                  ///< of each chunk in the order of its local numbers
    std::vector<std::int32_t> chunk_slots_;                  ///< where its part of the force of its shared nodes goes
    std::size_t largest_chunk_ = 0;                          ///< nodes
    /// First and last degrees of freedom of what no chunk in a row has, in pieces for threads.
    std::vector<std::pair<std::size_t, std::size_t>> between_;

    // nodes that more than one chunk touches, ascending, and where their slots begin; by ascending chunk
    std::vector<std::int32_t> shared_nodes_;
    std::vector<std::size_t> slot_starts_;
    std::size_t n_slots_ = 0;

    // scratch of one evaluation at a time
    mutable std::vector<double> slot_forces_;           ///< pairs
    mutable std::vector<std::vector<double>> scratch_;  ///< of each thread: u, f and v of a chunk's nodes
    mutable std::vector<std::ptrdiff_t> inverted_;
    mutable std::vector<ElementBlock::Sums> sums_;
    mutable std::vector<ElementBlock::Rates> rates_;
};

}  // namespace gneiss
