#include <wend/io/colour_encoding.h>

#include <cmath>

namespace wend {

float srgb_to_linear(float v) {
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

float linear_to_srgb(float v) {
    return v <= 0.0031308f ? v * 12.92f : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f;
}

std::vector<float> decoding_table(ColourEncoding encoding, std::uint32_t largest) {
    std::vector<float> table(std::size_t{largest} + 1);
    for (std::size_t i = 0; i < table.size(); ++i) {
        const float v = static_cast<float>(i) / static_cast<float>(largest);
        table[i] = encoding == ColourEncoding::srgb ? srgb_to_linear(v) : v;
    }
    return table;
}

}  // namespace wend
