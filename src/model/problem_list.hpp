#pragma once
// Bad input is reported all at once: what is wrong with one entry must not hide what is wrong with the next.

#include <string>
#include <utility>
#include <vector>

#include "base/errors.hpp"

namespace gneiss {

class ProblemList {
public:
    void add(std::string where, std::string message) { problems_.push_back({std::move(where), std::move(message)}); }

    /// Calls `action`. If it throws InputError its problems are kept; those without a place get `where`.
    /// @return true if it did not throw
    template <class Action>
    bool attempt(const std::string& where, Action&& action) {
        try {
            std::forward<Action>(action)();
            return true;
        } catch (const InputError& error) {
            for (const Problem& problem : error.problems()) {
                add(problem.where.empty() ? where : problem.where, problem.message);
            }
            return false;
        }
    }

    /// @throws InputError with everything collected, if there is anything
    void throw_if_any() const {
        if (!problems_.empty()) throw InputError(problems_);
    }

private:
    std::vector<Problem> problems_;
};

}  // namespace gneiss
