#include "app/finished_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/errors.hpp"
#include "io/output/atomic_file.hpp"
#include "io/output/summary.hpp"

namespace gneiss {

void keep_finished_run(const std::filesystem::path& folder, const std::vector<std::string>& own) {
    const std::filesystem::path file = folder / "summary.json";
    if (!std::filesystem::exists(file)) return;
    const auto summary = nlohmann::json::parse(read_file(file), nullptr, false);
    if (!summary.is_object() || summary.value("status", "") != name_of(RunStatus::done)) return;
    if (std::ranges::find(own, summary.value("deck_fingerprint", "")) != own.end()) return;
    throw InputError(
        folder.string(),
        fmt::format("holds a finished run of another deck, or of this one before it was changed ({}{}): "
                    "--overwrite replaces it, --out takes another folder",
                    summary.value("deck", "unknown"),
                    summary.contains("overrides")
                        ? fmt::format(" --set {}", fmt::join(summary["overrides"].get<std::vector<std::string>>(), " "))
                        : ""));
}

}  // namespace gneiss
