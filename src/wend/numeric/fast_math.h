// Elementary functions short enough to be inlined, and the same on every machine: exponentials of which the compiler
// can do several at once, a logarithm, and sine and cosine of a share of a turn.
#pragma once

#include <bit>
#include <cstdint>
#include <numbers>

namespace wend {

/// A float with its integer part, rounded to nearest, moved into the low bits of the mantissa.
struct RoundedExponent {
    /// What moves it there: to be added, and taken away again.
    static constexpr float to_integer = 0x1.8p23f;

    float shifted;  ///< the rounded number plus `to_integer`

    /// Of x, |x| < 2^22.
    explicit RoundedExponent(float x) : shifted(x + to_integer) {}
    /// The integer next to x, as a float.
    float integer() const { return shifted - to_integer; }
};

/// A power of two by its factors, 2^n (1 + rest), |rest| < 1/2.
struct FastPower {
    /// Coefficient of r. 1 plus the polynomial of the five has the least largest relative error, 1e-7, and all digits
    /// of a small r.
    static constexpr float first = 0.6931472f;
    static constexpr float second = 0.24022283f;   ///< of r²
    static constexpr float third = 0.055505585f;   ///< of r³
    static constexpr float fourth = 0.009669691f;  ///< of r to the power of 4
    static constexpr float fifth = 0.0013300605f;  ///< of r to the power of 5

    float rest;               ///< by how much 2^r differs from 1
    std::uint32_t shifted_n;  ///< n where a float has its exponent: adding it to the bits multiplies by 2^n

    /// 2^(n + r), |r| <= 1/2.
    FastPower(RoundedExponent n, float r) {
        // By halves that do not wait for each other.
        const float r2 = r * r;
        const float high = (second + r * third) + r2 * (fourth + r * fifth);
        rest = r * first + r2 * high;
        // The shift drops what RoundedExponent::to_integer has there.
        shifted_n = std::bit_cast<std::uint32_t>(n.shifted) << 23;
    }

    /// The power itself.
    float value() const { return std::bit_cast<float>(std::bit_cast<std::uint32_t>(1 + rest) + shifted_n); }
    /// The power minus 1, near 1 with all digits.
    float minus_one() const {
        const float power = std::bit_cast<float>(0x3f800000u + shifted_n);
        return power * rest + (power - 1);
    }
};

/// Below this, fast_exp2 stays at its value there (2e-35) rather than underflow, which would slow down what follows.
inline constexpr float fast_exp2_smallest = -115.0f;

/// 2^x in factors, for whoever wants both fast_exp2() and fast_exp2m1() of it.
inline FastPower fast_power_of_two(float x) {
    x = x > fast_exp2_smallest ? x : fast_exp2_smallest;
    const RoundedExponent n(x);
    return {n, x - n.integer()};
}

/// 2^x for x in [fast_exp2_smallest, 127]; smaller x, and NaN, give 2^fast_exp2_smallest. Relative error below 3e-7. No
/// branch, no table and no call: a loop over it vectorizes without loosening floating-point rules, and the result is
/// the same at every vector width.
inline float fast_exp2(float x) {
    return fast_power_of_two(x).value();
}

/// 2^x - 1 for x in [fast_exp2_smallest, 127], of small x with all digits. Relative error below 1e-6.
inline float fast_exp2m1(float x) {
    return fast_power_of_two(x).minus_one();
}

/// Below this, fast_exp stays at its value there (1.8e-35) rather than underflow, which would slow down what follows.
inline constexpr float fast_exp_smallest = -80.0f;

/// From powers of e to powers of 2.
struct NaturalBase {
    /// What powers are multiplied by.
    static constexpr float log2_e = std::numbers::log2e_v<float>;
    /// Of two parts of ln 2 the larger one, with few enough digits for its multiples to be exact.
    static constexpr float ln2_high = 0.693359375f;
    /// The other part: what the larger one lacks.
    static constexpr float ln2_low = -2.12194440e-4f;
};

/// e^x in factors, for whoever wants both fast_exp() and fast_expm1() of it.
inline FastPower fast_power_of_e(float x) {
    using B = NaturalBase;
    x = x > fast_exp_smallest ? x : fast_exp_smallest;
    const RoundedExponent n(x * B::log2_e);
    return {n, ((x - n.integer() * B::ln2_high) - n.integer() * B::ln2_low) * B::log2_e};
}

/// e^x for x in [fast_exp_smallest, 88]; smaller x, and NaN, give e^fast_exp_smallest. Relative error below 5e-7. Loops
/// over it vectorize like those over fast_exp2.
inline float fast_exp(float x) {
    return fast_power_of_e(x).value();
}

/// e^x - 1 for x in [fast_exp_smallest, 88], of small x with all digits. Relative error below 1e-6.
inline float fast_expm1(float x) {
    return fast_power_of_e(x).minus_one();
}

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

/// A point of the unit circle.
struct Turn {
    float cosine;  ///< of the angle to the first axis
    float sine;    ///< of the same angle
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
