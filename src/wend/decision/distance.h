// Decision 1: scatter in the medium, and where, or reach the end of the segment.
#pragma once

#include <wend/core/random.h>
#include <wend/medium/medium.h>

#include <concepts>

namespace wend {

/// The outcome of a flight through a medium. The walk multiplies its throughput by `weight`: for a collision
/// transmittance times scattering coefficient over density, for the end of the segment transmittance over probability.
struct Flight {
    bool scatters = false;
    float distance = 0;  ///< of the collision; the segment's length if it does not scatter
    Rgb weight;
    Rgb emitted;  ///< radiance picked up from an emissive medium on the way, before `weight`
};

/// A decision about flights: draws one, and tells the probability, under each colour channel, of flying through a
/// segment without a collision. Where that cannot be told (null-collision tracking) it is 1: it only enters multiple
/// importance sampling weights, where any function of the path will do.
template <class D>
concept DistanceDecision = requires(const D& d, const Medium& m, const Ray& ray, float length, const Rgb& throughput,
                                    float u, Pcg32& random) {
    { d.sample(m, ray, length, throughput, u, random) } -> std::same_as<Flight>;
    { d.pass_probability(m, ray, length) } -> std::same_as<Rgb>;
};

/// Classical sampling: in proportion to transmittance times extinction, absorption by weight. Homogeneous media by
/// inversion; grids by delta tracking against the local majorant.
class ClassicalDistance {
public:
    /// `throughput` is that of the walk so far and chooses among colour channels; `u` is uniform in [0,1).
    Flight sample(const Medium& medium, const Ray& ray, float length, const Rgb& throughput, float u,
                  Pcg32& random) const;
    Rgb pass_probability(const Medium& medium, const Ray& ray, float length) const;
};

static_assert(DistanceDecision<ClassicalDistance>);

}  // namespace wend
