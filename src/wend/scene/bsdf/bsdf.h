// Scattering at a surface point. Local directions point away from the surface, z is the shading normal. evaluate()
// includes the cosine of the sampled direction; radiance is carried, so transmission includes the squared ratio of
// indices.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/vector.h>
#include <wend/sampling/axial_lobes.h>

#include <optional>
#include <variant>

namespace wend {

/// A direction drawn from a BSDF, local.
struct BsdfSample {
    Vec3 direction;
    Rgb value;          ///< BSDF times cosine (for specular: the coefficient times `density`)
    float density = 0;  ///< per steradian; a probability if specular
    bool specular = false;
    float density_ratio = 1;  ///< density over what it would be without DielectricBsdf::odds
};

/// Ideal diffuse reflection.
struct LambertBsdf {
    Rgb reflectance;

    Rgb evaluate(const Vec3& wo, const Vec3& wi) const;
    float density(const Vec3& wo, const Vec3& wi) const;
    std::optional<BsdfSample> sample(const Vec3& wo, float u, const Vec2& u2) const;
    bool is_specular() const { return false; }
};

/// Smooth or rough conductor.
struct ConductorBsdf {
    Rgb eta;
    Rgb k;
    float alpha_x = 0;
    float alpha_y = 0;

    Rgb evaluate(const Vec3& wo, const Vec3& wi) const;
    float density(const Vec3& wo, const Vec3& wi) const;
    std::optional<BsdfSample> sample(const Vec3& wo, float u, const Vec2& u2) const;
    bool is_specular() const;
};

/// Smooth or rough boundary between dielectrics (walter2007); `ior` is the index on the far side of the normal over
/// that on the near side.
struct DielectricBsdf {
    float ior = 1.5f;
    float alpha_x = 0;
    float alpha_y = 0;
    /// How many times more often than Fresnel's equations have it a reflection is drawn over a refraction.
    float odds = 1;
    /// Of all samples, in (0,1], what is left to Fresnel's equations all the same.
    float fresnel_share = 0.25f;

    Rgb evaluate(const Vec3& wo, const Vec3& wi) const;
    float density(const Vec3& wo, const Vec3& wi) const;
    std::optional<BsdfSample> sample(const Vec3& wo, float u, const Vec2& u2) const;
    bool is_specular() const;

private:
    /// With which a reflection is drawn where that is Fresnel's.
    float reflection_probability(float fresnel) const;
};

/// A diffuse base under a dielectric coat, smooth or rough. Light that enters is refracted in and out and reflected
/// inside any number of times, in closed form for a smooth coat; a rough coat keeps the smooth one's transmission, and
/// its reflection is a GGX lobe. Seen from below it is like from above.
struct CoatedDiffuseBsdf {
    Rgb reflectance;
    float ior = 1.5f;
    float alpha_x = 0;
    float alpha_y = 0;
    float inner_reflectance = 0;  ///< hemispherical reflectance of the coat from inside

    Rgb evaluate(const Vec3& wo, const Vec3& wi) const;
    float density(const Vec3& wo, const Vec3& wi) const;
    std::optional<BsdfSample> sample(const Vec3& wo, float u, const Vec2& u2) const;
    bool is_specular() const { return false; }

private:
    float coat_probability(float cosine) const;
};

/// The closed set of BSDFs.
using Bsdf = std::variant<LambertBsdf, ConductorBsdf, DielectricBsdf, CoatedDiffuseBsdf>;

/// Refractive index beyond over before for light going from wo to wi; 1 unless refracted.
float index_ratio(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi);

/// Rough estimate of the share of light that a BSDF reflects or transmits from wo: for the albedo layer of a picture.
Rgb directional_albedo(const Bsdf& bsdf, const Vec3& wo);

/// The shape of evaluate() over wi, colour and scale apart, as lobes for a guide; uniform for a BSDF that is not
/// pictured.
AxialLobes lobes_of(const Bsdf& bsdf, const Vec3& wo);

/// Whether lobes_of() is a fair picture, for wo on either side.
bool is_pictured_by_lobes(const Bsdf& bsdf);

}  // namespace wend
