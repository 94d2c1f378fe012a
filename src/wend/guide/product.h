// Incident radiance times what scatters it: the distribution that guided directions are drawn from.
#pragma once

#include <wend/guide/mixture.h>
#include <wend/guide/product_lanes.h>
#include <wend/sampling/axial_lobes.h>

#include <span>

namespace wend::guide {

/// The normalized product V H / Z of a mixture V and lobes H, exact in both: samples come from the products of all
/// pairs of their lobes, which are lobes again; the density asks V and H alone. Where the product is too small to tell
/// (Z below 1e-20), it is V instead, and the integral 0. Two kilobytes, filled where it is constructed: to be passed by
/// reference.
class MixtureProduct {
public:
    MixtureProduct(const VmfMixture& mixture, const AxialLobes& lobes);
    MixtureProduct(const MixtureView& view, const AxialLobes& lobes);

    /// Z = ∫ V H dω, in 1/sr.
    float integral() const { return lanes_.integral; }

    /// The part of Z that each lobe of V has, if Z is not 0.
    std::span<const float> parts() const { return {lanes_.parts(), static_cast<std::size_t>(lanes_.mixture.size)}; }

    /// Density at a unit direction, in 1/sr.
    float density(const Vec3& direction) const;

    /// A direction distributed by the density, from a point of [0,1)².
    Vec3 sample(Vec2 u) const;

private:
    ProductLanes lanes_;
};

}  // namespace wend::guide
