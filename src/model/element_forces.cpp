#include "model/element_forces.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <algorithm>
#include <stdexcept>

#include "base/errors.hpp"
#include "base/parallel.hpp"
#include "base/prefetch.hpp"

namespace gneiss {
namespace {

/// Sub-triangles per chunk. Large enough that few nodes are shared between chunks (about 15 %), small enough that its
/// nodes stay in the nearest cache and that two thousand elements still occupy two threads.
constexpr std::size_t chunk_size = 1024;

/// Nodes whose displacements and forces no longer fit a second-level cache of 1 MiB. Below, asking for them ahead costs
/// 3 % of a step; far above it saves 10 %.
constexpr std::size_t many_nodes = (1 << 20) / (2 * bytes_per_pair);

}  // namespace

ElementForces::ElementForces(std::vector<std::unique_ptr<ElementBlock>> blocks, const Mesh& mesh)
    : blocks_(std::move(blocks)),
      place_(mesh.n_elements()),
      n_nodes_(mesh.n_nodes()),
      far_(mesh.n_nodes() > many_nodes),
      mesh_(mesh) {
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        const ElementBlock& block = *blocks_[b];
        z_offset_.push_back(z_offset_.back() + block.n_internal());
        history_offset_.push_back(history_offset_.back() + block.n_history());
        for (std::size_t local = 0; local < block.n_elements(); ++local)
            place_[static_cast<std::size_t>(block.element(local))] = {static_cast<std::int32_t>(b),
                                                                      static_cast<std::int32_t>(local)};
    }
    watch_offset_.push_back(history_offset_.back());
    for (const auto& block : blocks_)
        watch_offset_.push_back(watch_offset_.back() + (block->watched() ? block->n_packs() : 0));
    for (const PackRange& range : pack_ranges(blocks_, chunk_size)) chunks_.push_back({range});
    inverted_.resize(chunks_.size());
    sums_.resize(chunks_.size());
    rates_.resize(chunks_.size());
    nodes_of_chunk_.resize(chunks_.size());
    for (std::size_t c = 0; c < chunks_.size(); ++c) list_nodes(c);
    plan();
}

auto ElementForces::nodes_of(const Chunk& chunk) -> std::pair<std::span<const std::int32_t>, std::span<PairBytes>> {
    ElementBlock& block = *blocks_[chunk.block];
    const std::size_t stride = static_cast<std::size_t>(block.n_nodes()) * pack_width;
    const std::size_t first = chunk.first * stride, count = (chunk.last - chunk.first) * stride;
    return {block.nodes().subspan(first, count), block.local_nodes().subspan(first, count)};
}

void ElementForces::renumber(const Mesh& mesh, std::span<const std::int32_t> elements) {
    std::vector<std::vector<std::int32_t>> locals(blocks_.size());
    for (const std::int32_t e : elements) {
        const Place& place = place_[static_cast<std::size_t>(e)];
        locals[static_cast<std::size_t>(place.block)].push_back(place.local);
    }
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        blocks_[b]->renumber(mesh, locals[b]);
        std::ranges::sort(locals[b]);
    }
    n_nodes_ = mesh.n_nodes();
    for (std::size_t c = 0; c < chunks_.size(); ++c) {
        const auto& changed = locals[chunks_[c].block];
        const auto first = std::ranges::lower_bound(changed, static_cast<std::int32_t>(chunks_[c].first * pack_width));
        // the lanes behind the last element repeat it, and stand in its chunk
        if (first != changed.end() && static_cast<std::size_t>(*first) < chunks_[c].last * pack_width) list_nodes(c);
    }
    plan();
}

void ElementForces::list_nodes(std::size_t c) {
    const auto nodes = nodes_of(chunks_[c]).first;
    std::vector<std::int32_t>& own = nodes_of_chunk_[c];
    own.assign(nodes.begin(), nodes.end());
    std::ranges::sort(own);
    own.erase(std::unique(own.begin(), own.end()), own.end());
}

