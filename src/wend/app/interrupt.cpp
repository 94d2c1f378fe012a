#include <wend/app/interrupt.h>

#include <wend/io/atomic_file.h>

#include <unistd.h>

#include <cstddef>

namespace wend {
namespace {

constexpr int ended_by_signal = 128;

// A signal handler can reach nothing but objects of static storage.
std::atomic<bool> interrupted = false;
std::atomic<int> signal_number = 0;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

extern "C" void remember_interrupt(int signal) {
    if (interrupted) {
        remove_unfinished_files();
        _exit(ended_by_signal + signal);
    }
    signal_number = signal;
    interrupted = true;
}

}  // namespace

InterruptGuard::InterruptGuard() {
    signal_number = 0;
    interrupted = false;
    struct sigaction action {};
    action.sa_handler = remember_interrupt;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    for (std::size_t i = 0; i < signals.size(); ++i) {
        sigaction(signals[i], nullptr, &before_[i]);
        if (before_[i].sa_handler != SIG_IGN) {
            sigaction(signals[i], &action, nullptr);
        }
    }
    action.sa_handler = SIG_IGN;
    sigaction(SIGPIPE, &action, &pipe_before_);
}

InterruptGuard::~InterruptGuard() {
    for (std::size_t i = 0; i < signals.size(); ++i) {
        sigaction(signals[i], &before_[i], nullptr);
    }
    sigaction(SIGPIPE, &pipe_before_, nullptr);
}

const std::atomic<bool>& InterruptGuard::flag() const {
    return interrupted;
}

int InterruptGuard::signal() {
    return signal_number;
}

}  // namespace wend
