// Numbers of all lobes of a mixture side by side, in a form that compilers turn into vector instructions.
#pragma once

#include <cstring>

namespace wend::guide {

/// Most lobes of a mixture.
inline constexpr int max_lobes = 16;
/// Loops run over whole blocks of lanes, so their inner length is a constant; unused lanes hold harmless numbers.
inline constexpr int lanes_per_block = 8;

constexpr int blocks_for(int lobes) {
    return (lobes + lanes_per_block - 1) / lanes_per_block;
}

/// One number per lobe.
struct alignas(16) Lanes {
    float value[max_lobes] = {};

    Lanes() = default;
    // Written out, since compilers copy a structure of many lanes by a slow string instruction otherwise.
    Lanes(const Lanes& other) { std::memcpy(value, other.value, sizeof value); }
    Lanes& operator=(const Lanes& other) {
        std::memcpy(value, other.value, sizeof value);
        return *this;
    }

    float& operator[](int i) { return value[i]; }
    float operator[](int i) const { return value[i]; }
};

/// Calls body(i) for every lane of the first `blocks` blocks.
template <class Body>
inline void for_lanes(int blocks, const Body& body) {
    for (int block = 0; block < blocks; ++block) {
        for (int j = 0; j < lanes_per_block; ++j) {
            body(block * lanes_per_block + j);
        }
    }
}

/// Combines the lanes of the first `blocks` blocks by an associative and commutative operation, in an order that does
/// not depend on the vector width.
template <class Operation>
inline float reduce_lanes(int blocks, const Lanes& lanes, const Operation& combine) {
    static_assert(lanes_per_block == 8);
    float a[8];
    for (int j = 0; j < 8; ++j) {
        a[j] = lanes.value[j];
    }
    for (int block = 1; block < blocks; ++block) {
        for (int j = 0; j < 8; ++j) {
            a[j] = combine(a[j], lanes.value[block * 8 + j]);
        }
    }
    float b[4];
    for (int j = 0; j < 4; ++j) {
        b[j] = combine(a[j], a[j + 4]);
    }
    return combine(combine(b[0], b[2]), combine(b[1], b[3]));
}

inline float sum_lanes(int blocks, const Lanes& lanes) {
    return reduce_lanes(blocks, lanes, [](float a, float b) { return a + b; });
}

inline float largest_lane(int blocks, const Lanes& lanes) {
    return reduce_lanes(blocks, lanes, [](float a, float b) { return a > b ? a : b; });
}

}  // namespace wend::guide
