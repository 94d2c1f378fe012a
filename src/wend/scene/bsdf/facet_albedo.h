// How much light facets reflect, by direction and roughness: what is left for what is below them, and what single
// reflections lack.
#pragma once

#include <array>
#include <cstddef>

namespace wend {

/// Directional albedos of GGX facets in single reflection, as tables.
class FacetAlbedo {
public:
    /// `ior`: of the facets over outside; above 0.
    explicit FacetAlbedo(float ior);

    /// By Fresnel's equations for a dielectric; `cosine` and `alpha` in [0, 1].
    float dielectric(float cosine, float alpha) const { return look_up(dielectric_, cosine, alpha); }
    /// Of facets that reflect everything.
    float white(float cosine, float alpha) const { return look_up(white_, cosine, alpha); }
    /// Of facets that reflect (1 - cosine)^5 of what meets them.
    float grazing(float cosine, float alpha) const { return look_up(grazing_, cosine, alpha); }
    /// white(), as a mean over the directions of even radiance.
    float mean_white(float alpha) const;
    /// Of a smooth dielectric, as a mean over the directions of even radiance.
    float mean_fresnel() const { return mean_fresnel_; }

private:
    static constexpr std::size_t cosines = 48, roughnesses = 32;
    using Table = std::array<std::array<float, cosines>, roughnesses>;
    static float look_up(const Table& table, float cosine, float alpha);

    Table dielectric_{}, white_{}, grazing_{};
    std::array<float, roughnesses> mean_white_{};
    float mean_fresnel_ = 0;
};

}  // namespace wend
