// What the surfaces of burley2012 and burley2015 are made of.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/vector.h>

#include <algorithm>

namespace wend {

inline float schlick_weight(float cosine) {
    const float m = std::clamp(1 - cosine, 0.0f, 1.0f);
    return sqr(sqr(m)) * m;
}

/// Schlick's reflectance by what it is at normal incidence.
inline Rgb schlick(const Rgb& normal, float weight) {
    return normal + (Rgb(1.0f) - normal) * weight;
}

/// A colour of luminance 1.
inline Rgb hue_of(const Rgb& colour) {
    const float brightness = luminance(colour);
    return brightness > 0 ? colour / brightness : Rgb(1.0f);
}

/// A diffuse base, over its colour and the cosine over pi, of the two directions' cosines and that between one and the
/// half vector: with a gloss at grazing angles, or, by the `flatness`, as if light went below the surface.
inline float matt_value(float roughness, float flatness, float cos_o, float cos_i, float half) {
    const float seen = schlick_weight(cos_o), lit = schlick_weight(cos_i), retro = 2 * roughness * sqr(half);
    const float plain = (1 - 0.5f * seen) * (1 - 0.5f * lit) + retro * (seen + lit + seen * lit * (retro - 1));
    const float flat = (1 + (retro / 2 - 1) * lit) * (1 + (retro / 2 - 1) * seen);
    const float below = 1.25f * (flat * (1 / (cos_o + cos_i) - 0.5f) + 0.5f);
    return plain + (below - plain) * flatness;
}

/// What cloth adds to it, over the cosine.
inline Rgb cloth_value(const Rgb& base, float sheen, float sheen_tint, float half) {
    return (Rgb(1.0f) + (hue_of(base) - Rgb(1.0f)) * sheen_tint) * (sheen * schlick_weight(half));
}

}  // namespace wend
