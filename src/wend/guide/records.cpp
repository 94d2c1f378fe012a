#include <wend/guide/records.h>

#include <cmath>

namespace wend::guide {

bool is_usable(const Record& record) {
    constexpr float unit_tolerance = 1e-3f;
    // Far beyond any scene, and far enough from overflow for squares and sums.
    constexpr float largest_coordinate = 1e15f;
    constexpr double largest_weight = 1e30;
    const auto in_space = [](float x) { return std::abs(x) <= largest_coordinate; };
    return in_space(record.position.x) && in_space(record.position.y) && in_space(record.position.z) &&
           std::abs(length_squared(record.direction) - 1) <= unit_tolerance && record.radiance >= 0 &&
           std::isfinite(record.radiance) && record.density > 0 && std::isfinite(record.density) &&
           record.distance > 0 && weight_of(record) <= largest_weight && record.classical_density >= 0 &&
           std::isfinite(record.classical_density) && record.guided_density >= 0 &&
           std::isfinite(record.guided_density) && record.scattered >= 0 &&
           static_cast<double>(record.scattered) / record.density <= largest_weight && min_value(record.colour) >= 0 &&
           is_finite(record.colour);
}

}  // namespace wend::guide
