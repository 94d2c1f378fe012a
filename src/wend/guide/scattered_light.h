// What a cell of the field tells a ray that passes through: how much light is scattered into it there.
#pragma once

#include <wend/core/vector.h>
#include <wend/medium/phase.h>

namespace wend::guide {

/// Light that arrives from everywhere, known by its amount and its mean direction alone.
struct ArrivingLight {
    /// ∫ L dω, in radiance times sr.
    float fluence = 0;
    /// ∫ ω L dω / ∫ L dω, shorter than 1: towards where the light comes from.
    Vec3 mean{0, 0, 0};
};

/// The light scattered in a cell. As a function of direction, what arrives is taken for Henyey and Greenstein's
/// function around its mean direction: that kind is closed under convolution, so the in-scattered radiance for a phase
/// function of that kind costs one evaluation.
struct ScatteredLight {
    /// What walks found on their way, and what their connections to lights did: together all the light.
    ArrivingLight walked, connected;
    /// Radiance that leaves the vertices of the cell towards where walks came from.
    float leaving = 0;
    /// Mean square of its estimates over the square of their mean, at least 1.
    float noise = 1;

    /// ∫ p(before, ω) L(ω) dω, in radiance.
    float in_scattered(const Vec3& before, const PhaseFunction& phase) const {
        return walked.fluence * phase.blurred(before, walked.mean) +
               connected.fluence * phase.blurred(before, connected.mean);
    }
};

/// Sums over the records of a cell, older ones counting less.
struct ScatterSums {
    float records = 0;
    float leaving = 0;
    float leaving_square = 0;
    float connected = 0;
    Vec3 connected_direction{0, 0, 0};

    ScatterSums scaled(float factor) const {
        return {records * factor,        leaving * factor,   leaving_square * factor,
                connected * factor,      connected_direction * factor};
    }
    ScatterSums& operator+=(const ScatterSums& o) {
        records += o.records;
        leaving += o.leaving;
        leaving_square += o.leaving_square;
        connected += o.connected;
        connected_direction += o.connected_direction;
        return *this;
    }
};

}  // namespace wend::guide
