#include <wend/film/false_colour.h>

#include <wend/core/error.h>
#include <wend/core/vector.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace wend {
namespace {

/// Oklab coordinates at equal steps of position; lightness (x) takes equal steps, and all are within the sRGB gamut.
constexpr std::array<Vec3, 6> control_points = {{
    {0.14f, 0.007f, -0.039f},
    {0.30f, 0.052f, -0.130f},
    {0.46f, 0.172f, -0.080f},
    {0.62f, 0.180f, 0.073f},
    {0.78f, 0.068f, 0.143f},
    {0.94f, -0.026f, 0.110f},
}};

Rgb oklab_to_linear(const Vec3& lab) {
    const auto cube = [](float v) { return v * v * v; };
    const float l = cube(lab.x + 0.3963377774f * lab.y + 0.2158037573f * lab.z);
    const float m = cube(lab.x - 0.1055613458f * lab.y - 0.0638541728f * lab.z);
    const float s = cube(lab.x - 0.0894841775f * lab.y - 1.2914855480f * lab.z);
    return {4.0767416621f * l - 3.3077115913f * m + 0.2309699292f * s,
            -1.2684380046f * l + 2.6097574011f * m - 0.3413193965f * s,
            -0.0041960863f * l - 0.7034186147f * m + 1.7076147010f * s};
}

}  // namespace

float ColourScale::position(float value) const {
    if (std::isnan(value)) {
        return 1;
    }
    const float clamped = std::clamp(value, low, high);
    return kind == Kind::linear ? (clamped - low) / (high - low) : std::log(clamped / low) / std::log(high / low);
}

Rgb false_colour(float position) {
    const float scaled = std::clamp(position, 0.0f, 1.0f) * static_cast<float>(control_points.size() - 1);
    const std::size_t segment = std::min(static_cast<std::size_t>(scaled), control_points.size() - 2);
    const float fraction = scaled - static_cast<float>(segment);
    return oklab_to_linear(control_points[segment] * (1 - fraction) + control_points[segment + 1] * fraction);
}

Image false_colour(const std::vector<float>& values, int width, int height, const ColourScale& scale) {
    if (width < 0 || height < 0 ||
        values.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
        throw InputError("a false-colour picture of " + std::to_string(width) + 'x' + std::to_string(height) +
                         " pixels needs as many values, not " + std::to_string(values.size()));
    }
    if (!(scale.low < scale.high) || (scale.kind == ColourScale::Kind::logarithmic && !(scale.low > 0))) {
        throw InputError("a colour scale from " + std::to_string(scale.low) + " to " + std::to_string(scale.high) +
                         " is empty");
    }
    Image picture(width, height);
    std::transform(values.begin(), values.end(), picture.pixels.begin(),
                   [&](float value) { return false_colour(scale.position(value)); });
    return picture;
}

}  // namespace wend
