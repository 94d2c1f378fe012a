// Powers of two, for densities whose exponents can be told in that base at no cost: the shortest chain of operations.
#pragma once

#include <bit>
#include <cstdint>

namespace wend {

/// A float with its integer part, rounded to nearest, moved into the low bits of the mantissa.
struct RoundedExponent {
    static constexpr float to_integer = 0x1.8p23f;

    float shifted;

    explicit RoundedExponent(float x) : shifted(x + to_integer) {}
    float integer() const { return shifted - to_integer; }
};

/// A power of two by its factors, 2^n (1 + rest), |rest| < 1/2.
struct FastPower {
    /// 1 plus the polynomial of these has the least largest relative error, 1e-7, and all digits of a small r.
    static constexpr float first = 0.6931472f, second = 0.24022283f, third = 0.055505585f, fourth = 0.009669691f,
                           fifth = 0.0013300605f;

    float rest;
    std::uint32_t shifted_n;

    /// 2^(n + r), |r| <= 1/2.
    FastPower(RoundedExponent n, float r) {
        // By halves that do not wait for each other.
        const float r2 = r * r;
        const float high = (second + r * third) + r2 * (fourth + r * fifth);
        rest = r * first + r2 * high;
        // The shift drops what RoundedExponent::to_integer has there.
        shifted_n = std::bit_cast<std::uint32_t>(n.shifted) << 23;
    }

    float value() const { return std::bit_cast<float>(std::bit_cast<std::uint32_t>(1 + rest) + shifted_n); }
    float minus_one() const {
        const float power = std::bit_cast<float>(0x3f800000u + shifted_n);
        return power * rest + (power - 1);
    }
};

/// Below this, fast_exp2 stays at its value there (2e-35) rather than underflow, which would slow down what follows.
inline constexpr float fast_exp2_smallest = -115.0f;

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

}  // namespace wend
