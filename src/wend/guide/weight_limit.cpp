#include <wend/guide/weight_limit.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace wend::guide {

double weight_limit(std::span<const double> weights) {
    constexpr int most_rounds = 8;
    double limit = std::numeric_limits<double>::infinity();
    for (int round = 0; round < most_rounds; ++round) {
        double sum = 0;
        for (const double w : weights) {
            sum += std::min(w, limit);
        }
        const double next = sum / std::sqrt(static_cast<double>(weights.size()));
        if (next >= limit) {
            break;
        }
        limit = next;
    }
    return limit;
}

}  // namespace wend::guide
