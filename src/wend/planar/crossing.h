// The planar decision at a boundary reached from inside: leave or be reflected, and at what cosine.
#pragma once

#include <wend/core/random.h>
#include <wend/planar/adjoint.h>

#include <array>
#include <vector>

namespace wend {

/// Outcome at a boundary. The walk multiplies its weight by `weight`, probability by physics over the one drawn with; a
/// weight of 0 ends it.
struct PlanarCrossing {
    bool leaves = true;
    double cosine = 1;  ///< against the normal: outside if it leaves, inside if it is reflected
    double weight = 1;
};

/// By reflectance: no more is known.
class ClassicalCrossing {
public:
    /// The slab is not owned.
    explicit ClassicalCrossing(const PlanarSlab& slab) : slab_(&slab) {}

    PlanarCrossing sample(bool at_far, double cosine, Pcg32& random) const;

    /// Probability of leaving a smooth boundary.
    double leaving_probability(bool at_far, double cosine) const;

private:
    const PlanarSlab* slab_;
};

/// By what either outcome brings: reflectance times radiance inside against transmittance times illumination outside. A
/// rough boundary has no closed form for that: of several microfacets, and both ways to leave each, one is chosen in
/// proportion to what it would bring, and the weight is the mean of all (talbot2005).
class GuidedCrossing {
public:
    /// The adjoint is not owned.
    explicit GuidedCrossing(const PlanarAdjoint& adjoint);

    PlanarCrossing sample(bool at_far, double cosine, Pcg32& random) const;

    /// Probability of leaving a smooth boundary.
    double leaving_probability(bool at_far, double cosine) const;

private:
    PlanarCrossing sample_rough(bool at_far, double cosine, Pcg32& random) const;
    double radiance_inward(bool at_far, double cosine) const;

    const PlanarAdjoint* adjoint_;
    // Radiance from inside at either boundary, at equal steps of the cosine: for rough boundaries, where it only weighs
    // candidates against each other.
    std::array<std::vector<double>, 2> inward_;
};

}  // namespace wend
