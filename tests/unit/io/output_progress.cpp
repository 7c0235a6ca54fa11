#include "io/output/progress.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "unit/io/output_folder.hpp"

namespace gneiss {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

ProgressState example() { return {0.008, 0.02, 12000, 2e-7, 3.14e-5, {"12 cracks"}, {}}; }

std::size_t count(const std::string& text, std::string_view what) {
    std::size_t n = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size())) ++n;
    return n;
}

// ---- text -----------------------------------------------------------------------------------------------------------

TEST(ProgressBar, WideTerminal_HasEveryField) {
    EXPECT_EQ(
        progress_bar(example(), 65, 200),
        "[################------------------------]   40 %  t = 8.00e-03 / 2.00e-02 s  step 12000  dt = 2.0e-07 s  "
        "left 1 min 05 s  balance error 3.1e-05  12 cracks");
}

TEST(ProgressBar, NarrowerTerminals_LoseTheLeastImportantFields) {
    EXPECT_EQ(progress_bar(example(), 65, 120),
              "[######---------]   40 %  t = 8.00e-03 / 2.00e-02 s  step 12000  dt = 2.0e-07 s  left 1 min 05 s  "
              "balance error 3.1e-05");
    EXPECT_EQ(progress_bar(example(), 65, 80),
              "[##########----------------]   40 %  t = 8.00e-03 / 2.00e-02 s  left 1 min 05 s");
    EXPECT_EQ(progress_bar(example(), 65, 40), "[#####--------]   40 %  left 1 min 05 s");
    EXPECT_EQ(progress_bar(example(), 65, 24), "[#####---------]   40 %");
    EXPECT_EQ(progress_bar(example(), 65, 8), " 40 %");
}

TEST(ProgressBar, WithinAStep_ItsStateTakesThePlaceOfStepLengthAndBalance) {
    ProgressState state = example();
    state.within = "iteration 300: 1.2e-03 out of balance";
    EXPECT_EQ(progress_bar(state, 65, 200),
              "[################------------------------]   40 %  t = 8.00e-03 / 2.00e-02 s  step 12000  "
              "iteration 300: 1.2e-03 out of balance  left 1 min 05 s  12 cracks");
    EXPECT_THAT(progress_bar(state, 65, 80), HasSubstr("iteration 300"));
}

TEST(ProgressBar, AnyWidth_FitsAndNeverShrinksWithMoreRoom) {
    ProgressState state = example();
    state.extra = {"12 cracks", "3 Stücke"};  // the ü is two bytes and one column
    for (int width = 0; width < 250; ++width)
        EXPECT_LE(display_width(progress_bar(state, 65, width)), std::max(0, width - 1)) << width;
    EXPECT_THAT(progress_bar(state, 65, 250), EndsWith("  12 cracks  3 Stücke"));
}

TEST(ProgressBar, Ends_AreEmptyAndFull) {
    EXPECT_EQ(progress_bar({0, 1, 0, 1e-3}, unknown, 24), "[--------------]    0 %");
    EXPECT_EQ(progress_bar({1, 1, 10, 1e-3}, 0, 24), "[##############]  100 %");
    EXPECT_EQ(progress_bar({0.99999, 1, 10, 1e-3}, 0, 24), "[#############-]   99 %");
    EXPECT_EQ(progress_bar({1.5, 1, 10, 1e-3}, 0, 24), "[##############]  100 %");
    EXPECT_EQ(progress_bar({unknown, 1, 10, 1e-3}, 0, 24), "[--------------]    0 %");
}

TEST(ProgressBar, UnknownNumbers_AreLeftOutOrDashed) {
    const std::string line = progress_bar({0, 1, 0, 1e-3}, unknown, 200);
    EXPECT_THAT(line, HasSubstr("left --"));
    EXPECT_THAT(line, Not(HasSubstr("balance")));
}

TEST(ProgressRecord, HasEveryFieldInOneLine) {
    EXPECT_EQ(
        progress_record(example(), 43, 65),
        "progress: 43 s spent, 40 %, t = 8.00e-03 / 2.00e-02 s, step 12000, dt = 2.0e-07 s, left 1 min 05 s, balance "
        "error 3.1e-05, 12 cracks");
}

TEST(FinalLine, TellsHowItEnded) {
    EXPECT_EQ(final_line("done", example(), 65),
              "done: t = 0.008 s, 12000 steps in 1 min 05 s, balance error 3.1e-05, 12 cracks");
}

