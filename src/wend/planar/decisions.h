// Decisions of a walk in a plane-parallel medium, in depth and cosine: the vocabulary that all of them share.
#pragma once

#include <wend/core/random.h>

#include <concepts>

namespace wend {

/// Outcome of a flight towards a boundary. `density_ratio` is its density over that of a classical flight, exp(-s): for
/// a collision per mean free path, for reaching the boundary as a ratio of probabilities. The walk divides its weight
/// by it.
struct PlanarFlight {
    bool scatters = false;
    double length = 0;  ///< flown, in mean free paths
    double density_ratio = 1;
};

/// A drawn cosine; `density_ratio` is its density over the phase function's, averaged over azimuth.
struct PlanarDirection {
    double cosine = 1;
    double density_ratio = 1;
};

/// Draws flights. A Site is a depth with whatever the decision has found out about it; at() makes one. sample() puts
/// the place of a collision into `to`; density_ratio() tells the same ratio for any outcome, where `to` is the place of
/// the collision and not looked at for a flight that reaches the boundary.
template <class D>
concept PlanarFlightDecision = requires(const D& d, typename D::Site& to, const typename D::Site& from, double mu,
                                        const PlanarFlight& outcome, Pcg32& random) {
    { d.at(1.0, to) } -> std::same_as<void>;
    { from.depth } -> std::convertible_to<double>;
    { d.sample(from, mu, random, to) } -> std::same_as<PlanarFlight>;
    { d.density_ratio(from, mu, outcome, to) } -> std::same_as<double>;
};

/// Draws the cosine after a collision at a depth, given the one before; density_ratio() tells the ratio for any.
template <class D>
concept PlanarDirectionDecision = requires(const D& d, double depth, double before, double after, Pcg32& random) {
    { d.sample(depth, before, random) } -> std::same_as<PlanarDirection>;
    { d.density_ratio(depth, before, after) } -> std::same_as<double>;
};

}  // namespace wend
