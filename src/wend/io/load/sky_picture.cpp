#include <wend/io/load/sky_picture.h>

#include <wend/core/vector.h>
#include <wend/scene/light.h>
#include <wend/scene/picture_lookup.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

Rgb towards(const Image& by_longitude, SkyRows rows, const Vec3& d) {
    const float u = 0.5f - std::atan2(d.y, d.x) / (2 * pi), v = std::acos(std::clamp(d.z, -1.0f, 1.0f)) / pi;
    const int width = by_longitude.width, height = by_longitude.height;
    const float row =
        rows == SkyRows::in_strips ? v * static_cast<float>(height) : v * static_cast<float>(height - 1) + 0.5f;
    return bilinear({u * static_cast<float>(width), row}, [&](int x, int y) {
        return by_longitude.at(((x % width) + width) % width, std::clamp(y, 0, height - 1));
    });
}

}  // namespace

Image equal_area_sky(const Image& by_longitude, SkyRows rows) {
    // Pixels of lights at infinity are even: what is smooth between a few large ones is so only by many small ones.
    constexpr double finer = 1.25, least = 1024, most = 4096;
    constexpr double samples_for_each = 5;  // along a side of a given pixel
    const double given = std::sqrt(static_cast<double>(by_longitude.width) * by_longitude.height);
    const int side = static_cast<int>(std::clamp(std::ceil(finer * given), least, most));
    const int samples = std::max(1, static_cast<int>(std::ceil(samples_for_each * given / side)));
    Image sky(side, side);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            Rgb sum;
            for (int i = 0; i < samples * samples; ++i) {
                const auto within = [&](int pixel, int sample) {
                    const float middle = (static_cast<float>(sample) + 0.5f) / static_cast<float>(samples);
                    return (static_cast<float>(pixel) + middle) / static_cast<float>(side);
                };
                sum += towards(by_longitude, rows,
                               equal_area_square_to_sphere({within(x, i % samples), within(y, i / samples)}));
            }
            sky.at(x, y) = sum / static_cast<float>(samples * samples);
        }
    }
    return sky;
}

}  // namespace wend
