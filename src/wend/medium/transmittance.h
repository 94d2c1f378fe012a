// Unbiased estimates of transmittance exp(-optical thickness).
#pragma once

#include <wend/core/export.h>
#include <wend/core/random.h>
#include <wend/medium/medium.h>

namespace wend {

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
