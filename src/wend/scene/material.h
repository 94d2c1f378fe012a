// Materials: how a surface's BSDF follows from textures. A material holds indices into the scene's textures.
#pragma once

#include <wend/scene/bsdf/bsdf.h>
#include <wend/scene/bsdf/facet_albedo.h>
#include <wend/scene/texture.h>

#include <memory>
#include <variant>
#include <vector>

namespace wend {

struct DiffuseMaterial {
    TextureId reflectance = 0;
};

/// Roughness as pbrt gives it: alpha is its square root where `remap` is set.
struct Roughness {
    TextureId u = 0;
    TextureId v = 0;
    bool remap = true;
    FacetSlopes slopes = FacetSlopes::ggx;
};

struct ConductorMaterial {
    /// Complex index; or, where `reflectance` is set (>= 0), the reflectance at normal incidence, which then determines
    /// k with eta = 1.
    TextureId eta = 0;
    TextureId k = 0;
    TextureId reflectance = -1;
    Roughness roughness;
    TextureId tint = -1;  ///< that of ConductorBsdf; -1: 1
};

struct DielectricMaterial {
    float ior = 1.5f;
    Roughness roughness;
    /// Of the medium inside, where a walk enters it: the albedo that the walk finds there until it enters anew, over
    /// that of the medium; -1: 1.
    TextureId relative_albedo = -1;
    /// Those of DielectricBsdf; -1: 1.
    TextureId reflectance = -1;
    TextureId transmittance = -1;
    bool is_antireflective = false;
};

struct DiffuseTransmissionMaterial {
    TextureId reflectance = 0;
    TextureId transmittance = 0;
    float scale = 1;  ///< of both
};

struct ThinDielectricMaterial {
    float ior = 1.5f;
    /// As those of DielectricMaterial.
    TextureId reflectance = -1;
    TextureId transmittance = -1;
};

/// CoatedBsdf by textures.
struct CoatedMaterial {
    std::variant<DiffuseMaterial, ConductorMaterial> base;
    float ior = 1.5f;
    Roughness roughness;
    TextureId thickness = 0;
    TextureId albedo = 0;
    TextureId mean_cosine = 0;
    int max_depth = 10;
    int walks = 1;
    float returned = -1;  ///< CoatedBsdf::returned, where the thickness is the same everywhere
    /// Whether what comes out is in proportion to the reflectance of a diffuse base, as if what the coat returns met
    /// white.
    bool is_linear = false;
};

/// HairBsdf by textures: absorption by one of three colours.
struct HairMaterial {
    enum class Colour { absorption, reflectance, pigments };

    Colour given = Colour::pigments;
    TextureId colour = -1;  ///< the absorption, or the reflectance of much hair (chiang2016)
    TextureId eumelanin = -1;
    TextureId pheomelanin = -1;
    TextureId ior = 0;
    TextureId roughness_along = 0;
    TextureId roughness_across = 0;
    TextureId tilt = 0;  ///< degrees
};

/// PrincipledBsdf by textures.
struct PrincipledMaterial {
    TextureId base = 0;
    TextureId metallic = 0;
    TextureId roughness = 0;  ///< alpha is its square
    TextureId specular = 0;
    TextureId coat = 0;
    TextureId coat_roughness = 0;
    TextureId anisotropy = -1;         ///< from 0 to 1, of facets as Disney's model has it; -1: none
    TextureId specular_tint = -1;      ///< those of PrincipledBsdf; -1: 1
    TextureId coat_tint = -1;          ///< the same
    TextureId diffuse_roughness = -1;  ///< -1: 0
    TextureId sheen = -1;              ///< -1: none
    TextureId sheen_tint = -1;         ///< -1: 1
    TextureId sheen_roughness = 0;
    float ior = 1.5f, coat_ior = 1.5f;
    TextureId subsurface = -1;  ///< -1: there is nothing inside
    float entry_ior = 1.5f;
    TextureId entry_roughness = 0;  ///< alpha is its square
    float entry_even = 0;
    TextureId relative_albedo = -1;                   ///< that of DielectricMaterial
    std::shared_ptr<const FacetAlbedo> below, above;  ///< of both
};

/// MeasuredBsdf.
struct MeasuredMaterial {
    std::shared_ptr<const MeasuredTables> tables;
};

/// DisneyBsdf by textures.
struct DisneyMaterial {
    TextureId base = 0;
    TextureId roughness = 0;  ///< alpha is its square
    TextureId anisotropy = 0;
    TextureId metallic = 0;
    TextureId spec_trans = 0;
    TextureId spec_tint = 0;
    TextureId sheen = 0;
    TextureId sheen_tint = 0;
    TextureId flatness = 0;
    TextureId coat = 0;
    TextureId coat_gloss = 0;  ///< from an alpha of 0.1 down to 0.001
    float ior = 1.5f;
    bool transmits = false;  ///< whether `spec_trans` is anything but 0
};

/// DisneySheetBsdf by textures.
struct DisneySheetMaterial {
    TextureId base = 0;
    TextureId roughness = 0;  ///< alpha is its square
    TextureId anisotropy = 0;
    TextureId spec_trans = 0;
    TextureId diff_trans = 0;  ///< twice the share
    TextureId spec_tint = 0;
    TextureId sheen = 0;
    TextureId sheen_tint = 0;
    TextureId flatness = 0;
    float ior = 1.5f;
};

/// At each point one of two others, by chance.
struct MixMaterial {
    int first = 0;
    int second = 0;        ///< index in the scene's materials
    TextureId amount = 0;  ///< probability of the second
    /// Whether both are there at once, with all that each scatters: what is drawn counts by the inverse of its
    /// probability.
    bool is_sum = false;
};

/// No scattering at all: a boundary between media of the same refractive index.
struct InterfaceMaterial {};

using Material = std::variant<DiffuseMaterial, DiffuseTransmissionMaterial, ConductorMaterial, DielectricMaterial,
                              ThinDielectricMaterial, CoatedMaterial, HairMaterial, PrincipledMaterial,
                              MeasuredMaterial, DisneyMaterial, DisneySheetMaterial, MixMaterial, InterfaceMaterial>;

/// The BSDF at a point. The material must be neither an interface nor a mixture.
Bsdf make_bsdf(const Material& material, const Textures& textures, const TexturePoint& p);

/// Whether a material looks different when it is turned about its normal, or may do so.
bool is_directed(const Material& material);

/// What a point has of a material.
struct MaterialPart {
    int index = 0;    ///< of the scene's materials: no mixture
    float count = 1;  ///< what its BSDF is multiplied with, as a part of sums
};

/// Which of the materials is there: `index`, or where that is a mixture, what the point has of it.
MaterialPart material_at(const std::vector<Material>& materials, int index, const Textures& textures,
                         const TexturePoint& p);

}  // namespace wend
