// The colours of a cell's lobes.
#pragma once

#include <wend/core/colour.h>
#include <wend/guide/brief_float.h>
#include <wend/guide/lanes.h>

#include <algorithm>
#include <array>
#include <cstddef>

namespace wend::guide {

/// Of each lobe its radiance by channel over their mean, to within 1/256: white at first.
class LobeColours {
public:
    LobeColours() {
        red_.fill(1.0f);
        blue_.fill(1.0f);
    }

    /// A colour of mean 1; channels are not negative.
    void set(int lobe, float red, float blue) {
        red_[static_cast<std::size_t>(lobe)] = red;
        blue_[static_cast<std::size_t>(lobe)] = blue;
    }
    Rgb operator[](int lobe) const {
        const float red = red_[static_cast<std::size_t>(lobe)], blue = blue_[static_cast<std::size_t>(lobe)];
        return {red, std::max(0.0f, 3 - red - blue), blue};
    }

private:
    std::array<BriefFloat, max_lobes> red_, blue_;
};

}  // namespace wend::guide
