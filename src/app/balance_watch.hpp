#pragma once
// Whether the energy balance of a run is to be trusted, and what is said where it is not.

#include <limits>
#include <string>

#include "model/energy_ledger.hpp"
#include "model/options.hpp"
#include "system/semi_discrete.hpp"

namespace gneiss {

/// What a run remembers of its energy balance; part of a checkpoint.
struct BalanceRecord {
    double largest_entry = 0;               ///< of the energy balance so far, J; at first least_energy()
    double most_gained = 0, most_lost = 0;  ///< largest left over of either sign, by size, J
    double doubtful_since = std::numeric_limits<double>::infinity();  ///< s; infinite: it is not
    double gaining_since = std::numeric_limits<double>::infinity();   ///< s, past run.most_energy_gained

    friend bool operator==(const BalanceRecord&, const BalanceRecord&) = default;
};

/// What a balance error is measured by at least, J: neither vibration by round-off of a body at rest nor what comes in
/// with the first, smallest part of a load is an energy of the run. Two bounds from below, added:
///
///     (1/2) sum m (omega eps L)^2    positions are known to L eps, the fastest vibration has the frequency omega
///     c (1/2) sum f^2/(m omega^2)    what the loads where they are largest or fastest give to nodes within 1/omega, or
///                                    m v^2/2 of supports; c = 1e-4
/// @param at_start  of the run
/// @param extent    L, largest coordinate, m
double least_energy(const SemiDiscrete& system, const State& at_start, double extent);

/// Looks at every row. A balance that is out for less than a hundredth of the run does not count yet: when energy first
/// comes in, errors are large against the little that there is.
class BalanceWatch {
public:
    /// Balance error from which on a run is warned of.
    static constexpr double doubtful = 0.01;

    BalanceWatch(const CaseOptions& options, bool is_static) : options_(&options), is_static_(is_static) {}

    void look(double t, const EnergyLedger& ledger, BalanceRecord& record) const;
    bool to_be_warned_of(double t, const BalanceRecord& record) const { return stands(record.doubtful_since, t); }
    bool to_be_ended(double t, const BalanceRecord& record) const { return stands(record.gaining_since, t); }

    /// Largest balance error so far: over the largest entry so far.
    static double largest_error(const BalanceRecord& record);
    /// What has gone wrong and why it may have.
    std::string text(double t, const BalanceRecord& record) const;

private:
    bool stands(double since, double t) const;
    std::string cause(bool gained) const;

    const CaseOptions* options_;
    bool is_static_;
};

}  // namespace gneiss
