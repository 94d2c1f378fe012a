// A part of a picture, and what its walks have come to.
#pragma once

#include <wend/core/vector.h>
#include <wend/film/film.h>
#include <wend/render/guiding_choice.h>
#include <wend/render/render.h>
#include <wend/render/walk_tally.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace wend {

/// A block of pixels, rendered by one thread at a time.
struct Tile {
    PixelRect pixels;
    WalkCounts counts;
    WalkShares shares{1};                                ///< in the pass at hand
    WalkTallies tallies{};                               ///< of it
    std::array<std::uint64_t, most_walk_kinds> walks{};  ///< of each kind, in all passes
    std::array<double, most_walk_kinds> work{};          ///< theirs, counted as WalkTally::work
    // How far this pass is: kinds whose walks are done, pixels that have all walks of the next kind, samples of the
    // next pixel that are done or of another kind, and what they have brought.
    std::size_t kinds_done = 0;
    int pixels_done = 0, samples_done = 0;
    PixelWalks of_pixel;

    int pixel_count() const { return pixels.width() * pixels.height(); }
    Vec2i pixel(int index) const {
        return {pixels.min.x + index % pixels.width(), pixels.min.y + index / pixels.width()};
    }

    /// Of a walk in the pass at hand, by those that there have been.
    double expected_work() const {
        const auto all_walks = static_cast<double>(std::accumulate(walks.begin(), walks.end(), std::uint64_t{0}));
        const double all_work = std::accumulate(work.begin(), work.end(), 0.0);
        double expected = 0;
        for (std::size_t kind = 0; kind < most_walk_kinds; ++kind) {
            const bool is_known = walks[kind] > 0;
            expected += static_cast<double>(shares[kind]) * (is_known ? work[kind] : all_work) /
                        std::max(is_known ? static_cast<double>(walks[kind]) : all_walks, 1.0);
        }
        return expected;
    }

    /// See ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& tile) {
        bytes(tile.counts, tile.shares, tile.tallies, tile.walks, tile.work, tile.kinds_done, tile.pixels_done,
              tile.samples_done, tile.of_pixel);
        bytes.require(tile.kinds_done <= most_walk_kinds && tile.pixels_done >= 0 &&
                      tile.pixels_done <= tile.pixel_count() && tile.samples_done >= 0);
    }
};

}  // namespace wend
