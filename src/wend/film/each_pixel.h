// Work on all pixels of a film.
#pragma once

#include <wend/core/parallel.h>
#include <wend/film/film.h>

#include <cstddef>

namespace wend {

/// each(index of a pixel), in no order, on all threads: between passes, and where a render was told to stop, there is
/// nothing else to do.
template <class Each>
void for_each_pixel(const PixelRect& crop, const Each& each) {
    const auto width = static_cast<std::size_t>(crop.width());
    parallel_for(static_cast<std::size_t>(crop.height()), 0, [&](std::size_t row) {
        for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
            each(i);
        }
    });
}

}  // namespace wend
