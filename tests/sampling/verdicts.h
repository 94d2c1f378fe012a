// Two verdicts that tests of samplers share: numbers are uniform, and an estimate is right to better than 1 %.
#pragma once

#include <wend/core/vector.h>
#include <wend/stats/chi_square.h>
#include <wend/stats/significance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace wend::test {

/// Counts numbers that should be uniform in [0,1), such as samples put through their cumulative distribution.
class Uniformity {
public:
    explicit Uniformity(int cells = 64) : counts_(static_cast<std::size_t>(cells)) {}

    void add(double x) {
        const auto n = static_cast<int>(counts_.size());
        ++counts_[static_cast<std::size_t>(std::clamp(static_cast<int>(x * n), 0, n - 1))];
    }
    /// A point of the unit square, counted in 8 columns: 64 cells count it in 8 x 8.
    void add(const Vec2& p) { add((std::min(static_cast<int>(p.x * 8), 7) + static_cast<double>(p.y)) / 8); }

    /// Probability of counts as uneven as these if the numbers are uniform.
    double p_value() const {
        double total = 0;
        for (const std::uint64_t n : counts_) {
            total += static_cast<double>(n);
        }
        const std::vector<double> expected(counts_.size(), total / static_cast<double>(counts_.size()));
        return chi_square_test(counts_, expected).p_value;
    }

private:
    std::vector<std::uint64_t> counts_;
};

/// What a p-value must reach to pass, and stay below in a twin that must fail.
inline constexpr double passing = 1e-3;
inline constexpr double failing = 1e-6;

/// Passes when the mean agrees with the reference within 4 standard errors (wrongly refused in 6 of 100,000 tests) and
/// is precise enough to refuse a reference that is 1 % larger or smaller.
inline testing::AssertionResult is_within_one_percent(const Moments& moments, double reference,
                                                      double rounding = 1e-5) {
    constexpr double z = 4;
    const auto report = [&](testing::AssertionResult result) {
        return result << "mean " << moments.mean() << ", standard error " << moments.standard_error() << ", reference "
                      << reference;
    };
    if (!agrees(moments, reference, z, rounding)) {
        return report(testing::AssertionFailure());
    }
    if (agrees(moments, 1.01 * reference, z, rounding) || agrees(moments, 0.99 * reference, z, rounding)) {
        return report(testing::AssertionFailure() << "too imprecise to see 1 %: ");
    }
    return testing::AssertionSuccess();
}

}  // namespace wend::test
