#include <wend/scene/bsdf/facet_albedo.h>

#include <wend/medium/fresnel.h>
#include <wend/medium/microfacet.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// Where a number of [0, 1] lies between the entries of a table.
struct Between {
    std::size_t first;
    float part;

    Between(float x, std::size_t entries) {
        const float place = std::clamp(x, 0.0f, 1.0f) * static_cast<float>(entries - 1);
        first = std::min(static_cast<std::size_t>(place), entries - 2);
        part = place - static_cast<float>(first);
    }
    template <class Entries>
    float of(const Entries& entries) const {
        return entries[first] + part * (entries[first + 1] - entries[first]);
    }
};

}  // namespace

FacetAlbedo::FacetAlbedo(float ior) {
    constexpr int samples = 1024;
    // Spread evenly, and no grid: light is lost beyond an edge, which must not fall between rows of points.
    constexpr double golden = 0.6180339887498949;
    constexpr float most_grazing = 1e-3f;
    for (std::size_t r = 0; r < roughnesses; ++r) {
        const float alpha = sqr(static_cast<float>(r) / (roughnesses - 1));
        const Microfacets facets(alpha, alpha);
        for (std::size_t i = 0; i < cosines; ++i) {
            const float cosine = std::max(sqr(static_cast<float>(i) / (cosines - 1)), most_grazing);
            const Vec3 wo(safe_sqrt(1 - cosine * cosine), 0, cosine);
            double dielectric = 0, white = 0, grazing = 0;
            for (int k = 0; k < samples; ++k) {
                const double turn = (k + 0.5) * golden;
                const Vec2 u((static_cast<float>(k) + 0.5f) / samples, static_cast<float>(turn - std::floor(turn)));
                const Vec3 m = facets.sample_visible(wo, u);
                const Vec3 wi = m * (2 * dot(wo, m)) - wo;
                if (wi.z > 0) {
                    const float weight = facets.g(wo, wi) / facets.g1(wo), c = abs_dot(wo, m);
                    white += static_cast<double>(weight);
                    grazing += static_cast<double>(weight * std::pow(1 - c, 5.0f));
                    dielectric += static_cast<double>(weight * fresnel_dielectric(c, ior));
                }
            }
            white_[r][i] = static_cast<float>(white / samples);
            grazing_[r][i] = static_cast<float>(grazing / samples);
            dielectric_[r][i] = static_cast<float>(dielectric / samples);
        }
        constexpr int steps = 64;
        for (int k = 0; k < steps; ++k) {
            const float cosine = (static_cast<float>(k) + 0.5f) / steps;
            mean_white_[r] += 2 * cosine * Between(std::sqrt(cosine), cosines).of(white_[r]) / steps;
        }
    }
    constexpr int steps = 256;
    for (int k = 0; k < steps; ++k) {
        const float cosine = (static_cast<float>(k) + 0.5f) / steps;
        mean_fresnel_ += 2 * cosine * fresnel_dielectric(cosine, ior) / steps;
    }
}

float FacetAlbedo::look_up(const Table& table, float cosine, float alpha) {
    // Closer to each other where albedos are steep: at grazing angles, and where facets are smooth.
    const Between row(std::sqrt(std::max(alpha, 0.0f)), roughnesses);
    const Between column(std::sqrt(std::max(cosine, 0.0f)), cosines);
    const float below = column.of(table[row.first]), above = column.of(table[row.first + 1]);
    return below + row.part * (above - below);
}

float FacetAlbedo::mean_white(float alpha) const {
    return Between(std::sqrt(std::max(alpha, 0.0f)), roughnesses).of(mean_white_);
}

}  // namespace wend
