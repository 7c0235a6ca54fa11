#include "base/suggest.hpp"

#include <algorithm>
#include <cctype>

namespace gneiss {

std::size_t edit_distance(std::string_view a, std::string_view b) {
    const auto same = [](char p, char q) {
        return std::tolower(static_cast<unsigned char>(p)) == std::tolower(static_cast<unsigned char>(q));
    };
    std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = last[j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
            if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1])) {
                row[j] = std::min(row[j], before_last[j - 2] + 1);
            }
        }
        before_last = last;
        last = row;
    }
    return last[b.size()];
}

std::string_view nearest(std::string_view given, const std::vector<std::string_view>& candidates) {
    std::string_view best;
    std::size_t best_distance = given.size() <= 3 ? 2 : given.size() <= 7 ? 3 : 4;  // one more than is near enough
    for (std::string_view candidate : candidates) {
        const std::size_t distance = edit_distance(given, candidate);
        if (distance < best_distance && distance < candidate.size()) {
            best = candidate;
            best_distance = distance;
        }
    }
    return best;
}

std::string suggestion(std::string_view given, const std::vector<std::string_view>& candidates) {
    const std::string_view name = nearest(given, candidates);
    return name.empty() ? std::string() : ", did you mean `" + std::string(name) + "`?";
}

}  // namespace gneiss
