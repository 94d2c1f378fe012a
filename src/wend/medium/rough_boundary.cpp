#include <wend/medium/rough_boundary.h>

#include <wend/medium/fresnel.h>
#include <wend/medium/microfacet.h>
#include <wend/sampling/warp.h>

#include <cmath>
#include <numbers>

namespace wend {
namespace {

/// Of the quadratures: points over microfacets, and azimuths.
constexpr int microfacet_points = 8192;
constexpr int azimuths = 256;

/// The mean of use(u) over a lattice in the unit square. (On a grid the disk of visible normals would have few radii,
/// and transmission ends at one.)
double lattice_mean(const auto& use) {
    double sum = 0;
    for (int i = 0; i < microfacet_points; ++i) {
        sum += use(golden_lattice_point(i, microfacet_points, Vec2(0, 0)));
    }
    return sum / microfacet_points;
}

Vec3 at_cosine(double cosine, double azimuth = 0) {
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    return {static_cast<float>(sine * std::cos(azimuth)), static_cast<float>(sine * std::sin(azimuth)),
            static_cast<float>(cosine)};
}

}  // namespace

RoughBoundary::Encounter RoughBoundary::encounter(double cosine, const Vec2& u, bool outside) const {
    const auto alpha = static_cast<float>(alpha_);
    const Microfacets facets(alpha, alpha);
    // The normal points to the side the walk is on; `ior` is the index beyond over the index here.
    const auto ior = static_cast<float>(outside ? ior_ : 1 / ior_);
    const Vec3 w = at_cosine(std::max(cosine, 1e-6));
    const Vec3 m = facets.sample_visible(w, u);
    const float c = dot(w, m);
    Encounter encounter;
    if (c <= 0) {
        return encounter;
    }
    const float reflectance = fresnel_dielectric(c, ior);
    const Vec3 reflected = m * (2 * c) - w;
    if (reflected.z > 0) {
        encounter.reflected_cosine = static_cast<double>(reflected.z);
        encounter.reflected_weight = static_cast<double>(reflectance * facets.g(w, reflected) / facets.g1(w));
    }
    if (const auto refracted = refract(w, m, ior); refracted && refracted->direction.z < 0) {
        encounter.transmitted_cosine = static_cast<double>(-refracted->direction.z);
        encounter.transmitted_weight =
            static_cast<double>((1 - reflectance) * facets.g(w, refracted->direction) / facets.g1(w));
    }
    return encounter;
}

double RoughBoundary::mean_transmitted(double cosine, const std::function<double(double)>& value, bool outside) const {
    return lattice_mean([&](const Vec2& u) {
        const Encounter e = encounter(cosine, u, outside);
        return e.transmitted_weight > 0 ? e.transmitted_weight * value(e.transmitted_cosine) : 0;
    });
}

double RoughBoundary::reflected_from_outside(double cosine, const std::function<double(double)>& value) const {
    return lattice_mean([&](const Vec2& u) {
        const Encounter e = encounter(cosine, u, true);
        return e.reflected_weight > 0 ? e.reflected_weight * value(e.reflected_cosine) : 0;
    });
}

double RoughBoundary::reflection(double from, double to) const {
    const auto alpha = static_cast<float>(alpha_);
    const Microfacets facets(alpha, alpha);
    const Vec3 w = at_cosine(from);
    double sum = 0;
    for (int i = 0; i < azimuths; ++i) {
        const Vec3 other = at_cosine(to, 2 * std::numbers::pi * (i + 0.5) / azimuths);
        const Vec3 m = normalize(w + other);
        const float reflectance = fresnel_dielectric(-dot(w, m), static_cast<float>(ior_));
        sum += static_cast<double>(reflectance * facets.d(m) * facets.g(w, other));
    }
    return sum / azimuths * 2 * std::numbers::pi / (4 * from);
}

}  // namespace wend
