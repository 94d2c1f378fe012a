// How the integers of picture files map to linear colour.
#pragma once

#include <wend/io/image_file.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace wend {

/// The sRGB transfer function and its inverse, of values in [0, 1].
float srgb_to_linear(float v);
float linear_to_srgb(float v);

/// The linear values of 0, 1, ..., `largest`, of which the last means 1.
std::vector<float> decoding_table(ColourEncoding encoding, std::uint32_t largest);

/// Those of all numbers that an integer channel can hold.
template <class Integer>
std::vector<float> decoding_table(ColourEncoding encoding) {
    return decoding_table(encoding, std::numeric_limits<Integer>::max());
}

}  // namespace wend
