#pragma once
// The two kinds of failure a user can meet. Programmer errors are assertions.

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gneiss {

/// One thing that is wrong with what the user gave.
struct Problem {
    std::string where;    ///< "case.toml:12:8", "mesh.msh", or empty where the input has no place
    std::string message;  ///< key, what was given, what is allowed, a suggestion where one exists
};

/// Bad input: a deck, a mesh, an option out of its range. Carries every problem that was found, not only the first.
class InputError : public std::runtime_error {
public:
    explicit InputError(std::vector<Problem> problems);
    InputError(std::string where, std::string message);

    const std::vector<Problem>& problems() const { return problems_; }

private:
    std::vector<Problem> problems_;
};

/// A numerical failure that a solver may answer by trying again with a smaller step: an inverted element, say.
class RecoverableError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace gneiss
