// How long a render has taken.
#pragma once

#include <algorithm>
#include <chrono>

namespace wend {

/// Counts from when it is made, and what was spent before.
class SpentTime {
public:
    using Clock = std::chrono::steady_clock;

    /// `before`: seconds, not negative.
    explicit SpentTime(double before = 0) : before_(before) {}

    double seconds() const { return before_ + std::chrono::duration<double>(Clock::now() - start_).count(); }

    /// When so many seconds will have been spent; now or in the past where they have been.
    Clock::time_point when_spent(double seconds) const {
        // Longer than any render, and less than the clock can count.
        constexpr double longest = 1e9;
        return start_ + std::chrono::duration_cast<Clock::duration>(
                            std::chrono::duration<double>(std::clamp(seconds - before_, 0.0, longest)));
    }

private:
    double before_;
    Clock::time_point start_ = Clock::now();
};

}  // namespace wend
