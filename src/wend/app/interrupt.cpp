#include <wend/app/interrupt.h>

#include <atomic>
#include <csignal>

namespace wend {
namespace {

// A signal handler can reach nothing but an object of static storage.
std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void remember_interrupt(int signal) {
    interrupted = true;
    std::signal(signal, SIG_DFL);
}

}  // namespace

InterruptGuard::InterruptGuard() {
    interrupted = false;
    std::signal(SIGINT, remember_interrupt);
    std::signal(SIGTERM, remember_interrupt);
}

InterruptGuard::~InterruptGuard() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

bool InterruptGuard::requested() const {
    return interrupted;
}

const std::atomic<bool>& InterruptGuard::flag() const {
    return interrupted;
}

}  // namespace wend
