#include <wend/scene/portal_light.h>

#include <wend/core/contracts.h>
#include <wend/scene/light.h>
#include <wend/scene/picture_lookup.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace wend {
namespace {

/// A picture without detail still has to be drawn from evenly by solid angle.
constexpr int fewest_pixels = 32;

/// Radiance from a direction of the sky, interpolated.
Rgb interpolate(const Image& sky, const Vec3& direction) {
    const Vec2 uv = equal_area_sphere_to_square(direction);
    return bilinear(Vec2(uv.x * static_cast<float>(sky.width), uv.y * static_cast<float>(sky.height)),
                    [&](int i, int j) { return octahedral_pixel(sky, i, j); });
}

/// Solid angle over area of the picture, at a unit direction in the rectangle's frame.
float solid_angle_factor(const Vec3& d) {
    return pi * pi * (1 - d.x * d.x) * (1 - d.y * d.y) / d.z;
}

}  // namespace

PortalLight::PortalLight(const Image& sky, float scale, const Transform& world_from_light,
                         const std::array<Vec3, 4>& corners)
    : corners_{corners[0], corners[2]} {
    WEND_EXPECT(sky.width > 0 && sky.width == sky.height);
    const Vec3 across = corners[3] - corners[0], up = corners[1] - corners[0];
    frame_.s = normalize(across);
    frame_.n = normalize(cross(across, up));
    frame_.t = cross(frame_.n, frame_.s);
    const int size = sky.width > 1 ? sky.width : fewest_pixels;
    picture_ = Image(size, size);
    const AffineMap light_from_world(world_from_light.inverse());
    const float area = length(cross(across, up));
    std::vector<float> weights;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const Vec2 middle((static_cast<float>(x) + 0.5f) / static_cast<float>(size),
                              (static_cast<float>(y) + 0.5f) / static_cast<float>(size));
            const Vec3 d = local_direction(middle);
            const Vec3 in_light = normalize(light_from_world.vector(frame_.to_world(d)));
            picture_.at(x, y) = interpolate(sky, in_light) * scale;
            const float solid_angle = solid_angle_factor(d);
            weights.push_back(mean(picture_.at(x, y)) * solid_angle);
            power_ += picture_.at(x, y) * (solid_angle * d.z * area / static_cast<float>(size * size));
        }
    }
    distribution_ = WindowedPiecewiseConstant2D(weights, size, size);
}

Vec3 PortalLight::local_direction(const Vec2& place) const {
    // Written without the tangent, which has no value at the ends.
    const Vec2 angle((place.x - 0.5f) * pi, (place.y - 0.5f) * pi);
    const float cx = std::cos(angle.x), cy = std::cos(angle.y);
    return normalize(Vec3(std::sin(angle.x) * cy, std::sin(angle.y) * cx, std::max(cx * cy, 1e-12f)));
}

std::optional<Vec2> PortalLight::place_of(const Vec3& direction) const {
    const Vec3 d = frame_.to_local(direction);
    if (!(d.z > 0)) {
        return std::nullopt;
    }
    const auto in_picture = [](float angle) { return std::clamp(0.5f + angle * inv_pi, 0.0f, 1.0f); };
    return Vec2(in_picture(std::atan2(d.x, d.z)), in_picture(std::atan2(d.y, d.z)));
}

std::optional<PortalLight::Window> PortalLight::window_from(const Vec3& p) const {
    const auto a = place_of(corners_[0] - p), b = place_of(corners_[1] - p);
    if (!a || !b) {
        return std::nullopt;
    }
    return Window{{std::min(a->x, b->x), std::min(a->y, b->y)}, {std::max(a->x, b->x), std::max(a->y, b->y)}};
}

const Rgb& PortalLight::pixel(const Vec2& place) const {
    const auto index = [this](float coordinate) {
        return std::clamp(static_cast<int>(coordinate * static_cast<float>(picture_.width)), 0, picture_.width - 1);
    };
    return picture_.at(index(place.x), index(place.y));
}

Rgb PortalLight::radiance(const Vec3& p, const Vec3& direction) const {
    const auto place = place_of(direction);
    const auto window = place ? window_from(p) : std::nullopt;
    return window && window->holds(*place) ? pixel(*place) : Rgb(0.0f);
}

float PortalLight::density(const Vec3& p, const Vec3& direction) const {
    const auto place = place_of(direction);
    const auto window = place ? window_from(p) : std::nullopt;
    const float solid_angle = place ? solid_angle_factor(frame_.to_local(direction)) : 0.0f;
    return window && solid_angle > 0 ? distribution_.density(*place, *window) / solid_angle : 0.0f;
}

std::optional<PortalSample> PortalLight::sample(const Vec3& p, const Vec2& u) const {
    const auto window = window_from(p);
    const auto chosen = window ? distribution_.sample(u, *window) : std::nullopt;
    if (!chosen) {
        return std::nullopt;
    }
    const Vec3 d = local_direction(chosen->point);
    const float density = chosen->density / solid_angle_factor(d);
    if (!(density > 0) || !std::isfinite(density)) {
        return std::nullopt;
    }
    return PortalSample{frame_.to_world(d), pixel(chosen->point), density};
}

}  // namespace wend
