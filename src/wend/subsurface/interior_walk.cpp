#include <wend/subsurface/interior_walk.h>

#include <wend/core/contracts.h>
#include <wend/medium/transmittance.h>
#include <wend/numeric/fast_math.h>
#include <wend/sampling/discrete.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace wend {
namespace {

/// Below this share of what it was expected to bring a walk is up for roulette.
constexpr float least_expectation = 0.1f;
/// No walk of so little throughput is still where a guide that is right would have it.
constexpr float least_throughput = 1e-3f;
/// How often a lamp is connected to at the boundary, over the part of the scattered light that comes straight from it.
constexpr float connections_to_lamps = 32;

float extinction_of(const InteriorGuide& guide, int channel) {
    return guide.medium.absorption[channel] + guide.medium.scattering[channel];
}

}  // namespace

void InteriorWalk::enter(const InteriorGuide& guide, const Rgb& channels, float defensive_fraction) {
    guide_ = &guide;
    survived_ = 1;
    groups_ = defensive_fraction < 1 ? 2 : 1;
    is_lit_ = groups_ > 1 && guide.heads_for_emitters;
    share_[0] = defensive_fraction;
    share_[1] = 1 - defensive_fraction;
    const int count = guide.channels();
    for (int group = 0; group < groups_; ++group) {
        for (int c = 0; c < count; ++c) {
            posterior_[static_cast<std::size_t>(group * count + c)] = share_[group] * (count == 1 ? 1.0f : channels[c]);
        }
    }
}

void InteriorWalk::aim(const Vec3& normal, float steepness) {
    normal_ = normal;
    level_ = guide_->level(steepness);
}

void InteriorWalk::aim(const EmitterView& view) {
    lamps_ = EmitterGuide(view, guide_->medium.extinction(), channels());
}

float InteriorWalk::scattered(int channel, const EmitterGuide::PerEmitter& phases, const Vec3& before) const {
    float sum = diffuse(channel) * mode(channel).source(dot(before, normal_));
    for (std::size_t j = 0; j < lamps_.size(); ++j) {
        sum += lamps_.fluence(channel, j) * phases[j];
    }
    return sum;
}

void InteriorWalk::head(const Vec3& w) {
    has_turned_ = false;
    head(w, is_lit_ ? lamps_.densities(w) : EmitterGuide::PerEmitter{});
}

void InteriorWalk::head(const Vec3& w, const EmitterGuide::PerEmitter& densities) {
    for (int c = 0; c < channels(); ++c) {
        rate_[static_cast<std::size_t>(c)] = extinction_of(*guide_, c);
    }
    for_modes([&](std::size_t i, int c) { rate_[i] = extinction_of(*guide_, c) * mode(c).rate(dot(w, normal_)); });
    if (is_lit_) {
        const float mu = dot(w, normal_);
        for (int c = 0; c < channels(); ++c) {
            float direct = 0;
            for (std::size_t j = 0; j < lamps_.size(); ++j) {
                direct += lamps_.fluence(c, j) * densities[j];
            }
            direct_[static_cast<std::size_t>(c)] = direct / (direct + diffuse(c) * mode(c).radiance(mu));
        }
    }
}

InteriorWalk::Directions::Directions(const InteriorWalk& walk, const Vec3& before, Pcg32& random)
    : walk_(walk), before_(before), random_(random) {
    relative_ = walk.posterior_;
    const EmitterGuide::PerEmitter phases =
        walk.is_lit_ ? walk.lamps_.phases(walk.guide_->medium.phase, before) : EmitterGuide::PerEmitter{};
    walk.for_modes([&](std::size_t i, int c) {
        if (walk.is_lit_) {
            const float scattered = walk.scattered(c, phases, before);
            for (std::size_t j = 0; j < walk.lamps_.size(); ++j) {
                const float share = walk.lamps_.fluence(c, j) * phases[j] / scattered;
                shares_[static_cast<std::size_t>(c)][j] = share;
                lamps_[j] += relative_[i] * share;
            }
            relative_[i] *= walk.diffuse(c) / scattered;
        } else {
            relative_[i] /= walk.mode(c).source(dot(before, walk.normal_));
        }
    });
    if (walk.is_lit_ && walk.guide_->connects_at_boundary) {
        const float often = connections_to_lamps / static_cast<float>(walk.channels());
        float sum = 0;
        for (std::size_t j = 0; j < connected_.size(); ++j) {
            connected_[j] = often * (shares_[0][j] + shares_[1][j] + shares_[2][j]);
            sum += connected_[j];
        }
        for (float& probability : connected_) {
            probability /= std::max(1.0f, sum);
        }
    }
}