void ElementForces::plan() {
    chunk_nodes_.clear();
    chunk_slots_.clear();
    shared_nodes_.clear();
    slot_starts_.clear();
    largest_chunk_ = n_slots_ = 0;
    std::vector<std::int32_t> local(n_nodes_), touched(n_nodes_, 0);
    for (std::size_t c = 0; c < chunks_.size(); ++c) {
        const std::vector<std::int32_t>& own = nodes_of_chunk_[c];
        chunks_[c].first_node = chunk_nodes_.size();
        chunk_nodes_.insert(chunk_nodes_.end(), own.begin(), own.end());
        chunks_[c].last_node = chunk_nodes_.size();
        largest_chunk_ = std::max(largest_chunk_, own.size());
        for (const std::int32_t node : own) ++touched[static_cast<std::size_t>(node)];
    }
    if (largest_chunk_ * bytes_per_pair > std::size_t{1} << 16)
        throw std::logic_error("a chunk has more nodes than 16-bit offsets reach: make chunk_size smaller");
    for (Chunk& chunk : chunks_) {
        const auto begin = chunk_nodes_.begin();
        const auto first = begin + static_cast<std::ptrdiff_t>(chunk.first_node);
        const auto last = begin + static_cast<std::ptrdiff_t>(chunk.last_node);
        const auto first_shared = std::stable_partition(
            first, last, [&](std::int32_t node) { return touched[static_cast<std::size_t>(node)] == 1; });
        chunk.first_shared = static_cast<std::size_t>(first_shared - begin);
        for (auto node = first; node != last; ++node)
            local[static_cast<std::size_t>(*node)] = static_cast<std::int32_t>((node - first) * bytes_per_pair);
        chunk.in_a_row = first_shared == last && *(last - 1) - *first + 1 == last - first;
        const auto [nodes, local_nodes] = nodes_of(chunk);
        for (std::size_t i = 0; i < nodes.size(); ++i)
            local_nodes[i].value = static_cast<std::uint16_t>(local[static_cast<std::size_t>(nodes[i])]);
    }

    between_.clear();
    const auto add_between = [&](std::size_t first, std::size_t last) {
        for (; first < last; first += parallel_range)
            between_.emplace_back(first, std::min<std::size_t>(first + parallel_range, last));
    };
    std::vector<std::pair<std::size_t, std::size_t>> rows;  // degrees of freedom of chunks in a row
    for (const Chunk& chunk : chunks_)
        if (chunk.in_a_row) {
            const auto first = static_cast<std::size_t>(chunk_nodes_[chunk.first_node]);
            rows.emplace_back(2 * first, 2 * (first + chunk.last_node - chunk.first_node));
        }
    std::ranges::sort(rows);
    std::size_t behind = 0;
    for (const auto& [first, last] : rows) {
        add_between(behind, first);
        behind = last;
    }
    add_between(behind, 2 * n_nodes_);

    // slots of shared nodes: by node, and for one node by chunk, which is the order of chunk_nodes_
    std::vector<std::size_t> next(n_nodes_, 0);
    for (std::size_t node = 0; node < n_nodes_; ++node) {
        if (touched[node] < 2) continue;
        shared_nodes_.push_back(static_cast<std::int32_t>(node));
        slot_starts_.push_back(n_slots_);
        next[node] = n_slots_;
        n_slots_ += static_cast<std::size_t>(touched[node]);
    }
    slot_starts_.push_back(n_slots_);
    for (Chunk& chunk : chunks_) {
        chunk.first_slot = chunk_slots_.size();
        for (std::size_t i = chunk.first_shared; i < chunk.last_node; ++i)
            chunk_slots_.push_back(static_cast<std::int32_t>(next[static_cast<std::size_t>(chunk_nodes_[i])]++));
    }
    slot_forces_.assign(2 * n_slots_, 0.0);
}

