#include "model/element_levels.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "base/parallel.hpp"

namespace gneiss {
namespace {

using PackLevels = std::vector<std::vector<int>>;  ///< of each pack of each block
using PackFrequencies = std::vector<std::vector<double>>;

PackFrequencies pack_frequencies(const ElementForces& elements, const State& state) {
    PackFrequencies omega;
    for (std::size_t b = 0; b < elements.blocks().size(); ++b) {
        const ElementBlock& block = *elements.blocks()[b];
        const ElementBlock::Evaluation at = elements.evaluation(b, state, Trial::of(state));
        omega.emplace_back(block.n_packs());
        parallel_ranges(block.n_packs(), [&](std::size_t first, std::size_t last) {
            for (std::size_t pack = first; pack < last; ++pack)
                omega[b][pack] = std::sqrt(block.largest_rates(pack, pack + 1, at).omega_squared);
        });
    }
    return omega;
}

/// The coarsest levels that stand the steps, with a layer of the same level around them, neighbours at most one apart.
PackLevels graded(const ElementForces& elements, const PackFrequencies& omega, double coarsest, int finest,
                  std::size_t n_nodes) {
    PackLevels levels;
    for (const std::vector<double>& of_block : omega) {
        levels.emplace_back();
        for (const double one : of_block) {
            constexpr double round_off = 1e-9;
            const double level = std::ceil(std::log2(one / coarsest) - round_off);
            levels.back().push_back(static_cast<int>(std::clamp(level, 0.0, static_cast<double>(finest))));
        }
    }
    std::vector<int> of_node(n_nodes, 0);
    const auto for_each_node = [&](auto body) {
        for (std::size_t b = 0; b < levels.size(); ++b)
            for (std::size_t pack = 0; pack < levels[b].size(); ++pack)
                for (const std::int32_t node : elements.blocks()[b]->nodes_of_packs(pack, pack + 1))
                    body(levels[b][pack], of_node[static_cast<std::size_t>(node)]);
    };
    for (int sweep = 0; sweep < finest; ++sweep) {
        const int apart = sweep == 0 ? 0 : 1;  // at first a layer around each level, then slopes
        for_each_node([](int level, int& node) { node = std::max(node, level); });
        for_each_node([&](int& level, int node) { level = std::max(level, node - apart); });
    }
    return levels;
}

std::vector<std::size_t> count_packs(const PackLevels& levels, int finest) {
    std::vector<std::size_t> n(static_cast<std::size_t>(finest) + 1, 0);
    for (const std::vector<int>& of_block : levels)
        for (const int level : of_block) ++n[static_cast<std::size_t>(level)];
    return n;
}

/// Evaluations of packs over the time of the shortest step: all at first, then those of level k 2^k times.
double cost(const std::vector<std::size_t>& n_packs) {
    double sum = 0, all = 0;
    for (std::size_t k = 0; k < n_packs.size(); ++k) {
        all += static_cast<double>(n_packs[k]);
        if (k > 0) sum += std::ldexp(static_cast<double>(n_packs[k]), static_cast<int>(k));
    }
    return std::ldexp(all + sum, 1 - static_cast<int>(n_packs.size()));
}

}  // namespace

std::unique_ptr<ElementLevels> ElementLevels::make(const ElementForces& elements, const State& initial, int most) {
    const PackFrequencies omega = pack_frequencies(elements, initial);
    double largest = 0;
    std::size_t n_packs = 0;
    for (const std::vector<double>& of_block : omega) {
        largest = std::max(largest, *std::ranges::max_element(of_block));
        n_packs += of_block.size();
    }
    // what is worth having: the evaluations counted here are not all that a step costs
    constexpr double worth = 0.8;
    double least = worth * static_cast<double>(n_packs);
    PackLevels best;
    int finest = 0;
    for (int tried = 1; tried < most; ++tried) {
        PackLevels levels = graded(elements, omega, std::ldexp(largest, -tried), tried, initial.u.size() / 2);
        const std::vector<std::size_t> count = count_packs(levels, tried);
        const double now = cost(count);
        if (count.front() == 0 || now >= least) continue;
        least = now;
        finest = tried;
        best = std::move(levels);
    }
    if (finest == 0) return nullptr;
    return std::unique_ptr<ElementLevels>(new ElementLevels(elements, best, finest));
}

ElementLevels::ElementLevels(const ElementForces& elements, const PackLevels& level_of_pack, int finest)
    : elements_(elements), n_elements_(static_cast<std::size_t>(finest) + 1, 0) {
    for (std::size_t c = 0; c < elements.n_chunks(); ++c) {
        const PackRange chunk = elements.packs_of(c);
        for (std::size_t pack = chunk.first; pack < chunk.last; ++pack) {
            const int level = level_of_pack[chunk.block][pack];
            if (pack > chunk.first && runs_.back().level == level)
                ++runs_.back().packs.last;
            else
                runs_.push_back({{chunk.block, pack, pack + 1}, level});
            n_elements_[static_cast<std::size_t>(level)] +=
                std::min(pack_width, elements.blocks()[chunk.block]->n_elements() - pack * pack_width);
        }
    }
    rates_.resize(runs_.size());
    levels_.resize(static_cast<std::size_t>(finest));
    for (int level = finest; level > 0; --level) add_level(level, level_of_pack);
    std::size_t largest = 0, n_slots = 0, n_pieces = 0;
    for (const Level& level : levels_) {
        n_slots = std::max(n_slots, level.slot_starts.back());
        n_pieces = std::max(n_pieces, level.pieces.size());
        for (const Piece& piece : level.pieces) largest = std::max(largest, piece.n_chunk_nodes);
    }
    slot_forces_.resize(2 * n_slots);
    inverted_.resize(n_pieces);
    scratch_.resize(static_cast<std::size_t>(omp_get_max_threads()));
    for (std::vector<double>& scratch : scratch_) scratch.resize(6 * largest);
}

void ElementLevels::add_level(int number, const PackLevels& level_of_pack) {
    Level& level = levels_[static_cast<std::size_t>(number - 1)];
    if (number < finest()) level.nodes = of(number + 1).nodes;
    for (std::size_t c = 0; c < elements_.n_chunks(); ++c) {
        const PackRange chunk = elements_.packs_of(c);
        Piece piece{chunk.block, elements_.nodes_of_chunk(c).size(), level.runs.size(), 0, 0, 0};
        std::vector<std::int32_t> nodes;
        for (std::size_t pack = chunk.first; pack < chunk.last; ++pack) {
            if (level_of_pack[chunk.block][pack] != number) continue;
            if (level.runs.size() > piece.first_run && level.runs.back().last == pack)
                ++level.runs.back().last;
            else
                level.runs.push_back({chunk.block, pack, pack + 1});
            const auto own = elements_.blocks()[chunk.block]->nodes_of_packs(pack, pack + 1);
            nodes.insert(nodes.end(), own.begin(), own.end());
        }
        piece.last_run = level.runs.size();
        if (nodes.empty()) continue;
        std::ranges::sort(nodes);
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        level.nodes.insert(level.nodes.end(), nodes.begin(), nodes.end());
        const auto in_chunk = elements_.nodes_of_chunk(c);
        std::vector<std::pair<std::int32_t, std::int32_t>> numbers;
        for (std::size_t i = 0; i < in_chunk.size(); ++i)
            numbers.emplace_back(in_chunk[i], static_cast<std::int32_t>(i));
        std::ranges::sort(numbers);
        piece.first_node = level.piece_nodes.size();
        for (const std::int32_t node : nodes) {
            const auto found = std::ranges::lower_bound(numbers, node, {}, [](const auto& n) { return n.first; });
            level.piece_nodes.push_back({found->second, node, -1});
        }
        piece.last_node = level.piece_nodes.size();
        level.pieces.push_back(piece);
    }
    std::ranges::sort(level.nodes);
    level.nodes.erase(std::unique(level.nodes.begin(), level.nodes.end()), level.nodes.end());
    for (PieceNode& node : level.piece_nodes)
        node.position =
            static_cast<std::int32_t>(std::ranges::lower_bound(level.nodes, node.position) - level.nodes.begin());
    share_nodes(level);
}

void ElementLevels::share_nodes(Level& level) {
    std::vector<std::int32_t> touched(level.nodes.size(), 0), next(level.nodes.size(), -1);
    for (const PieceNode& node : level.piece_nodes) ++touched[static_cast<std::size_t>(node.position)];
    std::int32_t n_slots = 0;
    for (std::size_t i = 0; i < touched.size(); ++i) {
        if (touched[i] < 2) continue;
        level.shared.push_back(static_cast<std::int32_t>(i));
        level.slot_starts.push_back(static_cast<std::size_t>(n_slots));
        next[i] = n_slots;
        n_slots += touched[i];
    }
    level.slot_starts.push_back(static_cast<std::size_t>(n_slots));
    for (PieceNode& node : level.piece_nodes) {
        std::int32_t& slot = next[static_cast<std::size_t>(node.position)];
        if (slot >= 0) node.slot = slot++;
    }
}

std::ptrdiff_t ElementLevels::add_piece(const Level& level, const Piece& piece, const ElementBlock::Evaluation& at,
                                        std::span<const double> u, std::span<double> f, double* scratch) const {
    const ElementBlock& block = *elements_.blocks()[piece.block];
    double *local_u = scratch, *local_f = scratch + 2 * piece.n_chunk_nodes,
           *local_v = local_f + 2 * piece.n_chunk_nodes;
    const std::span nodes(level.piece_nodes.data() + piece.first_node, piece.last_node - piece.first_node);
    const double* from = u.data();
    for (const PieceNode& node : nodes) {
        local_u[2 * node.local] = from[2 * node.position];
        local_u[2 * node.local + 1] = from[2 * node.position + 1];
        local_f[2 * node.local] = local_f[2 * node.local + 1] = 0;
    }
    if (block.viscous())
        for (const PieceNode& node : nodes) {
            const auto global = 2 * static_cast<std::size_t>(level.nodes[static_cast<std::size_t>(node.position)]);
            local_v[2 * node.local] = at.v[global];
            local_v[2 * node.local + 1] = at.v[global + 1];
        }
    for (std::size_t run = piece.first_run; run < piece.last_run; ++run) {
        const std::ptrdiff_t inverted =
            block.add_force(level.runs[run].first, level.runs[run].last, at, {local_u, local_v, local_f});
        if (inverted != ElementBlock::none) return inverted;
    }
    for (const PieceNode& node : nodes) {
        double* to = node.slot < 0 ? f.data() + 2 * node.position : slot_forces_.data() + 2 * node.slot;
        to[0] = local_f[2 * node.local];
        to[1] = local_f[2 * node.local + 1];
    }
    return ElementBlock::none;
}

void ElementLevels::force(int number, const State& accepted, const Trial& trial, std::span<const double> u,
                          std::span<double> f) const {
    const Level& level = of(number);
    std::ranges::fill(f, 0.0);
    const auto n = static_cast<std::ptrdiff_t>(level.pieces.size());
#pragma omp parallel for schedule(static) if (n > 1)
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        const Piece& piece = level.pieces[static_cast<std::size_t>(i)];
        inverted_[static_cast<std::size_t>(i)] =
            add_piece(level, piece, elements_.evaluation(piece.block, accepted, trial), u, f,
                      scratch_[static_cast<std::size_t>(omp_get_thread_num())].data());
    }
    for (std::size_t i = 0; i < level.pieces.size(); ++i)
        if (inverted_[i] != ElementBlock::none)
            throw RecoverableError(fmt::format("{} is inverted in a local step at t = {:.9g} s",
                                               elements_.description(level.pieces[i].block, inverted_[i]), trial.t));
    for (std::size_t k = 0; k < level.shared.size(); ++k) {
        double x = 0, y = 0;
        for (std::size_t slot = level.slot_starts[k]; slot < level.slot_starts[k + 1]; ++slot) {
            x += slot_forces_[2 * slot];
            y += slot_forces_[2 * slot + 1];
        }
        f[2 * static_cast<std::size_t>(level.shared[k])] = x;
        f[2 * static_cast<std::size_t>(level.shared[k]) + 1] = y;
    }
}

FrequencyBound ElementLevels::bound(const State& accepted) const {
    const auto n = static_cast<std::ptrdiff_t>(runs_.size());
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t i = 0; i < n; ++i) {
        const PackRange& packs = runs_[static_cast<std::size_t>(i)].packs;
        rates_[static_cast<std::size_t>(i)] = elements_.blocks()[packs.block]->largest_rates(
            packs.first, packs.last, elements_.evaluation(packs.block, accepted, Trial::of(accepted)));
    }
    FrequencyBound bound;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
        bound.omega = std::max(bound.omega, std::ldexp(std::sqrt(rates_[i].omega_squared), -runs_[i].level));
        bound.damping_rate = std::max(bound.damping_rate, rates_[i].damping);
    }
    return bound;
}

}  // namespace gneiss
