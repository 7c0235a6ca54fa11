#pragma once
// The simplest interaction with a memory: springs between the two faces of a cut, those along x with a friction slider.

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/inner_sides.hpp"
#include "model/interaction.hpp"
#include "support/small_solids.hpp"

namespace gneiss::test {

class Sliders final : public Interaction {
public:
    /// @param stiffness  N/m, of each spring; @param limit  N, of each slider
    Sliders(std::vector<NodeCopy> pairs, double stiffness, double limit)
        : pairs_(std::move(pairs)), stiffness_(stiffness), limit_(limit) {}

    std::string name() const override { return "sliders"; }
    /// Slip and dissipated energy of each pair.
    std::size_t n_history() const override { return 2 * pairs_.size(); }
    void initial_history(std::span<double> history) const override { std::ranges::fill(history, 0.0); }
    void add_force(const Trial& trial, std::span<const double> history, std::span<double> f,
                   std::span<double> updated) const override {
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            const Slip slip = slip_of(trial, history, i);
            const std::size_t a = 2 * index(pairs_[i].original), b = 2 * index(pairs_[i].copy);
            const double y = stiffness_ * (trial.u[b + 1] - trial.u[a + 1]);
            f[a] += slip.force;
            f[b] -= slip.force;
            f[a + 1] += y;
            f[b + 1] -= y;
            if (updated.empty()) continue;
            updated[2 * i] = slip.total;
            updated[2 * i + 1] = history[2 * i + 1] + limit_ * std::abs(slip.total - history[2 * i]);
        }
    }
    void follow(const Parting&, const State&, std::vector<double>&, PathEnergies&) override {}  // of a mesh that stays
    std::vector<std::array<std::int32_t, 2>> couplings() const override {
        std::vector<std::array<std::int32_t, 2>> all;
        for (const auto& [a, b] : pairs_) all.insert(all.end(), {{a, a}, {a, b}, {b, a}, {b, b}});
        return all;
    }
    bool symmetric() const override { return true; }
    void stiffness(const Trial& trial, std::span<const double> history,
                   std::span<ForceTerm::Stiffness> df_du) const override {
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            const double x = slip_of(trial, history, i).slides ? 0.0 : stiffness_;
            for (const std::size_t k : {0, 1, 2, 3}) {
                const double sign = k == 0 || k == 3 ? -1 : 1;
                df_du[4 * i + k] = {sign * x, 0, 0, sign * stiffness_};
            }
        }
    }
    double omega_squared(const Trial&, std::span<const double>, std::span<const double> mass) const override {
        double largest = 0;  // of each pair alone: no node belongs to two
        for (const auto& [a, b] : pairs_)
            largest = std::max(largest, stiffness_ * (1 / mass[2 * index(a)] + 1 / mass[2 * index(b)]));
        return largest;
    }
    void add_stiffness_bound(const Trial&, std::span<const double>, std::span<double> bound) const override {
        for (const auto& [a, b] : pairs_)
            for (const std::size_t dof : {2 * index(a), 2 * index(a) + 1, 2 * index(b), 2 * index(b) + 1})
                bound[dof] += 2 * stiffness_;
    }
    void add_stored(const Trial& accepted, std::span<const double> history, StoredEnergies& energies) const override {
        for (std::size_t i = 0; i < pairs_.size(); ++i) {
            const double x = separation(accepted, i, 0) - history[2 * i], y = separation(accepted, i, 1);
            energies.joints += 0.5 * stiffness_ * (x * x + y * y);
        }
    }
    void add_dissipated(std::span<const double> from, std::span<const double> to,
                        PathEnergies& energies) const override {
        for (std::size_t i = 0; i < pairs_.size(); ++i) energies.friction += to[2 * i + 1] - from[2 * i + 1];
    }

private:
    struct Slip {
        double force, total;  ///< on the original, N; m
        bool slides;
    };
    static std::size_t index(std::int32_t node) { return static_cast<std::size_t>(node); }
    double separation(const Trial& trial, std::size_t i, std::size_t component) const {
        return trial.u[2 * index(pairs_[i].copy) + component] - trial.u[2 * index(pairs_[i].original) + component];
    }
    Slip slip_of(const Trial& trial, std::span<const double> history, std::size_t i) const {
        const double elastic = stiffness_ * (separation(trial, i, 0) - history[2 * i]);
        const double force = std::clamp(elastic, -limit_, limit_);
        return {force, history[2 * i] + (elastic - force) / stiffness_, elastic != force};
    }

    std::vector<NodeCopy> pairs_;
    double stiffness_, limit_;
};

/// A rectangle of 2 m x 1 m cut along y = 0.5 m; the halves hold together by sliders.
/// @param limit  N, of each of the sliders
inline Solid cut_solid(bool compt, double limit, const SolidDescription& what = {}) {
    Mesh mesh = rectangle(compt, 2, 1, {3, 2});
    InnerSides sides(mesh);
    std::vector<std::int32_t> cut;
    for (std::size_t s = 0; s < sides.sides().size(); ++s) {
        const ElementSide& side = sides.sides()[s].left;
        const auto local = side_nodes(mesh.kind, side.side);
        if (std::ranges::all_of(local, [&](int k) {
                const std::int32_t node = mesh.element(static_cast<std::size_t>(side.element))[k];
                return std::abs(mesh.nodes[static_cast<std::size_t>(node)][1] - 0.5) < 1e-9;
            }))
            cut.push_back(static_cast<std::int32_t>(s));
    }
    const std::vector<NodeCopy> pairs = sides.open(cut);
    return make_solid(std::move(mesh), what, [&](SolidSystem::Parts& parts) {
        parts.interactions.push_back(std::make_unique<Sliders>(pairs, 2e9, limit));
    });
}

}  // namespace gneiss::test