bool ElementForces::viscous() const {
    return std::any_of(blocks_.begin(), blocks_.end(), [](const auto& block) { return block->viscous(); });
}

std::vector<double> ElementForces::lumped_mass() const {
    std::vector<double> mass(2 * n_nodes_, 0.0);
    for (const auto& block : blocks_)
        for (std::size_t local = 0; local < block->n_elements(); ++local) block->add_mass(local, mass);
    return mass;
}

void ElementForces::add_mass(std::int32_t element, std::span<double> mass) const {
    const Place& place = place_[static_cast<std::size_t>(element)];
    blocks_[static_cast<std::size_t>(place.block)]->add_mass(static_cast<std::size_t>(place.local), mass);
}

void ElementForces::point_fields(std::int32_t element, const State& state, PointFields* fields) const {
    const Place& place = place_[static_cast<std::size_t>(element)];
    const auto block = static_cast<std::size_t>(place.block);
    blocks_[block]->point_fields(static_cast<std::size_t>(place.local), evaluation(block, state, Trial::of(state)),
                                 fields);
}

void ElementForces::initial_memory(std::span<double> z, std::span<double> history) const {
    for (std::size_t b = 0; b < blocks_.size(); ++b)
        blocks_[b]->initial_memory(z.data() + z_offset_[b], history.data() + history_offset_[b]);
}

