#include <wend/guide/weight_limit.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace wend::guide {
namespace {

/// Σ min(w, limit), in four sums that do not wait for each other.
double cut_sum(std::span<const double> weights, double limit) {
    constexpr std::size_t parts = 4;
    double sum[parts] = {};
    std::size_t i = 0;
    for (; i + parts <= weights.size(); i += parts) {
        for (std::size_t k = 0; k < parts; ++k) {
            sum[k] += std::min(weights[i + k], limit);
        }
    }
    for (; i < weights.size(); ++i) {
        sum[0] += std::min(weights[i], limit);
    }
    return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

}  // namespace

double weight_limit(std::span<const double> weights) {
    constexpr int most_rounds = 8;
    double limit = std::numeric_limits<double>::infinity();
    for (int round = 0; round < most_rounds; ++round) {
        const double next = cut_sum(weights, limit) / std::sqrt(static_cast<double>(weights.size()));
        if (next >= limit) {
            break;
        }
        limit = next;
    }
    return limit;
}

}  // namespace wend::guide
