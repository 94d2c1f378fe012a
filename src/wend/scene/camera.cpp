#include <wend/scene/camera.h>

#include <wend/core/vector.h>
#include <wend/sampling/warp.h>
#include <wend/scene/light.h>

#include <algorithm>
#include <array>

namespace wend {
namespace {

/// Through a lens of the given radius, focused on the plane z = focal distance.
Ray through_lens(const Ray& pinhole, float lens_radius, float focal_distance, const Vec2& u) {
    if (!(lens_radius > 0)) {
        return pinhole;
    }
    const Vec2 lens = to_disk(u) * lens_radius;
    const Vec3 focus = pinhole.at(focal_distance / pinhole.direction.z);
    const Vec3 origin = pinhole.origin + Vec3(lens.x, lens.y, 0);
    return {origin, normalize(focus - origin)};
}

CameraRay local_ray(const PerspectiveCamera& c, const Vec2& p, const Vec2& lens) {
    const Vec2 s = c.screen.at(p);
    return {through_lens({{0, 0, 0}, normalize(Vec3(s.x, s.y, 1))}, c.lens_radius, c.focal_distance, lens)};
}

CameraRay local_ray(const OrthographicCamera& c, const Vec2& p, const Vec2& lens) {
    const Vec2 s = c.screen.at(p);
    return {through_lens({{s.x, s.y, 0}, {0, 0, 1}}, c.lens_radius, c.focal_distance, lens)};
}

CameraRay local_ray(const SphericalCamera& c, const Vec2& p, const Vec2&) {
    Vec3 d;
    if (c.mapping == SphericalCamera::Mapping::equirectangular) {
        const float theta = pi * p.y;
        const float phi = 2 * pi * p.x;
        d = {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
    } else {
        // Points that the pixel filter moves over the edge come back in by reflection, where the mapping is continuous.
        const auto mirror = [](float x) { return x < 0 ? -x : (x > 1 ? 2 - x : x); };
        const bool over_x = p.x < 0 || p.x > 1;
        const bool over_y = p.y < 0 || p.y > 1;
        const float x = mirror(p.x);
        const float y = mirror(p.y);
        d = equal_area_square_to_sphere({over_y ? 1 - x : x, over_x ? 1 - y : y});
    }
    // The mappings have z up, the camera y.
    return {{{0, 0, 0}, {d.x, d.z, d.y}}};
}

/// With a lens across the ray, so that what is in focus is on a sphere.
CameraRay local_ray(const PanoramicCamera& camera, const Vec2& p, const Vec2& lens) {
    const Panorama& c = *camera.panorama;
    const std::optional<Vec3> direction = c.direction(p);
    if (!direction) {
        return {{{0, 0, 0}, {0, 0, 1}}, 0};
    }
    if (!(c.lens_radius > 0)) {
        return {{{0, 0, 0}, *direction}};
    }
    const Frame across = Frame::from_z(*direction);
    const Vec2 at = to_disk(lens) * c.lens_radius;
    const Vec3 origin = across.to_world({at.x, at.y, 0});
    return {{origin, normalize(*direction * c.focal_distance - origin)}};
}

CameraRay local_ray(const RealisticCamera& c, const Vec2& p, const Vec2& lens) {
    // The picture on the film is upside down and mirrored.
    const auto sample = c.lenses->sample({(0.5f - p.x) * c.film_size.x, (p.y - 0.5f) * c.film_size.y}, lens);
    return sample ? CameraRay{sample->ray, sample->weight} : CameraRay{{{0, 0, 0}, {0, 0, 1}}, 0};
}

/// Of the camera's own points, in normalized device coordinates.
Imath::M44d projection(const ScreenWindow& s, bool is_perspective) {
    const double width = s.x_max - s.x_min, height = s.y_max - s.y_min;
    Imath::M44d m;
    m[0][0] = 1 / width;
    m[1][1] = -1 / height;
    // What is added stands in the row of z where everything is divided by z.
    const int row = is_perspective ? 2 : 3;
    m[row][0] = -s.x_min / width;
    m[row][1] = s.y_max / height;
    if (is_perspective) {
        m[2][3] = 1;
        m[3][3] = 0;
    }
    return m;
}

std::array<float, 16> numbers(const Imath::M44d& m) {
    std::array<float, 16> result;
    std::transform(m.getValue(), m.getValue() + 16, result.begin(), [](double x) { return static_cast<float>(x); });
    return result;
}

}  // namespace

std::optional<ViewMatrices> Camera::view_matrices() const {
    const auto* perspective = std::get_if<PerspectiveCamera>(&kind_);
    const auto* orthographic = std::get_if<OrthographicCamera>(&kind_);
    if (!perspective && !orthographic) {
        return std::nullopt;
    }
    const Transform camera_from_world = motion_.start().inverse();
    Imath::M44d m;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            m[column][row] = camera_from_world.element(row, column);
        }
    }
    const ScreenWindow& screen = perspective ? perspective->screen : orthographic->screen;
    return ViewMatrices{numbers(m), numbers(m * projection(screen, perspective != nullptr))};
}

CameraRay Camera::ray(const Vec2& film, const Vec2& lens, float time) const {
    const Vec2 p(film.x / static_cast<float>(width_), film.y / static_cast<float>(height_));
    const CameraRay local = std::visit([&](const auto& c) { return local_ray(c, p, lens); }, kind_);
    const AffineMap place = motion_.is_moving() ? motion_.at(time).world_from_object : start_;
    return {{place.point(local.origin), normalize(place.vector(local.direction)), time}, local.weight};
}

}  // namespace wend