std::optional<Vec3> InteriorWalk::Directions::sample_emitters() const {
    if (!walk_.guide_->connects_at_boundary) {
        return std::nullopt;
    }
    float u = random_.uniform();
    for (std::size_t j = 0; j < connected_.size(); ++j) {
        if (u < connected_[j]) {
            return walk_.lamps_.lobe(j).sample(random_.uniform2());
        }
        u -= connected_[j];
    }
    return std::nullopt;
}

float InteriorWalk::Directions::emitter_density(const Vec3& w) const {
    if (!walk_.is_lit_ || !walk_.guide_->connects_at_boundary) {
        return 0;
    }
    const EmitterGuide::PerEmitter lobes = walk_.lamps_.densities(w);
    return std::inner_product(lobes.begin(), lobes.end(), connected_.begin(), 0.0f);
}

float InteriorWalk::Directions::density(const Vec3& w) const {
    float density_ratio = 0;
    for (int c = 0; c < walk_.channels(); ++c) {
        density_ratio += relative_[static_cast<std::size_t>(c)];
    }
    walk_.for_modes(
        [&](std::size_t i, int c) { density_ratio += relative_[i] * walk_.mode(c).radiance(dot(w, walk_.normal_)); });
    float density = density_ratio * walk_.guide_->medium.phase.evaluate(dot(before_, w));
    if (walk_.is_lit_) {
        const EmitterGuide::PerEmitter lobes = walk_.lamps_.densities(w);
        for (std::size_t j = 0; j < walk_.lamps_.size(); ++j) {
            density += lamps_[j] * lobes[j];
        }
    }
    return density;
}

std::optional<DirectionSample> InteriorWalk::Directions::sample(float u, const Vec2& u2) const {
    const PhaseFunction& phase = walk_.guide_->medium.phase;
    const std::size_t technique = walk_.choose(u);
    const auto channels = static_cast<std::size_t>(walk_.channels());
    const bool is_guided = technique >= channels;
    const std::size_t channel = technique % channels;
    Vec3 w;
    if (!is_guided) {
        w = phase.sample(before_, u2);
    } else {
        std::size_t lamp = 0;
        const std::size_t lamps = walk_.is_lit_ ? walk_.lamps_.size() : 0;
        for (; lamp < lamps && !(u < shares_[channel][lamp]); ++lamp) {
            u -= shares_[channel][lamp];
        }
        w = lamp < lamps ? walk_.lamps_.lobe(lamp).sample(u2)
                         : walk_.mode(static_cast<int>(channel)).sample(phase, before_, walk_.normal_, random_);
    }
    DirectionSample s;
    s.direction = w;
    s.value = Rgb(phase.evaluate(dot(before_, w)));
    s.density = density(w);
    WEND_ENSURE(s.density > 0);
    return s;
}

void InteriorWalk::turn(const Directions& directions, const Vec3& w) {
    const EmitterGuide::PerEmitter densities = is_lit_ ? lamps_.densities(w) : EmitterGuide::PerEmitter{};
    head(w, densities);
    // All densities over the phase function.
    const float phase = guide_->medium.phase.evaluate(dot(directions.before_, w));
    float total = 0;
    for (int c = 0; c < channels(); ++c) {
        total += posterior_[static_cast<std::size_t>(c)];
    }
    for_modes([&](std::size_t i, int c) {
        float towards = directions.relative_[i] * mode(c).radiance(dot(w, normal_));
        if (is_lit_) {
            const EmitterGuide::PerEmitter& shares = directions.shares_[static_cast<std::size_t>(c)];
            towards +=
                posterior_[i] / phase * std::inner_product(shares.begin(), shares.end(), densities.begin(), 0.0f);
        }
        posterior_[i] = towards;
        total += towards;
    });
    normalize(total);
    has_turned_ = true;
}

