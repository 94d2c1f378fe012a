#pragma once

#include <wend/core/colour.h>

#include <cstddef>
#include <vector>

namespace wend {

/// A picture in memory: linear colour, row-major, the first row on top.
struct Image {
    int width = 0;            ///< in pixels
    int height = 0;           ///< in pixels
    std::vector<Rgb> pixels;  ///< as many as width times height

    Image() = default;
    /// Of one colour.
    Image(int w, int h, Rgb fill = {})
        : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), fill) {}

    /// The pixel in column x and row y, to be written.
    Rgb& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
    /// The pixel in column x and row y.
    const Rgb& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

}  // namespace wend
