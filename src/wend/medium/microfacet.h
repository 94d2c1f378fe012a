#pragma once

#include <wend/core/vector.h>
#include <wend/sampling/warp.h>

namespace wend {

/// The anisotropic GGX (Trowbridge-Reitz) distribution of microfacet normals (walter2007), sampled by visible normals
/// (heitz2018). Directions are local, z is the mean normal.
class Microfacets {
public:
    Microfacets(float alpha_x, float alpha_y) : ax_(std::max(alpha_x, 1e-4f)), ay_(std::max(alpha_y, 1e-4f)) {}

    /// Rough so little that it is treated as a perfect mirror.
    static bool is_smooth(float alpha_x, float alpha_y) { return std::max(alpha_x, alpha_y) < 1e-3f; }

    /// Density of normals per projected area.
    float d(const Vec3& m) const {
        const float e = sqr(m.x / ax_) + sqr(m.y / ay_) + sqr(m.z);
        return e > 0 ? 1 / (pi * ax_ * ay_ * sqr(e)) : 0.0f;
    }
    /// Smith's auxiliary function; the masking is 1 / (1 + lambda).
    float lambda(const Vec3& w) const {
        const float z2 = w.z * w.z;
        if (z2 <= 0) {
            return 0;
        }
        return 0.5f * (std::sqrt(1 + (sqr(ax_ * w.x) + sqr(ay_ * w.y)) / z2) - 1);
    }
    float g1(const Vec3& w) const { return 1 / (1 + lambda(w)); }
    float g(const Vec3& a, const Vec3& b) const { return 1 / (1 + lambda(a) + lambda(b)); }
    /// Density per steradian of the normals visible from w.
    float visible_density(const Vec3& w, const Vec3& m) const {
        return w.z == 0 ? 0.0f : g1(w) * d(m) * abs_dot(w, m) / std::abs(w.z);
    }
    /// A normal visible from w, with w.z > 0 or < 0; the normal has z > 0.
    Vec3 sample_visible(Vec3 w, const Vec2& u) const {
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

private:
    float ax_;
    float ay_;
};

}  // namespace wend
