// Random numbers as arguments: a small generator and the hash that keys it by (pixel, sample, branch).
#pragma once

#include <wend/core/vector.h>

#include <cstdint>

namespace wend {

/// A well-mixed 64-bit hash of a 64-bit key (the finalizer of splitmix64).
constexpr std::uint64_t mix(std::uint64_t x) {
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9ull;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebull;
    x ^= x >> 31;
    return x;
}

/// A hash of several keys, order mattering.
template <class... Keys>
constexpr std::uint64_t hash_of(Keys... keys) {
    std::uint64_t h = 0x9e3779b97f4a7c15ull;
    ((h = mix(h + 0x9e3779b97f4a7c15ull + static_cast<std::uint64_t>(keys))), ...);
    return h;
}

/// A uniform number in [0, 1) from the top 24 bits.
constexpr float to_unit_float(std::uint32_t bits) {
    return static_cast<float>(bits >> 8) * 0x1p-24f;
}

/// PCG32 (oneill2014): 64 bits of state, 32 bits out, independent streams by key.
class Pcg32 {
public:
    /// The stream of a key: equal keys give equal numbers.
    explicit constexpr Pcg32(std::uint64_t key) : state_(mix(key)), increment_(mix(key ^ 0xda3e39cb94b95bdbull) | 1u) {
        next();
    }

    /// 32 uniform bits.
    constexpr std::uint32_t next() {
        const std::uint64_t old = state_;
        state_ = old * 6364136223846793005ull + increment_;
        const auto xorshifted = static_cast<std::uint32_t>(((old >> 18u) ^ old) >> 27u);
        const auto rotation = static_cast<std::uint32_t>(old >> 59u);
        return (xorshifted >> rotation) | (xorshifted << ((32u - rotation) & 31u));
    }

    /// Uniform in [0, 1).
    constexpr float uniform() { return to_unit_float(next()); }
    /// Uniform in [0, 1) with 53 random bits, from two draws. The 24 bits of a float cannot draw an event rarer than
    /// 6e-8, nor place a sample between its steps.
    constexpr double uniform_double() {
        const auto high = static_cast<std::uint64_t>(next());
        return static_cast<double>((high << 32 | next()) >> 11) * 0x1p-53;
    }
    /// Uniform in [0, 1)², x drawn first.
    Vec2 uniform2() {
        const float x = uniform();
        return {x, uniform()};
    }

private:
    std::uint64_t state_;
    std::uint64_t increment_;
};

}  // namespace wend
