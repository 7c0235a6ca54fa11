#include "io/output/run_log.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <unistd.h>

#include <vector>

#include "io/output/atomic_file.hpp"

namespace gneiss {

std::shared_ptr<spdlog::logger> open_run_log(const RunLogOptions& options) {
    std::vector<spdlog::sink_ptr> sinks;
    auto on_stderr = std::make_shared<spdlog::sinks::stderr_sink_mt>();
    on_stderr->set_level(options.quiet ? spdlog::level::err : spdlog::level::warn);
    // On a terminal the progress bar may stand where the record goes: erase it first (ECMA-48 ED).
    on_stderr->set_pattern(::isatty(STDERR_FILENO) == 1 ? "\r\x1b[Jgneiss: %l: %v" : "gneiss: %l: %v");
    sinks.push_back(std::move(on_stderr));

    if (!options.path.empty()) {
        try {
            auto file = std::make_shared<spdlog::sinks::basic_file_sink_mt>(options.path.string(), !options.append);
            file->set_pattern("%Y-%m-%d %H:%M:%S.%e %-5l %v");
            sinks.push_back(std::move(file));
        } catch (const spdlog::spdlog_ex& error) {
            throw IoError(options.path, std::string("cannot open the log: ") + error.what());
        }
    }

    auto log = std::make_shared<spdlog::logger>("gneiss", sinks.begin(), sinks.end());
    log->set_level(options.verbose ? spdlog::level::debug : spdlog::level::info);
    log->flush_on(spdlog::level::info);
    return log;
}

}  // namespace gneiss
