// Light from infinity that comes through a window.
#pragma once

#include <wend/core/image.h>
#include <wend/core/transform.h>
#include <wend/core/vector.h>
#include <wend/sampling/windowed.h>

#include <array>
#include <optional>

namespace wend {

/// A sampled direction of a portal's light.
struct PortalSample {
    Vec3 direction;  ///< towards the light, unit length
    Rgb radiance;
    float density;  ///< per steradian
};

/// Radiance from infinity that reaches only those points which see it through a rectangle: a ray that leaves the scene
/// carries it if, from where it begins, it passes the rectangle. The picture of the sky is resampled over the angles
/// that lines through the rectangle make with its two sides, where the rectangle is one as well, from wherever it is
/// seen; directions are drawn in proportion to it there (bitterli2015).
class PortalLight {
public:
    /// `sky`: a square picture in the equal-area octahedral mapping; `corners` of the rectangle in the world, in an
    /// order that goes around it against the clock as seen by those whom the light reaches.
    PortalLight(const Image& sky, float scale, const Transform& world_from_light, const std::array<Vec3, 4>& corners);

    /// That arrives at `p` from a unit direction; black where that does not pass the rectangle.
    Rgb radiance(const Vec3& p, const Vec3& direction) const;
    /// Nothing where no light is seen.
    std::optional<PortalSample> sample(const Vec3& p, const Vec2& u) const;
    /// Per steradian, with which sample() draws a direction from there.
    float density(const Vec3& p, const Vec3& direction) const;
    /// That passes through the rectangle.
    const Rgb& power() const { return power_; }

private:
    using Window = WindowedPiecewiseConstant2D::Window;

    std::optional<Vec2> place_of(const Vec3& direction) const;
    std::optional<Window> window_from(const Vec3& p) const;
    Vec3 local_direction(const Vec2& place) const;
    const Rgb& pixel(const Vec2& place) const;

    std::array<Vec3, 2> corners_;  ///< opposite ones
    Frame frame_;                  ///< x and y along the sides, z towards the light
    Image picture_;
    WindowedPiecewiseConstant2D distribution_;
    Rgb power_;
};

}  // namespace wend
