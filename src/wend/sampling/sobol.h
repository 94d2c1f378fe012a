// Two-dimensional Owen-scrambled Sobol points (burley2020), padded: each pair of dimensions is an independently
// shuffled and scrambled copy of the first two Sobol dimensions.
#pragma once

#include <wend/core/random.h>

#include <array>
#include <cstdint>

namespace wend {

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    return __builtin_bswap32(x);
}

/// A hash in which a bit of the result depends on the bits of x below it only (laine2011, with the constants of
/// burley2020's erratum): on bit-reversed numbers this is an Owen scramble.
constexpr std::uint32_t scramble_reversed(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/// The first two Sobol coordinates of a point, as bit-reversed 32-bit fractions. The second dimension's matrix is
/// Pascal's triangle modulo 2, a Kronecker power of [1 1; 0 1], hence five butterfly steps.
constexpr std::array<std::uint32_t, 2> sobol_reversed(std::uint32_t index) {
    std::uint32_t y = index;
    y ^= (y >> 1) & 0x55555555u;
    y ^= (y >> 2) & 0x33333333u;
    y ^= (y >> 4) & 0x0f0f0f0fu;
    y ^= (y >> 8) & 0x00ff00ffu;
    y ^= (y >> 16) & 0x0000ffffu;
    return {index, y};
}

/// Point `index` of the scrambled sequence that `key` names.
inline Vec2 owen_sobol(std::uint32_t index, std::uint64_t key) {
    const auto shuffle = static_cast<std::uint32_t>(key);
    const auto scramble = static_cast<std::uint32_t>(key >> 32);
    const std::uint32_t shuffled = reverse_bits(scramble_reversed(reverse_bits(index), shuffle));
    const auto point = sobol_reversed(shuffled);
    return {to_unit_float(reverse_bits(scramble_reversed(point[0], scramble))),
            to_unit_float(reverse_bits(scramble_reversed(point[1], scramble * 0x9e3779b1u + 0x85ebca6bu)))};
}

}  // namespace wend
