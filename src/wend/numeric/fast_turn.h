// Sine and cosine of a share of a turn, short enough to be inlined and the same on every machine.
#pragma once

#include <bit>
#include <cstdint>

namespace wend {

struct Turn {
    float cosine, sine;
};

/// Cosine and sine of 2 pi u for u in [0, 1]. Error below 1e-7. Quarters are told apart by bits instead of branches,
/// which nobody could predict.
inline Turn fast_turn(float u) {
    constexpr float two_pi = 6.28318531f;
    // Adding this moves the integer part into the low bits of the mantissa, rounded to nearest: faster than
    // conversions.
    constexpr float to_integer = 0x1.8p23f;
    const float shifted = 4 * u + to_integer;
    // At most an eighth of a turn, without rounding.
    const float a = two_pi * (u - 0.25f * (shifted - to_integer));
    const float x = a * a;
    const auto sine =
        std::bit_cast<std::uint32_t>(a + a * x * (-0.166666647f + x * (0.00833274827f - x * 0.000195878909f)));
    const auto cosine = std::bit_cast<std::uint32_t>(
        1 - (0.5f * x - x * x * (0.0416666647f + x * (-0.0013888303f + x * 2.45479421e-05f))));

    const auto q = std::bit_cast<std::uint32_t>(shifted);
    const std::uint32_t exchange = (sine ^ cosine) & (0u - (q & 1u));
    return {std::bit_cast<float>(cosine ^ exchange ^ (((q + 1) & 2u) << 30)),
            std::bit_cast<float>(sine ^ exchange ^ ((q & 2u) << 30))};
}

}  // namespace wend
