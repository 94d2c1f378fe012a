// Incident radiance times what scatters it: the distribution that guided directions are drawn from.
#pragma once

#include <wend/core/export.h>
#include <wend/guide/lanes.h>
#include <wend/guide/mixture.h>
#include <wend/sampling/axial_lobes.h>

#include <span>

namespace wend::guide {

/// Of numbers that are not negative, what those before each one add up to, by a tree of few steps: never less than for
/// the one before, and the same across a 0.
struct SumsBelow {
    int lanes;    ///< how many numbers there are
    float total;  ///< of all of them
    /// By index, what those before it have; behind the last one the total again.
    float sum[max_lobes + 1];
};

/// A product V H / Z.
struct ProductLanes {
    /// Its weights are not set: nothing asks for them.
    MixtureLanes mixture;
    /// H, along its axis.
    AxialLobes scatterer;
    /// Of the parts that the lobes of the mixture have of Z.
    SumsBelow below;
    /// Z, in 1/sr; 0 where it is too small to tell.
    float integral;
    /// What the product of densities is multiplied by to be one.
    float scale;
    /// Of each pair of lobes, those of one axial lobe side by side, what the pairs up to it have of the part, so that a
    /// sample need not find them again. Only the pairs there are have some.
    float pair_sums[AxialLobes::capacity * max_lobes];

    /// For a mixture of as many lobes; the product itself is to be written.
    ProductLanes(int lobes, const AxialLobes& other) : mixture(lobes, Unset{}), scatterer(other) {}

    /// The part of Z that each lobe of the mixture has.
    const float* parts() const { return pair_sums + (scatterer.size() - 1) * mixture.lanes(); }
};

/// The normalized product V H / Z of a mixture V and lobes H, exact in both: samples come from the products of all
/// pairs of their lobes, which are lobes again; the density asks V and H alone. Where the product is too small to tell
/// (Z below 1e-20), it is V instead, and the integral 0. Two kilobytes, filled where it is constructed: to be passed by
/// reference.
class WEND_API MixtureProduct {
public:
    /// The product of a mixture as it is. Refers to neither afterwards.
    MixtureProduct(const VmfMixture& mixture, const AxialLobes& lobes);
    /// The product of a mixture as it is seen from elsewhere. Refers to neither afterwards.
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
