#pragma once
// What the progress of a run looks like, as text. Pure functions: no clock, no terminal.

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace gneiss {

/// Where a run is.
struct ProgressState {
    double t = 0;           ///< simulated time, s
    double t_end = 0;       ///< its end, s
    std::int64_t step = 0;  ///< steps done
    double dt = 0;          ///< present step, s
    double balance_error =
        std::numeric_limits<double>::quiet_NaN();  ///< of the energy, relative; nan: not known, not shown
    std::vector<std::string> extra = {};           ///< what else there is to say, most important first: "12 cracks"
    std::string within = {};  ///< where a long step stands, instead of dt and balance: "iteration 300"
};

/// Estimates the wall time left from how fast simulated time passes: the mean over the last `memory` seconds of wall
/// time, older speeds fading out exponentially.
class TimeLeft {
public:
    static constexpr double memory = 10.0;  ///< s; short enough to follow a changing step, long enough to read

    TimeLeft(double t_start, double wall_start) : t_(t_start), wall_(wall_start) {}

    /// @param t     simulated time, s
    /// @param wall  clock, s, of any origin
    void observe(double t, double wall);

    /// Wall time until `t_end`, s; nan before anything could be measured.
    double until(double t_end) const;

private:
    double t_, wall_;    // last observation
    double speed_ = 0;   // simulated seconds per second
    double weight_ = 0;  // of the observations in speed_, 0 to 1: corrects the start from nothing
};

/// "0.4 s", "4 s", "1 min 05 s", "2 h 03 min", "3 d 04 h"; "--" for nan.
std::string duration_text(double seconds);

/// The bar of a terminal: `[####------]  40 %  t = 8.00e-03 / 2.00e-02 s  step 12000  dt = 2.0e-07 s  left 1 min 05 s
/// balance error 3.1e-05  12 cracks`. Of fields that do not fit, the less important ones are left out; a bar of at
/// least ten marks takes what is left over.
/// @param width  columns of the terminal; the line is at most width - 1 long, so that no terminal wraps it
std::string progress_bar(const ProgressState& state, double left, int width);

/// The same in one plain line of any length, with the wall time spent, for logs.
std::string progress_record(const ProgressState& state, double elapsed, double left);

/// The last line: "done: t = 0.02 s, 100000 steps in 1 min 05 s, balance error 3.1e-05". @param word  "done", "stopped"
std::string final_line(std::string_view word, const ProgressState& state, double elapsed);

/// Number of columns that a UTF-8 text takes, as far as every character takes one.
int display_width(std::string_view text);

/// Wall time between two plain lines of a log, s: 10 s at first, then a twentieth of the time spent, at most 5 min. A
/// minute gives 6 lines, an hour 80, and nobody waits long for a sign of life.
double record_interval(double elapsed);

}  // namespace gneiss
