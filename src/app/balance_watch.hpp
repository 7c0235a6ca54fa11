#pragma once
// Whether the energy balance of a run is to be trusted, and what is said where it is not.

#include <limits>
#include <string>

#include "model/energy_ledger.hpp"
#include "model/options.hpp"

namespace gneiss {

/// What a run remembers of its energy balance; part of a checkpoint.
struct BalanceRecord {
    double largest_entry = 0;                                         ///< of the energy balance so far, J
    double most_gained = 0, most_lost = 0;                            ///< largest left over of either sign, by size, J
    double doubtful_since = std::numeric_limits<double>::infinity();  ///< s; infinite: it is not
    double gaining_since = std::numeric_limits<double>::infinity();   ///< s, past run.most_energy_gained

    friend bool operator==(const BalanceRecord&, const BalanceRecord&) = default;
};

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
