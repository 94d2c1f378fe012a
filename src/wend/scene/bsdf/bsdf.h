// Scattering at a surface point. Local directions point away from the surface, z is the shading normal. evaluate()
// includes the cosine of the sampled direction; radiance is carried, so transmission includes the squared ratio of
// indices.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/vector.h>
#include <wend/medium/microfacet.h>
#include <wend/sampling/axial_lobes.h>

#include <array>
#include <cstdint>
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

/// Ideal diffuse reflection and transmission, alike from either side.
struct DiffuseTransmissionBsdf {
    Rgb reflectance;
    Rgb transmittance;

    Rgb evaluate(const Vec3& wo, const Vec3& wi) const;
    float density(const Vec3& wo, const Vec3& wi) const;
    std::optional<BsdfSample> sample(const Vec3& wo, float u, const Vec2& u2) const;
    bool is_specular() const { return false; }
    /// Probability that a reflection is drawn.
    float reflection_probability() const;
};

/// Smooth or rough conductor.
struct ConductorBsdf {
    Rgb eta;
    Rgb k;
    float alpha_x = 0;
    float alpha_y = 0;
    FacetSlopes slopes = FacetSlopes::ggx;
    Rgb tint{1.0f};  ///< multiplies what is reflected

    Rgb evaluate(const Vec3& wo, const Vec3& wi) const;
    float density(const Vec3& wo, const Vec3& wi) const;
    std::optional<BsdfSample> sample(const Vec3& wo, float u, const Vec2& u2) const;
    bool is_specular() const;
    /// Of light that meets a facet at an angle of this cosine >= 0.
    Rgb reflectance(float cosine) const;
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
    FacetSlopes slopes = FacetSlopes::ggx;
    /// Factors of what is reflected and of what passes, up to 1: glass that is coloured at its surface.
    Rgb reflectance{1.0f};
    Rgb transmittance{1.0f};
    /// Whether all that can pass does, as below an ideal coat against reflections: total reflection alone is left.
    bool is_antireflective = false;

    Rgb evaluate(const Vec3& wo, const Vec3& wi) const;
    float density(const Vec3& wo, const Vec3& wi) const;
    std::optional<BsdfSample> sample(const Vec3& wo, float u, const Vec2& u2) const;
    bool is_specular() const;
    /// Of light that a facet meets at this cosine, signed as that of fresnel_dielectric().
    float reflected_share(float cosine) const;

    /// Reflections alone, or refractions alone: densities are those given that.
    std::optional<BsdfSample> sample_reflection(const Vec3& wo, const Vec2& u2) const;
    std::optional<BsdfSample> sample_refraction(const Vec3& wo, const Vec2& u2) const;
    float refraction_density(const Vec3& wo, const Vec3& wi) const;

private:
    Vec3 sample_facet(const Vec3& wo, const Vec2& u2) const;
    std::optional<BsdfSample> reflected(const Vec3& wo, const Vec3& m) const;
    std::optional<BsdfSample> refracted(const Vec3& wo, const Vec3& m) const;
    /// With which a reflection is drawn where that is Fresnel's.
    float reflection_probability(float fresnel) const;
};

/// A sheet of glass so thin that light goes on straight, reflected inside any number of times; `ior` of the glass.
struct ThinDielectricBsdf {
    float ior = 1.5f;
    /// As those of DielectricBsdf.
    Rgb reflectance{1.0f};
    Rgb transmittance{1.0f};

    Rgb evaluate(const Vec3&, const Vec3&) const { return Rgb(0.0f); }
    float density(const Vec3&, const Vec3&) const { return 0; }
    std::optional<BsdfSample> sample(const Vec3& wo, float u, const Vec2& u2) const;
    bool is_specular() const { return true; }
    /// Share of light from wo that clear glass reflects.
    float reflected_share(const Vec3& wo) const;
};

/// A diffuse or metal base under a dielectric coat, smooth or rough, which is filled with a medium of extinction 1.
/// What comes in through the coat is reflected between coat and base, and scattered by the medium, up to `max_depth`
/// times. Seen from below it is like from above.
///
/// In closed form where the coat is smooth, does not scatter, and the base is diffuse or a smooth metal. Otherwise
/// evaluate() is the outcome of `walks` random walks inside (guo2018): a function of the directions and of `seed` whose
/// mean is the BSDF. The density is always exact.
struct CoatedBsdf {
    using Base = std::variant<LambertBsdf, ConductorBsdf>;

    DielectricBsdf coat;
    Base base;
    float thickness = 0;     ///< optical
    Rgb albedo{0.0f};        ///< of the medium
    float mean_cosine = 0;   ///< of the medium's phase function (Henyey and Greenstein's)
    int max_depth = 10;      ///< crossings of the coat, collisions included
    int walks = 1;           ///< for one value
    std::uint64_t seed = 0;  ///< of the walks
    /// Of light that leaves a diffuse base, the share that a smooth coat returns to it; negative: not known, and walks
    /// find out.
    float returned = -1;

