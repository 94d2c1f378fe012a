// Films that see around and bend straight lines by a formula: fisheyes, cylinders, parts of the sphere.
#pragma once

#include <wend/scene/screen_window.h>

#include <array>
#include <limits>
#include <optional>

namespace wend {

/// Looks along +z, with x on the right and y up. What the screen's coordinates are depends on the mapping.
struct Panorama {
    enum class Mapping {
        equirectangular,  ///< longitude and latitude in radians
        cylindrical,      ///< longitude in radians, height on a cylinder of radius 1
        cube_face,        ///< longitude along the horizon, latitude along the meridian in the middle, in radians
        mirror_ball,      ///< a ball of radius 1, seen from far away
        equidistant,      ///< the distance from the middle is the angle to the axis in radians
        equisolid,        ///< it is twice the sine of half the angle
        polynomial        ///< the angle is a polynomial of it
    };

    Mapping mapping = Mapping::equirectangular;
    ScreenWindow screen;
    /// Of fisheyes: beyond this angle to the axis, in radians, the film is dark.
    float largest_angle = std::numeric_limits<float>::infinity();
    /// Of the polynomial, in radians: by ascending powers of the distance from the middle.
    std::array<float, 5> coefficients{};
    float lens_radius = 0;  ///< of a lens across each ray; 0: a pinhole
    float focal_distance = 1e6f;

    /// Where the light of a film point comes from, by shares of width and height; none where the film is dark.
    std::optional<Vec3> direction(const Vec2& p) const;
};

}  // namespace wend
