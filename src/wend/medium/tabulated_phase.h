// Phase functions by a table: measured ones, Mie's, Fournier and Forand's. Conventions as in phase.h.
#pragma once

#include <wend/core/export.h>
#include <wend/core/vector.h>
#include <wend/sampling/axial_lobes.h>

#include <functional>
#include <memory>
#include <span>

namespace wend {

/// A function that is linear in the scattering cosine between the nodes of a table, normalized. Copies share the table.
class WEND_API TabulatedPhase {
public:
    /// `cosines` increase from -1 to 1, `values` are relative to each other. Throws InputError unless there are two or
    /// more nodes, and the values are finite, not negative and not all 0.
    TabulatedPhase(std::span<const double> cosines, std::span<const double> values);

    /// Density per steradian.
    float evaluate(float cosine) const;
    /// Inverts the cumulative distribution, which grows with the cosine; u in [0,1).
    float sample_cosine(float u) const;
    /// moment(1).
    float mean_cosine() const { return static_cast<float>(moment(1)); }
    /// Whether all directions are alike.
    bool is_isotropic() const;
    /// The integral of the function times Legendre's polynomial of the scattering cosine; 0 beyond most_moments, where
    /// narrow peaks still have some.
    double moment(int degree) const;
    /// As many lobes as there is room for, fitted by expectation maximization.
    AxialLobes lobes() const;
    /// As PhaseFunction::convolved(), by a table; mean cosines beyond 0.98 are taken for that.
    float convolved(const Vec3& before, const Vec3& mean) const;

    /// How many moments are kept.
    static constexpr int most_moments = 1024;

private:
    struct Table;
    std::shared_ptr<const Table> table_;
};

/// The table of a function of the scattering angle (radians), dense towards forward scattering. Below a thousandth of a
/// radian, where single precision ends, it keeps the share of all light, but not the shape.
WEND_API TabulatedPhase tabulate_phase(const std::function<double(double)>& by_angle);

/// Fournier and Forand's function (fournier1999) of particles in water whose sizes follow a power law. `index` of
/// refraction relative to the water, above 1; `slope` of the law, in (3, 5). Throws InputError otherwise.
WEND_API TabulatedPhase fournier_forand(double index, double slope);

/// Mie's function of the droplets of fog or clouds by their diameter in micrometres, from 5 to 50, as a mixture of
/// Henyey and Greenstein's function with Draine's (jendersie2023). Throws InputError beyond.
WEND_API TabulatedPhase fog_droplets(double diameter);

}  // namespace wend