    Rgb evaluate(const Vec3& wo, const Vec3& wi) const;
    float density(const Vec3& wo, const Vec3& wi) const;
    std::optional<BsdfSample> sample(const Vec3& wo, float u, const Vec2& u2) const;
    bool is_specular() const;
    /// Rough estimate of what comes back from wo.
    Rgb reflectance_estimate(const Vec3& wo) const;
    /// What stands for a metal base seen through the coat: as rough as both together.
    ConductorBsdf seen_base() const;

private:
    /// How a direction is drawn: by reflection at the coat, as the base has it, or evenly by projected area.
    struct Shares {
        float coat, base, diffuse;
    };
    Shares shares(const Vec3& wo) const;
    bool has_smooth_metal() const;
    Rgb mirrored(const Vec3& wo) const;
    Rgb diffuse_value(const Vec3& wo, const Vec3& wi) const;
    Rgb walked_value(const Vec3& wo, const Vec3& wi) const;
    float base_density(const Vec3& wo, const Vec3& wi) const;
    std::optional<Vec3> sample_base(const Vec3& wo, float u, const Vec2& u2) const;
};

/// Of light that leaves a diffuse base evenly, the share that a smooth coat reflects back to it, the way through the
/// coat (optical thickness) twice included. `ior`: of the coat over outside.
float coat_return(float ior, float thickness);

/// Light scattered by a hair or fibre (chiang2016, after marschner2003): x is along the fibre.
class HairBsdf {
public:
    /// `offset` across the fibre, in [-1, 1]; `absorption` inside, per radius; roughness along and across, in (0, 1];
    /// `tilt` of the scales, radians.
    HairBsdf(float offset, float ior, const Rgb& absorption, float roughness_along, float roughness_across, float tilt);

    Rgb evaluate(const Vec3& wo, const Vec3& wi) const;
    float density(const Vec3& wo, const Vec3& wi) const;
    std::optional<BsdfSample> sample(const Vec3& wo, float u, const Vec2& u2) const;
    bool is_specular() const { return false; }
    /// What is scattered of light from wo.
    Rgb albedo(const Vec3& wo) const;

private:
    /// Reflection, through, one reflection inside, and all the rest.
    static constexpr int orders = 4;
    struct Fibre;

    float offset_;
    float ior_;
    Rgb absorption_;
    std::array<float, orders> variance_{};          ///< along
    float scale_ = 0;                               ///< of the logistic distribution across
    std::array<float, 3> sin_tilt_{}, cos_tilt_{};  ///< of 1, 2 and 4 tilts
};

class FacetAlbedo;

/// What surface shaders of artists' programs have in common (burley2012): a diffuse base below dielectric facets, a
/// metal, or some of both, a coat over these, and fibres over all. What is below gets what a layer leaves, by the
/// layer's directional albedo from wo; so no energy is lost, and the albedo is right from everywhere, but for
/// dielectrics the two directions cannot be exchanged. Light that facets reflect several times is counted in
/// (kulla2017b).
struct PrincipledBsdf {
    Rgb base;            ///< colour of the diffuse base, and of metal from the front; in [0, 1]
    float metallic = 0;  ///< share of metal
    float alpha = 0.25f;
    float aspect = 1;  ///< facets are rougher along x by 1 over this and along y by this
    float ior = 1.5f;
    float specular = 1;  ///< what multiplies the reflectance of the dielectric
    /// In [0, 1]: of the dielectric what multiplies it at normal incidence, of metal what multiplies it at an angle of
    /// the cosine 1/7 (kutz2021).
    Rgb specular_tint{1.0f};
    /// Of the diffuse base, in [0, 1]: facets without a gloss (fujii2020), and what they reflect several times
    /// (portsmouth2025).
    float diffuse_roughness = 0;
    float coat = 0;  ///< share of the surface that it covers
    float coat_alpha = 0.01f;
    float coat_ior = 1.5f;
    /// What is left of what passes the coat, twice the way straight through; aslant it is a longer way, from wo.
    Rgb coat_tint{1.0f};
    float sheen =
        0;  ///< how much of what fibres over all scatter there is (Sheen), and in which colour; both in [0, 1]
    Rgb sheen_tint{1.0f};
    float sheen_roughness = 0.5f;
    /// Whether there is a medium inside, of the same index, in place of a share of the diffuse base. What goes in goes
    /// by refraction at facets or evenly, undiminished by what facets reflect from inside; what comes out does so
    /// evenly, whatever it met. The two directions cannot be exchanged.
    bool has_inside = false;
    float subsurface = 0;  ///< that share
    float entry_ior = 1.5f, entry_alpha = 0.25f;
    float entry_even = 0;                ///< share of what goes in evenly
    const FacetAlbedo* below = nullptr;  ///< of `ior`; referred to
    const FacetAlbedo* above = nullptr;  ///< of `coat_ior`, where there is a coat

    /// Facets are no smoother.
    static constexpr float least_alpha = 5e-4f;

