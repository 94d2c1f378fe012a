#include <wend/render/tiles_at_work.h>

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace wend {
namespace {

std::vector<Tile> tiles_of(const PixelRect& crop) {
    constexpr int side = 16;
    std::vector<Tile> tiles;
    for (int y = crop.min.y; y < crop.max.y; y += side) {
        for (int x = crop.min.x; x < crop.max.x; x += side) {
            tiles.emplace_back().pixels = {{x, y}, {std::min(x + side, crop.max.x), std::min(y + side, crop.max.y)}};
        }
    }
    return tiles;
}

/// Of those tiles that are `wanted`.
template <class Wanted>
double mean_samples_of(const std::vector<Tile>& tiles, const Wanted& wanted) {
    double paths = 0, pixels = 0;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        if (wanted(i)) {
            paths += static_cast<double>(tiles[i].counts.paths);
            pixels += tiles[i].pixel_count();
        }
    }
    return pixels > 0 ? paths / pixels : 0;
}

}  // namespace

TilesAtWork::TilesAtWork(const PixelRect& crop, Ranks* ranks) : crop_(crop), tiles_(tiles_of(crop)), shares_(ranks) {
}

void TilesAtWork::begin_pass(const GuidingChoice& choice, const PassPlan& plan) {
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
        tiles_[i].shares = choice.shares(i, plan.count);
        tiles_[i].tallies = {};
    }
    share_out(plan);
}

void TilesAtWork::end_pass() {
    for (Tile& tile : tiles_) {
        tile.kinds_done = 0;
    }
}

void TilesAtWork::share_out(const PassPlan& plan) {
    std::vector<std::uint64_t> work;
    work.reserve(tiles_.size());
    std::transform(tiles_.begin(), tiles_.end(), std::back_inserter(work), [&](const Tile& tile) {
        return static_cast<std::uint64_t>(tile.expected_work() * samples_of(tile, plan));
    });
    shares_.share_out(work);
}

double TilesAtWork::samples_of(const Tile& tile, const PassPlan& plan) const {
    if (plan.counts.empty()) {
        return static_cast<double>(plan.count) * tile.pixel_count();
    }
    double samples = 0;
    for (int i = 0; i < tile.pixel_count(); ++i) {
        samples += plan.counts[crop_.place_of(tile.pixel(i))];
    }
    return samples;
}

WalkCounts TilesAtWork::counts() const {
    WalkCounts counts;
    for (const Tile& tile : tiles_) {
        counts += tile.counts;
    }
    return counts;
}

double TilesAtWork::walks(std::size_t kind) const {
    double walks = 0;
    for (const Tile& tile : tiles_) {
        walks += static_cast<double>(tile.walks[kind]);
    }
    return walks;
}

std::vector<WalkTallies> TilesAtWork::tallies() const {
    std::vector<WalkTallies> tallies;
    tallies.reserve(tiles_.size());
    std::transform(tiles_.begin(), tiles_.end(), std::back_inserter(tallies),
                   [](const Tile& tile) { return tile.tallies; });
    return tallies;
}

double TilesAtWork::mean_samples() const {
    return mean_samples_of(tiles_, [](std::size_t) { return true; });
}

double TilesAtWork::own_mean_samples() const {
    return mean_samples_of(tiles_, [&](std::size_t i) { return shares_.owns(i); });
}

}  // namespace wend
