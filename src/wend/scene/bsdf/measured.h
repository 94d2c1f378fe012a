// Reflections measured and tabulated as dupuy2018 do: what MeasuredBsdf refers to.
#pragma once

#include <wend/core/colour.h>
#include <wend/sampling/bilinear.h>

#include <optional>
#include <utility>
#include <vector>

namespace wend {

/// Tables over the direction that light is seen from, and over facets m or places that facets are drawn from. A
/// direction at the angle t to the normal and the azimuth p is at (sqrt(2 t / pi), (p + pi) / (2 pi)) in the unit
/// square. Facets are drawn in two steps: a place in proportion to the luminance, and of it a facet as `visible` has
/// them.
struct MeasuredData {
    std::vector<float> azimuths;     ///< of the slices, radians, increasing
    std::vector<float> angles;       ///< of the slices, radians, increasing; these run fastest
    BilinearTable<float> facets;     ///< distribution of facets, one slice
    BilinearTable<float> projected;  ///< projected area of the facets by direction, one slice
    BilinearTable<float> visible;    ///< of facets, by direction
    BilinearTable<float> luminance;  ///< by place and direction
    BilinearTable<Rgb> colours;      ///< by place and direction: what the reflection is over that of mirrors

    /// Up to so many azimuths, all directions at an angle are alike, and facets count from the azimuth of the view.
    static constexpr std::size_t most_azimuths_if_isotropic = 2;
};

class MeasuredTables {
public:
    /// All of the data must be finite, none negative, and its sizes fit each other.
    explicit MeasuredTables(MeasuredData data);

    // Directions are on the upper side. Values include the cosine of wi; densities are of wi, given wo.
    Rgb value(const Vec3& wo, const Vec3& wi) const;
    float density(const Vec3& wo, const Vec3& wi) const;
    /// None where the reflection would go below.
    std::optional<Vec3> sample(const Vec3& wo, const Vec2& u) const;
    /// Estimate of what is reflected of light from wo, on either side.
    Rgb albedo(const Vec3& wo) const;

private:
    /// What both directions have in common.
    struct Pair {
        SliceBlend blend;
        Vec3 facet;
        Vec2 facet_place;
        BilinearDensity::Point drawn_from;  // with the density of facet_place
    };
    Pair pair_of(const Vec3& wo, const Vec3& wi) const;
    SliceBlend blend_of(const Vec3& wo) const;
    bool is_isotropic() const { return data_.azimuths.size() <= MeasuredData::most_azimuths_if_isotropic; }
    Rgb measured_albedo(const Vec3& wo) const;

    MeasuredData data_;
    BilinearDensity visible_;
    BilinearDensity luminance_;
    std::vector<Rgb> albedos_;  // slice by slice
};

}  // namespace wend
