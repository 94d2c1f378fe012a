#include <wend/core/random.h>
#include <wend/medium/fresnel.h>
#include <wend/medium/microfacet.h>
#include <wend/medium/phase.h>
#include <wend/sampling/warp.h>
#include <wend/scene/bsdf/bsdf.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace wend {
namespace {

Vec3 upwards(const Vec3& w) {
    return w.z < 0 ? -w : w;
}

float transmittance(float thickness, const Vec3& w) {
    return std::exp(-thickness / std::max(std::abs(w.z), 1e-6f));
}

/// Of a direction outside of a smooth coat, that inside, on the same side; none where it is totally reflected.
std::optional<Vec3> refracted_side(const Vec3& w, float ior) {
    const float z2 = 1 - (sqr(w.x) + sqr(w.y)) / sqr(ior);
    return z2 > 0 ? std::optional(Vec3(w.x / ior, w.y / ior, std::sqrt(z2))) : std::nullopt;
}

/// Sum of the first powers of the ratio, 1 included.
float partial_series(float ratio, int terms) {
    return ratio < 1 ? (1 - std::pow(ratio, static_cast<float>(terms))) / (1 - ratio) : static_cast<float>(terms);
}

float power_heuristic(float a, float b) {
    return a > 0 ? 1 / (1 + sqr(b / a)) : 0.0f;
}

template <class... Vectors>
std::uint64_t key_of(std::uint64_t seed, const Vectors&... v) {
    return hash_of(seed,
                   (std::uint64_t{std::bit_cast<std::uint32_t>(v.x)} << 32 | std::bit_cast<std::uint32_t>(v.y))...,
                   std::bit_cast<std::uint32_t>(v.z)...);
}

/// A walk between coat and base. All directions point upwards or downwards the way that light is followed, from where
/// it is looked at.
class CoatWalk {
public:
    CoatWalk(const CoatedBsdf& b, const Vec3& wi, Pcg32& random)
        : b_(b), wi_(wi), random_(random), exit_(b.coat.sample_refraction(wi, random.uniform2())) {
        // Radiance in the coat is that outside times the squared index; what comes in along wi is followed inwards.
        leaving_ = exit_ ? exit_->value.r / exit_->density * sqr(b.coat.ior) * std::abs(wi.z) : 0.0f;
    }

    Rgb run(const Vec3& wo) {
        const auto entry = b_.coat.sample_refraction(wo, random_.uniform2());
        if (!entry || !exit_) {
            return Rgb(0.0f);
        }
        weight_ = entry->value / entry->density;
        w_ = entry->direction;
        height_ = b_.thickness;
        for (int depth = 0; depth < b_.max_depth && survives(depth); ++depth) {
            if (!(fly() ? scatter() : w_.z > 0 ? reflect_at_coat() : reflect_at_base())) {
                break;
            }
        }
        return sum_;
    }

private:
    bool survives(int depth) {
        const float left = max_value(weight_);
        if (depth <= 3 || left >= 0.25f) {
            return left > 0;
        }
        weight_ = weight_ / left;
        return random_.uniform() < left;
    }

    /// Whether there is a collision before the boundary ahead.
    bool fly() {
        const float ahead = w_.z > 0 ? b_.thickness - height_ : height_;
        if (is_black(b_.albedo)) {
            weight_ *= transmittance(ahead, w_);
            height_ = w_.z > 0 ? b_.thickness : 0.0f;
            return false;
        }
        const float step = -std::log(1 - random_.uniform()) * std::abs(w_.z);
        if (step < ahead) {
            height_ += w_.z > 0 ? step : -step;
            return true;
        }
        height_ = w_.z > 0 ? b_.thickness : 0.0f;
        return false;
    }

    bool scatter() {
        const HenyeyGreenstein phase{b_.mean_cosine};
        weight_ = weight_ * b_.albedo;
        const float towards = phase.evaluate(dot(w_, -exit_->direction));
        connect(Rgb(towards / std::abs(exit_->direction.z)), towards);
        const Vec3 before = w_;
        w_ = Frame::from_z(before).to_world(
            direction_from_cosine(phase.sample_cosine(random_.uniform()), random_.uniform()));
        leave(phase.evaluate(dot(before, w_)));
        return w_.z != 0;
    }

    bool reflect_at_coat() {
        const auto s = b_.coat.sample_reflection(-w_, random_.uniform2());
        return go_on(s);
    }

    bool reflect_at_base() {
        const bool is_mirror = std::visit([](const auto& base) { return base.is_specular(); }, b_.base);
        const Vec3 wo = -w_;
        if (!is_mirror) {
            const Vec3 up = -exit_->direction;
            const Rgb value = std::visit([&](const auto& base) { return base.evaluate(wo, up); }, b_.base);
            connect(value / std::abs(up.z),
                    std::visit([&](const auto& base) { return base.density(wo, up); }, b_.base));
        }
        const float u = random_.uniform();
        const Vec2 u2 = random_.uniform2();
        const auto s = std::visit([&](const auto& base) { return base.sample(wo, u, u2); }, b_.base);
        if (!go_on(s)) {
            return false;
        }
        leave(is_mirror ? std::optional<float>() : s->density);
        return true;
    }

