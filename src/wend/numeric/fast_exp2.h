// Powers of two, for densities whose exponents can be told in that base at no cost: the shortest chain of operations.
#pragma once

#include <bit>
#include <cstdint>

namespace wend {

/// Below this, fast_exp2 stays at its value there (2e-35) rather than underflow, which would slow down what follows.
inline constexpr float fast_exp2_smallest = -115.0f;

/// The two factors of 2^x = 2^n (1 + rest), |rest| < 1/2, for x in [fast_exp2_smallest, 127].
struct FastExp2Parts {
    float rest;
    std::uint32_t shifted_n;

    float power_of_two() const { return std::bit_cast<float>(0x3f800000u + shifted_n); }
};

inline FastExp2Parts fast_exp2_parts(float x) {
    // Adding this moves the integer part into the low bits of the mantissa, rounded to nearest.
    constexpr float to_integer = 0x1.8p23f;

    x = x > fast_exp2_smallest ? x : fast_exp2_smallest;
    const float shifted = x + to_integer;
    const float r = x - (shifted - to_integer);
    // 1 plus this polynomial has the least largest relative error for |r| <= 1/2, 1e-7, and all digits of a small r. It
    // is evaluated by halves that do not wait for each other.
    const float r2 = r * r;
    const float high = (0.24022283f + r * 0.055505585f) + r2 * (0.009669691f + r * 0.0013300605f);
    const float rest = r * 0.6931472f + r2 * high;
    // The shift drops what to_integer has there.
    return {rest, std::bit_cast<std::uint32_t>(shifted) << 23};
}

/// 2^x for x in [fast_exp2_smallest, 127]; smaller x, and NaN, give 2^fast_exp2_smallest. Relative error below 3e-7. No
/// branch, no table and no call: a loop over it vectorizes, and the result is the same at every vector width.
inline float fast_exp2(float x) {
    const FastExp2Parts e = fast_exp2_parts(x);
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(1 + e.rest) + e.shifted_n);
}

/// 2^x - 1 for x in [fast_exp2_smallest, 127], of small x with all digits. Relative error below 1e-6.
inline float fast_exp2m1(float x) {
    const FastExp2Parts e = fast_exp2_parts(x);
    return e.power_of_two() * e.rest + (e.power_of_two() - 1);
}

}  // namespace wend
