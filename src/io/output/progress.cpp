#include "io/output/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <string>

#include "io/output/atomic_file.hpp"

namespace gneiss {
namespace {

constexpr int usual_width = 80;                      // of a terminal that does not tell
constexpr std::string_view erase_to_end = "\x1b[J";  // ECMA-48 ED: from the cursor to the end of the screen

double steady_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool is_terminal(int descriptor) {
    const char* kind = std::getenv("TERM");
    return ::isatty(descriptor) == 1 && !(kind && std::string_view(kind) == "dumb");
}

void write_quietly(int descriptor, const std::string& text) {
    try {
        write_all(descriptor, text, "stderr");
    } catch (const IoError&) {
        // Nobody reads it; the run goes on.
    }
}

ProgressOptions with_clock(ProgressOptions options) {
    if (!options.clock) options.clock = steady_seconds;
    return options;
}

}  // namespace

Progress::Progress(ProgressOptions options)
    : options_(with_clock(std::move(options))),
      on_terminal_(is_terminal(options_.descriptor)),
      start_(options_.clock()),
      last_look_(start_),
      // The bar is there from the first step on; a log waits for its first line.
      last_shown_(on_terminal_ ? start_ - refresh_interval : start_),
      time_left_(options_.t_start, start_) {
    if (options_.quiet) countdown_ = std::numeric_limits<std::int64_t>::max();
}

bool Progress::is_due() {
    const double now = options_.clock();
    // Steps may suddenly take longer: at most double the calls, but drop at once.
    const double per_call = (now - last_look_) / static_cast<double>(calls_between_looks_);
    const double wanted = per_call > 0 ? check_interval / per_call : std::numeric_limits<double>::infinity();
    calls_between_looks_ =
        static_cast<std::int64_t>(std::clamp(wanted, 1.0, 2.0 * static_cast<double>(calls_between_looks_)));
    countdown_ = calls_between_looks_;
    last_look_ = now;
    return now - last_shown_ >= (on_terminal_ ? refresh_interval : record_interval(now - start_));
}

void Progress::show(const ProgressState& state) {
    last_shown_ = last_look_;
    time_left_.observe(state.t, last_look_);
    const double left = time_left_.until(state.t_end);
    if (on_terminal_) {
        // Cursor back to the beginning: if the terminal is made narrower and wraps the line, it goes along with the
        // line's first row, and the next picture erases the others.
        write_quietly(options_.descriptor,
                      fmt::format("\r{}{}\r", progress_bar(state, left, terminal_width()), erase_to_end));
    } else {
        write_quietly(options_.descriptor, progress_record(state, last_look_ - start_, left) + "\n");
    }
}

void Progress::finish(std::string_view word, const ProgressState& state) {
    if (options_.quiet) return;
    const std::string line = final_line(word, state, options_.clock() - start_);
    write_quietly(options_.descriptor,
                  on_terminal_ ? fmt::format("\r{}{}\n", erase_to_end, line) : fmt::format("{}\n", line));
}

int Progress::terminal_width() const {
    struct winsize size {};
    if (::ioctl(options_.descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
    return usual_width;
}

}  // namespace gneiss
