// Walks in a plane-parallel medium: the loop that asks the planar decisions and multiplies weights.
#pragma once

#include <wend/lab/entry.h>
#include <wend/lab/roulette_splitting.h>
#include <wend/medium/averaged_phase.h>
#include <wend/planar/crossing.h>
#include <wend/planar/decisions.h>

#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

namespace wend {

using PlanarCrossingDecision = std::variant<ClassicalCrossing, GuidedCrossing>;

/// Watches walks. The default sees nothing and costs nothing.
struct UnobservedWalk {
    void enters(double /*cosine*/) {}
    /// A collision, after the direction was drawn.
    void collides(double /*depth*/, double /*length*/, double /*before*/, double /*after*/) {}
    /// A collision that ends the walk.
    void is_absorbed(double /*depth*/, double /*length*/, double /*cosine*/) {}
    /// The walk reaches a boundary at a depth.
    void arrives(double /*depth*/, double /*length*/, double /*cosine*/) {}
};

/// A sampler: one decision of each kind.
template <PlanarFlightDecision F, PlanarDirectionDecision D>
struct PlanarSampler {
    using Flight = F;
    PlanarEntry entry;
    Flight first_flight, flight;
    D direction;
    PlanarCrossingDecision crossing;
};

/// A grey walk. `Capture` says what absorption does: it ends the walk or lowers its weight.
template <class Capture, class Sampler>
class PlanarWalker {
    using Flight = typename Sampler::Flight;

public:
    /// Nothing is owned.
    struct Parts {
        double albedo;
        const PlanarSlab* slab;
        const Sampler* sampler;
        PlanarSurvival survival;
    };
    explicit PlanarWalker(const Parts& parts) : parts_(parts) {}

    /// One walk, with all the branches it may be split into: its value, and its collisions added to `collisions`.
    template <class Observer>
    double walk(Pcg32& random, std::uint64_t& collisions, Observer& observer) const {
        const PlanarEntry::Outcome entry = parts_.sampler->entry.sample(random);
        double value = entry.reflected;
        if (!(entry.weight > 0)) {
            return value;
        }
        observer.enters(entry.cosine);
        std::vector<Branch> pending;
        Branch now;
        parts_.sampler->first_flight.at(0, now.site);
        now.cosine = entry.cosine;
        now.weight = entry.weight;
        const Flight* flight = &parts_.sampler->first_flight;
        typename Flight::Site next;
        for (;;) {
            const PlanarFlight outcome = flight->sample(now.site, now.cosine, random, next);
            flight = &parts_.sampler->flight;
            now.weight /= outcome.density_ratio;
            const bool goes_on = outcome.scatters
                                     ? scatter(now, next, outcome.length, random, pending, collisions, observer)
                                     : arrive(now, outcome.length, random, value, observer);
            if (!goes_on) {
                if (pending.empty()) {
                    return value;
                }
                now = pending.back();
                pending.pop_back();
            }
        }
    }

private:
    struct Branch {
        typename Flight::Site site;
        double cosine = 1;
        double weight = 1;
        std::uint64_t collisions = 0;
    };

    template <class Observer>
    bool scatter(Branch& now, typename Flight::Site& next, double length, Pcg32& random, std::vector<Branch>& pending,
                 std::uint64_t& collisions, Observer& observer) const {
        ++collisions;
        ++now.collisions;
        std::swap(now.site, next);
        if (!Capture::survive(parts_.albedo, now.weight, random)) {
            observer.is_absorbed(now.site.depth, length, now.cosine);
            return false;
        }
        const PlanarDirection direction = parts_.sampler->direction.sample(now.site.depth, now.cosine, random);
        now.weight /= direction.density_ratio;
        observer.collides(now.site.depth, length, now.cosine, direction.cosine);
        now.cosine = direction.cosine;
        const int copies = parts_.survival.copies(now.weight, now.site.depth, now.cosine, now.collisions, random);
        for (int i = 1; i < copies; ++i) {
            pending.push_back(now);
        }
        return copies > 0;
    }

    template <class Observer>
    bool arrive(Branch& now, double length, Pcg32& random, double& value, Observer& observer) const {
        const bool at_far = now.cosine > 0;
        const double cosine = at_far ? now.cosine : -now.cosine;
        const double depth = at_far ? parts_.slab->thickness : 0;
        observer.arrives(depth, length, now.cosine);
        const PlanarCrossing crossing = std::visit(
            [&](const auto& decision) { return decision.sample(at_far, cosine, random); }, parts_.sampler->crossing);
        now.weight *= crossing.weight;
        if (!(now.weight > 0)) {
            return false;
        }
        if (crossing.leaves) {
            const PlanarBoundary& boundary = at_far ? parts_.slab->far : parts_.slab->near;
            value += boundary.illumination ? now.weight * boundary.illumination(crossing.cosine) : 0;
            return false;
        }
        parts_.sampler->flight.at(depth, now.site);
        now.cosine = at_far ? -crossing.cosine : crossing.cosine;
        return true;
    }

    Parts parts_;
};

}  // namespace wend
