#include "model/solid_tangent.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "base/parallel.hpp"

namespace gneiss {
namespace {

/// Sub-triangles per chunk: a few chunks of each colour even in small solids.
constexpr std::size_t chunk_size = 512;

/// Where item k of n of an element stands in an array of shape (packs, n, pack_width).
std::size_t lane_of(std::uint32_t n, std::uint32_t local, std::uint32_t k) {
    return (local / pack_width * n + k) * pack_width + local % pack_width;
}

}  // namespace

SolidTangent::SolidTangent(const ElementForces& elements, std::span<const std::unique_ptr<ForceTerm>> terms,
                           const Interactions& interactions, const LumpedModels& models,
                           std::span<const double> lumped_mass, const Damping& damping)
    : elements_(elements),
      terms_(terms),
      interactions_(interactions),
      models_(models),
      mass_(lumped_mass),
      damping_(damping) {
    symmetric_ = std::ranges::all_of(elements.blocks(), [](const auto& block) { return block->symmetric_tangent(); });
    for (const auto& term : terms) {
        couplings_.push_back(term->couplings());
        symmetric_ = symmetric_ && couplings_.back().empty();
    }
    for (std::size_t i = 0; i < interactions_.size(); ++i) {
        couplings_.push_back(interactions_[i].couplings());
        symmetric_ = symmetric_ && interactions_[i].symmetric();
    }
    for (std::size_t i = 0; i < models_.size(); ++i) couplings_.push_back(models_[i].couplings());
    std::size_t most = 0;
    for (const auto& pairs : couplings_) most = std::max(most, pairs.size());
    term_stiffness_.resize(most);
    plan_chunks();
}

const SolidTangent::Places& SolidTangent::places() const {
    if (!places_) {
        auto places = std::make_unique<Places>();
        plan_pattern(*places);
        plan_terms(*places);
        places_ = std::move(places);
    }
    return *places_;
}

void SolidTangent::plan_pattern(Places& places) const {
    const std::size_t n_nodes = mass_.size() / 2;
    // the elements at each node
    struct Corner {
        std::uint32_t block, local, node;  ///< which block, element of the block, and node of the element
    };
    std::vector<std::size_t> corner_starts(n_nodes + 1, 0);
    const auto for_each_corner = [&](auto visit) {
        for (std::uint32_t b = 0; b < elements_.blocks().size(); ++b) {
            const ElementBlock& block = *elements_.blocks()[b];
            const auto n = static_cast<std::uint32_t>(block.n_nodes());
            for (std::uint32_t local = 0; local < block.n_elements(); ++local)
                for (std::uint32_t k = 0; k < n; ++k)
                    visit(static_cast<std::size_t>(block.nodes()[lane_of(n, local, k)]), Corner{b, local, k});
        }
    };
    for_each_corner([&](std::size_t node, const Corner&) { ++corner_starts[node + 1]; });
    std::partial_sum(corner_starts.begin(), corner_starts.end(), corner_starts.begin());
    std::vector<Corner> corners(corner_starts.back());
    std::vector<std::size_t> next(corner_starts.begin(), corner_starts.end() - 1);
    for_each_corner([&](std::size_t node, const Corner& corner) { corners[next[node]++] = corner; });

    for (const auto& block : elements_.blocks()) {
        const auto n = static_cast<std::size_t>(block->n_nodes());
        places.blocks.emplace_back(block->n_packs() * n * n * pack_width);
    }
    // pairs of nodes that share no element, in both directions: the pattern is symmetric
    std::vector<std::array<std::int32_t, 2>> across;
    for (std::size_t term = terms_.size(); term < couplings_.size(); ++term)
        for (const auto& [a, b] : couplings_[term]) {
            across.push_back({a, b});
            across.push_back({b, a});
        }
    std::sort(across.begin(), across.end());
    auto next_across = across.cbegin();

    constexpr std::int32_t none = -1;
    std::vector<std::int32_t> seen_by(n_nodes, none), place_of(n_nodes);  // of the row at hand
    places.neighbour_starts.reserve(n_nodes + 1);
    places.neighbour_starts.push_back(0);
    places.row_pairs.reserve(n_nodes);
    for (std::int32_t node = 0; node < static_cast<std::int32_t>(n_nodes); ++node) {
        const auto for_each_other = [&](auto visit) {
            const auto at = static_cast<std::size_t>(node);
            for (std::size_t c = corner_starts[at]; c < corner_starts[at + 1]; ++c) {
                const ElementBlock& block = *elements_.blocks()[corners[c].block];
                const auto n = static_cast<std::uint32_t>(block.n_nodes());
                for (std::uint32_t k = 0; k < n; ++k)
                    visit(corners[c], n, k, block.nodes()[lane_of(n, corners[c].local, k)]);
            }
        };
        const std::size_t first = places.neighbours.size();
        for_each_other([&](const Corner&, std::uint32_t, std::uint32_t, std::int32_t other) {
            if (std::exchange(seen_by[static_cast<std::size_t>(other)], node) != node)
                places.neighbours.push_back(other);
        });
        for (; next_across != across.cend() && (*next_across)[0] == node; ++next_across)
            if (const std::int32_t other = (*next_across)[1];
                std::exchange(seen_by[static_cast<std::size_t>(other)], node) != node)
                places.neighbours.push_back(other);
        if (places.neighbours.size() > std::numeric_limits<std::int32_t>::max() / 2)
            throw std::length_error("a tangent of more than 2^32 entries");
        std::sort(places.neighbours.begin() + static_cast<std::ptrdiff_t>(first), places.neighbours.end());
        for (std::size_t i = first; i < places.neighbours.size(); ++i)
            place_of[static_cast<std::size_t>(places.neighbours[i])] = static_cast<std::int32_t>(first + i);
        for_each_other([&](const Corner& corner, std::uint32_t n, std::uint32_t k, std::int32_t other) {
            places.blocks[corner.block][lane_of(n * n, corner.local, corner.node * n + k)].value =
                place_of[static_cast<std::size_t>(other)];
        });
        places.neighbour_starts.push_back(static_cast<std::int32_t>(places.neighbours.size()));
        places.row_pairs.push_back(static_cast<std::int32_t>(places.neighbours.size() - first));
    }
    places.neighbours.shrink_to_fit();
    // lanes behind the last element repeat it
    for (std::size_t b = 0; b < places.blocks.size(); ++b) {
        const ElementBlock& block = *elements_.blocks()[b];
        const auto n = static_cast<std::uint32_t>(block.n_nodes() * block.n_nodes());
        const auto last = static_cast<std::uint32_t>(block.n_elements() - 1);
        for (std::uint32_t lane = last + 1; lane < block.n_packs() * pack_width; ++lane)
            for (std::uint32_t k = 0; k < n; ++k)
                places.blocks[b][lane_of(n, lane, k)] = places.blocks[b][lane_of(n, last, k)];
    }
}

MatrixPattern SolidTangent::pattern() const {
    const Places& at = places();
    MatrixPattern pattern;
    pattern.row_starts.reserve(2 * at.row_pairs.size() + 1);
    pattern.columns.reserve(n_nonzero());
    pattern.row_starts.push_back(0);
    for (std::size_t node = 0; node < at.row_pairs.size(); ++node) {
        for (int row = 0; row < 2; ++row) {
            for (std::int32_t k = at.neighbour_starts[node]; k < at.neighbour_starts[node + 1]; ++k)
                for (int component = 0; component < 2; ++component)
                    pattern.columns.push_back(std::int64_t{2} * at.neighbours[static_cast<std::size_t>(k)] + component);
            pattern.row_starts.push_back(static_cast<std::int64_t>(pattern.columns.size()));
        }
    }
    return pattern;
}

void SolidTangent::plan_chunks() {
    const std::vector<PackRange> chunks = pack_ranges(elements_.blocks(), chunk_size);
    // the lowest colour that no neighbour has
    std::vector<std::uint64_t> colours_at(mass_.size() / 2, 0);  // bits, of each node
    std::vector<int> colour_of;
    for (const PackRange& chunk : chunks) {
        const auto nodes = elements_.blocks()[chunk.block]->nodes_of_packs(chunk.first, chunk.last);
        std::uint64_t taken = 0;
        for (const std::int32_t node : nodes) taken |= colours_at[static_cast<std::size_t>(node)];
        const int colour = std::countr_one(taken);
        if (colour == 64) throw std::logic_error("chunks of elements need more than 64 colours");
        for (const std::int32_t node : nodes) colours_at[static_cast<std::size_t>(node)] |= std::uint64_t{1} << colour;
        colour_of.push_back(colour);
    }
    const int n_colours = chunks.empty() ? 0 : *std::ranges::max_element(colour_of) + 1;
    colour_starts_.assign(1, 0);
    for (int colour = 0; colour < n_colours; ++colour) {
        for (std::size_t c = 0; c < chunks.size(); ++c)
            if (colour_of[c] == colour) chunks_.push_back(chunks[c]);
        colour_starts_.push_back(chunks_.size());
    }
}

PairNumber SolidTangent::Places::of(std::int32_t row_node, std::int32_t column_node) const {
    const auto row = static_cast<std::size_t>(row_node);
    const auto begin = neighbours.begin(), first = begin + neighbour_starts[row],
               last = begin + neighbour_starts[row + 1];
    const auto found = std::lower_bound(first, last, column_node);
    if (found == last || *found != column_node)
        throw std::logic_error("a load couples two nodes that share no element");
    return {neighbour_starts[row] + static_cast<std::int32_t>(found - begin)};
}

void SolidTangent::plan_terms(Places& places) const {
    places.diagonal.reserve(places.row_pairs.size());
    for (std::int32_t node = 0; node < static_cast<std::int32_t>(places.row_pairs.size()); ++node)
        places.diagonal.push_back(places.of(node, node));
    for (const auto& pairs : couplings_) {
        std::vector<PairNumber>& term = places.terms.emplace_back();
        for (const auto& [a, b] : pairs) term.push_back(places.of(a, b));
    }
}

template <class BlockPlaces>
void SolidTangent::add_elements(const State& accepted, const Trial& trial, const Factors& factors,
                                BlockPlaces block_places, double* values) const {
    if (factors.stiffness == 0 && factors.velocity == 0) return;
    for (std::size_t colour = 0; colour + 1 < colour_starts_.size(); ++colour) {
        const auto first = static_cast<std::ptrdiff_t>(colour_starts_[colour]);
        const auto last = static_cast<std::ptrdiff_t>(colour_starts_[colour + 1]);
#pragma omp parallel for schedule(static)
        for (std::ptrdiff_t c = first; c < last; ++c) {
            const PackRange& chunk = chunks_[static_cast<std::size_t>(c)];
            elements_.blocks()[chunk.block]->add_tangent(
                chunk.first, chunk.last, elements_.evaluation(chunk.block, accepted, trial), -factors.stiffness,
                -factors.velocity, block_places(chunk.block), values);
        }
    }
}

std::span<const ForceTerm::Stiffness> SolidTangent::stiffness(std::size_t term, const State& accepted,
                                                              const Trial& trial) const {
    const std::span stiffness(term_stiffness_.data(), couplings_[term].size());
    if (term < terms_.size()) {
        terms_[term]->stiffness(trial, stiffness);
    } else if (const std::size_t i = term - terms_.size(); i < interactions_.size()) {
        interactions_[i].stiffness(trial, interactions_.part(i, std::span<const double>(accepted.history)), stiffness);
    } else {
        models_.stiffness(i - interactions_.size(), accepted, trial, stiffness);
    }
    return stiffness;
}

template <class Body>
void SolidTangent::for_each_term(const State& accepted, const Trial& trial, const Factors& factors, Body body) const {
    if (factors.stiffness != 0)
        for (std::size_t t = 0; t < couplings_.size(); ++t) body(t, factors.stiffness, stiffness(t, accepted, trial));
    if (factors.velocity == 0) return;
    for (std::size_t i = 0; i < models_.size(); ++i) {
        if (!models_[i].depends_on_velocity()) continue;
        const std::size_t t = terms_.size() + interactions_.size() + i;
        const std::span df_dv(term_stiffness_.data(), couplings_[t].size());
        models_.velocity_stiffness(i, accepted, trial, df_dv);
        body(t, factors.velocity, std::span<const ForceTerm::Stiffness>(df_dv));
    }
}

void SolidTangent::assemble(const State& accepted, const Trial& trial, const Factors& factors,
                            std::span<double> values) const {
    const Places& at = places();
    const auto add_block = [&](std::size_t node, PairNumber place, double xx, double xy, double yx, double yy) {
        double* upper = pair_at(values.data(), place);
        double* lower = upper + 2 * at.row_pairs[node];
        upper[0] += xx;
        upper[1] += xy;
        lower[0] += yx;
        lower[1] += yy;
    };
    const double c_mass = factors.mass + factors.damping * damping_.mass_proportional;
    parallel_ranges(at.diagonal.size(), [&](std::size_t first, std::size_t last) {
        const auto entry = [&](std::size_t node) { return std::ptrdiff_t{4} * at.neighbour_starts[node]; };
        std::fill(values.begin() + entry(first), values.begin() + entry(last), 0.0);
        for (std::size_t node = first; node < last; ++node) {
            const double mass = c_mass * mass_[2 * node];
            add_block(node, at.diagonal[node], mass, 0, 0, mass);
        }
    });
    for (const Damping::Block& block : damping_.blocks) {
        const auto node = static_cast<std::size_t>(block.node);
        const double c = factors.damping;
        add_block(node, at.diagonal[node], c * block.xx, c * block.xy, c * block.xy, c * block.yy);
    }
    const auto block_places = [&](std::size_t block) {
        return ElementBlock::MatrixPlaces{at.blocks[block].data(), at.row_pairs.data()};
    };
    add_elements(accepted, trial, factors, block_places, values.data());
    for_each_term(accepted, trial, factors, [&](std::size_t t, double c, std::span<const ForceTerm::Stiffness> term) {
        for (std::size_t i = 0; i < term.size(); ++i)
            add_block(static_cast<std::size_t>(couplings_[t][i][0]), at.terms[t][i], -c * term[i].xx, -c * term[i].xy,
                      -c * term[i].yx, -c * term[i].yy);
    });
}

void SolidTangent::assemble_diagonal(const State& accepted, const Trial& trial, const Factors& factors,
                                     std::span<double> diagonal) const {
    const double c_mass = factors.mass + factors.damping * damping_.mass_proportional;
    parallel_ranges(diagonal.size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) diagonal[i] = c_mass * mass_[i];
    });
    const auto add = [&](std::int32_t node, double c, double xx, double yy) {
        diagonal[2 * static_cast<std::size_t>(node)] += c * xx;
        diagonal[2 * static_cast<std::size_t>(node) + 1] += c * yy;
    };
    for (const Damping::Block& block : damping_.blocks) add(block.node, factors.damping, block.xx, block.yy);
    const auto no_places = [](std::size_t) { return ElementBlock::MatrixPlaces{nullptr, nullptr}; };
    add_elements(accepted, trial, factors, no_places, diagonal.data());
    for_each_term(accepted, trial, factors, [&](std::size_t t, double c, std::span<const ForceTerm::Stiffness> term) {
        for (std::size_t i = 0; i < term.size(); ++i)
            if (couplings_[t][i][0] == couplings_[t][i][1]) add(couplings_[t][i][0], -c, term[i].xx, term[i].yy);
    });
    for (const LowRank::Dyad& dyad : beside(accepted, trial, factors).dyads)
        for (const auto& [row, value] : dyad.column)
            diagonal[static_cast<std::size_t>(row)] += dyad.factor * value * value;
}

}  // namespace gneiss
