#include <wend/scene/light.h>

#include <wend/core/vector.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace wend {

Vec3 equal_area_square_to_sphere(const Vec2& p) {
    const float u = 2 * p.x - 1;
    const float v = 2 * p.y - 1;
    const float signed_distance = 1 - (std::abs(u) + std::abs(v));
    const float r = 1 - std::abs(signed_distance);
    const float phi = (r == 0 ? 1 : (std::abs(v) - std::abs(u)) / r + 1) * (pi / 4);
    const float scale = r * safe_sqrt(2 - r * r);
    return {std::copysign(std::cos(phi) * scale, u), std::copysign(std::sin(phi) * scale, v),
            std::copysign(1 - r * r, signed_distance)};
}

Vec2 equal_area_sphere_to_square(const Vec3& d) {
    const float x = std::abs(d.x);
    const float y = std::abs(d.y);
    const float r = safe_sqrt(1 - std::abs(d.z));
    const float phi = (x == 0 && y == 0) ? 0.0f : std::atan2(y, x) * (2 / pi);
    float v = phi * r;
    float u = r - v;
    if (d.z < 0) {
        std::swap(u, v);
        u = 1 - u;
        v = 1 - v;
    }
    return {0.5f * (std::copysign(u, d.x) + 1), 0.5f * (std::copysign(v, d.y) + 1)};
}

ImageInfiniteLight::ImageInfiniteLight(Image image, float scale, const Transform& world_from_light)
    : image_(std::move(image)),
      scale_(scale),
      world_from_light_(world_from_light),
      light_from_world_(world_from_light.inverse()) {
    std::vector<float> weights;
    weights.reserve(image_.pixels.size());
    Rgb sum;
    for (const Rgb& pixel : image_.pixels) {
        weights.push_back(std::max(0.0f, mean(pixel)));
        sum += pixel;
    }
    mean_ = sum * (scale / static_cast<float>(image_.pixels.size()));
    distribution_ = PiecewiseConstant2D(weights, image_.width, image_.height);
}

Rgb ImageInfiniteLight::texel(int x, int y) const {
    return image_.at(std::clamp(x, 0, image_.width - 1), std::clamp(y, 0, image_.height - 1)) * scale_;
}

Rgb ImageInfiniteLight::radiance(const Vec3& direction) const {
    const Vec2 uv = equal_area_sphere_to_square(normalize(light_from_world_.vector(direction)));
    return texel(static_cast<int>(uv.x * static_cast<float>(image_.width)),
                 static_cast<int>(uv.y * static_cast<float>(image_.height)));
}

float ImageInfiniteLight::density(const Vec3& direction) const {
    return distribution_.density(equal_area_sphere_to_square(normalize(light_from_world_.vector(direction)))) * inv_4pi;
}

LightSample ImageInfiniteLight::sample(const Vec2& u) const {
    const auto s = distribution_.sample(u);
    const Vec3 w = normalize(world_from_light_.vector(equal_area_square_to_sphere(s.point)));
    return {w, infinity, radiance(w), density(w), false};
}

}  // namespace wend
