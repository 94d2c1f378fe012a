// All tiles of a picture: which process walks which, and what all of them have come to.
#pragma once

#include <wend/render/learner.h>
#include <wend/render/tile.h>
#include <wend/render/tile_shares.h>

#include <cstddef>
#include <vector>

namespace wend {

class TilesAtWork {
public:
    /// Blocks of 16 by 16 pixels. `ranks` may be null, and must outlive this.
    TilesAtWork(const PixelRect& crop, Ranks* ranks);

    std::size_t size() const { return tiles_.size(); }
    Tile& operator[](std::size_t i) { return tiles_[i]; }
    const Tile& operator[](std::size_t i) const { return tiles_[i]; }
    TileShares& shares() { return shares_; }
    const TileShares& shares() const { return shares_; }

    void begin_pass(const GuidingChoice& choice, const PassPlan& plan);
    void end_pass();
    /// Among the processes, by the work that each tile is expected to be in the pass at hand.
    void share_out(const PassPlan& plan);

    /// Of all passes.
    WalkCounts counts() const;
    double walks(std::size_t kind) const;
    /// Of the pass at hand.
    std::vector<WalkTallies> tallies() const;
    /// Samples of a pixel as a mean, of all passes: of the picture, and of the tiles that this process walks, 0 where
    /// it walks none.
    double mean_samples() const;
    double own_mean_samples() const;

private:
    double samples_of(const Tile& tile, const PassPlan& plan) const;

    PixelRect crop_;
    std::vector<Tile> tiles_;
    TileShares shares_;  ///< of the pass at hand
};

}  // namespace wend
