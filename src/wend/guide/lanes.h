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

    /// Takes the first `blocks` blocks of another; the rest stays.
    void copy(int blocks, const Lanes& other) {
        for (int block = 0; block < blocks; ++block) {
            const int first = block * lanes_per_block;
            std::memcpy(value + first, other.value + first, lanes_per_block * sizeof(float));
        }
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

/// The numbers of one block, by the compilers' own vectors: for what loops over single lanes are not always recognized
/// as. Lowered to what the target has.
using Block [[gnu::vector_size(lanes_per_block * sizeof(float))]] = float;

/// Σ_i term(i) over every lane of the first `blocks` blocks, in an order that does not depend on the vector width.
template <class Term>
[[gnu::always_inline]] inline float sum_over_lanes(int blocks, const Term& term) {
    static_assert(lanes_per_block == 8);
    using Half [[gnu::vector_size(4 * sizeof(float))]] = float;
    Block sum{};
    for (int block = 0; block < blocks; ++block) {
        float terms[lanes_per_block];
        for (int j = 0; j < lanes_per_block; ++j) {
            terms[j] = term(block * lanes_per_block + j);
        }
        Block row;
        std::memcpy(&row, terms, sizeof row);
        sum += row;
    }
    Half halves[2];
    std::memcpy(halves, &sum, sizeof sum);
    const Half four = halves[0] + halves[1];
    return (four[0] + four[2]) + (four[1] + four[3]);
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

/// Of numbers that are not negative, what those before each one add up to, by a tree of few steps: never less than for
/// the one before, and the same across a 0.
class SumsBelow {
public:
    /// Of the first `blocks` blocks.
    [[gnu::always_inline]] void set(int blocks, const float* lanes) {
        static_assert(lanes_per_block == 8);
        blocks_ = blocks;
        float below = 0;
        sum_[0] = below;
        for (int first = 0; first < blocks * lanes_per_block; first += lanes_per_block) {
            const float* w = lanes + first;
            const float w01 = w[0] + w[1], w23 = w[2] + w[3], w45 = w[4] + w[5], w67 = w[6] + w[7];
            const float half = below + (w01 + w23), all = half + (w45 + w67);
            // As a whole, since that is how it will be read.
            const Block sums = {below + w[0], below + w01, below + (w01 + w[2]), half,
                                half + w[4],  half + w45,  half + (w45 + w[6]),  all};
            std::memcpy(sum_ + first + 1, &sums, sizeof sums);
            below = all;
        }
        total_ = below;
    }

    float operator[](int i) const { return sum_[i]; }
    float total() const { return total_; }

    /// The lane whose share of the total holds the target, in [0, total): never one of 0.
    int find(float target) const {
        // No branch depends on the target: the processor could not guess it.
        int passed = 0;
        for_lanes(blocks_, [&](int i) { passed += sum_[i + 1] <= target ? 1 : 0; });
        return passed;
    }

private:
    int blocks_;
    float total_;
    float sum_[max_lobes + 1];
};

}  // namespace wend::guide
