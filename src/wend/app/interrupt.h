#pragma once

#include <atomic>

namespace wend {

/// While it lives, SIGINT and SIGTERM no longer kill the program but ask it to come to an end: walks are dropped where
/// they are, and the picture is written. A second signal kills.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    bool requested() const;
    const std::atomic<bool>& flag() const;
};

}  // namespace wend
