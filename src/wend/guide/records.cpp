#include <wend/guide/path_records.h>

#include <cmath>

namespace wend::guide {

namespace {

constexpr float unit_tolerance = 1e-3f;
constexpr double largest_weight = 1e30;

bool in_space(const Vec3& p) {
    // Far beyond any scene, and far enough from overflow for squares and sums.
    constexpr float largest_coordinate = 1e15f;
    const auto near = [](float x) { return std::abs(x) <= largest_coordinate; };
    return near(p.x) && near(p.y) && near(p.z);
}

}  // namespace

bool is_usable(const ScatterRecord& record) {
    constexpr float largest = 1e15f;
    return in_space(record.position) && length_squared(record.normal) <= 1 + unit_tolerance && record.leaving >= 0 &&
           record.leaving <= largest && record.connected >= 0 && record.connected <= largest &&
           (record.connected == 0 ||
            (std::abs(length_squared(record.to_light) - 1) <= unit_tolerance && record.light_distance >= 0));
}

bool is_usable(const Record& record) {
    const double most = largest_weight * record.density;
    return in_space(record.position) && std::abs(length_squared(record.direction) - 1) <= unit_tolerance &&
           record.radiance >= 0 && std::isfinite(record.radiance) && record.density > 0 &&
           std::isfinite(record.density) && record.distance > 0 && record.radiance <= most &&
           record.classical_density >= 0 && std::isfinite(record.classical_density) && record.guided_density >= 0 &&
           std::isfinite(record.guided_density) && record.scattered >= 0 && record.scattered <= most &&
           min_value(record.colour) >= 0 && is_finite(record.colour);
}

}  // namespace wend::guide