void ElementForces::internal_weights(std::span<double> weights) const {
    for (std::size_t b = 0; b < blocks_.size(); ++b) blocks_[b]->internal_weights(weights.data() + z_offset_[b]);
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

template <class Body>
void ElementForces::for_each_chunk(Body body) const {
    const auto n_chunks = static_cast<std::ptrdiff_t>(chunks_.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t c = 0; c < n_chunks; ++c) {
        const auto number = static_cast<std::size_t>(c);
        body(number, chunks_[number]);
    }
}

std::vector<std::int32_t> ElementForces::chunk_of_node() const {
    std::vector<std::int32_t> chunk_of(n_nodes_, -1);
    for (std::size_t c = 0; c < chunks_.size(); ++c)
        for (std::size_t i = chunks_[c].first_node; i < chunks_[c].first_shared; ++i)
            chunk_of[static_cast<std::size_t>(chunk_nodes_[i])] = static_cast<std::int32_t>(c);
    return chunk_of;
}

void ElementForces::force(const State& accepted, const Trial& trial, std::span<double> f, std::span<double> z,
                          std::span<double> history, const Company& company) const {
    const Arrival* arrival = company.arrival;
    const auto evaluation_of = [&](std::size_t block) {
        ElementBlock::Evaluation at = evaluation(block, accepted, trial);
        if (!z.empty() || !history.empty()) {
            at.z_updated = z.data() + z_offset_[block];
            at.history_updated = history.data() + history_offset_[block];
            if (blocks_[block]->watched()) at.beyond = history.data() + watch_offset_[block];
        }
        return at;
    };
    prepare_scratch();
    if (arrival != nullptr) {
        const auto n = static_cast<std::ptrdiff_t>(between_.size());
#pragma omp parallel for schedule(static) if (n > 1)
        for (std::ptrdiff_t i = 0; i < n; ++i)
            arrival->bring(between_[static_cast<std::size_t>(i)].first, between_[static_cast<std::size_t>(i)].second);
    }
    for_each_chunk([&](std::size_t c, const Chunk& chunk) {
        if (arrival != nullptr && chunk.in_a_row) {
            const auto first = static_cast<std::size_t>(chunk_nodes_[chunk.first_node]);
            arrival->bring(2 * first, 2 * (first + chunk.last_node - chunk.first_node));
        }
        const ElementBlock::Evaluation at = evaluation_of(chunk.block);
        inverted_[c] =
            chunk_sum(chunk, at, f,
                      [&](const ElementBlock& block, std::size_t first, std::size_t last,
                          const ElementBlock::LocalNodes& local) { return block.add_force(first, last, at, local); });
        if (company.interactions != nullptr) company.interactions->add_chunk_force(c, accepted, trial, f, history);
    });
    for (std::size_t c = 0; c < chunks_.size(); ++c)
        if (inverted_[c] != ElementBlock::none)
            throw_inverted(chunks_[c].block, inverted_[c], evaluation_of(chunks_[c].block), trial.t);
    add_shared(f);
}

void ElementForces::add_company_force(const State& accepted, const Trial& trial, std::span<double> f,
                                      std::span<double> history, const Interactions& interactions) const {
    for_each_chunk([&](std::size_t c, const Chunk&) { interactions.add_chunk_force(c, accepted, trial, f, history); });
}

void ElementForces::prepare_scratch() const {
    const auto n_threads = static_cast<std::size_t>(omp_get_max_threads());
    if (scratch_.size() < n_threads) scratch_.resize(n_threads);
    for (std::vector<double>& scratch : scratch_) scratch.resize(6 * largest_chunk_);
}

void ElementForces::stiffness_bound(const State& accepted, const Trial& trial, std::span<double> bound) const {
    prepare_scratch();
    for_each_chunk([&](std::size_t, const Chunk& chunk) {
        const ElementBlock::Evaluation at = evaluation(chunk.block, accepted, trial);
        chunk_sum(
            chunk, at, bound,
            [&](const ElementBlock& block, std::size_t first, std::size_t last, const ElementBlock::LocalNodes& local) {
                block.add_row_sums(first, last, at, local);
                return ElementBlock::none;
            });
    });
    add_shared(bound);
}

template <class Add>
std::ptrdiff_t ElementForces::chunk_sum(const Chunk& chunk, const ElementBlock::Evaluation& at, std::span<double> f,
                                        Add add) const {
    const ElementBlock& block = *blocks_[chunk.block];
    const std::size_t n = chunk.last_node - chunk.first_node;
    const std::int32_t* nodes = chunk_nodes_.data() + chunk.first_node;
    ElementBlock::LocalNodes local;
    if (chunk.in_a_row) {
        const auto first = 2 * static_cast<std::size_t>(*nodes);
        local = {at.u + first, at.v == nullptr ? nullptr : at.v + first, f.data() + first};
    } else {
        double* scratch = scratch_[static_cast<std::size_t>(omp_get_thread_num())].data();
        const auto gather = [&](const double* from, double* to) {
            for (std::size_t i = 0; i < n; ++i) {
                to[2 * i] = from[2 * nodes[i]];
                to[2 * i + 1] = from[2 * nodes[i] + 1];
            }
        };
        local = {scratch, scratch + 4 * n, scratch + 2 * n};
        gather(at.u, scratch);
        if (block.viscous()) gather(at.v, scratch + 4 * n);
    }
    std::fill(local.f, local.f + 2 * n, 0.0);
    std::ptrdiff_t inverted = ElementBlock::none;
    constexpr std::size_t n_pieces = 16;
    const std::size_t piece = (chunk.last - chunk.first + n_pieces - 1) / n_pieces;
    for (std::size_t i = 0, pack = chunk.first; pack < chunk.last && inverted == ElementBlock::none;
         ++i, pack += piece) {
        // meanwhile the nodes of the next chunk, about as many as this one has, come to a nearer cache
        if (far_) prefetch_nodes(chunk.last_node + n * i / n_pieces, chunk.last_node + n * (i + 1) / n_pieces, at.u, f);
        inverted = add(block, pack, std::min(pack + piece, chunk.last), local);
    }
    if (chunk.in_a_row) return inverted;
    const std::size_t n_own = chunk.first_shared - chunk.first_node;
    const auto scatter = [](const double* from, const std::int32_t* where, std::size_t count, double* to) {
        for (std::size_t i = 0; i < count; ++i) {
            to[2 * where[i]] = from[2 * i];
            to[2 * where[i] + 1] = from[2 * i + 1];
        }
    };
    scatter(local.f, nodes, n_own, f.data());
    scatter(local.f + 2 * n_own, chunk_slots_.data() + chunk.first_slot, n - n_own, slot_forces_.data());
    return inverted;
}

void ElementForces::prefetch_nodes(std::size_t first, std::size_t last, const double* u, std::span<double> f) const {
    constexpr std::size_t pairs_per_line = 4;  // most nodes of a chunk follow each other
    for (std::size_t i = first; i < std::min(last, chunk_nodes_.size()); i += pairs_per_line) {
        prefetch(u + 2 * chunk_nodes_[i]);
        prefetch<Access::write>(f.data() + 2 * chunk_nodes_[i]);
    }
}

void ElementForces::add_shared(std::span<double> f) const {
    parallel_ranges(shared_nodes_.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) {
            double x = 0, y = 0;
            for (std::size_t slot = slot_starts_[k]; slot < slot_starts_[k + 1]; ++slot) {
                x += slot_forces_[2 * slot];
                y += slot_forces_[2 * slot + 1];
            }
            f[2 * static_cast<std::size_t>(shared_nodes_[k])] = x;
            f[2 * static_cast<std::size_t>(shared_nodes_[k]) + 1] = y;
        }
    });
}

