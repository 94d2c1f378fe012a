// Cameras: from a point on the film to a ray. Film coordinates are in pixels of the full picture, (0,0) the upper left
// corner.
#pragma once

#include <wend/core/motion.h>
#include <wend/core/vector.h>
#include <wend/core/view_matrices.h>
#include <wend/scene/lens_system.h>
#include <wend/scene/panorama.h>

#include <memory>
#include <optional>
#include <variant>

namespace wend {

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

/// A film behind lenses.
struct RealisticCamera {
    std::shared_ptr<const LensSystem> lenses;
    Vec2 film_size;  ///< in metres
};

/// A film that sees around.
struct PanoramicCamera {
    std::shared_ptr<const Panorama> panorama;
};

/// A ray with what its radiance counts for.
struct CameraRay : Ray {
    float weight = 1;  ///< 0: nothing gets to the film, and the ray is any
};

/// When the shutter is open, and when what moves is at its start and its end, in one unit.
struct Shutter {
    float open = 0, close = 1;
    float start = 0, end = 1;

    /// Ray::time of a moment that is uniform while the shutter is open, by a uniform number. Before the start and after
    /// the end everything is at rest.
    float time(float u) const {
        const float moment = open + u * (close - open);
        return moment <= start ? 0.0f : moment >= end ? 1.0f : (moment - start) / (end - start);
    }
};

class Camera {
public:
    using Kind = std::variant<PerspectiveCamera, OrthographicCamera, SphericalCamera, RealisticCamera, PanoramicCamera>;

    Camera() = default;
    /// `width` and `height` are the full picture's in pixels.
    Camera(Kind kind, const Motion& world_from_camera, int width, int height, const Shutter& shutter = {})
        : kind_(std::move(kind)),
          shutter_(shutter),
          motion_(world_from_camera),
          start_(world_from_camera.start()),
          width_(width),
          height_(height) {}

    /// The ray through a film point at a time; `lens` is uniform in [0,1)².
    CameraRay ray(const Vec2& film, const Vec2& lens, float time = 0) const;
    const Shutter& shutter() const { return shutter_; }
    bool is_moving() const { return motion_.is_moving(); }
    /// The ray in the middle of film and lens, at time 0.
    Ray middle() const {
        return ray({0.5f * static_cast<float>(width_), 0.5f * static_cast<float>(height_)}, {0.5f, 0.5f});
    }
    /// At time 0; none for cameras that bend straight lines.
    std::optional<ViewMatrices> view_matrices() const;

private:
    Kind kind_;
    Shutter shutter_;
    Motion motion_;
    AffineMap start_;
    int width_ = 1;
    int height_ = 1;
};

}  // namespace wend
