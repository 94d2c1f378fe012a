#pragma once

#include <wend/core/vector.h>

#include <algorithm>
#include <span>
#include <vector>

namespace wend {

/// An index with a probability in proportion to its weight, for few weights that add up to `total`, none of them
/// negative and one at least positive. What is left of `u` in [0,1) is put back there, uniform in [0,1) again.
inline int select(std::span<const float> weights, float total, float& u) {
    // No branch depends on u: the processor could not guess it.
    const float target = u * total;
    std::size_t chosen = 0;
    float sum = 0, below = 0;
    for (const float weight : weights) {
        sum += weight;
        const bool passed = sum <= target;
        chosen += passed ? 1 : 0;
        below = passed ? sum : below;
    }
    if (chosen == weights.size()) {  // by rounding
        do {
            --chosen;
        } while (!(weights[chosen] > 0));
        u = one_minus_epsilon;
    } else {
        u = std::min(one_minus_epsilon, (target - below) / weights[chosen]);
    }
    return static_cast<int>(chosen);
}

/// Draws indices with probability proportional to given weights, in constant time (Walker's alias method).
class AliasTable {
public:
    AliasTable() = default;
    /// Weights must be finite and not negative; all zero means uniform.
    explicit AliasTable(std::span<const float> weights);

    /// An index for u in [0,1).
    int sample(float u) const;
    /// The probability of an index.
    float probability(int index) const { return entries_[static_cast<std::size_t>(index)].probability; }
    int size() const { return static_cast<int>(entries_.size()); }

private:
    struct Entry {
        float threshold = 1;
        int alias = 0;
        float probability = 0;
    };
    std::vector<Entry> entries_;
};

/// A density on [0,1)² that is constant over the cells of a regular grid.
class PiecewiseConstant2D {
public:
    PiecewiseConstant2D() = default;
    /// Row-major weights of width x height cells, finite and not negative; all zero means uniform.
    PiecewiseConstant2D(std::span<const float> weights, int width, int height);

    struct Sample {
        Vec2 point;
        float density;
    };
    Sample sample(const Vec2& u) const;
    float density(const Vec2& point) const;

private:
    int width_ = 0;
    int height_ = 0;
    std::vector<float> rows_;     // cumulative over rows, height + 1 entries from 0 to 1
    std::vector<float> columns_;  // cumulative within each row, width + 1 entries a row
};

}  // namespace wend
