// Every sampler's mean is the exact one, over media, boundaries, tallies and incidences.
#include <tests/lab/experiments.h>
#include <wend/medium/fresnel.h>
#include <wend/planar/albedo_inversion.h>
#include <wend/stats/chi_square.h>
#include <wend/stats/significance.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace wend {
namespace {

using test::half_space;
using test::is_exact;
using test::run;
using test::slab;

std::string describe(const PlanarExperiment& e) {
    std::string text = e.sampler + ", albedo " + std::to_string(e.albedo[0]);
    text += std::isinf(e.thickness) ? ", half-space" : ", slab " + std::to_string(e.thickness);
    text += e.tally == Tally::transmittance ? ", transmittance" : "";
    text += ", g " + std::to_string(e.g) + ", ior " + std::to_string(e.ior) + ", alpha " + std::to_string(e.roughness);
    return text + (e.mu0 ? ", mu0 " + std::to_string(*e.mu0) : ", diffuse");
}

/// Runs experiments by all samplers that can; every mean must be right, and a reference off by 1 % is refused wherever
/// the standard error permits, which by `modes`, and in half-spaces `boundary`, it always does. Together the deviations
/// must be those of a normal distribution: a sum of squares neither too large (bias) nor too small (errors overstated).
class MeansOf {
public:
    explicit MeansOf(std::uint64_t walks) : walks_(walks) {}
    ~MeansOf() {
        EXPECT_GT(chi_square_p_value(squares_, count_), 1e-3) << squares_ << " of " << count_;
        EXPECT_LT(chi_square_p_value(squares_, count_), 1 - 1e-3) << squares_ << " of " << count_;
    }
    MeansOf(const MeansOf&) = delete;
    MeansOf& operator=(const MeansOf&) = delete;

