#include <wend/openpgl/path_segments.h>

#include <wend/openpgl/values.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace wend::openpgl {
namespace {

/// Below, a lobe is too narrow to learn from: it is taken for a mirror.
constexpr float least_roughness = 0.01f;
/// Below, what is seen in a surface is further away than the surface.
constexpr float least_rough = 0.3f;

/// Of the radiance that arrives behind the segment's scattering: its weight over survival.
Rgb scattered_on(const PGLPathSegmentData& s) {
    const float survival = s.russianRouletteSurvivalProbability;
    return survival > 0 ? to_colour(s.scatteringWeight) / survival : Rgb();
}

/// The part of the virtual distance that a mirror or a refraction adds to what is seen in it.
float seen_through(const PGLPathSegmentData& s, float distance) {
    if (!s.isDelta && s.roughness >= least_rough) {
        return 0;
    }
    if (s.eta == 1) {
        return distance;
    }
    const Vec3 normal = to_vector(s.normal);
    const float out = dot(normal, to_vector(s.directionOut)), in = dot(normal, to_vector(s.directionIn));
    return distance * std::abs(out / (in * s.eta));
}

std::uint32_t flags_of(const PGLPathSegmentData& segment, const PGLPathSegmentData& next) {
    const bool met_light = !is_black(to_colour(next.directContribution));
    const bool met_light_alone = met_light && is_black(to_colour(next.scatteredContribution));
    std::uint32_t flags = 0;
    if (segment.volumeScatter) {
        flags |= PGLSampleData::EInsideVolume;
    }
    if (met_light_alone) {
        flags |= PGLSampleData::EDirectLight;
    }
    if (next.volumeScatter) {
        flags |= PGLSampleData::ENextEventVolume;
    }
    return flags;
}

}  // namespace

void PathSegments::reserve(std::size_t most) {
    if (most != segments_.size()) {
        segments_ = std::vector<PGLPathSegmentData>(most);
        clear();
    }
}

void PathSegments::clear() {
    size_ = 0;
    samples_.clear();
    added_.clear();
    plain_.clear();
    zeros_.clear();
}

PGLPathSegmentData* PathSegments::next() {
    if (size_ == segments_.size()) {
        return nullptr;
    }
    segments_[size_] = {};
    return &segments_[size_++];
}

void PathSegments::add_sample(const PGLSampleData& sample) {
    added_.push_back({sample, Rgb()});
    samples_.push_back(added_.back());
    plain_.push_back(sample);
}

void PathSegments::prepare(const LightRules& rules) {
    samples_ = added_;
    zeros_.clear();
    // Of what is behind the next vertex: the radiance that arrives there and its distance, as far as that adds up.
    Rgb beyond;
    float distance_beyond = 0;
    for (std::size_t i = size_ < 2 ? 0 : size_ - 1; i-- > 0;) {
        const PGLPathSegmentData &segment = segments_[i], &next = segments_[i + 1];
        const Rgb flight = to_colour(segment.transmittanceWeight), light = to_colour(next.directContribution);
        const Rgb others = to_colour(next.scatteredContribution) + scattered_on(next) * beyond;
        const Rgb next_light = rules.counts_next ? light * (rules.weights_next ? next.miWeight : 1.0f) : Rgb();
        const Rgb incident = flight * (others + next_light);

        const float step = length(to_vector(next.position) - to_vector(segment.position));
        const float distance = std::min(step + distance_beyond, 2 * max_distance);
        if (!segment.isDelta && segment.roughness > least_roughness) {
            // NaN is not black: the fit ignores such samples, and counts them.
            if (is_black(incident)) {
                zeros_.push_back({segment.position, segment.directionIn, segment.volumeScatter});
            } else {
                const float pdf = segment.pdfDirectionIn;
                samples_.push_back({{segment.position, segment.directionIn, mean(incident) / pdf, pdf, distance,
                                     flags_of(segment, next)},
                                    incident});
            }
        }
        distance_beyond = seen_through(segment, distance);
        const float undone = rules.divides_by_survival ? 1.0f : segment.russianRouletteSurvivalProbability;
        beyond = flight * (others + light * (next.miWeight * undone));
    }
    plain_.clear();
    for (const Sample& sample : samples_) {
        plain_.push_back(sample.data);
    }
}

Rgb PathSegments::estimate(bool divides_by_survival) const {
    if (size_ == 0) {
        return Rgb();
    }
    Rgb beyond;
    for (std::size_t i = size_ - 1; i-- > 0;) {
        const PGLPathSegmentData &segment = segments_[i], &next = segments_[i + 1];
        const float undone = divides_by_survival ? 1.0f : segment.russianRouletteSurvivalProbability;
        beyond = to_colour(segment.transmittanceWeight) *
                 (to_colour(next.scatteredContribution) +
                  to_colour(next.directContribution) * (next.miWeight * undone) + scattered_on(next) * beyond);
    }
    const PGLPathSegmentData& first = segments_[0];
    return to_colour(first.directContribution) * first.miWeight + to_colour(first.scatteredContribution) +
           scattered_on(first) * beyond;
}

bool is_usable(const PGLPathSegmentData& s) {
    const auto is_weight = [](const pgl_vec3f& v) {
        return v.x >= 0 && v.y >= 0 && v.z >= 0 && std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    };
    const auto is_number = [](float f) { return f >= 0 && std::isfinite(f); };
    return is_finite(to_vector(s.position)) && is_finite(to_vector(s.directionIn)) &&
           is_finite(to_vector(s.directionOut)) && is_finite(to_vector(s.normal)) && is_number(s.pdfDirectionIn) &&
           is_weight(s.scatteringWeight) && is_weight(s.transmittanceWeight) && is_weight(s.directContribution) &&
           is_weight(s.scatteredContribution) && is_number(s.miWeight) && s.miWeight <= 1 &&
           is_number(s.russianRouletteSurvivalProbability) && s.russianRouletteSurvivalProbability <= 1 && s.eta > 0 &&
           std::isfinite(s.eta) && std::isfinite(s.roughness);
}

}  // namespace wend::openpgl
