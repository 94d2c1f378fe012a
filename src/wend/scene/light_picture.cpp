#include <wend/scene/light_picture.h>

#include <wend/core/contracts.h>
#include <wend/scene/picture_lookup.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// A coordinate in pixels, where a conversion to int is defined.
float to_pixels(float coordinate, int pixels) {
    constexpr float beyond_any_picture = 1e6f;
    const float scaled = coordinate * static_cast<float>(pixels);
    return std::isfinite(scaled) ? std::clamp(scaled, -beyond_any_picture, beyond_any_picture) : 0.0f;
}

}  // namespace

LightPicture::LightPicture(Image image) : image_(std::move(image)) {
    WEND_EXPECT(image_.width > 0 && image_.height > 0);
    double sum[3] = {0, 0, 0};
    for (const Rgb& pixel : image_.pixels) {
        for (int c = 0; c < 3; ++c) {
            sum[c] += static_cast<double>(pixel[c]);
        }
    }
    for (int c = 0; c < 3; ++c) {
        mean_[c] = static_cast<float>(sum[c] / static_cast<double>(image_.pixels.size()));
    }
}

const Rgb& LightPicture::clamped(int x, int y) const {
    return image_.at(std::clamp(x, 0, image_.width - 1), std::clamp(y, 0, image_.height - 1));
}

const Rgb& LightPicture::nearest(const Vec2& point) const {
    return clamped(static_cast<int>(std::floor(to_pixels(point.x, image_.width))),
                   static_cast<int>(std::floor(to_pixels(point.y, image_.height))));
}

Rgb LightPicture::bilinear(const Vec2& point) const {
    return wend::bilinear(Vec2(to_pixels(point.x, image_.width), to_pixels(point.y, image_.height)),
                          [this](int i, int j) { return clamped(i, j); });
}

}  // namespace wend
