#pragma once
// The progress of a run on stderr: a bar on a terminal, now and then a plain line elsewhere.

#include <cstdint>
#include <functional>
#include <string_view>

#include "io/output/progress_line.hpp"

namespace gneiss {

struct ProgressOptions {
    bool quiet = false;  ///< show nothing
    double t_start = 0;  ///< simulated time at which this part of the run begins, s; not 0 after a restart
    int descriptor = 2;  ///< where to write: stderr
    std::function<double()> clock = {};  ///< wall time, s; the steady clock if none: tests bring their own
};

/// Shows where a run is. Call update() after every step: it costs a nanosecond, since it looks at the clock only about
/// fifty times a second, however long a step takes, and asks for the state only when it is about to show it.
///
/// On a terminal a bar is drawn at most eight times a second, as wide as the terminal is at that moment. It is
/// overwritten in place, never erased first, and the cursor waits at its beginning, so that whatever is written next
/// takes its place. Elsewhere, a line comes every record_interval(). Errors of writing are ignored: a run does not fail
/// because nobody watches.
class Progress {
public:
    explicit Progress(ProgressOptions options = {});

    /// @param state  called only when the state will be shown; returns a ProgressState
    template <class F>
    void update(F&& state) {
        if (--countdown_ > 0) return;
        if (is_due()) show(state());
    }

    /// The last line, with a newline. @param word  "done", "stopped", "failed"
    void finish(std::string_view word, const ProgressState& state);

    static constexpr double refresh_interval = 0.125;  ///< s between two pictures of the bar
    static constexpr double check_interval = 0.02;     ///< s between two looks at the clock, about

private:
    /// Looks at the clock and sets how many calls to let pass until the next look.
    bool is_due();
    void show(const ProgressState& state);
    int terminal_width() const;

    ProgressOptions options_;
    bool on_terminal_;
    double start_, last_look_, last_shown_;  // wall time, s
    TimeLeft time_left_;
    std::int64_t countdown_ = 1, calls_between_looks_ = 1;
};

}  // namespace gneiss
