#include "model/element_forces.hpp"

#include <algorithm>
#include <fmt/format.h>

#include "base/errors.hpp"
#include "base/parallel.hpp"

namespace gneiss {
namespace {

/// Sub-triangles per chunk. Large enough that few nodes are shared between chunks (about 15 %), small enough that two
/// thousand elements still occupy two threads.
constexpr std::size_t chunk_size = 1024;

}  // namespace

ElementForces::ElementForces(std::vector<std::unique_ptr<ElementBlock>> blocks, const Mesh& mesh)
    : blocks_(std::move(blocks)), n_nodes_(mesh.n_nodes()), labels_(mesh.element_labels) {
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        const ElementBlock& block = *blocks_[b];
        z_offset_.push_back(z_offset_.back() + block.n_internal());
        history_offset_.push_back(history_offset_.back() + block.n_history());
        const std::size_t step =
            chunk_size / (static_cast<std::size_t>(block.n_sub_triangles()) * pack_width);
        for (std::size_t first = 0; first < block.n_packs(); first += step)
            chunks_.push_back({b, first, std::min(first + step, block.n_packs())});
    }
    inverted_.resize(chunks_.size());
    sums_.resize(chunks_.size());
    rates_.resize(chunks_.size());
    plan();
}

void ElementForces::plan() {
    constexpr std::int32_t nobody = -1;
    std::vector<std::int32_t> owner(n_nodes_, nobody), last_visitor(n_nodes_, nobody), slot_of(n_nodes_);
    struct Share {
        std::int32_t node, slot;
    };
    std::vector<Share> shares;
    auto next_slot = static_cast<std::int32_t>(n_nodes_);
    for (std::size_t c = 0; c < chunks_.size(); ++c) {
        const auto chunk = static_cast<std::int32_t>(c);
        const std::size_t stride = static_cast<std::size_t>(blocks_[chunks_[c].block]->n_nodes()) * pack_width;
        for (std::int32_t& target : blocks_[chunks_[c].block]->targets().subspan(
                 chunks_[c].first * stride, (chunks_[c].last - chunks_[c].first) * stride)) {
            const auto node = static_cast<std::size_t>(target);
            if (owner[node] == nobody) owner[node] = chunk;
            if (owner[node] == chunk) continue;
            if (last_visitor[node] != chunk) {
                last_visitor[node] = chunk;
                slot_of[node] = next_slot;
                shares.push_back({target, next_slot++});
            }
            target = slot_of[node];
        }
    }
    std::stable_sort(shares.begin(), shares.end(), [](const Share& a, const Share& b) { return a.node < b.node; });
    for (const Share& share : shares) {
        if (shared_nodes_.empty() || shared_nodes_.back() != share.node) {
            shared_nodes_.push_back(share.node);
            slot_starts_.push_back(slots_.size());
        }
        slots_.push_back(share.slot);
    }
    slot_starts_.push_back(slots_.size());
    workspace_.assign(2 * static_cast<std::size_t>(next_slot), 0.0);
}

bool ElementForces::viscous() const {
    return std::any_of(blocks_.begin(), blocks_.end(), [](const auto& block) { return block->viscous(); });
}

std::vector<double> ElementForces::lumped_mass() const {
    std::vector<double> mass(2 * n_nodes_, 0.0);
    for (const auto& block : blocks_) block->add_mass(mass);
    return mass;
}

void ElementForces::initial_memory(std::span<double> z, std::span<double> history) const {
    for (std::size_t b = 0; b < blocks_.size(); ++b)
        blocks_[b]->initial_memory(z.data() + z_offset_[b], history.data() + history_offset_[b]);
}

ElementBlock::Evaluation ElementForces::evaluation(std::size_t block, const State& accepted, const Trial& trial) const {
    ElementBlock::Evaluation at;
    at.u = trial.u.data();
    at.v = trial.v.data();
    at.given = !trial.z.empty();
    at.z = (at.given ? trial.z.data() : accepted.z.data()) + z_offset_[block];
    at.history = accepted.history.data() + history_offset_[block];
    return at;
}

