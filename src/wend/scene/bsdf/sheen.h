// A layer of fibres that stand on a surface.
#pragma once

#include <wend/core/vector.h>

namespace wend {

/// What fibres scatter, any number of times, of light from one direction: a linearly transformed cosine (zeltner2022).
/// Directions are local, z is the normal; the fibres are alike from both sides.
class Sheen {
public:
    /// `roughness` in [0, 1]; the least is `least_roughness`.
    Sheen(const Vec3& wo, float roughness);

    /// Share of the light that is scattered back; the rest passes.
    float albedo() const { return albedo_; }
    /// Per steradian, on the side of wo: of sample(), and the share that goes there of what is scattered back.
    float density(const Vec3& wi) const;
    Vec3 sample(const Vec2& u) const;

    /// Smoother fibres reflect at grazing angles alone, and next to nothing.
    static constexpr float least_roughness = 4.0f / 31;

private:
    /// From the world's local frame to that of the cosine: (a x + b z, a y, z), with x along wo.
    float a_, b_;
    float albedo_;
    Vec3 along_;  ///< x
    float side_;  ///< sign of wo.z
};

}  // namespace wend
