// The loops over the lobes of a mixture, compiled for several vector targets.
#pragma once

#include <wend/guide/lobe_lanes.h>
#include <wend/guide/mixture.h>

#include <span>

namespace wend::guide {

/// One target's functions. All targets' return the same, bit for bit.
struct Kernels {
    /// The name that Highway gives the target.
    const char* target;

    /// Σ_i w_i vMF_i at a unit direction.
    float (*density)(const MixtureLanes& mixture, const Vec3& direction);

    /// Sets all of `turned`, of the same size, to the mixture as seen from a point displaced by -`offset`
    /// (VmfMixture::re_aimed).
    void (*turn)(const MixtureLanes& mixture, const Vec3& offset, const Lanes& inverse_distance, MixtureLanes& turned);

    /// Set all of a product but the scatterer and the weights, which are given: of the mixture as it is, or turned.
    /// Where Z is too small, the product becomes that with the uniform scatterer, and Z is 0.
    void (*multiply)(const MixtureLanes& mixture, ProductLanes& product);
    void (*turn_and_multiply)(const MixtureLanes& mixture, const Vec3& offset, const Lanes& inverse_distance,
                              ProductLanes& product);

    float (*product_density)(const ProductLanes& product, const Vec3& direction);
    Vec3 (*product_sample)(const ProductLanes& product, Vec2 u);

    /// Adds observations to the sums, each divided among the lobes by the probability that it came from them.
    void (*add_observations)(const LobeLanes& lobes, std::span<const Observation> observations, SumLanes& sums);
};

/// Those for the best target that this processor has, or that Highway has been told to keep to.
Kernels best_kernels();

/// The same, chosen once.
inline const Kernels& kernels() {
    static const Kernels best = best_kernels();
    return best;
}

}  // namespace wend::guide
