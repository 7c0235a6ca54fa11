#pragma once
// Gmsh as a quiet library: one use at a time, its failures as our exceptions, its changes to the process undone.

#include <gmsh.h>

#include <mutex>
#include <string>
#include <vector>

#include "base/errors.hpp"

namespace gneiss {

/// Gmsh is initialised while one of these lives; every session starts with Gmsh's default options. It prints nothing,
/// reads no configuration and never ends the process. initialize() sets the number of OpenMP threads to one and the
/// locale to the user's: the destructor gives back what was there.
class GmshSession {
public:
    GmshSession();
    ~GmshSession();
    GmshSession(const GmshSession&) = delete;
    GmshSession& operator=(const GmshSession&) = delete;

    /// The result of call(). Gmsh throws its messages as strings; they leave here as InputError.
    /// @param where  the file that Gmsh is at work on
    template <class Call>
    auto run(const std::string& where, Call&& call) const {
        try {
            return call();
        } catch (const std::string& message) {
            throw InputError(where, "Gmsh: " + message);
        } catch (int code) {
            throw InputError(where, "Gmsh gave up with code " + std::to_string(code));
        }
    }

    /// What Gmsh has warned of so far.
    std::vector<std::string> warnings() const;

private:
    std::unique_lock<std::mutex> lock_;
    int n_threads_;
    std::string locale_;
};

}  // namespace gneiss
