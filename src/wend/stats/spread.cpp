#include <wend/stats/spread.h>

#include <wend/stats/moments.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace wend {

double quantile(const std::vector<double>& ascending, double q) {
    if (ascending.empty()) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    const double place = std::clamp(q, 0.0, 1.0) * static_cast<double>(ascending.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, ascending.size() - 1);
    return std::lerp(ascending[below], ascending[above], place - static_cast<double>(below));
}

Spread spread_of(std::vector<double> values) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    values.erase(std::remove_if(values.begin(), values.end(), [](double value) { return !std::isfinite(value); }),
                 values.end());
    if (values.empty()) {
        return {0, unknown, unknown, unknown, unknown, unknown};
    }
    std::sort(values.begin(), values.end());
    Moments moments;
    for (const double value : values) {
        moments.add(value);
    }
    return {values.size(), quantile(values, 0.5), values.front(),
            values.back(), moments.mean(),        values.size() < 2 ? unknown : moments.standard_error()};
}

}  // namespace wend