TEST(DurationText, HasTwoUnitsAtMost) {
    EXPECT_EQ(duration_text(0), "0 s");
    EXPECT_EQ(duration_text(0.43), "0.4 s");
    EXPECT_EQ(duration_text(0.96), "1 s");
    EXPECT_EQ(duration_text(59.4), "59 s");
    EXPECT_EQ(duration_text(59.6), "1 min 00 s");
    EXPECT_EQ(duration_text(7384), "2 h 03 min");
    EXPECT_EQ(duration_text(273600), "3 d 04 h");
    EXPECT_EQ(duration_text(unknown), "--");
    EXPECT_EQ(duration_text(std::numeric_limits<double>::infinity()), "--");
    EXPECT_EQ(duration_text(-1), "--");
}

TEST(TimeLeft, SteadySpeed_IsExactFromTheFirstObservation) {
    constexpr double round_off = 1e-12;  // some tens of operations on numbers of order 1
    TimeLeft left(0.5, 100);
    EXPECT_TRUE(std::isnan(left.until(1)));
    for (int i = 1; i <= 50; ++i) {
        left.observe(0.5 + 0.001 * i, 100 + 0.1 * i);
        EXPECT_NEAR(left.until(1), (0.5 - 0.001 * i) / 0.01, round_off * 50) << i;
    }
}

TEST(TimeLeft, ChangedSpeed_IsFollowedWithinSomeMemories) {
    TimeLeft left(0, 0);
    for (int i = 1; i <= 1000; ++i) left.observe(0.1 * i, 0.1 * i);              // 1 s/s up to t = 100
    for (int i = 1; i <= 500; ++i) left.observe(100 + 0.01 * i, 100 + 0.1 * i);  // then 0.1 s/s for 50 s
    // Five memories at the new speed, ten before at the old one, none before those.
    const double speed = (0.1 * (1 - std::exp(-5.0)) + std::exp(-5.0) * (1 - std::exp(-10.0))) / (1 - std::exp(-15.0));
    constexpr double round_off = 1e-9;  // hundreds of exponentials
    EXPECT_NEAR(left.until(105 + 1), 1 / speed, round_off);
}

TEST(TimeLeft, NoProgress_IsUnknown) {
    TimeLeft left(1, 0);
    left.observe(1, 10);
    EXPECT_TRUE(std::isnan(left.until(2)));
}

TEST(RecordInterval, GrowsFromTenSecondsToFiveMinutes) {
    EXPECT_EQ(record_interval(0), 10);
    EXPECT_EQ(record_interval(200), 10);
    EXPECT_EQ(record_interval(1200), 60);
    EXPECT_EQ(record_interval(1e6), 300);
}

// ---- on a pipe and on a terminal ------------------------------------------------------------------------------------

/// Two ends of a pipe or of a pseudo-terminal: what is written to `near` is read at `far`.
struct Channel {
    int near = -1, far = -1;

    static Channel pipe() {
        int ends[2];
        if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
        return {ends[1], ends[0]};
    }
    static Channel terminal(unsigned short columns) {
        const int far = ::posix_openpt(O_RDWR | O_NOCTTY);
        if (far < 0 || ::grantpt(far) != 0 || ::unlockpt(far) != 0) throw std::runtime_error("no pseudo-terminal");
        const int near = ::open(::ptsname(far), O_RDWR | O_NOCTTY);
        struct termios mode {};
        ::tcgetattr(near, &mode);
        ::cfmakeraw(&mode);  // bytes as they are
        ::tcsetattr(near, TCSANOW, &mode);
        Channel channel{near, far};
        channel.resize(columns);
        return channel;
    }
    void resize(unsigned short columns) const {
        const struct winsize size { 24, columns, 0, 0 };
        ::ioctl(near, TIOCSWINSZ, &size);
    }
    /// What has been written since the last call.
    std::string read_all() const {
        ::fcntl(far, F_SETFL, O_NONBLOCK);
        std::string text;
        char buffer[4096];
        for (ssize_t n; (n = ::read(far, buffer, sizeof buffer)) > 0;) text.append(buffer, static_cast<std::size_t>(n));
        return text;
    }
    void close() const {
        ::close(near);
        ::close(far);
    }
};

class ProgressOutput : public ::testing::Test {
protected:
    ProgressOutput() { ::setenv("TERM", "xterm", 1); }
    ~ProgressOutput() override { channel.close(); }

    ProgressOptions options(bool quiet = false) {
        return {quiet, 0.0, channel.near, [this] {
                    ++looks;
                    return wall;
                }};
    }
    /// Runs steps of `step_time` wall seconds for `seconds`.
    void run(Progress& progress, double seconds, double step_time) {
        const auto n = std::llround(seconds / step_time);
        for (long long i = 0; i < n; ++i) {
            wall += step_time;
            progress.update([&] {
                ++states;
                return ProgressState{wall / 1000, 1, ++step, 1e-6, 1e-5, {}, {}};
            });
        }
    }

