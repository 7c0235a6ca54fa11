#pragma once
// run.log: what a run did, in records like "step: t = 1e-3, dt = 2e-7". Warnings and errors go to stderr too.

#include <spdlog/logger.h>

#include <filesystem>
#include <memory>

namespace gneiss {

struct RunLogOptions {
    std::filesystem::path path;  ///< of the file; none: stderr only
    bool append = false;         ///< after a restart: keep what the file holds
    bool quiet = false;          ///< only errors on stderr, no warnings; the file gets everything
    bool verbose = false;        ///< records of level debug too, in the file
};

/// A logger that is not registered anywhere and ends with its last owner. Records of level info and above are in the
/// file at once, so that the log of a crash is complete; it grows line by line and is the one file that is not
/// written atomically. On a terminal a record takes the place of the progress bar, which is drawn again below it.
/// @throws IoError if the file cannot be opened
std::shared_ptr<spdlog::logger> open_run_log(const RunLogOptions& options);

}  // namespace gneiss
