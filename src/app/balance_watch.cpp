#include "app/balance_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <string_view>

namespace gneiss {

void BalanceWatch::look(double t, const EnergyLedger& ledger, BalanceRecord& record) const {
    const double left_over = ledger.left_over(), relative = ledger.relative_left_over();
    record.largest_entry = ledger.largest_entry();
    record.most_gained = std::max(record.most_gained, left_over);
    record.most_lost = std::max(record.most_lost, -left_over);
    const auto since = [t](bool is_so, double before) {
        return is_so ? std::min(before, t) : std::numeric_limits<double>::infinity();
    };
    // what is no number is no balance either
    record.doubtful_since = since(!(ledger.balance_error() < doubtful), record.doubtful_since);
    const double most = options_->run.most_energy_gained;
    record.gaining_since = since(most > 0 && !(relative <= most), record.gaining_since);
}

bool BalanceWatch::stands(double since, double t) const {
    constexpr double part_of_run = 0.01;
    return since <= t && (t - since >= part_of_run * options_->run.t_end || !(t < options_->run.t_end));
}

double BalanceWatch::largest_error(const BalanceRecord& record) {
    const double largest = std::max(record.most_gained, record.most_lost);
    return record.largest_entry > 0 ? largest / record.largest_entry : 0;
}

std::string BalanceWatch::text(double t, const BalanceRecord& record) const {
    const bool gained = record.most_gained >= record.most_lost;
    return fmt::format("energy balance: by t = {:.6g} s {:.3g} J, {:.3g} % of the largest energy of the run, {}: {}", t,
                       std::max(record.most_gained, record.most_lost), 100 * largest_error(record),
                       gained ? "have come from nothing" : "have got lost", cause(gained));
}

std::string BalanceWatch::cause(bool gained) const {
    const IntegratorOptions& scheme = options_->integrator;
    const auto is = [&](std::initializer_list<std::string_view> types) {
        return std::ranges::find(types, scheme.type) != types.end();
    };
    if (is_static_) return "load steps too long for what the material remembers (`longest`)";
    const bool bdf = scheme.type == "ida" || (scheme.type == "cvode" && !scheme.adams);
    if (bdf)
        return gained ? "bdf of order 3 to 5 amplifies undamped vibration; a smaller `rtol`, `max_order = 2`, or a "
                        "scheme for vibration"
                      : "bdf damps what its steps do not resolve; a smaller `rtol`, or a scheme for vibration";
    if (is({"cvode", "arkode"}) && (scheme.type == "cvode" || scheme.dt == 0))
        return "steps at the limit of stability, which errors within `rtol` do not show; a smaller `rtol`, or a scheme "
               "for vibration";
    if (is({"arkode", "mri"})) return "steps too long; a smaller `dt`";
    if (is({"generalized_alpha", "newmark", "hht_alpha", "bathe"}))
        return gained ? "steps too long for contact, cracks or large rotations; a smaller `dt` or `rtol`"
                      : "the scheme damps what its steps do not resolve; a smaller `dt` or `rtol`, or less damping";
    if (scheme.type == "noh_bathe" && !gained)
        return "the scheme damps waves of the length of elements; `split = 0.5`, or another scheme";
    return "steps too long for how fast forces change, in contact or cracks; a smaller `safety`";
}

}  // namespace gneiss
