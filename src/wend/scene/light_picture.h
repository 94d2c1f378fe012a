// Pictures that lights shine by.
#pragma once

#include <wend/core/image.h>
#include <wend/core/vector.h>

namespace wend {

/// A picture that multiplies what a light emits, by a point (x, y) of the unit square, the first row at y = 0. Points
/// outside see its edge. Its pixels are finite and not negative.
class LightPicture {
public:
    explicit LightPicture(Image image);

    /// Of the pixel that holds the point.
    const Rgb& nearest(const Vec2& point) const;
    /// Interpolated between the middles of pixels.
    Rgb bilinear(const Vec2& point) const;
    /// Of all pixels alike.
    const Rgb& mean_colour() const { return mean_; }
    const Image& image() const { return image_; }

private:
    const Rgb& clamped(int x, int y) const;

    Image image_;
    Rgb mean_;
};

}  // namespace wend
