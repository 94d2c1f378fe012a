// What a cell of the field remembers between fits.
#pragma once

#include <wend/core/vector.h>
#include <wend/guide/lanes.h>

#include <array>

namespace wend::guide {

/// Sums over the records' shares in one lobe. A record of weight w that belongs to the lobe with probability γ counts γ
/// w. (Single precision where it suffices: a field has many cells.)
struct LobeSums {
    float weight = 0;
    /// Of the directions, re-aimed at the reference point.
    Vec3 direction{0, 0, 0};
    /// Of (γ w)²: weight² / weight_square is how many records of equal weight would know as much (kish1965).
    double weight_square = 0;
    double inverse_distance = 0;
    double inverse_distance_square = 0;
    /// How directions turn with the position: of the product of offset and direction across the lobe's mean, and of the
    /// squared offset. Their ratio is the inverse distance that the directions themselves tell.
    double turn = 0;
    double spread = 0;
};

/// Sums over all records of a cell, older fits counting less.
struct Statistics {
    /// Records, those of zero radiance included.
    double count = 0;
    /// Of radiance / density as recorded; divided by count, it is the fluence.
    double fluence = 0;
    std::array<LobeSums, max_lobes> lobes;

    /// What remains when every record's weight is multiplied by `factor`.
    Statistics decayed(double factor) const;
    /// What remains when a `share` of the records is kept.
    Statistics share(double share) const;
};

}  // namespace wend::guide
