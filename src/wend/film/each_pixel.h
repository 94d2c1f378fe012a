// Work on all pixels of a film.
#pragma once

#include <wend/core/parallel.h>
#include <wend/film/film.h>

#include <cstddef>
#include <cstdint>

namespace wend {

/// For parallel_for(): all, since between passes, and where a render was told to stop, there is nothing else to do.
/// Small pictures are done before others have begun.
inline int threads_for(const PixelRect& crop) {
    constexpr std::int64_t small = 1 << 15;
    return std::int64_t{crop.width()} * crop.height() < small ? 1 : 0;
}

/// each(index of a pixel), in no order.
template <class Each>
void for_each_pixel(const PixelRect& crop, const Each& each) {
    const auto width = static_cast<std::size_t>(crop.width());
    parallel_for(static_cast<std::size_t>(crop.height()), threads_for(crop), [&](std::size_t row) {
        for (std::size_t i = row * width; i < (row + 1) * width; ++i) {
            each(i);
        }
    });
}

}  // namespace wend
