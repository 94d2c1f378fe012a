// What a cell of the field remembers between fits.
#pragma once

#include <wend/core/vector.h>
#include <wend/guide/mixture.h>
#include <wend/guide/region.h>
#include <wend/guide/share.h>

#include <array>

namespace wend::guide {

/// Sums over the records' shares in one lobe. A record of weight w that belongs to the lobe with probability γ counts γ
/// w, in units of Statistics::unit: single precision suffices.
struct LobeSums {
    float weight = 0;
    /// Of (γ w)²: weight² / weight_square is how many records of equal weight would know as much (kish1965).
    float weight_square = 0;
    /// Of the directions, re-aimed at the reference point.
    Vec3 direction{0, 0, 0};
    /// Of the vectors from the records' positions to the reference point.
    Vec3 offset{0, 0, 0};
    float inverse_distance = 0;
    float inverse_distance_square = 0;
    /// How directions turn with the position: of the product of offset and direction across the lobe's mean, and of the
    /// squared offset. Their ratio is the inverse distance that the directions themselves tell.
    float turn = 0;
    float spread = 0;
    /// The shape, with u and v the components of a direction along the axes of Frame::from_z(mean): of u² - v², of
    /// 2 u v, and of (1 - cos)².
    float straight = 0;
    float oblique = 0;
    float beyond_square = 0;
    /// Of the first and the last colour channel over the mean of all three.
    float red = 0;
    float blue = 0;

    /// All sums but weight_square times `linear`, that one times `quadratic`.
    LobeSums scaled(double linear, double quadratic) const;
    LobeSums& operator+=(const LobeSums& other);
};

/// The sums as a cell keeps them, since a field has many: what follows the direction is per unit of weight, where few
/// digits suffice, and does not change when all records come to count less.
struct KeptLobeSums {
    float weight = 0;
    float weight_square = 0;
    Vec3 direction{0, 0, 0};
    std::array<BriefFloat, 12> per_weight{};

    KeptLobeSums() = default;
    KeptLobeSums(const LobeSums& sums);
    LobeSums sums() const;

    /// As of LobeSums.
    KeptLobeSums scaled(double linear, double quadratic) const;
};

/// How many records of equal weight would know as much about the lobe.
inline double effective_records(const LobeSums& s) {
    return s.weight_square > 0 ? static_cast<double>(s.weight) * s.weight / s.weight_square : 0.0;
}

/// Sums over all records of a cell, older fits counting less.
struct Statistics {
    /// Records, those of zero radiance included.
    double count = 0;
    /// Of radiance / density as recorded; divided by count, it is the fluence.
    double fluence = 0;
    /// Of its square; divided by count, it is the second moment.
    double fluence_square = 0;
    /// What a weight of 1 in the lobes stands for, in radiance times sr.
    double unit = 0;
    std::array<KeptLobeSums, max_lobes> lobes;
    ShareSums share_sums;

    std::array<LobeSums, max_lobes> lobe_sums() const;
    void keep(const std::array<LobeSums, max_lobes>& sums);

    /// What remains when every record's weight is multiplied by `factor`.
    Statistics decayed(double factor) const;
    /// What remains when a `share` of the records is kept.
    Statistics share(double share) const;
    /// The lobes in another unit, which must be positive.
    Statistics in_unit(double other) const;
    /// A unit for new records of this mean weight, which must be positive, on top of what is remembered: neither may
    /// become so small that single precision loses its squares. A freak would else be the unit long after it has been
    /// forgotten.
    double unit_with(double mean_weight) const;
};

}  // namespace wend::guide
