// Materials: how a surface's BSDF follows from textures. A material holds indices into the scene's textures.
#pragma once

#include <wend/scene/bsdf/bsdf.h>
#include <wend/scene/texture.h>

#include <variant>

namespace wend {

struct DiffuseMaterial {
    TextureId reflectance = 0;
};

/// Roughness as pbrt gives it: alpha is its square root where `remap` is set.
struct Roughness {
    TextureId u = 0;
    TextureId v = 0;
    bool remap = true;
};

struct ConductorMaterial {
    /// Complex index; or, where `reflectance` is set (>= 0), the reflectance at normal incidence, which then determines
    /// k with eta = 1.
    TextureId eta = 0;
    TextureId k = 0;
    TextureId reflectance = -1;
    Roughness roughness;
};

struct DielectricMaterial {
    float ior = 1.5f;
    Roughness roughness;
    /// Of the medium inside, where a walk enters it: the albedo that the walk finds there until it enters anew, over
    /// that of the medium; -1: 1.
    TextureId relative_albedo = -1;
};

struct CoatedDiffuseMaterial {
    TextureId reflectance = 0;
    float ior = 1.5f;
    Roughness roughness;
    float inner_reflectance = 0;  ///< fresnel_diffuse_reflectance(1 / ior)
};

/// No scattering at all: a boundary between media of the same refractive index.
struct InterfaceMaterial {};

using Material =
    std::variant<DiffuseMaterial, ConductorMaterial, DielectricMaterial, CoatedDiffuseMaterial, InterfaceMaterial>;

/// The BSDF at a point. The material must not be an interface.
Bsdf make_bsdf(const Material& material, const Textures& textures, const TexturePoint& p);

}  // namespace wend
