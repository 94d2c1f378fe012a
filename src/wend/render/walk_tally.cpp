#include <wend/render/walk_tally.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace wend {
namespace {

/// What all of so many cells have shown over what was expected of them; `cell` gives both for each.
template <class Cell>
double factor_of(std::size_t cells, const Cell& cell, double where_nothing_is_expected) {
    double shown = 0, expected = 0;
    for (std::size_t i = 0; i < cells; ++i) {
        const auto [more_shown, more_expected] = cell(i);
        shown += more_shown;
        expected += more_expected;
    }
    return expected > 0 ? shown / expected : where_nothing_is_expected;
}

/// The share of a tally's walks that counts for the picture.
double counted_share(const WalkTally& tally) {
    return tally.walks > 0 ? std::min(tally.walks, most_walks_of_tile) / tally.walks : 0.0;
}

}  // namespace

WalkTally PixelWalks::tally() const {
    if (count_ < 2) {
        return {};
    }
    const double variance = std::max(0.0, squares_ - sum_ * sum_ / count_) / (count_ - 1);
    const double squared_mean = (sum_ * sum_ - squares_) / (count_ * (count_ - 1));
    const double walks = weight_ * count_;
    return {walks,
            weight_ * sum_,
            walks * variance,
            walks * scale_ * scale_ * variance,
            weight_ * work_,
            walks * scale_ * scale_ * (unguided_ / count_ - squared_mean)};
}

WalkTally& WalkTally::operator+=(const WalkTally& o) {
    walks += o.walks;
    value += o.value;
    spread += o.spread;
    square += o.square;
    work += o.work;
    unguided += o.unguided;
    return *this;
}

WalkTally WalkTally::scaled(double factor) const {
    return {factor * walks, factor * value, factor * spread, factor * square, factor * work, factor * unguided};
}

TallyProducts::TallyProducts(const std::vector<WalkTallies>& tallies, std::size_t kinds, double WalkTally::*what)
    : tile(tallies.size(), 1.0) {
    // Each factor in turn from the other ones.
    constexpr int rounds = 50;
    // Shown, and expected by the other factor.
    const auto cell = [&](std::size_t t, std::size_t k, double other) {
        const WalkTally& tally = tallies[t][k];
        const double share = counted_share(tally);
        return std::pair(share * (tally.*what), share * tally.walks * other);
    };
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t k = 0; k < kinds; ++k) {
            kind[k] = factor_of(
                tile.size(), [&](std::size_t t) { return cell(t, k, tile[t]); }, 0);
        }
        for (std::size_t t = 0; t < tile.size(); ++t) {
            tile[t] = factor_of(
                kinds, [&](std::size_t k) { return cell(t, k, kind[k]); }, 1);
        }
    }
}

double TallyProducts::mean_of_tiles() const {
    return std::accumulate(tile.begin(), tile.end(), 0.0) / static_cast<double>(tile.size());
}

double tally_ratio(const std::vector<WalkTallies>& tallies, std::size_t kind, double WalkTally::*what,
                   double WalkTally::*over) {
    return std::max(0.0, factor_of(
                             tallies.size(),
                             [&](std::size_t tile) {
                                 const WalkTally& tally = tallies[tile][kind];
                                 const double share = counted_share(tally);
                                 return std::pair(share * (tally.*what), share * (tally.*over));
                             },
                             1));
}

}  // namespace wend
