#pragma once
// SIGINT and SIGTERM ask a run to finish its step, write a checkpoint and leave.

#include <atomic>
#include <csignal>

namespace gneiss {

/// While it lives, SIGINT and SIGTERM only set a flag that the run asks for between steps. A second SIGINT ends the
/// process at once, as without us: the way out when the step itself hangs. SIGTERM may come more than once (timeout(1)
/// sends two). A signal that the parent process had ignored, by nohup say, stays ignored. The former handlers
/// come back at the end of its life. Signals belong to the whole process: one object at a time.
class StopRequest {
public:
    /// @throws std::logic_error if another one is alive
    StopRequest();
    ~StopRequest();
    StopRequest(const StopRequest&) = delete;
    StopRequest& operator=(const StopRequest&) = delete;

    /// One load; cheap enough for every step.
    bool requested() const { return signal_.load(std::memory_order_relaxed) != 0; }

    /// 130 after SIGINT, 143 after SIGTERM (128 + number, the shell's convention; the first counts), 0 without a
    /// signal.
    int exit_code() const;

private:
    static void on_signal(int signal);

    // Lock-free, hence allowed in a signal handler [C++20, support.signal].
    static inline std::atomic<int> signal_{0};
    static_assert(std::atomic<int>::is_always_lock_free);

    struct sigaction former_interrupt_ {};
    struct sigaction former_terminate_ {};
};

}  // namespace gneiss