void ElementForces::force(const State& accepted, const Trial& trial, std::span<double> f, std::span<double> z,
                          std::span<double> history) const {
    const auto n_chunks = static_cast<std::ptrdiff_t>(chunks_.size());
    const auto evaluation_of = [&](std::size_t block) {
        ElementBlock::Evaluation at = evaluation(block, accepted, trial);
        if (!z.empty() || !history.empty()) {
            at.z_updated = z.data() + z_offset_[block];
            at.history_updated = history.data() + history_offset_[block];
        }
        return at;
    };
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t c = 0; c < n_chunks; ++c) {
        const Chunk& chunk = chunks_[static_cast<std::size_t>(c)];
        inverted_[static_cast<std::size_t>(c)] = blocks_[chunk.block]->add_force(
            chunk.first, chunk.last, evaluation_of(chunk.block), workspace_.data());
    }
    for (std::size_t c = 0; c < chunks_.size(); ++c) {
        if (inverted_[c] == ElementBlock::none) continue;
        std::fill(workspace_.begin(), workspace_.end(), 0.0);
        throw_inverted(chunks_[c].block, inverted_[c], evaluation_of(chunks_[c].block), trial.t);
    }
    reduce(f);
}

void ElementForces::reduce(std::span<double> f) const {
    parallel_ranges(n_nodes_, [&](std::size_t first, std::size_t last) {
        double* nodal = workspace_.data();
        std::copy(nodal + 2 * first, nodal + 2 * last, f.data() + 2 * first);
        std::fill(nodal + 2 * first, nodal + 2 * last, 0.0);
        auto shared = std::lower_bound(shared_nodes_.begin(), shared_nodes_.end(), static_cast<std::int32_t>(first));
        for (; shared != shared_nodes_.end() && *shared < static_cast<std::int32_t>(last); ++shared) {
            const auto k = static_cast<std::size_t>(shared - shared_nodes_.begin());
            double* sum = f.data() + 2 * *shared;
            for (std::size_t i = slot_starts_[k]; i < slot_starts_[k + 1]; ++i) {
                double* slot = nodal + 2 * static_cast<std::size_t>(slots_[i]);
                sum[0] += slot[0];
                sum[1] += slot[1];
                slot[0] = slot[1] = 0.0;
            }
        }
    });
}

void ElementForces::throw_inverted(std::size_t block, std::ptrdiff_t local, const ElementBlock::Evaluation& at,
                                   double t) const {
    const auto which = static_cast<std::size_t>(local);
    throw RecoverableError(fmt::format("element {} is inverted at t = {:.9g} s: {}", 
                                       labels_[static_cast<std::size_t>(blocks_[block]->element(which))], t, blocks_[block]->describe_inversion(which, at)));
}

void ElementForces::internal_rate(const State& accepted, const Trial& trial, std::span<double> rate) const {
    const auto n_chunks = static_cast<std::ptrdiff_t>(chunks_.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t c = 0; c < n_chunks; ++c) {
        const Chunk& chunk = chunks_[static_cast<std::size_t>(c)];
        blocks_[chunk.block]->internal_rate(chunk.first, chunk.last, evaluation(chunk.block, accepted, trial),
                                            rate.data() + z_offset_[chunk.block]);
    }
}

ElementBlock::Sums ElementForces::energies(const State& accepted, const Trial& trial) const {
    const auto n_chunks = static_cast<std::ptrdiff_t>(chunks_.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t c = 0; c < n_chunks; ++c) {
        const Chunk& chunk = chunks_[static_cast<std::size_t>(c)];
        sums_[static_cast<std::size_t>(c)] =
            blocks_[chunk.block]->energies(chunk.first, chunk.last, evaluation(chunk.block, accepted, trial));
    }
    ElementBlock::Sums total;
    for (const auto& sums : sums_) {
        total.stored += sums.stored;
        total.stress_power += sums.stress_power;
        total.viscous_power += sums.viscous_power;
    }
    return total;
}

ElementBlock::Rates ElementForces::largest_rates(const State& accepted) const {
    const auto n_chunks = static_cast<std::ptrdiff_t>(chunks_.size());
    const Trial at_rest = Trial::of(accepted);
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t c = 0; c < n_chunks; ++c) {
        const Chunk& chunk = chunks_[static_cast<std::size_t>(c)];
        rates_[static_cast<std::size_t>(c)] =
            blocks_[chunk.block]->largest_rates(chunk.first, chunk.last, evaluation(chunk.block, accepted, at_rest));
    }
    ElementBlock::Rates largest;
    for (const auto& rates : rates_) {
        largest.omega_squared = std::max(largest.omega_squared, rates.omega_squared);
        largest.damping = std::max(largest.damping, rates.damping);
    }
    return largest;
}

}  // namespace gneiss
