#include "model/lumped_models.hpp"

#include <algorithm>
#include <cassert>

namespace gneiss {

class LumpedModels::Seen {
public:
    Seen(const LumpedModels& models, std::size_t i, const State& accepted, const Trial& trial) : at(trial) {
        const std::size_t first = models.starts_[i], n = models.starts_[i + 1] - first;
        from = Trial::of(accepted);
        from.z = std::span(accepted.z).subspan(first, n);
        follows = trial.z.empty();
        if (!follows) {
            at.z = trial.z.subspan(first, n);
        } else if (n > 0) {
            models[i].update_internal(from, trial, std::span(updated_).first(n));
            at.z = std::span(updated_).first(n);
        }
    }
    Seen(const Seen&) = delete;  // at.z may lie in it
    Seen& operator=(const Seen&) = delete;

    Trial from, at;
    bool follows;

private:
    std::array<double, LumpedModel::most_internal> updated_;
};

LumpedModels::LumpedModels(std::vector<std::unique_ptr<LumpedModel>> all, std::size_t z_offset)
    : all_(std::move(all)), starts_{z_offset} {
    for (const auto& one : all_) {
        assert(one->n_internal() <= LumpedModel::most_internal);
        starts_.push_back(starts_.back() + one->n_internal());
    }
}

void LumpedModels::place_points(std::size_t n_nodes) {
    auto node = static_cast<std::int32_t>(n_nodes);
    for (const auto& one : all_)
        if (one->point()) one->place_point(node++);
}

std::vector<LumpedModel::Point> LumpedModels::points() const {
    std::vector<LumpedModel::Point> points;
    for (const auto& one : all_)
        if (const auto point = one->point()) points.push_back(*point);
    return points;
}

void LumpedModels::replace(std::vector<std::unique_ptr<LumpedModel>> all) {
    assert(all.size() == all_.size());
    all_ = std::move(all);
}

void LumpedModels::initial_internal(std::span<double> z) const {
    for (std::size_t i = 0; i < all_.size(); ++i)
        all_[i]->initial_internal(z.subspan(starts_[i], starts_[i + 1] - starts_[i]));
}

bool LumpedModels::depend_on_velocity() const {
    return std::ranges::any_of(all_, [](const auto& one) { return one->depends_on_velocity(); });
}

void LumpedModels::add_force(const State& accepted, const Trial& trial, std::span<double> f,
                             std::span<double> z) const {
    for (std::size_t i = 0; i < all_.size(); ++i) {
        const Seen seen(*this, i, accepted, trial);
        all_[i]->add_force(seen.at, f);
        if (!z.empty()) std::ranges::copy(seen.at.z, z.begin() + static_cast<std::ptrdiff_t>(starts_[i]));
    }
}

void LumpedModels::corner_forces(const State& state, std::vector<CornerForce>& forces) const {
    for (std::size_t i = 0; i < all_.size(); ++i)
        all_[i]->corner_forces(Seen(*this, i, state, Trial::of(state)).at, forces);
}

void LumpedModels::internal_rate(const Trial& trial, std::span<double> rate) const {
    for (std::size_t i = 0; i < all_.size(); ++i) {
        const std::size_t n = starts_[i + 1] - starts_[i];
        Trial at = trial;
        at.z = trial.z.subspan(starts_[i], n);
        all_[i]->internal_rate(at, rate.subspan(starts_[i], n));
    }
}

void LumpedModels::stiffness(std::size_t i, const State& accepted, const Trial& trial,
                             std::span<ForceTerm::Stiffness> df_du) const {
    all_[i]->stiffness(Seen(*this, i, accepted, trial).at, df_du);
}

void LumpedModels::velocity_stiffness(std::size_t i, const State& accepted, const Trial& trial,
                                      std::span<ForceTerm::Stiffness> df_dv) const {
    all_[i]->velocity_stiffness(Seen(*this, i, accepted, trial).at, df_dv);
}

LowRank LumpedModels::dyads(const State& accepted, const Trial& trial, double scale) const {
    LowRank beside;
    if (scale == 0) return beside;
    for (std::size_t i = 0; i < all_.size(); ++i) {
        const Seen seen(*this, i, accepted, trial);
        if (auto dyad = all_[i]->dyad(seen.follows ? &seen.from : nullptr, seen.at)) {
            dyad->factor *= scale;
            beside.dyads.push_back(std::move(*dyad));
        }
    }
    return beside;
}

LumpedModel::Rates LumpedModels::largest_rates(const State& accepted, std::span<const double> lumped_mass) const {
    LumpedModel::Rates sum;  // eigenvalues of a sum are at most the sum of the largest ones
    for (std::size_t i = 0; i < all_.size(); ++i) {
        const auto own = all_[i]->largest_rates(Seen(*this, i, accepted, Trial::of(accepted)).at, lumped_mass);
        sum.omega_squared += own.omega_squared;
        sum.damping += own.damping;
    }
    return sum;
}

void LumpedModels::add_stiffness_bound(const State& accepted, const Trial& trial, std::span<double> bound) const {
    for (std::size_t i = 0; i < all_.size(); ++i)
        all_[i]->add_stiffness_bound(Seen(*this, i, accepted, trial).at, bound);
}

double LumpedModels::stored_energy(const State& state) const {
    double sum = 0;
    for (std::size_t i = 0; i < all_.size(); ++i)
        sum += all_[i]->stored_energy(Seen(*this, i, state, Trial::of(state)).at);
    return sum;
}

void LumpedModels::add_path_energies(const State& from, const Trial& before, const State& to, const Trial& after,
                                     PathEnergies& energies) const {
    for (std::size_t i = 0; i < all_.size(); ++i)
        all_[i]->add_path_energies(Seen(*this, i, from, before).at, Seen(*this, i, to, after).at, energies);
}

std::vector<double> LumpedModels::switch_times() const {
    std::vector<double> times;
    for (const auto& one : all_) {
        const std::vector<double> own = one->switch_times();
        times.insert(times.end(), own.begin(), own.end());
    }
    return times;
}

std::vector<LumpedModel::Quantity> LumpedModels::quantities(const State& state) const {
    std::vector<LumpedModel::Quantity> all;
    for (std::size_t i = 0; i < all_.size(); ++i)
        for (auto& own : all_[i]->quantities(Seen(*this, i, state, Trial::of(state)).at))
            all.push_back({all_[i]->name() + "." + own.name, own.unit, own.value});
    return all;
}

}  // namespace gneiss
