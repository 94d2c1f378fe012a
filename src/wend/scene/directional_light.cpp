#include <wend/scene/directional_light.h>

#include <wend/scene/light.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// A direction of the world in a light's own space.
Vec3 to_light(const AffineMap& light_from_world, const Vec3& w) {
    return normalize(light_from_world.vector(w));
}

float in_cone(const ProjectionLight& light, float cosine) {
    return light.cone ? cone_falloff(cosine, light.cone->cos_inner, light.cone->cos_outer, light.cone->is_linear)
                      : 1.0f;
}

}  // namespace

float cone_falloff(float cosine, float cos_inner, float cos_outer, bool is_linear) {
    if (cosine >= cos_inner) {
        return 1;
    }
    if (!(cosine > cos_outer)) {
        return 0;
    }
    if (is_linear) {
        const float outer = std::acos(cos_outer), inner = std::acos(cos_inner);
        return std::clamp((outer - std::acos(cosine)) / (outer - inner), 0.0f, 1.0f);
    }
    const float t = (cosine - cos_outer) / (cos_inner - cos_outer);
    return t * t * (3 - 2 * t);
}

Rgb intensity_towards(const SpotLight& light, const Vec3& w) {
    const float cosine = to_light(light.light_from_world, w).z;
    return light.intensity * cone_falloff(cosine, light.cos_inner, light.cos_outer, light.is_linear);
}

Rgb intensity_towards(const GoniometricLight& light, const Vec3& w) {
    return light.intensity * light.picture->nearest(equal_area_sphere_to_square(to_light(light.light_from_world, w)));
}

Rgb intensity_towards(const ProjectionLight& light, const Vec3& w) {
    constexpr float grazing = 1e-3f;
    const Vec3 d = to_light(light.light_from_world, w);
    if (!(d.z >= grazing)) {
        return Rgb(0.0f);
    }
    const Vec2 on_window(d.x / (d.z * light.half_size.x), d.y / (d.z * light.half_size.y));
    if (!(std::abs(on_window.x) <= 1 && std::abs(on_window.y) <= 1)) {
        return Rgb(0.0f);
    }
    const Vec2 on_picture(0.5f * (on_window.x + 1), 0.5f * (on_window.y + 1));
    if (light.lights_plane_evenly) {
        return light.intensity * light.picture->bilinear(on_picture) * (in_cone(light, d.z) / (d.z * d.z * d.z));
    }
    return light.intensity * light.picture->nearest(on_picture) * in_cone(light, d.z);
}

float spread(const SpotLight& light) {
    if (light.is_linear && light.cos_outer < light.cos_inner) {
        const float outer = std::acos(light.cos_outer), inner = std::acos(light.cos_inner);
        return 2 * pi * (1 - (std::sin(outer) - std::sin(inner)) / (outer - inner));
    }
    // The smooth step is a half on average.
    return 2 * pi * ((1 - light.cos_inner) + 0.5f * (light.cos_inner - light.cos_outer));
}

Rgb spread(const GoniometricLight& light) {
    return light.picture->mean_colour() * (4 * pi);
}

Rgb spread(const ProjectionLight& light) {
    const Image& image = light.picture->image();
    const Vec2 pixel(2 * light.half_size.x / static_cast<float>(image.width),
                     2 * light.half_size.y / static_cast<float>(image.height));
    double sum[3] = {0, 0, 0};
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const float px = (static_cast<float>(x) + 0.5f) * pixel.x - light.half_size.x;
            const float py = (static_cast<float>(y) + 0.5f) * pixel.y - light.half_size.y;
            const double away2 = 1 + double{px} * px + double{py} * py, d2 = light.lights_plane_evenly ? 1 : away2;
            const double left = double{in_cone(light, static_cast<float>(1 / std::sqrt(away2)))};
            for (int c = 0; c < 3; ++c) {
                sum[c] += left * static_cast<double>(image.at(x, y)[c]) / (d2 * std::sqrt(d2));
            }
        }
    }
    const double area = double{pixel.x} * pixel.y;
    return {static_cast<float>(sum[0] * area), static_cast<float>(sum[1] * area), static_cast<float>(sum[2] * area)};
}

float corner_cosine(const ProjectionLight& light) {
    return 1 / std::sqrt(1 + sqr(light.half_size.x) + sqr(light.half_size.y));
}

}  // namespace wend