    bool go_on(const std::optional<BsdfSample>& s) {
        if (!s) {
            return false;
        }
        weight_ = weight_ * (s->value / s->density);
        w_ = s->direction;
        return true;
    }

    /// Adds what leaves along the exit that was drawn from outside, scattered into it by `value` (per cosine).
    /// `density`: with which that would have been drawn from here.
    void connect(const Rgb& value, float density) {
        const float share = exit_->specular ? 1.0f : power_heuristic(exit_->density, density);
        sum_ += weight_ * value * (leaving_ * share * transmittance(b_.thickness - height_, exit_->direction));
    }

    /// Adds what leaves along the direction that was drawn here, with that density if with any, through a rough coat.
    void leave(std::optional<float> density) {
        if (exit_->specular || w_.z <= 0) {
            return;
        }
        const float share = density ? power_heuristic(*density, b_.coat.refraction_density(wi_, -w_)) : 1.0f;
        sum_ += weight_ * b_.coat.evaluate(-w_, wi_) * (share * transmittance(b_.thickness - height_, w_));
    }

    const CoatedBsdf& b_;
    Vec3 wi_;
    Pcg32& random_;
    std::optional<BsdfSample> exit_;  ///< drawn from outside
    float leaving_ = 0;
    Rgb sum_{0.0f};
    Rgb weight_;
    Vec3 w_;
    float height_ = 0;  ///< above the base
};

}  // namespace

float coat_return(float ior, float thickness) {
    // ∫ F(c) exp(-2 thickness / c) 2c dc; from inside, F is 1 beyond the critical angle.
    constexpr int steps = 256;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const float c = (static_cast<float>(i) + 0.5f) / steps;
        sum += static_cast<double>(fresnel_dielectric(-c, ior) * std::exp(-2 * thickness / c) * 2 * c);
    }
    return static_cast<float>(sum / steps);
}

bool CoatedBsdf::has_smooth_metal() const {
    const auto* metal = std::get_if<ConductorBsdf>(&base);
    return metal && metal->is_specular();
}

bool CoatedBsdf::is_specular() const {
    return coat.is_specular() && has_smooth_metal() && is_black(albedo);
}

Rgb CoatedBsdf::reflectance_estimate(const Vec3& wo) const {
    const float f = fresnel_dielectric(std::abs(wo.z), coat.ior);
    const Rgb below = directional_albedo(std::visit([](const auto& b) { return Bsdf(b); }, base), upwards(wo));
    const float passed = std::exp(-2 * thickness);
    return Rgb(f) + (below * passed + albedo * (1 - passed)) * (1 - f);
}

CoatedBsdf::Shares CoatedBsdf::shares(const Vec3& wo) const {
    const float f = fresnel_dielectric(std::abs(wo.z), coat.ior);
    const float inside = mean_value(reflectance_estimate(wo)) - f;
    if (!(inside > 0)) {
        return {1, 0, 0};
    }
    const float below = inside / (f + inside);
    // Most of what a metal reflects goes the way of its lobe; of what was scattered or reflected again, all ways.
    const float as_base = std::holds_alternative<ConductorBsdf>(base)
                              ? (is_black(albedo) ? 0.8f : 0.8f * std::exp(-2 * thickness))
                              : 0.0f;
    const bool mirrors = has_smooth_metal() && coat.is_specular();
    const float base_share = below * as_base;
    return mirrors ? Shares{1 - below + base_share, 0, below - base_share}
                   : Shares{1 - below, base_share, below - base_share};
}

ConductorBsdf CoatedBsdf::seen_base() const {
    ConductorBsdf metal = std::get<ConductorBsdf>(base);
    metal.alpha_x = std::hypot(metal.alpha_x, coat.alpha_x);
    metal.alpha_y = std::hypot(metal.alpha_y, coat.alpha_y);
    return metal;
}

float CoatedBsdf::base_density(const Vec3& wo, const Vec3& wi) const {
    if (!coat.is_specular()) {
        return seen_base().density(wo, wi);
    }
    const auto o = refracted_side(wo, coat.ior);
    const auto i = refracted_side(wi, coat.ior);
    return o && i ? std::get<ConductorBsdf>(base).density(*o, *i) * wi.z / (sqr(coat.ior) * i->z) : 0.0f;
}

