// How planar walks enter the medium.
#pragma once

#include <wend/core/random.h>
#include <wend/planar/adjoint.h>
#include <wend/sampling/quantile_table.h>

#include <optional>

namespace wend {

/// The camera's ray crosses the near boundary from outside, at one cosine or at cosines of Lambertian distribution.
/// What the boundary reflects is scored at once, in the mean.
class PlanarEntry {
public:
    /// At one cosine outside, in (0,1].
    PlanarEntry(const PlanarSlab& slab, double cosine);
    /// Lambertian: the density of the cosine outside is twice the cosine; with an adjoint, in proportion to that times
    /// the value of entering. Neither is owned.
    PlanarEntry(const PlanarSlab& slab, const PlanarAdjoint* adjoint);

    struct Outcome {
        double outside = 1;    ///< cosine outside
        double reflected = 0;  ///< what the boundary reflects, weighted
        double cosine = 1;     ///< inside
        double weight = 1;
        double density_ratio = 1;  ///< density of the outside cosine over that of the illumination
    };
    Outcome sample(Pcg32& random) const;
    /// Density of a cosine outside over that of the illumination.
    double density_ratio(double outside) const;

    /// Mean of the weight times the adjoint's radiance inside: what walks are expected to bring, but for what is
    /// reflected at entry.
    double expected(const PlanarAdjoint& adjoint) const;
    /// The mean of what is reflected at entry.
    double expected_reflection() const;

private:
    Outcome enter(double outside, Pcg32& random) const;
    double value(const PlanarAdjoint& adjoint, double outside) const;
    double reflection(double outside) const;

    const PlanarSlab* slab_;
    std::optional<double> cosine_;
    std::optional<QuantileTable> table_;  // over the squared cosine, of which Lambertian light has equal parts
};

}  // namespace wend
