// Planar decisions that follow an adjoint of exponential modes, its boundaries included.
#pragma once

#include <wend/planar/adjoint.h>
#include <wend/planar/decisions.h>
#include <wend/planar/path_stretching.h>
#include <wend/sampling/quantile_table.h>

#include <functional>
#include <vector>

namespace wend {

/// Flights in proportion to transmittance times the adjoint's source, and the boundary in proportion to transmittance
/// times the value of arriving there: the density ratio is source, or arrival, over radiance, and with an exact adjoint
/// nothing is left to chance (docs/theory/planar.md). A term is chosen by its integral, a distance drawn from its
/// truncated exponential, and accepted with the part that negative terms leave of the positive ones.
class ModalFlight {
public:
    using Site = PlanarAdjoint::Site;

    /// The adjoint is not owned; PlanarAdjoint::keep_positive() has been called.
    explicit ModalFlight(const PlanarAdjoint& adjoint) : adjoint_(&adjoint) {}

    void at(double depth, Site& site) const { adjoint_->at(depth, site); }
    PlanarFlight sample(const Site& from, double mu, Pcg32& random, Site& to) const;
    double density_ratio(const Site& from, double mu, const PlanarFlight& outcome, const Site& to) const;

private:
    struct Stop {
        double depth, length;
    };
    Stop draw(const PlanarAdjoint::Ray& ray, double depth, Pcg32& random) const;

    const PlanarAdjoint* adjoint_;
};

/// Cosines in proportion to the azimuthally averaged phase function (Henyey and Greenstein's) times a radiance, from
/// tables of quantile functions over depth and, unless scattering is isotropic, over the cosine before.
class ModalDirection {
public:
    /// Rows of the tables: by depth, and by the cosine before; one of these where scattering is isotropic.
    struct Resolution {
        int depths, cosines;
    };

    /// For the radiance of an adjoint.
    ModalDirection(const PlanarAdjoint& adjoint, double g);
    ModalDirection(const PlanarAdjoint& adjoint, double g, const Resolution& rows);

    /// For a radiance by cosine that is the same at every depth.
    ModalDirection(const std::function<double(double)>& radiance, double g);

    PlanarDirection sample(double depth, double before, Pcg32& random) const;
    double density_ratio(double depth, double before, double after) const;

private:
    ModalDirection(double thickness, const Resolution& rows, std::vector<double> breaks, double g);
    template <class Radiance>
    void fill(const Radiance& radiance);
    QuantileTable::Blend blend(double depth, double before) const;
    double position(double depth) const;
    double depth_at(double position) const;

    double g_;
    double thickness_;
    int depth_rows_;
    int cosine_rows_;
    QuantileTable table_;
};

static_assert(PlanarFlightDecision<ModalFlight>);
static_assert(PlanarDirectionDecision<ModalDirection>);

}  // namespace wend
