#pragma once

#include <wend/core/vector.h>
#include <wend/sampling/warp.h>

namespace wend {

/// How the slopes of facets are distributed: with long tails (GGX, Trowbridge and Reitz's), or as a Gaussian
/// (Beckmann's).
enum class FacetSlopes { ggx, beckmann };

/// An anisotropic distribution of microfacet normals (walter2007). Directions are local, z is the mean normal. GGX is
/// sampled by visible normals (heitz2018), Beckmann's by all normals, as they are seen from above.
class Microfacets {
public:
    Microfacets(float alpha_x, float alpha_y, FacetSlopes slopes = FacetSlopes::ggx)
        : ax_(std::max(alpha_x, 1e-4f)), ay_(std::max(alpha_y, 1e-4f)), slopes_(slopes) {}

    /// Rough so little that it is treated as a perfect mirror.
    static bool is_smooth(float alpha_x, float alpha_y) { return std::max(alpha_x, alpha_y) < 1e-3f; }

    /// Density of normals per projected area.
    float d(const Vec3& m) const {
        if (slopes_ == FacetSlopes::beckmann) {
            const float z2 = sqr(m.z);
            return z2 > 0 ? std::exp(-(sqr(m.x / ax_) + sqr(m.y / ay_)) / z2) / (pi * ax_ * ay_ * sqr(z2)) : 0.0f;
        }
        const float e = sqr(m.x / ax_) + sqr(m.y / ay_) + sqr(m.z);
        return e > 0 ? 1 / (pi * ax_ * ay_ * sqr(e)) : 0.0f;
    }
    /// Smith's auxiliary function; the masking is 1 / (1 + lambda).
    float lambda(const Vec3& w) const {
        const float z2 = w.z * w.z;
        if (z2 <= 0) {
            return 0;
        }
        if (slopes_ == FacetSlopes::beckmann) {
            return beckmann_lambda(std::sqrt(z2 / std::max(sqr(ax_ * w.x) + sqr(ay_ * w.y), 1e-20f)));
        }
        return 0.5f * (std::sqrt(1 + (sqr(ax_ * w.x) + sqr(ay_ * w.y)) / z2) - 1);
    }
    float g1(const Vec3& w) const { return 1 / (1 + lambda(w)); }
    float g(const Vec3& a, const Vec3& b) const { return 1 / (1 + lambda(a) + lambda(b)); }
    /// Density per steradian of sample_visible().
    float visible_density(const Vec3& w, const Vec3& m) const {
        if (slopes_ == FacetSlopes::beckmann) {
            return d(m) * m.z;
        }
        return w.z == 0 ? 0.0f : g1(w) * d(m) * abs_dot(w, m) / std::abs(w.z);
    }
    /// A normal visible from w, with w.z > 0 or < 0; the normal has z > 0. Of Beckmann's some are not visible.
    Vec3 sample_visible(Vec3 w, const Vec2& u) const {
        if (slopes_ == FacetSlopes::beckmann) {
            const float slope = std::sqrt(-std::log1p(-std::min(u.x, 0.99999994f))), phi = 2 * pi * u.y;
            return normalize(Vec3(ax_ * slope * std::cos(phi), ay_ * slope * std::sin(phi), 1));
        }
        Vec3 h = normalize(Vec3(ax_ * w.x, ay_ * w.y, w.z));
        if (h.z < 0) {
            h = -h;
        }
        const Vec3 t1 = h.z < 0.99999f ? normalize(cross(Vec3(0, 0, 1), h)) : Vec3(1, 0, 0);
        const Vec3 t2 = cross(h, t1);
        Vec2 p = to_disk(u);
        const float s = 0.5f * (1 + h.z);
        p.y = (1 - s) * safe_sqrt(1 - p.x * p.x) + s * p.y;
        const Vec3 n = t1 * p.x + t2 * p.y + h * safe_sqrt(1 - p.x * p.x - p.y * p.y);
        return normalize(Vec3(ax_ * n.x, ay_ * n.y, std::max(1e-6f, n.z)));
    }

    /// Whether a normal of sample_visible() is visible from w: of GGX all are.
    bool is_visible(const Vec3& w, const Vec3& m) const { return slopes_ == FacetSlopes::ggx || dot(w, m) * w.z > 0; }

private:
    /// By walter2007's fit of the masking; `a` is the cotangent of the angle over the roughness.
    static float beckmann_lambda(float a) {
        return a < 1.6f ? (1 + a * (2.276f + a * 2.577f)) / (a * (3.535f + a * 2.181f)) - 1 : 0.0f;
    }

    float ax_;
    float ay_;
    FacetSlopes slopes_;
};

}  // namespace wend
