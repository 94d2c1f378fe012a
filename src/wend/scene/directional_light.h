// Lights at a point that shine differently in different directions.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/transform.h>
#include <wend/scene/light_picture.h>

#include <memory>
#include <optional>

namespace wend {

/// A point that shines into a cone around the z axis of its own space: with all of its intensity up to the inner angle,
/// then less and less, and beyond the outer angle not at all.
struct SpotLight {
    Vec3 position;  ///< in the world
    Rgb intensity;  ///< on the axis, power per steradian
    AffineMap light_from_world;
    float cos_inner = 1;
    float cos_outer = 0;
    bool is_linear = false;  ///< less in proportion to the angle, and not by a smooth step of its cosine
};

/// A point whose intensity, over all directions of its own space, is a square picture in the equal-area octahedral
/// mapping (clarberg2008) times a colour.
struct GoniometricLight {
    Vec3 position;
    Rgb intensity;
    AffineMap light_from_world;
    std::shared_ptr<const LightPicture> picture;
};

/// A point that throws a picture through a rectangular window, one unit ahead along the z axis of its own space.
/// The picture's first row is where y is least.
struct ProjectionLight {
    Vec3 position;
    Rgb intensity;  ///< where the picture is 1
    AffineMap light_from_world;
    std::shared_ptr<const LightPicture> picture;
    Vec2 half_size{1, 1};  ///< of the window
    /// Whether it is the irradiance of the window that the picture gives, interpolated between its pixels.
    bool lights_plane_evenly = false;
    /// That of a spot, around the z axis, of which the picture is a factor; none: all of the window.
    struct Cone {
        float cos_inner, cos_outer;
        bool is_linear;
    };
    std::optional<Cone> cone{};
};

/// What is left of full intensity at an angle of this cosine from the axis of a cone: SpotLight.
float cone_falloff(float cosine, float cos_inner, float cos_outer, bool is_linear);

/// Power per steradian that leaves into a unit direction of the world.
Rgb intensity_towards(const SpotLight& light, const Vec3& w);
Rgb intensity_towards(const GoniometricLight& light, const Vec3& w);
Rgb intensity_towards(const ProjectionLight& light, const Vec3& w);

/// Steradians of full intensity that shine as much as all directions of the light's own space together: its power is
/// its intensity times this. Pictures have one for each channel.
float spread(const SpotLight& light);
Rgb spread(const GoniometricLight& light);
Rgb spread(const ProjectionLight& light);

/// Cosine of the angle between the z axis and the corners of a projected picture.
float corner_cosine(const ProjectionLight& light);

}  // namespace wend
