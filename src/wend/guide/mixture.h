// A mixture of von Mises–Fisher lobes: what a learned field says about the incident radiance at a point.
#pragma once

#include <wend/core/export.h>
#include <wend/guide/lanes.h>
#include <wend/sampling/axial_lobes.h>
#include <wend/sampling/vmf.h>

#include <span>

namespace wend::guide {

/// One lobe of a mixture.
struct WeightedVmf {
    /// Share in the mixture, not negative.
    float weight;
    /// Its directions.
    Vmf vmf;
};

class MixtureProduct;

/// A density over directions, Σ w_i vMF_i, of at most max_lobes lobes whose weights add up to 1. A value of fixed size
/// without heap memory.
class WEND_API VmfMixture {
public:
    /// The uniform distribution: one lobe of concentration 0.
    VmfMixture();

    /// A mixture of 1 to max_lobes lobes; weights are scaled to the sum 1 (unless they have it but for
    /// rounding), and one at least must be positive.
    explicit VmfMixture(std::span<const WeightedVmf> lobes);

    /// Number of lobes, 1 to max_lobes.
    int size() const { return lanes_.size; }
    /// A lobe, i in [0, size()).
    WeightedVmf lobe(int i) const;

    /// Density at a unit direction, in 1/sr. Relative error 1e-6 · (1 + kappa angle²).
    float density(const Vec3& direction) const;

    /// A direction distributed by the density, from a point of [0,1)²; u.x selects the lobe, and what is left of it is
    /// used again within the lobe.
    Vec3 sample(Vec2 u) const;

    /// The normalized product with lobes of what scatters (product.h).
    MixtureProduct product(const AxialLobes& lobes) const;

    /// The mixture as seen from a point displaced by -`offset`, where lobe i comes from a distance
    /// 1/inverse_distance[i]: each mean m turns to the direction of m + offset · inverse_distance. Weights and
    /// concentrations stay.
    VmfMixture re_aimed(const Vec3& offset, const Lanes& inverse_distance) const;

private:
    friend class MixtureProduct;

    /// Of as many lobes, all of them still to be written.
    VmfMixture(int size, Unset unset) : lanes_(size, unset) {}

    MixtureLanes lanes_;
};

/// A mixture as seen from a displaced point (VmfMixture::re_aimed), before it is turned: its product comes cheaper
/// than that of a mixture turned first. Refers to the mixture and the distances, which must outlive it; the other
/// questions turn the mixture each time, so whoever has many of them should make a VmfMixture of this.
class WEND_API MixtureView {
public:
    /// The arguments of VmfMixture::re_aimed().
    MixtureView(const VmfMixture& mixture, const Vec3& offset, const Lanes& inverse_distance)
        : mixture_(mixture), inverse_distance_(inverse_distance), offset_(offset) {}

    /// The mixture, turned.
    operator VmfMixture() const { return mixture_.re_aimed(offset_, inverse_distance_); }

    /// VmfMixture::density() of the turned mixture.
    float density(const Vec3& direction) const { return VmfMixture(*this).density(direction); }
    /// VmfMixture::sample() of the turned mixture.
    Vec3 sample(Vec2 u) const { return VmfMixture(*this).sample(u); }
    /// The product of the turned mixture, which is turned on the way.
    MixtureProduct product(const AxialLobes& lobes) const;

private:
    friend class MixtureProduct;

    const VmfMixture& mixture_;
    const Lanes& inverse_distance_;
    Vec3 offset_;
};

}  // namespace wend::guide
