// Walks in a plane-parallel medium whose extinction or albedo differs between channels.
#pragma once

#include <wend/lab/walk.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace wend {

/// One-sample multiple importance sampling over channels, each with a sampler made for it: a walk follows one channel's
/// sampler, chosen at random, and is weighted by the balance heuristic over whole walks, that is by the mean of the
/// densities that all samplers would have given it. No channel can receive more than what its own sampler would have
/// weighted, over its share.
template <class Sampler>
class ChromaticPlanarWalker {
public:
    static constexpr std::size_t channels = 3;
    using Values = std::array<double, channels>;

    /// Lengths are scaled by `extinction`: each channel's slab and sampler are in its own mean free paths. Nothing is
    /// owned.
    struct Channel {
        double albedo;
        double extinction;
        double share;  ///< probability that a walk follows this channel; all positive, sum 1
        const PlanarSlab* slab;
        const Sampler* sampler;
    };
    ChromaticPlanarWalker(const std::array<Channel, channels>& parts, PlanarSurvival survival)
        : channels_(parts), survival_(survival) {}

    Values walk(Pcg32& random, std::uint64_t& collisions) const {
        const double u = random.uniform_double();
        const std::size_t guide = u < channels_[0].share ? 0 : (u < channels_[0].share + channels_[1].share ? 1 : 2);
        const PlanarEntry::Outcome entry = channels_[guide].sampler->entry.sample(random);
        State now;
        for (std::size_t c = 0; c < channels; ++c) {
            now.value[c] = 1;
            now.density[c] = channels_[c].sampler->entry.density_ratio(entry.outside);
            channels_[c].sampler->first_flight.at(0, now.site[c]);
        }
        Values result = estimate(now);
        for (double& value : result) {
            value *= entry.reflected * entry.density_ratio;
        }
        now.scale(entry.weight * entry.density_ratio);
        now.cosine = entry.cosine;
        bool first = true;
        std::uint64_t own_collisions = 0;
        while (now.alive()) {
            const PlanarFlight outcome = fly(now, guide, first, random);
            first = false;
            if (!outcome.scatters) {
                if (!arrive(now, guide, random, result)) {
                    break;
                }
                continue;
            }
            ++own_collisions;
            const PlanarDirection direction =
                channels_[guide].sampler->direction.sample(now.site[guide].depth, now.cosine, random);
            for (std::size_t c = 0; c < channels; ++c) {
                now.density[c] *= c == guide ? direction.density_ratio
                                             : channels_[c].sampler->direction.density_ratio(
                                                   now.site[c].depth, now.cosine, direction.cosine);
            }
            now.cosine = direction.cosine;
            now.normalize();
            const Values values = estimate(now);
            double weight = *std::max_element(values.begin(), values.end());
            const double before = weight;
            if (survival_.copies(weight, now.site[guide].depth, now.cosine, own_collisions, random) == 0) {
                break;
            }
            if (weight != before) {
                now.scale(weight / before);
            }
        }
        collisions += own_collisions;
        return result;
    }

private:
    struct State {
        std::array<typename Sampler::Flight::Site, channels> site;
        Values value, density;  // of the path so far, for each channel and under each channel's sampler
        double cosine = 1;

        void scale(double factor) {
            for (double& v : value) {
                v *= factor;
            }
        }
        // Only the ratios matter; none may leave the range of numbers.
        void normalize() {
            const double largest = *std::max_element(density.begin(), density.end());
            for (std::size_t c = 0; c < channels; ++c) {
                density[c] /= largest;
                value[c] /= largest;
            }
        }
        bool alive() const { return *std::max_element(value.begin(), value.end()) > 0; }
    };

    Values estimate(const State& now) const {
        double mean = 0;
        for (std::size_t c = 0; c < channels; ++c) {
            mean += channels_[c].share * now.density[c];
        }
        Values e;
        for (std::size_t c = 0; c < channels; ++c) {
            e[c] = now.value[c] / mean;
        }
        return e;
    }

    PlanarFlight fly(State& now, std::size_t guide, bool first, Pcg32& random) const {
        const auto flight = [&](std::size_t c) -> const typename Sampler::Flight& {
            return first ? channels_[c].sampler->first_flight : channels_[c].sampler->flight;
        };
        typename Sampler::Flight::Site to;
        const PlanarFlight outcome = flight(guide).sample(now.site[guide], now.cosine, random, to);
        const double length = outcome.length / channels_[guide].extinction;
        const double depth = outcome.scatters ? to.depth / channels_[guide].extinction : 0;
        // Transmittances relative to that of the channel that the walk follows.
        for (std::size_t c = 0; c < channels; ++c) {
            const Channel& channel = channels_[c];
            PlanarFlight own = outcome;
            own.length = length * channel.extinction;
            double transmittance = std::exp(outcome.length - own.length);
            if (c == guide) {
                now.density[c] *= own.density_ratio;
                if (outcome.scatters) {
                    std::swap(now.site[c], to);
                }
            } else {
                typename Sampler::Flight::Site own_to;
                if (outcome.scatters) {
                    flight(c).at(std::min(depth * channel.extinction, channel.slab->thickness), own_to);
                }
                now.density[c] *= transmittance * flight(c).density_ratio(now.site[c], now.cosine, own, own_to);
                if (outcome.scatters) {
                    std::swap(now.site[c], own_to);
                }
            }
            now.value[c] *= transmittance;
            if (outcome.scatters) {
                now.density[c] *= channel.extinction;
                now.value[c] *= channel.extinction * channel.albedo;
            }
        }
        now.normalize();
        return outcome;
    }

    /// At a boundary; false if the walk ends there.
    bool arrive(State& now, std::size_t guide, Pcg32& random, Values& result) const {
        const bool at_far = now.cosine > 0;
        const double cosine = std::abs(now.cosine);
        const auto boundary_of = [&](std::size_t c) -> const PlanarBoundary& {
            return at_far ? channels_[c].slab->far : channels_[c].slab->near;
        };
        const PlanarBoundary& boundary = boundary_of(guide);
        const PlanarCrossing crossing =
            std::visit([&](const auto& decision) { return decision.sample(at_far, cosine, random); },
                       channels_[guide].sampler->crossing);
        if (boundary.rough) {
            now.scale(crossing.weight);
        } else {
            const double reflectance = boundary.reflectance(cosine);
            now.scale(crossing.leaves ? 1 - reflectance : reflectance);
            for (std::size_t c = 0; c < channels; ++c) {
                const double leaving =
                    std::visit([&](const auto& decision) { return decision.leaving_probability(at_far, cosine); },
                               channels_[c].sampler->crossing);
                now.density[c] *= crossing.leaves ? leaving : 1 - leaving;
            }
        }
        if (!now.alive()) {
            return false;
        }
        now.normalize();
        if (crossing.leaves) {
            const Values values = estimate(now);
            for (std::size_t c = 0; c < channels; ++c) {
                result[c] += boundary.illumination ? values[c] * boundary.illumination(crossing.cosine) : 0;
            }
            return false;
        }
        for (std::size_t c = 0; c < channels; ++c) {
            channels_[c].sampler->flight.at(at_far ? channels_[c].slab->thickness : 0, now.site[c]);
        }
        now.cosine = at_far ? -crossing.cosine : crossing.cosine;
        return true;
    }

    std::array<Channel, channels> channels_;
    PlanarSurvival survival_;
};

}  // namespace wend
