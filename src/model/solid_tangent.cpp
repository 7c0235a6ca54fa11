#include "model/solid_tangent.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <stdexcept>

#include "base/parallel.hpp"

namespace gneiss {
namespace {

/// Sub-triangles per chunk: a few chunks of each colour even in small solids.
constexpr std::size_t chunk_size = 512;

}  // namespace

SolidTangent::SolidTangent(const ElementForces& elements, std::span<const std::unique_ptr<ForceTerm>> terms,
                           std::span<const double> lumped_mass, const Damping& damping)
    : elements_(elements), terms_(terms), mass_(lumped_mass), damping_(damping) {
    symmetric_ = std::ranges::all_of(elements.blocks(), [](const auto& block) { return block->symmetric_tangent(); });
    for (const auto& term : terms) {
        couplings_.push_back(term->couplings());
        symmetric_ = symmetric_ && couplings_.back().empty();
    }
    plan_pattern();
    plan_chunks();
    plan_places();
}

void SolidTangent::plan_pattern() {
    const std::size_t n_nodes = mass_.size() / 2;
    // neighbours of each node: the nodes of its elements
    std::vector<std::vector<std::int32_t>> neighbours(n_nodes);
    for (const auto& block : elements_.blocks()) {
        const auto n = static_cast<std::size_t>(block->n_nodes());
        for (std::size_t local = 0; local < block->n_elements(); ++local) {
            const std::size_t first = local / pack_width * n * pack_width + local % pack_width;
            const auto node = [&](std::size_t k) { return block->nodes()[first + k * pack_width]; };
            for (std::size_t a = 0; a < n; ++a)
                for (std::size_t b = 0; b < n; ++b) neighbours[static_cast<std::size_t>(node(a))].push_back(node(b));
        }
    }
    std::size_t n_nonzero = 0;
    for (auto& list : neighbours) {
        std::ranges::sort(list);
        list.erase(std::unique(list.begin(), list.end()), list.end());
        n_nonzero += 4 * list.size();
    }
    if (n_nonzero > std::numeric_limits<std::uint32_t>::max())
        throw std::length_error("a tangent of more than 2^32 entries");
    row_starts_.assign(1, 0);
    columns_.reserve(n_nonzero);
    for (const auto& list : neighbours) {
        row_lengths_.push_back(static_cast<std::uint32_t>(2 * list.size()));
        for (int row = 0; row < 2; ++row) {
            for (const std::int32_t node : list) columns_.insert(columns_.end(), {2 * node, 2 * node + 1});
            row_starts_.push_back(static_cast<std::int64_t>(columns_.size()));
        }
    }
}

void SolidTangent::plan_chunks() {
    const std::vector<PackRange> chunks = pack_ranges(elements_.blocks(), chunk_size);
    // the lowest colour that no neighbour has
    std::vector<std::uint64_t> colours_at(row_lengths_.size(), 0);  // bits, of each node
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

std::uint32_t SolidTangent::place(std::int32_t row_node, std::int32_t column_node) const {
    const auto row = static_cast<std::size_t>(2 * row_node);
    const auto first = columns_.begin() + row_starts_[row], last = columns_.begin() + row_starts_[row + 1];
    const auto found = std::lower_bound(first, last, std::int64_t{2} * column_node);
    if (found == last || *found != 2 * column_node)
        throw std::logic_error("a load couples two nodes that share no element");
    return static_cast<std::uint32_t>(found - columns_.begin());
}

void SolidTangent::plan_places() {
    for (const auto& block : elements_.blocks()) {
        const auto n = static_cast<std::size_t>(block->n_nodes());
        const auto nodes = block->nodes();
        std::vector<std::uint32_t>& places = blocks_.emplace_back();
        places.reserve(block->n_packs() * n * n * pack_width);
        for (std::size_t pack = 0; pack < block->n_packs(); ++pack)
            for (std::size_t a = 0; a < n; ++a)
                for (std::size_t b = 0; b < n; ++b)
                    for (std::size_t lane = 0; lane < pack_width; ++lane)
                        places.push_back(place(nodes[(pack * n + a) * pack_width + lane],
                                               nodes[(pack * n + b) * pack_width + lane]));
    }
    for (std::size_t node = 0; node < row_lengths_.size(); ++node)
        diagonal_.push_back(place(static_cast<std::int32_t>(node), static_cast<std::int32_t>(node)));
    std::size_t most = 0;
    for (const auto& pairs : couplings_) {
        std::vector<std::uint32_t>& places = term_places_.emplace_back();
        for (const auto& [a, b] : pairs) places.push_back(place(a, b));
        most = std::max(most, pairs.size());
    }
    term_stiffness_.resize(most);
}

void SolidTangent::assemble(const State& accepted, const Trial& trial, const Factors& factors,
                            std::span<double> values) const {
    const auto add_block = [&](std::size_t node, std::uint32_t at, double xx, double xy, double yx, double yy) {
        double* upper = values.data() + at;
        double* lower = upper + row_lengths_[node];
        upper[0] += xx;
        upper[1] += xy;
        lower[0] += yx;
        lower[1] += yy;
    };
    const double c_mass = factors.mass + factors.damping * damping_.mass_proportional;
    parallel_ranges(diagonal_.size(), [&](std::size_t first, std::size_t last) {
        std::fill(values.begin() + row_starts_[2 * first], values.begin() + row_starts_[2 * last], 0.0);
        for (std::size_t node = first; node < last; ++node) {
            const double mass = c_mass * mass_[2 * node];
            add_block(node, diagonal_[node], mass, 0, 0, mass);
        }
    });
    for (const Damping::Block& block : damping_.blocks) {
        const auto node = static_cast<std::size_t>(block.node);
        const double c = factors.damping;
        add_block(node, diagonal_[node], c * block.xx, c * block.xy, c * block.xy, c * block.yy);
    }
    if (factors.stiffness == 0 && factors.velocity == 0) return;

    for (std::size_t colour = 0; colour + 1 < colour_starts_.size(); ++colour) {
        const auto first = static_cast<std::ptrdiff_t>(colour_starts_[colour]);
        const auto last = static_cast<std::ptrdiff_t>(colour_starts_[colour + 1]);
#pragma omp parallel for schedule(static)
        for (std::ptrdiff_t c = first; c < last; ++c) {
            const PackRange& chunk = chunks_[static_cast<std::size_t>(c)];
            elements_.blocks()[chunk.block]->add_tangent(
                chunk.first, chunk.last, elements_.evaluation(chunk.block, accepted, trial), -factors.stiffness,
                -factors.velocity, {blocks_[chunk.block].data(), row_lengths_.data()}, values.data());
        }
    }
    for (std::size_t t = 0; t < terms_.size(); ++t) {
        const auto& pairs = couplings_[t];
        const std::span stiffness(term_stiffness_.data(), pairs.size());
        terms_[t]->stiffness(trial, stiffness);
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            const double c = -factors.stiffness;
            const ForceTerm::Stiffness& df = stiffness[i];
            add_block(static_cast<std::size_t>(pairs[i][0]), term_places_[t][i], c * df.xx, c * df.xy, c * df.yx,
                      c * df.yy);
        }
    }
}

}  // namespace gneiss
