// What the learned field knows about one cell of space.
#pragma once

#include <wend/adjoint/adjoint.h>
#include <wend/guide/lobe_colours.h>
#include <wend/guide/product.h>

namespace wend::guide {

/// The share of classical sampling where nothing is known.
inline constexpr float unproven_defensive_fraction = 0.3f;

/// The learned adjoint in one cell. The mixture belongs to a reference point; seen from elsewhere in the cell, lobes
/// whose distance is known turn to keep pointing at their source.
class Region {
public:
    /// Knows nothing: no radiance, equally from everywhere.
    Region() = default;

    /// `inverse_distance`: 1/distance of each lobe's source from the reference point; 0 where it is far or not known.
    Region(const Vec3& reference, const VmfMixture& mixture, const Lanes& inverse_distance, float fluence,
           const LobeColours& colours = {}, float defensive_fraction = unproven_defensive_fraction)
        : reference_(reference),
          fluence_(fluence),
          mixture_(mixture),
          inverse_distance_(inverse_distance),
          colours_(colours),
          defensive_fraction_(defensive_fraction) {}

    /// Distribution of the incident radiance at a position of the cell, as a view of this region.
    MixtureView incident(const Vec3& position) const {
        return MixtureView(mixture_, reference_ - position, inverse_distance_);
    }

    /// ∫ L dω averaged over the cell's records, in radiance times sr.
    float fluence() const { return fluence_; }

    /// ∫ f L dω by colour channel, for a product of what is incident somewhere in the cell with the lobes of f: each
    /// lobe brings its own colour.
    Rgb in_scattered(const MixtureProduct& product) const {
        Rgb sum;
        if (product.integral() > 0) {
            for (int i = 0; i < mixture_.size(); ++i) {
                sum += colours_[i] * (fluence_ * product.parts()[i]);
            }
        }
        return sum;
    }

    /// Radiance arriving at a position of the cell from a unit direction, by colour channel.
    Rgb radiance(const Vec3& position, const Vec3& direction) const {
        const VmfMixture seen = incident(position);
        Rgb sum;
        for (int i = 0; i < seen.size(); ++i) {
            const auto [weight, vmf] = seen.lobe(i);
            sum += colours_[i] * (fluence_ * weight * vmf.density(direction));
        }
        return sum;
    }

    /// How much of directions is best drawn by classical sampling, as measured (share.h).
    float defensive_fraction() const { return defensive_fraction_; }

    /// The point that mixture() belongs to.
    const Vec3& reference() const { return reference_; }
    /// The incident radiance as seen from the reference point: incident() gives it for others.
    const VmfMixture& mixture() const { return mixture_; }
    /// By lobe, 1/distance of its source from the reference point; 0 where it is far or not known.
    const Lanes& inverse_distance() const { return inverse_distance_; }
    /// By lobe, its radiance by channel over their mean.
    const LobeColours& colours() const { return colours_; }

private:
    Vec3 reference_{0, 0, 0};
    float fluence_ = 0;
    VmfMixture mixture_;
    Lanes inverse_distance_;
    LobeColours colours_;
    float defensive_fraction_ = unproven_defensive_fraction;
};

static_assert(IncidentRadiance<VmfMixture>);
static_assert(IncidentRadiance<MixtureView>);
static_assert(Adjoint<Region>);

}  // namespace wend::guide
