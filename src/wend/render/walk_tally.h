// What walks of each kind have shown, tile by tile.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace wend {

/// What walks of one kind have shown in a tile.
struct WalkTally {
    double walks = 0;
    double value = 0;   ///< sum of what they brought
    double spread = 0;  ///< sum over the walks of the variance of what one brings
    double square = 0;  ///< the same, as PixelWalks weighs it
    double work = 0;    ///< counted: segments, each by what one costs (GuidingChoice::cost_of_segment)
    /// What `square` would be, had they gone the same ways unguided but inside dense media
    /// (WalkResult::unguided_square).
    double unguided = 0;

    WalkTally& operator+=(const WalkTally& o);
    /// As if there had been fewer walks.
    WalkTally scaled(double factor) const;
};

/// The walks of one kind that a pixel has in a pass.
class PixelWalks {
public:
    /// Their errors are multiplied by `scale`: the picture's mean over what is expected of the pixel, since errors
    /// count relative to their pixel. A walk counts for `weight` walks, the less the more the pixel has in a pass:
    /// kinds that have walks in different passes are to be compared in the same pixels.
    explicit PixelWalks(double scale = 1, double weight = 1) : scale_(scale), weight_(weight) {}

    /// A walk that brought so much, by so much counted work; see WalkResult::unguided_square.
    void add(float brought, double work, double unguided_square) {
        const double x = static_cast<double>(brought);
        ++count_;
        sum_ += x;
        squares_ += x * x;
        work_ += work;
        unguided_ += unguided_square;
    }
    /// Empty where one walk alone shows no variance.
    WalkTally tally() const;

private:
    double scale_, weight_;
    double count_ = 0, sum_ = 0, squares_ = 0, work_ = 0, unguided_ = 0;
};

/// Of a tile, by kinds of walks.
inline constexpr std::size_t most_walk_kinds = 4;
using WalkTallies = std::array<WalkTally, most_walk_kinds>;

/// Of a kind in a tile, the walks that count for the picture: else the few walks of a trial would be nothing beside the
/// many of the tile's best kind, and products would not settle.
inline constexpr double most_walks_of_tile = 256;

/// What a walk of a kind shows in a tile, as a product of what is hard in the tile for all kinds and hard for the kind
/// in all tiles: kinds have walks in different tiles.
struct TallyProducts {
    std::vector<double> tile;
    std::array<double, most_walk_kinds> kind{};

    /// Of one of the sums of tallies, for the first `kinds`.
    TallyProducts(const std::vector<WalkTallies>& tallies, std::size_t kinds, double WalkTally::*what);

    double at(std::size_t t, std::size_t k) const { return tile[t] * kind[k]; }
    double mean_of_tiles() const;
};

/// Of a kind, one sum of its tallies over another, each tile by its walks, but no more than most_walks_of_tile; 1 where
/// both are nothing. At least 0.
double tally_ratio(const std::vector<WalkTallies>& tallies, std::size_t kind, double WalkTally::*what,
                   double WalkTally::*over);

}  // namespace wend
