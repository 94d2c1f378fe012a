// The colours of a cell's lobes, and the short floats that they are kept in.
#pragma once

#include <wend/core/colour.h>
#include <wend/guide/lanes.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace wend::guide {

/// A float in 16 bits: the range of a float and 8 significant bits, so a relative error of at most 1/256.
class BriefFloat {
public:
    /// 0.
    constexpr BriefFloat() = default;
    /// Rounds to the nearest, ties to even. Finite numbers only.
    constexpr BriefFloat(float value) {
        const auto bits = std::bit_cast<std::uint32_t>(value);
        const std::uint32_t rounded = (bits + 0x7fffu + (bits >> 16 & 1u)) >> 16;
        bits_ = static_cast<std::uint16_t>(rounded);
    }
    /// The number, exactly as it is kept.
    constexpr operator float() const { return std::bit_cast<float>(std::uint32_t{bits_} << 16); }

private:
    std::uint16_t bits_ = 0;
};

/// Of each lobe its radiance by channel over their mean, to within 1/256: white at first.
class LobeColours {
public:
    /// White.
    LobeColours() {
        red_.fill(1.0f);
        blue_.fill(1.0f);
    }

    /// A colour of mean 1; channels are not negative.
    void set(int lobe, float red, float blue) {
        red_[static_cast<std::size_t>(lobe)] = red;
        blue_[static_cast<std::size_t>(lobe)] = blue;
    }
    /// The colour of a lobe, of mean 1; green is what red and blue leave.
    Rgb operator[](int lobe) const {
        const float red = red_[static_cast<std::size_t>(lobe)], blue = blue_[static_cast<std::size_t>(lobe)];
        return {red, std::max(0.0f, 3 - red - blue), blue};
    }

private:
    std::array<BriefFloat, max_lobes> red_, blue_;
};

}  // namespace wend::guide