    Channel channel;
    double wall = 0;
    std::int64_t step = 0;
    int looks = 0, states = 0;
};

TEST_F(ProgressOutput, Pipe_GetsPlainLinesNowAndThen) {
    channel = Channel::pipe();
    Progress progress(options());
    run(progress, 65, 0.001);
    const std::string text = channel.read_all();
    EXPECT_EQ(count(text, "\n"), 6u);
    EXPECT_EQ(count(text, "\x1b"), 0u);
    EXPECT_EQ(count(text, "\r"), 0u);
    EXPECT_THAT(text, StartsWith("progress: 10 s spent, 1 %"));
    EXPECT_THAT(text, HasSubstr("left 16 min 30 s"));  // 1000 s in all, 10 s spent
    progress.finish("done", example());
    EXPECT_EQ(channel.read_all(), final_line("done", example(), 65) + "\n");
}

TEST_F(ProgressOutput, Terminal_GetsABarEightTimesASecondAtMost) {
    channel = Channel::terminal(80);
    Progress progress(options());
    run(progress, 10, 0.001);
    EXPECT_GE(states, 60);
    EXPECT_LE(states, 81);
    const std::string text = channel.read_all();
    EXPECT_EQ(count(text, "\n"), 0u);
    EXPECT_THAT(text, StartsWith("\r["));
    EXPECT_THAT(text, EndsWith("\x1b[J\r"));
    EXPECT_EQ(count(text, "\x1b[J"), static_cast<std::size_t>(states));
}

TEST_F(ProgressOutput, TerminalResized_NextBarHasTheNewWidth) {
    channel = Channel::terminal(80);
    Progress progress(options());
    const auto widest = [&] {
        run(progress, 1, 0.01);
        std::size_t width = 0, begin = 0;
        const std::string text = channel.read_all();
        for (std::size_t at = text.find("\x1b[J"); at != std::string::npos; at = text.find("\x1b[J", begin)) {
            width = std::max(width, at - begin - 1);  // without the carriage return
            begin = at + 4;
        }
        return width;
    };
    EXPECT_LE(widest(), 79u);
    channel.resize(40);
    EXPECT_LE(widest(), 39u);
    channel.resize(200);
    EXPECT_GT(widest(), 100u);
}

TEST_F(ProgressOutput, TerminalAtTheEnd_HasOneLineInsteadOfTheBar) {
    channel = Channel::terminal(80);
    Progress progress(options());
    run(progress, 1, 0.01);
    channel.read_all();
    progress.finish("stopped", example());
    EXPECT_EQ(channel.read_all(), "\r\x1b[J" + final_line("stopped", example(), 1) + "\n");
}

TEST_F(ProgressOutput, DumbTerminal_GetsPlainLines) {
    channel = Channel::terminal(80);
    ::setenv("TERM", "dumb", 1);
    Progress progress(options());
    run(progress, 15, 0.01);
    EXPECT_THAT(channel.read_all(), StartsWith("progress: 10 s spent"));
}

TEST_F(ProgressOutput, Quiet_WritesNothingAndAsksForNothing) {
    channel = Channel::terminal(80);
    Progress progress(options(true));
    run(progress, 100, 0.01);
    progress.finish("done", example());
    EXPECT_EQ(channel.read_all(), "");
    EXPECT_EQ(states, 0);
}

TEST_F(ProgressOutput, FastSteps_LookAtTheClockSeldom) {
    channel = Channel::pipe();
    Progress progress(options());
    run(progress, 1, 1e-6);
    // 50 looks a second and 14 doublings on the way there.
    EXPECT_LE(looks, 50 + 14 + 5);
}

TEST_F(ProgressOutput, StepsBecomeSlow_ShowsSoonAgain) {
    channel = Channel::terminal(80);
    Progress progress(options());
    run(progress, 1, 1e-3);
    const int before = states;
    run(progress, 30, 0.5);
    // At most the twenty calls of the last fast look pass unseen, then every slow step is shown.
    EXPECT_GE(states - before, 60 - 20);
}

TEST_F(ProgressOutput, ClosedPipe_IsNoFailure) {
    channel = Channel::pipe();
    ::close(channel.near);
    Progress progress(options());
    run(progress, 65, 0.01);
    progress.finish("done", example());
    EXPECT_GT(states, 0);
    channel.near = -1;
}

}  // namespace
}  // namespace gneiss
