// Numbers of which the field keeps many and needs few digits.
#pragma once

#include <bit>
#include <cstdint>

namespace wend::guide {

/// A float in 16 bits: the range of a float and 8 significant bits, so a relative error of at most 1/256.
class BriefFloat {
public:
    constexpr BriefFloat() = default;
    /// Rounds to the nearest, ties to even. Finite numbers only.
    constexpr BriefFloat(float value) {
        const auto bits = std::bit_cast<std::uint32_t>(value);
        const std::uint32_t rounded = (bits + 0x7fffu + (bits >> 16 & 1u)) >> 16;
        bits_ = static_cast<std::uint16_t>(rounded);
    }
    constexpr operator float() const { return std::bit_cast<float>(std::uint32_t{bits_} << 16); }

private:
    std::uint16_t bits_ = 0;
};

}  // namespace wend::guide
