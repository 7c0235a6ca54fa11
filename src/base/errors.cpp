#include "base/errors.hpp"

namespace gneiss {
namespace {

std::string one_line_each(const std::vector<Problem>& problems) {
    std::string text;
    for (const Problem& problem : problems) {
        if (!text.empty()) text += '\n';
        if (!problem.where.empty()) text += problem.where + ": ";
        text += problem.message;
    }
    return text;
}

}  // namespace

InputError::InputError(std::vector<Problem> problems)
    : std::runtime_error(one_line_each(problems)), problems_(std::move(problems)) {}

InputError::InputError(std::string where, std::string message)
    : InputError(std::vector<Problem>{{std::move(where), std::move(message)}}) {}

}  // namespace gneiss
