// What a walk found, and what it took.
#pragma once

#include <wend/film/film.h>

#include <cstdint>

namespace wend {

/// Counted work of walks.
struct WalkCounts {
    std::uint64_t paths = 0;
    std::uint64_t segments = 0;
    std::uint64_t rejected = 0;

    WalkCounts& operator+=(const WalkCounts& o) {
        paths += o.paths;
        segments += o.segments;
        rejected += o.rejected;
        return *this;
    }
};

/// What a walk found. The radiance may be not finite: the caller counts and rejects.
struct WalkResult {
    FilmSample sample;
    std::uint32_t interior_segments = 0;  ///< of the segments, those of guided interior walks
    /// An estimate of the mean square of what walks bring, as a mean over the channels, were all decisions but those of
    /// interior walks classical: that of this walk, if they are.
    double unguided_square = 0;
};

}  // namespace wend
