// Media that are the same everywhere.
#pragma once

#include <wend/core/colour.h>
#include <wend/medium/phase.h>

#include <cmath>
#include <variant>

namespace wend {

/// A medium that is the same everywhere. Coefficients are per scene unit.
struct HomogeneousMedium {
    Rgb absorption;       ///< coefficient, not negative
    Rgb scattering;       ///< coefficient, not negative
    Rgb emission;         ///< radiance emitted per unit length: absorption coefficient times the emitter's radiance
    PhaseFunction phase;  ///< where collisions send light; isotropic at first
    /// Whether what a walk meets inside counts towards its largest depth. (Not in pbrt's `subsurface`, where each stay
    /// is one event, that of entering.)
    bool counts_vertices = true;

    /// Collisions of both kinds per scene unit.
    Rgb extinction() const { return absorption + scattering; }
};

/// exp(-optical thickness), exact.
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

class GridMedium;

/// The closed set of media (medium.h).
using Medium = std::variant<HomogeneousMedium, GridMedium>;

}  // namespace wend
