// The part of its image plane that a camera sees.
#pragma once

#include <wend/core/vector.h>

namespace wend {

/// A rectangle in the camera's image plane.
struct ScreenWindow {
    float x_min = -1, x_max = 1, y_min = -1, y_max = 1;

    /// The point at shares of width and height, from the upper left.
    Vec2 at(const Vec2& p) const { return {x_min + p.x * (x_max - x_min), y_max - p.y * (y_max - y_min)}; }
};

}  // namespace wend
