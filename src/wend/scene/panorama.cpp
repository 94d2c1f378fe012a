#include <wend/scene/panorama.h>

#include <cmath>

namespace wend {
namespace {

using Mapping = Panorama::Mapping;

/// The angle to the axis at a distance from the middle; not a number where there is none.
float angle_of_fisheye(const Panorama& c, float r) {
    switch (c.mapping) {
        case Mapping::equisolid:
            return 2 * std::asin(0.5f * r);
        case Mapping::polynomial: {
            const auto& k = c.coefficients;
            return k[0] + r * (k[1] + r * (k[2] + r * (k[3] + r * k[4])));
        }
        default:
            return r;
    }
}

std::optional<Vec3> of_fisheye(const Panorama& c, const Vec2& s) {
    const float r = std::hypot(s.x, s.y);
    const float angle = angle_of_fisheye(c, r);
    if (!(std::abs(angle) <= c.largest_angle)) {
        return std::nullopt;
    }
    const Vec2 aside = r > 0 ? s / r : Vec2(1, 0);
    return Vec3(aside.x * std::sin(angle), aside.y * std::sin(angle), std::cos(angle));
}

std::optional<Vec3> of_mirror_ball(const Vec2& s) {
    const float height = 1 - s.x * s.x - s.y * s.y;
    if (height < 0) {
        return std::nullopt;
    }
    const float z = std::sqrt(height);
    return Vec3(2 * z * s.x, 2 * z * s.y, 2 * height - 1);
}

}  // namespace

std::optional<Vec3> Panorama::direction(const Vec2& p) const {
    const Vec2 s = screen.at(p);
    switch (mapping) {
        case Mapping::equirectangular:
            return Vec3(std::sin(s.x) * std::cos(s.y), std::sin(s.y), std::cos(s.x) * std::cos(s.y));
        case Mapping::cylindrical:
            return normalize(Vec3(std::sin(s.x), s.y, std::cos(s.x)));
        case Mapping::cube_face:
            return normalize(Vec3(std::tan(s.x), std::tan(s.y), 1));
        case Mapping::mirror_ball:
            return of_mirror_ball(s);
        default:
            return of_fisheye(*this, s);
    }
}

}  // namespace wend
