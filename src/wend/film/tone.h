// From linear colour to what a display takes.
#pragma once

#include <wend/core/image.h>

#include <cstdint>
#include <vector>

namespace wend {

/// The sRGB transfer curve (IEC 61966-2-1) as a byte: linear 0 is 0, linear 1 and above 255, negative values and NaN 0.
std::uint8_t encode_srgb(float linear);

/// The inverse of encode_srgb: linear value in [0,1] of an sRGB byte.
float decode_srgb(std::uint8_t byte);

/// The picture times 2^stops.
Image expose(const Image& image, float stops);

/// Bytes R, G, B of every pixel, row-major, ready for an 8-bit file.
std::vector<std::uint8_t> to_srgb8(const Image& image);

}  // namespace wend
