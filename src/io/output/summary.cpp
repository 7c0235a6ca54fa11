#include "io/output/summary.hpp"

#include <cmath>

#include "io/output/atomic_file.hpp"
#include "io/output/version.hpp"

namespace gneiss {
namespace {

using nlohmann::ordered_json;

/// Replaces every number that is not finite by null and adds "POINTER: VALUE" to `found`.
void replace_not_finite(ordered_json& value, const ordered_json::json_pointer& where, ordered_json& found) {
    if (value.is_object()) {
        for (auto& [key, child] : value.items()) replace_not_finite(child, where / key, found);
    } else if (value.is_array()) {
        for (std::size_t i = 0; i < value.size(); ++i) replace_not_finite(value[i], where / i, found);
    } else if (value.is_number_float() && !std::isfinite(value.get<double>())) {
        const double number = value.get<double>();
        found.push_back(where.to_string() + (std::isnan(number) ? ": nan" : number > 0 ? ": inf" : ": -inf"));
        value = nullptr;
    }
}

}  // namespace

std::string_view name_of(RunStatus status) {
    switch (status) {
        case RunStatus::running:
            return "running";
        case RunStatus::done:
            return "done";
        case RunStatus::failed:
            return "failed";
        case RunStatus::interrupted:
            return "interrupted";
    }
    return "failed";  // not reached: every status is above
}

nlohmann::ordered_json to_json(const RunSummary& summary) {
    ordered_json json;
    json["status"] = name_of(summary.status);
    if (!summary.message.empty()) json["message"] = summary.message;
    if (!summary.balance_warning.empty()) json["balance_warning"] = summary.balance_warning;
    if (!summary.warnings.empty()) json["warnings"] = summary.warnings;
    json["title"] = summary.title;
    json["version"] = version_string();
    json["deck_fingerprint"] = summary.deck_fingerprint;
    for (const auto& [key, group] : summary.groups.items()) json[key] = group;
    ordered_json not_finite = ordered_json::array();
    replace_not_finite(json, ordered_json::json_pointer(), not_finite);
    if (!not_finite.empty()) json["not_finite"] = not_finite;
    return json;
}

void write_summary(const std::filesystem::path& path, const RunSummary& summary) {
    constexpr int indent = 2;
    // `replace`: a title with bad bytes is no reason to lose the results.
    write_atomically(path, to_json(summary).dump(indent, ' ', false, ordered_json::error_handler_t::replace) + '\n');
}

}  // namespace gneiss
