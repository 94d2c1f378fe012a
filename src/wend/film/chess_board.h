// A picture divided like a chess board. Pixels are independent, so what those of one colour show may weigh those of the
// other without bias: no sample has a say in its own weight.
#pragma once

#include <wend/core/image.h>

#include <cstddef>

namespace wend {

/// The half that a pixel is in, 0 or 1; `index` counts row by row in a picture of that width.
inline std::size_t chess_half(std::size_t index, int width) {
    const auto columns = static_cast<std::size_t>(width);
    return (index % columns + index / columns) % 2;
}

/// The picture as the pixels of one half tell it: the others are the mean of their neighbours above, below and beside,
/// which are all of that half. Black where there are none.
Image filled_from_half(Image image, std::size_t half);

}  // namespace wend
