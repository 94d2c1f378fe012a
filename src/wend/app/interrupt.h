#pragma once

#include <csignal>

#include <array>
#include <atomic>

namespace wend {

/// While it lives, SIGINT, SIGTERM and SIGHUP no longer kill the program but ask it to come to an end: walks are
/// dropped where they are, and the picture is written. A second signal ends it at once, and leaves no half-written
/// file. One that the program was started to ignore stays ignored. Nor does it end with a reader of what it tells, such
/// as a monitor of its progress: from then on that is told to nobody.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    bool is_requested() const { return flag(); }
    const std::atomic<bool>& flag() const;
    /// Of the signal that came while the newest guard lived; 0 where there was none.
    static int signal();

private:
    static constexpr std::array<int, 3> signals{SIGINT, SIGTERM, SIGHUP};
    std::array<struct sigaction, signals.size()> before_{};
    struct sigaction pipe_before_ {};
};

/// Thrown by a subcommand that a signal has ended, once all is written: the program's exit status is 128 and its
/// number.
struct EndedBySignal {
    int number;
};

}  // namespace wend
