// Unbiased estimates of transmittance exp(-optical thickness).
#pragma once

#include <wend/core/export.h>
#include <wend/core/random.h>
#include <wend/medium/medium.h>

namespace wend {

/// Exact.
inline Rgb transmittance(const HomogeneousMedium& medium, float distance) {
    const Rgb tau = medium.extinction() * distance;
    return {std::exp(-tau.r), std::exp(-tau.g), std::exp(-tau.b)};
}

/// Through an integral of density, in double precision: what absorbs nothing passes all, however dense it is.
inline Rgb transmitted(const Rgb& extinction, double depth) {
    const auto channel = [depth](float e) { return static_cast<float>(std::exp(-double{e} * depth)); };
    return {channel(extinction.r), channel(extinction.g), channel(extinction.b)};
}

/// The light that the medium emits towards the start of a segment, in radiance: its expected value, which has no
/// variance.
inline Rgb emitted_along(const HomogeneousMedium& medium, float distance) {
    if (is_black(medium.emission)) {
        return Rgb(0.0f);
    }
    Rgb sum;
    const Rgb extinction = medium.extinction();
    for (int c = 0; c < 3; ++c) {
        const float tau = extinction[c] * distance;
        sum[c] = medium.emission[c] * (tau > 1e-4f ? -std::expm1(-tau) / extinction[c] : distance);
    }
    return sum;
}

/// Residual ratio tracking (novak2014) from 0 to `distance` along the ray: in each cell of the majorant grid the
/// smallest density is the control, whose transmittance is exact, and only the residual is estimated. Estimates that
/// have become small are ended by roulette, so that a dense medium costs no more than a few mean free paths. Cells in
/// which that would still be many steps are crossed voxel by voxel, exactly. So are all cells of a medium that does not
/// scatter: there transmittance is all that is seen, and without noise it is worth its voxels.
WEND_API Rgb estimate_transmittance(const GridMedium& medium, const Ray& ray, float distance, Pcg32& random);

/// The same for either kind; exact in a homogeneous medium.
inline Rgb estimate_transmittance(const Medium& medium, const Ray& ray, float distance, Pcg32& random) {
    if (const auto* homogeneous = std::get_if<HomogeneousMedium>(&medium)) {
        return transmittance(*homogeneous, distance);
    }
    return estimate_transmittance(std::get<GridMedium>(medium), ray, distance, random);
}

}  // namespace wend
