// Pictures between their pixels.
#pragma once

#include <wend/core/image.h>
#include <wend/core/vector.h>

#include <algorithm>
#include <cmath>

namespace wend {

/// Interpolated between the middles of the four pixels around a place, in pixels, which must fit into an int.
/// `pixel(i, j)` is asked beyond the borders as well.
template <class Pixel>
Rgb bilinear(const Vec2& place, const Pixel& pixel) {
    const float x = place.x - 0.5f, y = place.y - 0.5f;
    const float left = std::floor(x), low = std::floor(y), fx = x - left, fy = y - low;
    const int i = static_cast<int>(left), j = static_cast<int>(low);
    return (pixel(i, j) * (1 - fx) + pixel(i + 1, j) * fx) * (1 - fy) +
           (pixel(i, j + 1) * (1 - fx) + pixel(i + 1, j + 1) * fx) * fy;
}

/// The pixel of an octahedral picture of a sphere at a place that may be beyond one of its borders: there the sphere
/// goes on behind that border, mirrored about its middle. As in pbrt it begins there with the second row or column
/// where a coordinate is negative, and with the first beyond the other borders.
inline const Rgb& octahedral_pixel(const Image& image, int x, int y) {
    const auto mirrored = [](int i, int n) { return i < 0 ? -i : 2 * n - 1 - i; };
    if (x < 0 || x >= image.width) {
        x = mirrored(x, image.width);
        y = image.height - 1 - y;
    }
    if (y < 0 || y >= image.height) {
        y = mirrored(y, image.height);
        x = image.width - 1 - x;
    }
    // Further away than the picture is wide, there is nothing that makes sense.
    return image.at(std::clamp(x, 0, image.width - 1), std::clamp(y, 0, image.height - 1));
}

}  // namespace wend
