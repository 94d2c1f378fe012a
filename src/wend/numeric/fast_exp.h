// An exponential function short enough for the compiler to do several at once.
#pragma once

#include <bit>
#include <cstdint>

namespace wend {

/// Below this, fast_exp stays at its value there (1.8e-35) rather than underflow, which would slow down what follows.
inline constexpr float fast_exp_smallest = -80.0f;

/// The two factors of e^x = 2^n (1 + rest), |rest| < 1/2, for x in [fast_exp_smallest, 88].
struct FastExpParts {
    float rest;
    std::uint32_t shifted_n;

    float power_of_two() const { return std::bit_cast<float>(0x3f800000u + shifted_n); }
};

inline FastExpParts fast_exp_parts(float x) {
    constexpr float log2_e = 1.44269504f;
    // ln 2 in two parts, the first with few enough digits for n · ln2_high to be exact.
    constexpr float ln2_high = 0.693359375f, ln2_low = -2.12194440e-4f;
    // Adding this moves the integer part into the low bits of the mantissa, rounded to nearest.
    constexpr float to_integer = 0x1.8p23f;

    x = x > fast_exp_smallest ? x : fast_exp_smallest;
    const float shifted = x * log2_e + to_integer;
    const float n = shifted - to_integer;
    const float r = (x - n * ln2_high) - n * ln2_low;
    // 1 plus this polynomial, of degree 5 and 1 at 0, has the least largest relative error for |r| <= ln(2)/2, 1e-7.
    // It is evaluated by halves that do not wait for each other.
    const float r2 = r * r;
    const float high = (0.499991496f + r * 0.166676362f) + r2 * (0.0418979293f + r * 0.00829031497f);
    const float rest = r * 0.999999708f + r2 * high;
    // The shift drops what to_integer has there.
    return {rest, std::bit_cast<std::uint32_t>(shifted) << 23};
}

/// e^x for x in [fast_exp_smallest, 88]; smaller x, and NaN, give e^fast_exp_smallest. Relative error below 5e-7. No
/// branch, no table and no call: a loop over it vectorizes without loosening floating-point rules, and the result is
/// the same at every vector width.
inline float fast_exp(float x) {
    const FastExpParts e = fast_exp_parts(x);
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(1 + e.rest) + e.shifted_n);
}

/// e^x - 1 for x in [fast_exp_smallest, 88], of small x with all digits. Relative error below 1e-6.
inline float fast_expm1(float x) {
    const FastExpParts e = fast_exp_parts(x);
    return e.power_of_two() * e.rest + (e.power_of_two() - 1);
}

}  // namespace wend
