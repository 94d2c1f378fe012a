// Planar decisions that know one direction to head for: classical sampling, path stretching, Dwivedi's walk.
#pragma once

#include <wend/planar/decisions.h>

namespace wend {

/// The boundary that a walk should reach.
enum class Heading { near, far };

/// Flights with their rate stretched to 1 - b m, m the cosine towards the heading: the exponential transform of
/// clark1966. With b = 0 a flight is classical; with b = 1/nu0 it is that of dwivedi1982.
class PathStretching {
public:
    struct Site {
        double depth = 0;
    };

    /// `thickness` > 0, may be infinite; `stretch` in [0,1].
    PathStretching(double thickness, Heading heading, double stretch)
        : thickness_(thickness), stretch_(heading == Heading::far ? stretch : -stretch) {}

    void at(double depth, Site& site) const { site.depth = depth; }
    PlanarFlight sample(const Site& from, double mu, Pcg32& random, Site& to) const;
    double density_ratio(const Site& from, double mu, const PlanarFlight& outcome, const Site& to) const;

private:
    double thickness_;
    double stretch_;  // signed: positive heads deeper
};

/// Cosines by the phase function alone, Henyey and Greenstein's with mean cosine g.
class PhaseDirection {
public:
    explicit PhaseDirection(double g) : g_(g) {}

    PlanarDirection sample(double depth, double before, Pcg32& random) const;
    double density_ratio(double /*depth*/, double /*before*/, double /*after*/) const { return 1; }

private:
    double g_;
};

/// Cosines of isotropic scattering in proportion to Case's discrete mode alone, 1 / (nu - m), m the cosine towards
/// the heading (dwivedi1982; krivanek2014).
class DwivediDirection {
public:
    /// `gap` is 1 - 1/nu, in (0,1]; below 1e-9, where all walks would go straight ahead, it is taken as that; 1 is
    /// isotropic.
    DwivediDirection(double gap, Heading heading);

    PlanarDirection sample(double depth, double before, Pcg32& random) const;
    double density_ratio(double depth, double before, double after) const;

private:
    double gap_;
    double k_;          // 1/nu
    double logarithm_;  // ln((1 + k) / (1 - k))
    double sign_;
};

static_assert(PlanarFlightDecision<PathStretching>);
static_assert(PlanarDirectionDecision<PhaseDirection>);
static_assert(PlanarDirectionDecision<DwivediDirection>);

}  // namespace wend