    void check(PlanarExperiment e, std::uint64_t times = 1) {
        for (const std::string& sampler : planar_samplers()) {
            // Of walks that do not head for the far side too few get through to estimate by.
            const bool hopeless =
                e.tally == Tally::transmittance && e.thickness > 5 && (sampler == "analog" || sampler == "classical");
            if (hopeless) {
                continue;
            }
            e.sampler = sampler;
            const PlanarResult result = run(e, times * walks_, 4);
            const double exactness = test::reference_error(e);
            EXPECT_TRUE(is_exact(result, exactness)) << describe(e);
            const Moments& m = result.channels[0];
            const bool permits = 6 * m.relative_error() < 0.01 - 2 * exactness;
            const bool guided = sampler == "modes" || (sampler == "boundary" && std::isinf(e.thickness));
            EXPECT_TRUE(permits || !guided) << describe(e) << ": relative error " << m.relative_error();
            if (permits) {
                EXPECT_FALSE(is_exact(result, exactness, 1.01)) << describe(e);
                EXPECT_FALSE(is_exact(result, exactness, 0.99)) << describe(e);
            }
            if (sampler != "modes") {  // whose standard error may be below the reference's
                squares_ += std::pow((m.mean() - result.exact[0]) / m.standard_error(), 2);
                ++count_;
            }
        }
    }

private:
    std::uint64_t walks_;
    double squares_ = 0;
    int count_ = 0;
};

const std::vector<std::optional<double>> incidences = {1.0, 0.5, 1e-3, std::nullopt};

// Of the light that has entered a half-space whose albedo was made for a colour, that colour comes back.
TEST(SlowPlanarMeans, AlbedosForAColour) {
    for (const auto& [g, ior] : {std::pair{0.0, 1.33}, {0.8, 1.4}, {-0.5, 1.5}, {0.9, 1.0}}) {
        const AlbedoInversion albedo_of(g, ior);
        for (const float colour : {0.1f, 0.5f, 0.95f}) {
            PlanarExperiment e = half_space(static_cast<double>(albedo_of(colour)), "modes");
            e.g = g;
            e.ior = ior;
            e.mu0 = std::nullopt;
            const Moments m = run(e, 10000, 5).channels[0];
            const double outside = fresnel_diffuse_reflectance(static_cast<float>(ior));
            const double returned = (m.mean() - outside) / (1 - outside);
            const double error = m.standard_error() / (1 - outside);
            EXPECT_TRUE(agrees(returned, error, colour, 4, 1e-3))
                << returned << " +- " << error << " for " << colour << ", g " << g << ", ior " << ior;
            EXPECT_LT(error, 2e-3);
        }
    }
}

TEST(SlowPlanarMeans, IsotropicHalfSpace) {
    MeansOf means(20000);
    for (const double albedo : {0.2, 0.4, 0.8, 0.95, 0.99}) {
        for (const std::optional<double>& mu0 : incidences) {
            PlanarExperiment e = half_space(albedo, "");
            e.mu0 = mu0;
            means.check(e);
        }
    }
}

TEST(SlowPlanarMeans, IsotropicSlab) {
    MeansOf means(10000);
    for (const double albedo : {0.4, 0.8, 0.99}) {
        for (const double thickness : {2.0, 10.0}) {
            for (const Tally tally : {Tally::reflectance, Tally::transmittance}) {
                for (const std::optional<double>& mu0 : {std::optional(1.0), std::optional<double>()}) {
                    PlanarExperiment e = slab(albedo, thickness, tally, "");
                    e.mu0 = mu0;
                    means.check(e);
                }
            }
        }
    }
}

TEST(SlowPlanarMeans, AnisotropicMedia) {
    MeansOf means(10000);
    struct Medium {
        double g;
        double albedo;
        double thickness;
        Tally tally;
        std::optional<double> mu0;
        int modes;
    };
    const double infinite = std::numeric_limits<double>::infinity();
    for (const Medium& m : std::vector<Medium>{{0.5, 0.8, infinite, Tally::reflectance, 1.0, 12},
                                               {0.8, 0.95, infinite, Tally::reflectance, 0.5, 24},
                                               {-0.3, 0.99, infinite, Tally::reflectance, {}, 8},
                                               {0.8, 0.8, 2, Tally::transmittance, 1.0, 24},
                                               {0.5, 0.95, 10, Tally::transmittance, {}, 12},
                                               {-0.3, 0.4, 2, Tally::reflectance, 1e-3, 8}}) {
        PlanarExperiment e = slab(m.albedo, m.thickness, m.tally, "");
        e.g = m.g;
        e.mu0 = m.mu0;
        e.modes = m.modes;
        means.check(e);
    }
}

TEST(SlowPlanarMeans, RefractiveBoundaries) {
    MeansOf means(20000);
    struct Medium {
        double ior;
        double g;
        double albedo;
        double thickness;
        Tally tally;
        std::optional<double> mu0;
    };
    const double infinite = std::numeric_limits<double>::infinity();
    for (const Medium& m : std::vector<Medium>{{1.33, 0, 0.8, infinite, Tally::reflectance, 1.0},
                                               {1.5, 0, 0.95, infinite, Tally::reflectance, 0.5},
                                               {1.5, 0, 0.4, infinite, Tally::reflectance, {}},
                                               {1.5, 0, 0.99, infinite, Tally::reflectance, 1e-3},
                                               {1.5, 0.8, 0.95, infinite, Tally::reflectance, 1.0},
                                               {1.33, 0, 0.8, 2, Tally::reflectance, {}},
                                               {1.5, 0, 0.95, 2, Tally::transmittance, 1.0},
                                               {1.33, 0, 0.8, 10, Tally::transmittance, 0.5},
                                               {1.33, 0.5, 0.8, 2, Tally::transmittance, {}}}) {
        PlanarExperiment e = slab(m.albedo, m.thickness, m.tally, "");
        e.ior = m.ior;
        e.g = m.g;
        e.mu0 = m.mu0;
        e.modes = m.g > 0.6 ? 24 : 12;
        means.check(e);
    }
}

TEST(SlowPlanarMeans, RoughBoundaries) {
    MeansOf means(15000);
    struct Medium {
        double ior;
        double albedo;
        double thickness;
        Tally tally;
        std::optional<double> mu0;
    };
    const double infinite = std::numeric_limits<double>::infinity();
    for (const Medium& m : std::vector<Medium>{{1.33, 0.8, infinite, Tally::reflectance, 1.0},
                                               {1.5, 0.95, infinite, Tally::reflectance, 0.5},
                                               {1.5, 0.4, infinite, Tally::reflectance, {}},
                                               {1.5, 0.8, 2, Tally::transmittance, 1.0}}) {
        PlanarExperiment e = slab(m.albedo, m.thickness, m.tally, "");
        e.ior = m.ior;
        e.roughness = 0.3;
        e.mu0 = m.mu0;
        means.check(e, e.mu0 ? 1 : 3);  // what reflects varies most where directions of entry do
    }
}

// Values of others, independent of the solver that the laboratory takes its references from.
TEST(SlowPlanarMeans, PublishedValues) {
    struct Published {
        double albedo, g, ior, thickness;
        Tally tally;
        double value;
        double rounding;  // half a unit of the last digit given
    };
    const double infinite = std::numeric_limits<double>::infinity();
    // Half-spaces by adding and doubling, or by exact ordinates with a boundary; the slab of optical thickness 2 from
    // van de Hulst's tables.
    for (const Published& p : std::vector<Published>{{0.8, 0.5, 1, infinite, Tally::reflectance, 0.161535, 5e-7},
                                                     {0.95, 0.5, 1, infinite, Tally::reflectance, 0.403878, 5e-7},
                                                     {0.8, 0.8, 1, infinite, Tally::reflectance, 0.063908, 5e-7},
                                                     {0.95, -0.3, 1, infinite, Tally::reflectance, 0.584095, 5e-7},
                                                     {0.8, 0.9, 1, infinite, Tally::reflectance, 0.02891, 5e-6},
                                                     {0.9, 0, 1.5, infinite, Tally::reflectance, 0.2599186, 5e-8},
                                                     {0.8, 0, 1.4, infinite, Tally::reflectance, 0.1808231, 5e-8},
                                                     {0.9, 0.75, 1, 2, Tally::reflectance, 0.09739, 5e-6},
                                                     {0.9, 0.75, 1, 2, Tally::transmittance, 0.66096, 5e-6}}) {
        PlanarExperiment e = slab(p.albedo, p.thickness, p.tally, "modes");
        e.g = p.g;
        e.ior = p.ior;
        e.modes = p.g > 0.85 ? 32 : 24;
        const Moments m = run(e, 20000).channels[0];
        EXPECT_LE(std::abs(m.mean() - p.value), 3 * m.standard_error() + 1.02 * p.rounding)
            << describe(e) << ": " << m.mean() << " +- " << m.standard_error() << " against " << p.value;
    }
}

}  // namespace
}  // namespace wend