std::string ElementForces::description(std::size_t block, std::ptrdiff_t local) const {
    const auto e = static_cast<std::size_t>(blocks_[block]->element(static_cast<std::size_t>(local)));
    Vec2<double> centre{0, 0};
    for (int corner = 0; corner < 3; ++corner) {
        const int node = corner * mesh_.nodes_per_element() / 3;  // every second one of a composite
        const auto [x, y] = mesh_.nodes[static_cast<std::size_t>(mesh_.element(e)[node])];
        centre += Vec2<double>{x / 3, y / 3};
    }
    return fmt::format("element {} at ({:.4g}, {:.4g}) m of region `{}`", mesh_.element_labels[e], centre.x, centre.y,
                       mesh_.region_names[static_cast<std::size_t>(mesh_.region[e])]);
}

void ElementForces::throw_inverted(std::size_t block, std::ptrdiff_t local, const ElementBlock::Evaluation& at,
                                   double t) const {
    const auto which = static_cast<std::size_t>(local);
    throw RecoverableError(fmt::format("{} is inverted at t = {:.9g} s: {}", description(block, local), t,
                                       blocks_[block]->describe_inversion(which, at)));
}

void ElementForces::internal_rate(const State& accepted, const Trial& trial, std::span<double> rate) const {
    for_each_chunk([&](std::size_t, const Chunk& chunk) {
        blocks_[chunk.block]->internal_rate(chunk.first, chunk.last, evaluation(chunk.block, accepted, trial),
                                            rate.data() + z_offset_[chunk.block]);
    });
}

ElementBlock::Sums ElementForces::energies(const State& accepted, const Trial& trial) const {
    for_each_chunk([&](std::size_t c, const Chunk& chunk) {
        sums_[c] = blocks_[chunk.block]->energies(chunk.first, chunk.last, evaluation(chunk.block, accepted, trial));
    });
    ElementBlock::Sums total;
    for (const auto& sums : sums_) {
        total.stored += sums.stored;
        total.stress_power += sums.stress_power;
        total.viscous_power += sums.viscous_power;
    }
    return total;
}

ElementBlock::Rates ElementForces::largest_rates(const State& accepted) const {
    const Trial at_rest = Trial::of(accepted);
    for_each_chunk([&](std::size_t c, const Chunk& chunk) {
        rates_[c] =
            blocks_[chunk.block]->largest_rates(chunk.first, chunk.last, evaluation(chunk.block, accepted, at_rest));
    });
    ElementBlock::Rates largest;
    for (const auto& rates : rates_) {
        largest.omega_squared = std::max(largest.omega_squared, rates.omega_squared);
        largest.damping = std::max(largest.damping, rates.damping);
    }
    return largest;
}

}  // namespace gneiss
