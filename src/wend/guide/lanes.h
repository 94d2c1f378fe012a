// Numbers of all lobes of a mixture side by side, for vector instructions.
#pragma once

#include <cstring>

namespace wend::guide {

/// Most lobes of a mixture.
inline constexpr int max_lobes = 16;
/// Loops run over whole blocks of lanes; unused lanes hold harmless numbers.
inline constexpr int lanes_per_block = 8;

/// How many blocks hold that many lobes.
constexpr int blocks_for(int lobes) {
    return (lobes + lanes_per_block - 1) / lanes_per_block;
}

/// Asks for lanes without numbers: every lane of a used block must be written before it is read.
struct Unset {};

/// One number per lobe.
struct alignas(16) Lanes {
    float value[max_lobes];  ///< by lobe; those beyond the mixture's size are of no meaning

    /// All 0.
    Lanes() : value{} {}
    /// All to be written.
    explicit Lanes(Unset) {}
    /// Written out, since compilers copy a structure of many lanes by a slow string instruction otherwise.
    Lanes(const Lanes& other) { std::memcpy(value, other.value, sizeof value); }
    /// Likewise.
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

    /// The number of a lobe, to be written.
    float& operator[](int i) { return value[i]; }
    /// The number of a lobe.
    float operator[](int i) const { return value[i]; }
};

/// The lobes of a mixture (mixture.h).
struct MixtureLanes {
    int size;         ///< lobes in use, 1 to max_lobes
    Lanes mean_x;     ///< first coordinate of the means, which have unit length
    Lanes mean_y;     ///< their second coordinate
    Lanes mean_z;     ///< their third
    Lanes kappa;      ///< concentrations
    Lanes weight;     ///< shares, with the sum 1
    Lanes amplitude;  ///< weight times density at the mean, in 1/sr

    /// As many lobes, of which all numbers are 0.
    explicit MixtureLanes(int lobes) : size(lobes) {}
    /// As many lobes, of which all numbers are to be written.
    MixtureLanes(int lobes, Unset unset)
        : size(lobes), mean_x(unset), mean_y(unset), mean_z(unset), kappa(unset), weight(unset), amplitude(unset) {}

    /// Blocks in use.
    int blocks() const { return blocks_for(size); }
    /// Numbers in these blocks, those of unused lobes included.
    int lanes() const { return blocks() * lanes_per_block; }
};

}  // namespace wend::guide