    Rgb evaluate(const Vec3& wo, const Vec3& wi) const;
    float density(const Vec3& wo, const Vec3& wi) const;
    std::optional<BsdfSample> sample(const Vec3& wo, float u, const Vec2& u2) const;
    bool is_specular() const { return false; }
    /// What is reflected of light from wo.
    Rgb albedo(const Vec3& wo) const;

private:
    struct Parts;
    /// How a direction is drawn.
    struct Shares {
        float coat, facets, base, entry, sheen;
    };
    Shares shares(const Parts& parts) const;
    Microfacets facets() const { return {alpha / aspect, alpha * aspect}; }
    /// Of the facets of the dielectric, where glass would reflect this.
    Rgb tinted(float fresnel) const;
    Rgb diffuse_value(const Vec3& wo, const Vec3& wi) const;
    Rgb diffuse_albedo(float cosine) const;
    float entry_density(const Vec3& wo, const Vec3& wi) const;
    std::optional<Vec3> sample_entry(const Vec3& wo, float u, const Vec2& u2) const;
};

class MeasuredTables;

/// A measured reflection, alike from either side; x is where azimuths begin.
struct MeasuredBsdf {
    const MeasuredTables* tables = nullptr;  ///< referred to

    Rgb evaluate(const Vec3& wo, const Vec3& wi) const;
    float density(const Vec3& wo, const Vec3& wi) const;
    std::optional<BsdfSample> sample(const Vec3& wo, float u, const Vec2& u2) const;
    bool is_specular() const { return false; }
};

/// The surface that Mitsuba calls principled (burley2012, burley2015), as it has it: lobes that are added, so that
/// energy is lost or gained. From the front there is a diffuse base with a gloss at grazing angles, facets, a coat and
/// cloth; from behind, and through it, the facets of a dielectric.
struct DisneyBsdf {
    Rgb base;
    float roughness = 0.5f;  ///< of the diffuse base
    float alpha_x = 0.25f, alpha_y = 0.25f;
    float ior = 1.5f;
    float metallic = 0;
    float spec_trans = 0;             ///< share of what is no metal that lets light through; 0: alike from both sides
    float spec_tint = 0;              ///< how far the facets of a dielectric have the base's hue
    float sheen = 0, sheen_tint = 0;  ///< of cloth: how much, and how far it has the base's hue
    float flatness = 0;               ///< share of the diffuse base that is as if light went below the surface
    float coat = 0;
    float coat_alpha = 0.1f;

    Rgb evaluate(const Vec3& wo, const Vec3& wi) const;
    float density(const Vec3& wo, const Vec3& wi) const;
    std::optional<BsdfSample> sample(const Vec3& wo, float u, const Vec2& u2) const;
    bool is_specular() const { return false; }
    /// Rough estimate of what is reflected or passes of light from wo.
    Rgb albedo(const Vec3& wo) const;

private:
    struct Meeting;
    /// How a direction is drawn; facets get the rest.
    struct Shares {
        float base, coat;
    };
    Shares shares(bool is_front) const;
    std::optional<Meeting> meet(const Vec3& wo, const Vec3& wi) const;
    Vec3 to_front(const Vec3& w, const Vec3& wo) const;
    Rgb facet_colour(const Meeting& at, bool is_front) const;
    Rgb diffuse_value(const Meeting& at, float cos_o, float cos_i) const;
    float reflected_share(float fresnel, bool is_front) const;
    std::optional<Vec3> sample_direction(const Vec3& wo, float u, const Vec2& u2) const;
};

/// The same for a sheet so thin that light goes on straight, alike from both sides: Mitsuba's principledthin. Facets
/// reflect, and others, less rough, let through; a diffuse base does both.
struct DisneySheetBsdf {
    Rgb base;
    float roughness = 0.5f;  ///< of the diffuse base
    float alpha_x = 0.25f, alpha_y = 0.25f;
    float passing_alpha_x = 0.1f, passing_alpha_y = 0.1f;  ///< of the facets that let through
    float ior = 1.5f;
    float spec_trans = 0;             ///< share of facets, of which there are none else
    float diff_trans = 0;             ///< share of the rest that goes through
    float spec_tint = 0;              ///< those of DisneyBsdf
    float sheen = 0, sheen_tint = 0;  ///< the same
    float flatness = 0;               ///< the same

    Rgb evaluate(const Vec3& wo, const Vec3& wi) const;
    float density(const Vec3& wo, const Vec3& wi) const;
    std::optional<BsdfSample> sample(const Vec3& wo, float u, const Vec2& u2) const;
    bool is_specular() const { return false; }

private:
    /// How a direction is drawn; a diffuse passage gets the rest.
    struct Shares {
        float mirrored, passed, diffuse;
    };
    Shares shares(const Vec3& wo) const;
    Microfacets facets(bool passes) const {
        return passes ? Microfacets(passing_alpha_x, passing_alpha_y) : Microfacets(alpha_x, alpha_y);
    }
};

/// The closed set of BSDFs.
using Bsdf = std::variant<LambertBsdf, DiffuseTransmissionBsdf, ConductorBsdf, DielectricBsdf, ThinDielectricBsdf,
                          CoatedBsdf, HairBsdf, PrincipledBsdf, MeasuredBsdf, DisneyBsdf, DisneySheetBsdf>;

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
