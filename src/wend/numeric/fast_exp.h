// An exponential function short enough for the compiler to do several at once.
#pragma once

#include <wend/numeric/fast_exp2.h>

#include <numbers>

namespace wend {

/// Below this, fast_exp stays at its value there (1.8e-35) rather than underflow, which would slow down what follows.
inline constexpr float fast_exp_smallest = -80.0f;

/// From powers of e to powers of 2.
struct NaturalBase {
    static constexpr float log2_e = std::numbers::log2e_v<float>;
    /// ln 2 in two parts, the first with few enough digits for its multiples to be exact.
    static constexpr float ln2_high = 0.693359375f, ln2_low = -2.12194440e-4f;
};

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

}  // namespace wend
