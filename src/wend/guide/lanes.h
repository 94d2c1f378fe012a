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

/// Asks for lanes without numbers: every lane of a used block must be written before it is read.
struct Unset {};

/// One number per lobe.
struct alignas(16) Lanes {
    float value[max_lobes];

    Lanes() : value{} {}
    explicit Lanes(Unset) {}
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

/// The numbers of one block, by the compilers' own vectors: for sums over what is stored block after block, which loops
/// over single lanes are not always recognized as. Lowered to what the target has.
using Block [[gnu::vector_size(lanes_per_block * sizeof(float))]] = float;

/// to[i] = Σ_j from[j * stride + i] for the lanes of one block, from the first of `count` rows on.
inline void sum_rows(const float* from, int count, int stride, float* to) {
    Block sum;
    std::memcpy(&sum, from, sizeof sum);
    for (int j = 1; j < count; ++j) {
        Block row;
        std::memcpy(&row, from + j * stride, sizeof row);
        sum += row;
    }
    std::memcpy(to, &sum, sizeof sum);
}

/// Combines the lanes of the first `blocks` blocks by an associative and commutative operation, in an order that does
/// not depend on the vector width.
template <class Operation>
inline float reduce_lanes(int blocks, const Lanes& lanes, const Operation& combine) {
    static_assert(lanes_per_block == 8);
    // By half blocks: what was just stored by wide instructions comes back at once by narrower ones, not the reverse.
    float b[4];
    for (int j = 0; j < 4; ++j) {
        b[j] = combine(lanes.value[j], lanes.value[j + 4]);
    }
    for (int block = 1; block < blocks; ++block) {
        for (int j = 0; j < 4; ++j) {
            b[j] = combine(b[j], combine(lanes.value[block * 8 + j], lanes.value[block * 8 + j + 4]));
        }
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
