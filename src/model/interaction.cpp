#include "model/interaction.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace gneiss {

Interactions::Interactions(std::vector<std::unique_ptr<Interaction>> all, std::size_t history_offset)
    : all_(std::move(all)), starts_{history_offset} {
    for (const auto& one : all_) starts_.push_back(starts_.back() + one->n_history());
}

void Interactions::initial_history(std::span<double> history) const {
    for (std::size_t i = 0; i < all_.size(); ++i) all_[i]->initial_history(part(i, history));
}

std::span<double> Interactions::part(const Interaction& interaction, State& state) const {
    const auto found = std::ranges::find(all_, &interaction, [](const auto& one) { return one.get(); });
    return part(static_cast<std::size_t>(found - all_.begin()), std::span(state.history));
}

bool Interactions::irreversible() const {
    return std::ranges::any_of(all_, [](const auto& one) { return one->irreversible(); });
}

bool Interactions::watch() const {
    return std::ranges::any_of(all_, [](const auto& one) { return one->watches(); });
}

bool Interactions::stirred(const State& state) const {
    return std::ranges::any_of(all_, [&](const auto& one) { return one->watches() && one->stirred(state); });
}

bool Interactions::look(const State& accepted) {
    bool changed = false;
    for (const auto& one : all_) changed |= one->watches() && one->look(accepted);
    return changed;
}

bool Interactions::renew(const State& accepted) {
    bool changed = false;
    for (const auto& one : all_) changed |= one->renew(accepted);
    return changed;
}

void Interactions::follow(const Parting& parting, State& accepted) {
    std::vector<double> whole(accepted.history.begin(),
                              accepted.history.begin() + static_cast<std::ptrdiff_t>(starts_.front()));
    std::vector<std::size_t> starts{starts_.front()};
    for (std::size_t i = 0; i < all_.size(); ++i) {
        const auto old = part(i, std::as_const(accepted));
        std::vector<double> own(old.begin(), old.end());
        all_[i]->follow(parting, accepted, own, accepted.path);
        assert(own.size() == all_[i]->n_history());
        whole.insert(whole.end(), own.begin(), own.end());
        starts.push_back(whole.size());
    }
    starts_ = std::move(starts);
    accepted.history = std::move(whole);
}

void Interactions::add_force(const State& accepted, const Trial& trial, std::span<double> f,
                             std::span<double> updated) const {
    for (std::size_t i = 0; i < all_.size(); ++i) all_[i]->add_force(trial, part(i, accepted), f, part(i, updated));
}

void Interactions::take_chunks(std::span<const std::int32_t> chunk_of_node, std::size_t n_chunks) {
    for (const auto& one : all_) one->take_chunks(chunk_of_node, n_chunks);
}

void Interactions::add_chunk_force(std::size_t chunk, const State& accepted, const Trial& trial, std::span<double> f,
                                   std::span<double> updated) const {
    for (std::size_t i = 0; i < all_.size(); ++i)
        all_[i]->add_chunk_force(chunk, trial, part(i, accepted), f, part(i, updated));
}

double Interactions::omega_squared(const State& accepted, const Trial& trial,
                                   std::span<const double> lumped_mass) const {
    double sum = 0;  // eigenvalues of a sum are at most the sum of the largest ones
    for (std::size_t i = 0; i < all_.size(); ++i) sum += all_[i]->omega_squared(trial, part(i, accepted), lumped_mass);
    return sum;
}

void Interactions::add_stiffness_bound(const State& accepted, const Trial& trial, std::span<double> bound) const {
    for (std::size_t i = 0; i < all_.size(); ++i) all_[i]->add_stiffness_bound(trial, part(i, accepted), bound);
}

void Interactions::add_stored(const State& state, StoredEnergies& energies) const {
    const Trial at = Trial::of(state);
    for (std::size_t i = 0; i < all_.size(); ++i) all_[i]->add_stored(at, part(i, state), energies);
}

void Interactions::add_dissipated(const State& from, State& to) const {
    for (std::size_t i = 0; i < all_.size(); ++i) all_[i]->add_dissipated(part(i, from), part(i, to), to.path);
}

}  // namespace gneiss
