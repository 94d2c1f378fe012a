#include <wend/film/tone.h>

#include <algorithm>
#include <cmath>

namespace wend {

std::uint8_t encode_srgb(float linear) {
    if (!(linear > 0)) {
        return 0;
    }
    const float value = std::min(linear, 1.0f);
    const float encoded = value <= 0.0031308f ? 12.92f * value : 1.055f * std::pow(value, 1 / 2.4f) - 0.055f;
    return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

float decode_srgb(std::uint8_t byte) {
    const float encoded = static_cast<float>(byte) / 255;
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

Image expose(const Image& image, float stops) {
    const float factor = std::exp2(stops);
    Image result = image;
    for (Rgb& pixel : result.pixels) {
        pixel *= factor;
    }
    return result;
}

std::vector<std::uint8_t> to_srgb8(const Image& image) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * image.pixels.size());
    for (const Rgb& pixel : image.pixels) {
        for (int c = 0; c < 3; ++c) {
            bytes.push_back(encode_srgb(pixel[c]));
        }
    }
    return bytes;
}

}  // namespace wend
