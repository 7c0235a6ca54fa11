#include "io/output/stop_request.hpp"

#include <stdexcept>

namespace gneiss {
namespace {

std::atomic<bool> alive{false};

/// Replaces the handler of `signal` unless the process was started with that signal ignored. Returns the former one.
struct sigaction install(int signal, void (*handler)(int), int flags) {
    struct sigaction former {};
    sigaction(signal, nullptr, &former);
    if ((former.sa_flags & SA_SIGINFO) == 0 && former.sa_handler == SIG_IGN) return former;

    struct sigaction ours {};
    ours.sa_handler = handler;
    sigemptyset(&ours.sa_mask);
    ours.sa_flags = flags;
    sigaction(signal, &ours, nullptr);
    return former;
}

}  // namespace

StopRequest::StopRequest() {
    if (alive.exchange(true)) throw std::logic_error("StopRequest: one at a time, signals belong to the whole process");
    signal_ = 0;
    // SA_RESTART: reads and writes under way go on. SA_RESETHAND: the second SIGINT finds the default, which kills.
    former_interrupt_ = install(SIGINT, on_signal, SA_RESTART | SA_RESETHAND);
    former_terminate_ = install(SIGTERM, on_signal, SA_RESTART);
}

StopRequest::~StopRequest() {
    sigaction(SIGINT, &former_interrupt_, nullptr);
    sigaction(SIGTERM, &former_terminate_, nullptr);
    alive = false;
}

int StopRequest::exit_code() const {
    const int signal = signal_.load();
    return signal == 0 ? 0 : 128 + signal;
}

void StopRequest::on_signal(int signal) {
    int none = 0;
    signal_.compare_exchange_strong(none, signal);
}

}  // namespace gneiss
