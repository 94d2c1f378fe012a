#include "tests/support/measured_tables.h"

#include <wend/core/random.h>
#include <wend/core/vector.h>

#include <cmath>

namespace wend::test {
namespace {

Vec3 direction(float angle, float azimuth) {
    return {std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), std::cos(angle)};
}

MeasuredData without_reflection(bool is_isotropic, std::size_t size) {
    MeasuredData data;
    data.azimuths = is_isotropic ? std::vector<float>{0} : std::vector<float>{-pi, -1, 1.5f, pi};
    data.angles = {0, 0.4f, 0.8f, 1.2f, 1.5f};
    data.facets = {2, 2, std::vector<float>(4, 1.0f)};
    data.projected = data.facets;
    const std::size_t slices = data.azimuths.size() * data.angles.size();
    data.visible = {2, 2, std::vector<float>(4 * slices, 1.0f)};
    data.luminance = {size, size, std::vector<float>(size * size * slices)};
    data.colours = {size, size, std::vector<Rgb>(size * size * slices)};
    return data;
}

}  // namespace

MeasuredData even_reflectance(const Rgb& reflectance, bool is_isotropic, std::size_t size) {
    MeasuredData data = without_reflection(is_isotropic, size);
    std::size_t i = 0;
    for (const float azimuth : data.azimuths) {
        for (const float angle : data.angles) {
            const Vec3 wo = direction(angle, is_isotropic ? 0.0f : azimuth);
            for (std::size_t y = 0; y < size; ++y) {
                for (std::size_t x = 0; x < size; ++x, ++i) {
                    const float u = static_cast<float>(x) / static_cast<float>(size - 1);
                    const float v = static_cast<float>(y) / static_cast<float>(size - 1);
                    const Vec3 m = direction(u * u * pi / 2, 2 * pi * v - pi);
                    const float cosine = std::max(0.0f, 2 * dot(wo, m) * m.z - wo.z);
                    data.colours.values[i] = reflectance * (4 * cosine / pi);
                    // As measured ones have it: times the solid angle over the area of the unit square.
                    data.luminance.values[i] =
                        luminance(data.colours.values[i]) * dot(wo, m) * u * std::sin(u * u * pi / 2);
                }
            }
        }
    }
    return data;
}

MeasuredData uneven_reflectance(bool is_isotropic) {
    MeasuredData data = even_reflectance(Rgb(0.3f, 0.5f, 0.7f), is_isotropic, 6);
    Pcg32 random(3);
    for (float& value : data.visible.values) {
        value = 0.5f + random.uniform();
    }
    for (float& value : data.luminance.values) {
        value *= 0.5f + random.uniform();
    }
    for (Rgb& value : data.colours.values) {
        value *= 0.5f + 0.5f * random.uniform();
    }
    data.facets = {3, 2, {0.7f, 1, 0.8f, 0.7f, 0.5f, 0.8f}};
    data.projected = {2, 2, {1, 1.5f, 1, 1.5f}};
    return data;
}

}  // namespace wend::test
