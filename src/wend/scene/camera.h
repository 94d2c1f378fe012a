// Cameras: from a point on the film to a ray. Film coordinates are in pixels of the full picture, (0,0) the upper left
// corner.
#pragma once

#include <wend/core/ray.h>
#include <wend/core/transform.h>

#include <variant>

namespace wend {

/// A rectangle in the camera's image plane.
struct ScreenWindow {
    float x_min = -1, x_max = 1, y_min = -1, y_max = 1;
};

/// A thin lens; a pinhole where the radius is 0. The camera looks along +z.
struct PerspectiveCamera {
    ScreenWindow screen;  ///< at distance 1, already scaled by the tangent of half the field of view
    float lens_radius = 0;
    float focal_distance = 1e6f;
};

/// Parallel rays along +z.
struct OrthographicCamera {
    ScreenWindow screen;
    float lens_radius = 0;
    float focal_distance = 1e6f;
};

/// All directions around a point: a square in the equal-area octahedral mapping, or longitude and latitude.
struct SphericalCamera {
    enum class Mapping { equal_area, equirectangular };
    Mapping mapping = Mapping::equal_area;
};

class Camera {
public:
    using Kind = std::variant<PerspectiveCamera, OrthographicCamera, SphericalCamera>;

    Camera() = default;
    /// `width` and `height` are the full picture's in pixels.
    Camera(Kind kind, const Transform& world_from_camera, int width, int height)
        : kind_(std::move(kind)), world_from_camera_(world_from_camera), width_(width), height_(height) {}

    /// The ray through a film point; `lens` is uniform in [0,1)².
    Ray ray(const Vec2& film, const Vec2& lens) const;
    /// The one in the middle of both.
    Ray middle() const {
        return ray({0.5f * static_cast<float>(width_), 0.5f * static_cast<float>(height_)}, {0.5f, 0.5f});
    }

private:
    Kind kind_;
    AffineMap world_from_camera_;
    int width_ = 1;
    int height_ = 1;
};

}  // namespace wend
