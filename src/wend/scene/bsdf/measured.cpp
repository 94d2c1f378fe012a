#include <wend/scene/bsdf/measured.h>

#include <wend/core/random.h>
#include <wend/scene/bsdf/bsdf.h>

#include <cmath>

namespace wend {
namespace {

/// The place of a direction at an angle and an azimuth, which may be off by turns.
Vec2 place_of(float angle, float azimuth) {
    const float turn = (azimuth + pi) / (2 * pi);
    return {std::sqrt(std::max(angle, 0.0f) * (2 / pi)), turn - std::floor(turn)};
}

float angle_of(const Vec3& d) {
    return std::atan2(std::hypot(d.x, d.y), d.z);
}

/// Solid angle over area of the unit square, at the place of `facet`; not below what single precision tells from 0.
float stretch_of(const Vec3& facet, const Vec2& place) {
    constexpr float least = 1e-6f;
    return std::max(2 * sqr(pi) * place.x * std::hypot(facet.x, facet.y), least);
}

/// Index of the last node that is not above x, but one that has another after it, and the share of that.
struct Interval {
    std::size_t first = 0;
    float part = 0;

    Interval(const std::vector<float>& nodes, float x) {
        if (nodes.size() > 1) {
            const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, x);
            first = static_cast<std::size_t>(above - nodes.begin()) - 1;
            part = std::clamp((x - nodes[first]) / (nodes[first + 1] - nodes[first]), 0.0f, 1.0f);
        }
    }
};

}  // namespace

MeasuredTables::MeasuredTables(MeasuredData data)
    : data_(std::move(data)), visible_(std::move(data_.visible)), luminance_(std::move(data_.luminance)) {
    for (const float azimuth : data_.azimuths) {
        for (const float angle : data_.angles) {
            constexpr float most = 0.499f * pi;
            const float t = std::min(angle, most);
            albedos_.push_back(
                measured_albedo({std::sin(t) * std::cos(azimuth), std::sin(t) * std::sin(azimuth), std::cos(t)}));
        }
    }
}

Rgb MeasuredTables::measured_albedo(const Vec3& wo) const {
    constexpr int samples = 1024;
    Pcg32 random(1);
    Rgb sum(0.0f);
    for (int i = 0; i < samples; ++i) {
        const auto wi = sample(wo, random.uniform2());
        const float p = wi ? density(wo, *wi) : 0.0f;
        sum += p > 0 ? value(wo, *wi) / p : Rgb(0.0f);
    }
    return sum / samples;
}

Rgb MeasuredTables::albedo(const Vec3& wo) const {
    const SliceBlend blend = blend_of(wo.z < 0 ? -wo : wo);
    return blend.mixed([&](std::size_t slice) { return albedos_[slice]; });
}

SliceBlend MeasuredTables::blend_of(const Vec3& wo) const {
    const Interval azimuth(data_.azimuths, std::atan2(wo.y, wo.x)), angle(data_.angles, angle_of(wo));
    SliceBlend blend;
    blend.count = 0;
    for (std::size_t i = 0; i < 2; ++i) {
        for (std::size_t j = 0; j < 2; ++j) {
            const float weight = (i == 0 ? 1 - azimuth.part : azimuth.part) * (j == 0 ? 1 - angle.part : angle.part);
            if (weight > 0) {
                blend.slice[blend.count] = (azimuth.first + i) * data_.angles.size() + angle.first + j;
                blend.weight[blend.count++] = weight;
            }
        }
    }
    return blend;
}

MeasuredTables::Pair MeasuredTables::pair_of(const Vec3& wo, const Vec3& wi) const {
    Pair pair;
    pair.blend = blend_of(wo);
    pair.facet = normalize(wo + wi);
    const float from = is_isotropic() ? std::atan2(wo.y, wo.x) : 0.0f;
    pair.facet_place = place_of(angle_of(pair.facet), std::atan2(pair.facet.y, pair.facet.x) - from);
    pair.drawn_from = visible_.invert(pair.blend, pair.facet_place);
    return pair;
}

Rgb MeasuredTables::value(const Vec3& wo, const Vec3& wi) const {
    const Pair pair = pair_of(wo, wi);
    const float projected = data_.projected.at({}, place_of(angle_of(wo), std::atan2(wo.y, wo.x)));
    if (!(projected > 0)) {
        return Rgb(0.0f);
    }
    const float facets = data_.facets.at({}, pair.facet_place);
    return data_.colours.at(pair.blend, pair.drawn_from.position) * (facets / (4 * projected));
}

float MeasuredTables::density(const Vec3& wo, const Vec3& wi) const {
    const Pair pair = pair_of(wo, wi);
    const float jacobian = 4 * dot(wo, pair.facet) * stretch_of(pair.facet, pair.facet_place);
    return jacobian > 0 ? pair.drawn_from.density * luminance_.density(pair.blend, pair.drawn_from.position) / jacobian
                        : 0.0f;
}

std::optional<Vec3> MeasuredTables::sample(const Vec3& wo, const Vec2& u) const {
    const SliceBlend blend = blend_of(wo);
    const Vec2 place = visible_.sample(blend, luminance_.sample(blend, u).position).position;
    const float angle = sqr(place.x) * (pi / 2);
    const float azimuth = place.y * (2 * pi) - pi + (is_isotropic() ? std::atan2(wo.y, wo.x) : 0.0f);
    const Vec3 facet(std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), std::cos(angle));
    const Vec3 wi = facet * (2 * dot(wo, facet)) - wo;
    return wi.z > 0 ? std::optional(normalize(wi)) : std::nullopt;
}

Rgb MeasuredBsdf::evaluate(const Vec3& wo, const Vec3& wi) const {
    return !(wo.z * wi.z > 0) ? Rgb(0.0f) : wo.z > 0 ? tables->value(wo, wi) : tables->value(-wo, -wi);
}

float MeasuredBsdf::density(const Vec3& wo, const Vec3& wi) const {
    return !(wo.z * wi.z > 0) ? 0.0f : wo.z > 0 ? tables->density(wo, wi) : tables->density(-wo, -wi);
}

std::optional<BsdfSample> MeasuredBsdf::sample(const Vec3& wo, float, const Vec2& u2) const {
    const float side = wo.z > 0 ? 1.0f : -1.0f;
    const auto drawn = tables->sample(wo * side, u2);
    if (!drawn) {
        return std::nullopt;
    }
    const Vec3 wi = *drawn * side;
    const float p = density(wo, wi);
    if (!(p > 0)) {
        return std::nullopt;
    }
    return BsdfSample{wi, evaluate(wo, wi), p};
}

}  // namespace wend
