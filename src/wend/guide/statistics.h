// What a cell of the field remembers between fits.
#pragma once

#include <wend/guide/lanes.h>

#include <Imath/ImathVec.h>

#include <array>

namespace wend::guide {

/// Sums over the records' shares in one lobe. A record of weight w that belongs to the lobe with probability γ counts γ
/// w.
struct LobeSums {
    double weight = 0;
    /// Of (γ w)²: weight² / weight_square is how many records of equal weight would know as much (kish1965).
    double weight_square = 0;
    /// Of the directions, re-aimed at the reference point.
    Imath::V3d direction{0, 0, 0};
    double inverse_distance = 0;
    double inverse_distance_square = 0;
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
