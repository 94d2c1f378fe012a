// Media that are the same everywhere.
#pragma once

#include <wend/core/colour.h>
#include <wend/medium/phase.h>

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

}  // namespace wend
