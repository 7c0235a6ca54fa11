#pragma once
// Gmsh as a quiet library: one use at a time, its failures as our exceptions, its changes to the process undone.

#include <gmsh.h>

#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <type_traits>
#include <vector>

#include "base/errors.hpp"

namespace gneiss {

/// Gmsh is initialised while one of these lives; every session starts with Gmsh's default options. It prints nothing
/// unless asked to, reads no configuration and never ends the process. initialize() sets the number of OpenMP threads
/// to one and the locale to the user's: the destructor gives back what was there.
class GmshSession {
public:
    /// @param aloud  what Gmsh says goes to stdout and stderr too
    explicit GmshSession(bool aloud = false);
    ~GmshSession();
    GmshSession(const GmshSession&) = delete;
    GmshSession& operator=(const GmshSession&) = delete;

    /// The result of call(). Gmsh is told not to throw, since an exception on its way through Gmsh's parser leaves half
    /// a file in the parser's buffer, and one in its meshing threads ends the process; its log says what went wrong.
    /// @param where     the file that Gmsh is at work on
    /// @param harmless  whether an error is none, asked after the call: it joins the warnings
    /// @throws InputError with every other error that Gmsh reported during the call
    template <class Call>
    auto run(const std::string& where, Call&& call, const std::function<bool(const std::string&)>& harmless = {}) {
        const std::size_t n_before = errors().size();
        try {
            if constexpr (std::is_void_v<decltype(call())>) {
                call();
                throw_errors(where, n_before, harmless);
            } else {
                auto result = call();
                throw_errors(where, n_before, harmless);
                return result;
            }
        } catch (const std::string& message) {  // some functions of the interface throw all the same
            throw InputError(where, "Gmsh: " + message);
        }
    }

    /// A file that Gmsh reads goes by this name in its messages from now on.
    void call(const std::string& file, const std::string& name) { names_[file] = name; }

    /// What Gmsh has warned of so far, and its errors that were harmless.
    std::vector<std::string> warnings() const;

private:
    std::vector<std::string> errors() const { return log_lines("Error: "); }
    /// Without the summary that Gmsh prints after meshing, a frame of dashes around what it has said before.
    std::vector<std::string> log_lines(const std::string& prefix) const;
    void throw_errors(const std::string& where, std::size_t n_before,
                      const std::function<bool(const std::string&)>& harmless);

    std::unique_lock<std::mutex> lock_;
    int n_threads_;
    std::string locale_;
    std::map<std::string, std::string> names_;
    std::vector<std::string> harmless_;
};

}  // namespace gneiss