std::optional<Vec3> CoatedBsdf::sample_base(const Vec3& wo, float u, const Vec2& u2) const {
    if (!coat.is_specular()) {
        const auto s = seen_base().sample(wo, u, u2);
        return s ? std::optional(s->direction) : std::nullopt;
    }
    const auto o = refracted_side(wo, coat.ior);
    const auto s = o ? std::get<ConductorBsdf>(base).sample(*o, u, u2) : std::nullopt;
    return s ? refracted_side(s->direction, 1 / coat.ior) : std::nullopt;
}

/// Smooth coat over a smooth metal: there is but one direction.
Rgb CoatedBsdf::mirrored(const Vec3& wo) const {
    const float f = fresnel_dielectric(wo.z, coat.ior);
    const auto inside = refracted_side(wo, coat.ior);
    if (!has_smooth_metal() || !inside) {
        return Rgb(f);
    }
    const Rgb metal = directional_albedo(std::get<ConductorBsdf>(base), *inside);
    const float passed = transmittance(2 * thickness, *inside);
    Rgb value;
    for (int c = 0; c < 3; ++c) {
        const float once = metal[c] * passed;
        value[c] = f + sqr(1 - f) * once * partial_series(f * once, max_depth / 2);
    }
    return value;
}

/// Smooth coat over a diffuse base, without scattering.
Rgb CoatedBsdf::diffuse_value(const Vec3& wo, const Vec3& wi) const {
    const auto o = refracted_side(wo, coat.ior);
    const auto i = refracted_side(wi, coat.ior);
    if (!o || !i) {
        return Rgb(0.0f);
    }
    const float passed = (1 - fresnel_dielectric(wo.z, coat.ior)) * (1 - fresnel_dielectric(wi.z, coat.ior)) *
                         transmittance(thickness, *o) * transmittance(thickness, *i);
    const Rgb& colour = std::get<LambertBsdf>(base).reflectance;
    Rgb value;
    for (int c = 0; c < 3; ++c) {
        value[c] = colour[c] * passed * inv_pi * wi.z / sqr(coat.ior) *
                   partial_series(colour[c] * returned, (max_depth + 1) / 2);
    }
    return value;
}

Rgb CoatedBsdf::walked_value(const Vec3& wo, const Vec3& wi) const {
    Pcg32 random(key_of(seed, wo, wi));
    Rgb sum(0.0f);
    for (int i = 0; i < walks; ++i) {
        sum += CoatWalk(*this, wi, random).run(wo);
    }
    return sum / static_cast<float>(walks);
}

Rgb CoatedBsdf::evaluate(const Vec3& wo, const Vec3& wi) const {
    if (!(wo.z * wi.z > 0) || is_specular()) {
        return Rgb(0.0f);
    }
    const Vec3 o = upwards(wo), i = upwards(wi);
    const bool is_closed =
        returned >= 0 && coat.is_specular() && is_black(albedo) && std::holds_alternative<LambertBsdf>(base);
    return coat.evaluate(o, i) + (is_closed ? diffuse_value(o, i) : walked_value(o, i));
}

float CoatedBsdf::density(const Vec3& wo, const Vec3& wi) const {
    if (!(wo.z * wi.z > 0) || is_specular()) {
        return 0;
    }
    const Vec3 o = upwards(wo), i = upwards(wi);
    const Shares share = shares(o);
    float p = share.diffuse * cosine_hemisphere_density(i.z);
    if (!coat.is_specular()) {
        const Vec3 m = normalize(o + i);
        p += share.coat * Microfacets(coat.alpha_x, coat.alpha_y, coat.slopes).visible_density(o, m) /
             (4 * abs_dot(o, m));
    }
    return share.base > 0 ? p + share.base * base_density(o, i) : p;
}

std::optional<BsdfSample> CoatedBsdf::sample(const Vec3& wo, float u, const Vec2& u2) const {
    if (wo.z == 0) {
        return std::nullopt;
    }
    const Vec3 o = upwards(wo);
    const Shares share = shares(o);
    std::optional<Vec3> wi;
    if (u < share.coat || is_specular()) {
        if (coat.is_specular()) {
            const float chosen = is_specular() ? 1.0f : share.coat;
            return BsdfSample{{-wo.x, -wo.y, wo.z}, mirrored(o), chosen, true};
        }
        const auto s = coat.sample_reflection(o, u2);
        wi = s ? std::optional(s->direction) : std::nullopt;
    } else if (u < share.coat + share.base) {
        wi = sample_base(o, (u - share.coat) / share.base, u2);
    } else {
        wi = to_cosine_hemisphere(u2);
    }
    if (!wi || !(wi->z > 0)) {
        return std::nullopt;
    }
    const Vec3 turned = wo.z < 0 ? -*wi : *wi;
    const float p = density(wo, turned);
    return p > 0 ? std::optional(BsdfSample{turned, evaluate(wo, turned), p}) : std::nullopt;
}

}  // namespace wend