std::size_t InteriorWalk::choose(float& u) const {
    const std::span<const float> probabilities(posterior_.data(), techniques());
    return static_cast<std::size_t>(select(probabilities, 1, u));
}

void InteriorWalk::normalize(float total) {
    // What never happens may still be asked for, by connections: the inverse of its probability must not overflow.
    const float scale = total >= std::numeric_limits<float>::min() ? 1 / total : 0.0f;
    for (std::size_t i = 0; i < techniques(); ++i) {
        posterior_[i] *= scale;
    }
    WEND_ENSURE(scale == 0 ||
                std::abs(std::accumulate(posterior_.begin(),
                                         posterior_.begin() + static_cast<std::ptrdiff_t>(techniques()), 0.0) -
                         1) < 1e-4);
}

float InteriorWalk::draw_distance(float u) const {
    const std::size_t technique = choose(u);
    const auto count = static_cast<std::size_t>(channels());
    const float direct = is_lit_ && technique >= count ? direct_[technique - count] : 0.0f;
    return rate_[technique] > 0 && u >= direct ? to_exponential((u - direct) / (1 - direct), rate_[technique])
                                               : infinity;
}

InteriorFlight InteriorWalk::fly(float length, float drawn) {
    InteriorFlight result;
    Flight& flight = result.flight;
    flight.scatters = drawn < length;
    if (!flight.scatters) {
        flight.distance = length;
        result.pass_probability = pass(length);
        flight.weight = result.pass_probability >= std::numeric_limits<float>::min()
                            ? transmittance(guide_->medium, length) * (1 / result.pass_probability)
                            : Rgb(0.0f);
        return result;
    }
    flight.distance = drawn;
    const float density = weigh_flight(drawn, true);
    flight.weight = density >= std::numeric_limits<float>::min()
                        ? guide_->medium.scattering * transmittance(guide_->medium, drawn) * (1 / density)
                        : Rgb(0.0f);
    return result;
}

float InteriorWalk::pass(float length) {
    return weigh_flight(length, false);
}

float InteriorWalk::weigh_flight(float length, bool collides) {
    const std::size_t count = techniques();
    Values passed;
    for (std::size_t i = 0; i < count; ++i) {
        passed[i] = fast_exp(-rate_[i] * length) * (collides ? rate_[i] : 1.0f);
    }
    if (is_lit_) {
        for (int c = 0; c < channels(); ++c) {
            const float direct = direct_[static_cast<std::size_t>(c)];
            float& p = passed[guided(c)];
            p = (1 - direct) * p + (collides ? 0.0f : direct);
        }
    }
    float total = 0;
    for (std::size_t i = 0; i < count; ++i) {
        posterior_[i] *= passed[i];
        total += posterior_[i];
    }
    normalize(total);
    return total;
}

float InteriorWalk::relative_density(int group) const {
    float sum = 0;
    for (int c = 0; c < channels(); ++c) {
        sum += posterior_[static_cast<std::size_t>(group * channels() + c)];
    }
    return sum / share_[group];
}

InteriorGuide::PerTechnique InteriorWalk::relative_densities() const {
    return {relative_density(0), is_guided() ? relative_density(1) : 0.0f};
}

float InteriorWalk::survival(float throughput) {
    // Under a guide that is right, density times what is to be expected is the same everywhere: so its density over
    // that of the mixture is what the walk may yet bring, over what it might have brought when it entered.
    float expected = is_guided() ? relative_density(1) : 0.0f;
    expected = std::min(expected / survived_, throughput / least_throughput);
    if (expected >= least_expectation) {
        return 1;
    }
    const float classical = relative_density(0);
    const float survival = std::min(1.0f, std::max(expected, classical > 0 ? throughput / classical : 1.0f));
    survived_ *= survival;
    return survival;
}

}  // namespace wend
