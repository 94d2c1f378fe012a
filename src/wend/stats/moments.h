// Running mean and variance of a stream of values, mergeable over threads.
#pragma once

#include <cstdint>

namespace wend {

/// Count, mean and variance of the values added so far, in one pass and without cancellation: Welford's update
/// (welford1962) and the pairwise merge of chan1979. Merging in a fixed order gives the same bits whatever thread
/// filled which part.
class Moments {
public:
    void add(double value);

    /// As if the other's values had been added here.
    void merge(const Moments& other);

    std::uint64_t count() const { return count_; }

    /// Mean of the values; 0 when there are none.
    double mean() const { return mean_; }

    /// Unbiased estimate of the variance of one value; 0 with fewer than two values.
    double variance() const;

    /// Standard deviation of the mean; 0 with fewer than two values.
    double standard_error() const;

    /// Standard error over |mean|: 0 when the variance is 0, infinite when only the mean is.
    double relative_error() const;

private:
    std::uint64_t count_ = 0;
    double mean_ = 0;
    double squared_deviations_ = 0;
};

}  // namespace wend
