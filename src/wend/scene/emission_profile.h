// How what shines shines differently in different directions.
#pragma once

#include <wend/core/vector.h>

namespace wend {

/// What multiplies the radiance of a surface that shines, by direction.
struct EmissionProfile {
    enum class Kind {
        cone,  ///< 1 up to an inner angle from an axis, then less and less, and beyond an outer angle 0
        slats  ///< as behind a grid of black slats: less and less with the tangent of the angle from the normal
    };
    Kind kind = Kind::cone;
    Vec3 axis{0, 0, 1};  ///< of a cone, in the world, unit length; it stays where the surface turns
    float cos_inner = 1, cos_outer = 0;
    bool is_linear = false;  ///< SpotLight::is_linear
    /// Of slats, radians, in (0, pi / 2): beyond, nothing passes. What passes is as much as without slats.
    float half_angle = 1;

    /// The factor of what leaves towards w from a surface with that normal, both of unit length.
    float towards(const Vec3& normal, const Vec3& w) const;
    /// About its mean over what the whole surface emits, for choosing among lights.
    float mean() const;
};

}  // namespace wend
