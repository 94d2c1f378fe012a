// A rough refractive boundary seen from inside a plane-parallel medium: cosines only, averaged over azimuth.
#pragma once

#include <wend/core/vector.h>

#include <functional>

namespace wend {

/// A dielectric boundary of GGX microfacets (walter2007), single scattering: what is masked is lost. Cosines are taken
/// against the normal on their own side and positive. Radiance is carried in units of the squared index, so that the
/// factors of refraction cancel.
class RoughBoundary {
public:
    /// `ior`: inside over outside, > 1; `alpha` in [0.02, 1].
    RoughBoundary(double ior, double alpha) : ior_(ior), alpha_(alpha) {}

    /// A microfacet that a walk meets from one side, drawn among the visible ones, with both of its continuations. A
    /// weight is the probability by Fresnel's equations times what is not masked on the way out, 0 where there is none.
    struct Encounter {
        double reflected_cosine = 0, reflected_weight = 0;
        double transmitted_cosine = 0, transmitted_weight = 0;
    };
    Encounter encounter_from_inside(double cosine, const Vec2& u) const { return encounter(cosine, u, false); }
    Encounter encounter_from_outside(double cosine, const Vec2& u) const { return encounter(cosine, u, true); }

    /// Mean of transmitted weight times a function of the transmitted cosine, by a fixed quadrature over microfacets.
    double transmitted_from_inside(double cosine, const std::function<double(double)>& value) const {
        return mean_transmitted(cosine, value, false);
    }
    double transmitted_from_outside(double cosine, const std::function<double(double)>& value) const {
        return mean_transmitted(cosine, value, true);
    }
    /// Mean of reflected weight times a function of the reflected cosine.
    double reflected_from_outside(double cosine, const std::function<double(double)>& value) const;

    /// Density, by the new cosine, of being reflected from inside cosine `from` to inside cosine `to`; its integral is
    /// the probability of being reflected.
    double reflection(double from, double to) const;

private:
    Encounter encounter(double cosine, const Vec2& u, bool outside) const;
    double mean_transmitted(double cosine, const std::function<double(double)>& value, bool outside) const;

    double ior_;
    double alpha_;
};

}  // namespace wend
