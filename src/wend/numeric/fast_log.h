// A logarithm short enough to be inlined, and the same on every machine.
#pragma once

#include <bit>
#include <cstdint>

namespace wend {

/// ln x for normal positive x. Error below 2e-7 of the result or, near 1, of x - 1. No branch, no table and no call.
inline float fast_log(float x) {
    constexpr float ln2_high = 0.693359375f, ln2_low = -2.12194440e-4f;
    constexpr std::uint32_t sqrt_half = 0x3f3504f3;
    // x = m 2^n with m between sqrt(1/2) and sqrt(2).
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const std::int32_t exponent = static_cast<std::int32_t>(bits - sqrt_half) >> 23;
    const float m = std::bit_cast<float>(bits - (static_cast<std::uint32_t>(exponent) << 23));
    const auto n = static_cast<float>(exponent);
    // ln m = f + f² times a polynomial that has the least largest relative error for these m, 3e-8. Pairs of terms do
    // not wait for each other, and nothing for a division.
    const float f = m - 1, f2 = f * f;
    const float low = (-0.4999999f + f * 0.3333395f) + f2 * (-0.25001755f + f * 0.19962072f);
    const float high = (-0.16570508f + f * 0.14917974f) + f2 * (-0.14307521f + f * 0.08734843f);
    const float rest = f2 * (low + f2 * f2 * high);
    return n * ln2_high + (f + (rest + n * ln2_low));
}

/// ln(1 + x) for 1 + x normal and positive, without losing the digits of a small x.
inline float fast_log1p(float x) {
    const float y = 1 + x;
    return fast_log(y) + (x - (y - 1)) / y;
}

}  // namespace wend
