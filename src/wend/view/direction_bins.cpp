#include <wend/view/direction_bins.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace wend {

std::array<int, 2> DirectionBins::of(const Vec3& w) const {
    const float x = (std::atan2(w.y, w.x) / (2 * pi) + 0.5f) * static_cast<float>(columns);
    const float y = std::acos(std::clamp(w.z, -1.0f, 1.0f)) / pi * static_cast<float>(rows);
    return {std::clamp(static_cast<int>(x), 0, columns - 1), std::clamp(static_cast<int>(y), 0, rows - 1)};
}

double DirectionBins::solid_angle(int row) const {
    return 2.0 * pi / columns * (std::cos(double{pi} * row / rows) - std::cos(double{pi} * (row + 1) / rows));
}

std::vector<float> radiance_by_direction(const guide::Records& records, const DirectionBins& bins) {
    std::vector<double> sums(static_cast<std::size_t>(bins.columns) * static_cast<std::size_t>(bins.rows));
    for (const guide::Record& record : records) {
        const auto [x, y] = bins.of(record.direction);
        sums[static_cast<std::size_t>(y * bins.columns + x)] += guide::weight_of(record);
    }
    std::vector<float> radiance;
    radiance.reserve(sums.size());
    const auto count = static_cast<double>(std::max<std::size_t>(records.size(), 1));
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const int row = static_cast<int>(i) / bins.columns;
        radiance.push_back(static_cast<float>(sums[i] * (1 / (bins.solid_angle(row) * count))));
    }
    return radiance;
}

}  // namespace wend
