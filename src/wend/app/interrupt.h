#pragma once

namespace wend {

/// While it lives, SIGINT and SIGTERM no longer kill the program but ask it to come to an end: the pass is finished and
/// the picture written. A second signal kills.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    bool requested() const;
};

}  // namespace wend
