// Which ways to sample interior walks in a dense medium are worth their time: variance times cost, told by the interior
// walks themselves.
#pragma once

#include <wend/subsurface/technique_mixes.h>

namespace wend {

struct TechniqueVariance {
    double value = 0;
    double count = 0;  ///< how many interior walks of equal weight tell it
};

/// 0 where nothing varies.
TechniqueVariance variance(const SecondMoments::Kind& sums);

/// Of guided interior walks over others, where those are what `seen` says.
struct TechniqueAdvantage {
    double efficiency = 0;  ///< logarithm of the ratio of variance times cost
    double deviation = 1;   ///< of that, as far as it is known
    double variance = 0;    ///< logarithm of the ratio of the variances alone
    double over_field = 0;  ///< that of variance times cost, if every unguided flight followed the learned field

    /// Whether guides are to be given up. What is rarely found by classical sampling may long seem not to be there:
    /// while that is what they are compared with they are not. In the end a doubt is in favour of the field: what it
    /// has just learned is not seen yet.
    bool is_loss(NextWalks seen, NextWalks next) const;

    /// The share of unguided interior walks while both kinds are watched.
    float share_for_watching() const;

    /// Of telling the field what a guided interior walk meets. Unguided interior walks only ever seem to be better than
    /// they are.
    float recording_probability() const;
};

/// `through_boundaries` is the probability that a collision is connected along a way that boundaries refract. Nothing
/// is known of either where one kind does not vary.
TechniqueAdvantage advantage(const SecondMoments::Sums& sums, NextWalks seen, float through_boundaries);

/// Share of unguided interior walks to begin with.
inline constexpr float largest_share_for_watching = 0.0625f;

}  // namespace wend
