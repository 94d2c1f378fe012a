// Variances of the samplers: closed forms where there are any, and how close to zero the guided ones come.
#include <tests/lab/experiments.h>
#include <tests/lab/walks.h>
#include <wend/planar/half_space.h>

#include <algorithm>

namespace wend {
namespace {

using test::half_space;
using test::run;
using test::slab;
using test::variance_of;
using test::VarianceEstimate;

/// Within 2 %, and by enough walks that this means something: the standard error of the sample variance, from the
/// fourth moment, is at most a third of that.
testing::AssertionResult is_variance(const VarianceEstimate& v, double expected) {
    if (!(3 * v.standard_error <= 0.02 * expected)) {
        return testing::AssertionFailure() << "too few walks: standard error " << v.standard_error;
    }
    if (!(std::abs(v.variance - expected) <= 0.02 * expected)) {
        return testing::AssertionFailure() << "variance " << v.variance << ", expected " << expected;
    }
    return testing::AssertionSuccess();
}

struct ClosedForm {
    double albedo;
    double classical, dwivedi_classical, dwivedi_stretched;  // normal incidence
    std::size_t walks;
};

// The relative standard error of a classical sample variance from n walks is 2.9 / sqrt(n) at albedo 0.4, 1.3 at 0.8
// and 0.7 at 0.95; of Dwivedi's it is 1 to 1.5.
const ClosedForm closed_forms[] = {{0.4, 0.020413, 0.016204, 0.008715, 400000},
                                   {0.8, 0.093393, 0.031117, 0.008507, 200000},
                                   {0.95, 0.132755, 0.030174, 0.003954, 100000}};

TEST(PlanarVariance, ClassicalIsItsClosedForm) {
    for (const ClosedForm& f : closed_forms) {
        const VarianceEstimate v = variance_of(test::walk_values(half_space(f.albedo, "classical"), f.walks, 1));
        EXPECT_NEAR(classical_variance(f.albedo, 1), f.classical, 1e-6);
        EXPECT_TRUE(is_variance(v, f.classical)) << f.albedo;
        EXPECT_FALSE(is_variance(v, 1.05 * f.classical)) << f.albedo;
    }
}

TEST(PlanarVariance, DwivediIsItsClosedForm) {
    for (const ClosedForm& f : closed_forms) {
        PlanarExperiment e = half_space(f.albedo, "dwivedi");
        const VarianceEstimate stretched = variance_of(test::walk_values(e, f.walks, 1));
        e.first_flight = FirstFlight::classical;
        const VarianceEstimate classical = variance_of(test::walk_values(e, f.walks, 1));
        EXPECT_NEAR(dwivedi_variance(f.albedo, 1, FirstFlight::stretched), f.dwivedi_stretched, 1e-6);
        EXPECT_NEAR(dwivedi_variance(f.albedo, 1, FirstFlight::classical), f.dwivedi_classical, 1e-6);
        EXPECT_TRUE(is_variance(stretched, f.dwivedi_stretched)) << f.albedo;
        EXPECT_TRUE(is_variance(classical, f.dwivedi_classical)) << f.albedo;
        EXPECT_FALSE(is_variance(stretched, f.dwivedi_classical)) << f.albedo;
        EXPECT_FALSE(is_variance(classical, f.dwivedi_stretched)) << f.albedo;
    }
}

TEST(PlanarVariance, StretchedFirstFlightIsTheDefaultAndBelowTheTalk) {
    EXPECT_EQ(PlanarExperiment().first_flight, FirstFlight::stretched);
    EXPECT_LT(dwivedi_variance(0.4, 1, FirstFlight::stretched), 0.020);
    EXPECT_LT(dwivedi_variance(0.8, 1, FirstFlight::stretched), 0.034);
    EXPECT_LT(dwivedi_variance(0.95, 1, FirstFlight::stretched), 0.025);
}

constexpr double albedos[] = {0.1, 0.2, 0.4, 0.6, 0.8, 0.9, 0.95, 0.99, 0.999};

double variance(const PlanarExperiment& e, std::uint64_t walks) {
    const PlanarResult result = run(e, walks);
    EXPECT_TRUE(test::is_exact(result)) << e.sampler << ' ' << e.albedo[0];
    return result.channels[0].variance();
}

TEST(PlanarVariance, BoundaryIsBelowDwivediAtEveryAlbedo) {
    for (const double albedo : albedos) {
        for (const int exponentials : {1, 2}) {
            PlanarExperiment e = half_space(albedo, "boundary");
            e.exponentials = exponentials;
            EXPECT_LT(variance(e, 20000), dwivedi_variance(albedo, 1, FirstFlight::stretched)) << albedo;
        }
        PlanarExperiment e = half_space(albedo, "boundary");
        e.moments = MatchedMoments::first_second;
        EXPECT_LT(variance(e, 20000), dwivedi_variance(albedo, 1, FirstFlight::stretched)) << albedo;
    }
}

TEST(PlanarVariance, BoundaryMatchesTwoMoments) {
    for (const auto& [albedo, bar] : {std::pair(0.4, 1e-4), std::pair(0.8, 4e-4), std::pair(0.95, 3e-4)}) {
        for (const int exponentials : {1, 2}) {
            PlanarExperiment e = half_space(albedo, "boundary");
            e.exponentials = exponentials;
            EXPECT_LE(variance(e, 50000), bar) << albedo << ", " << exponentials;
        }
        EXPECT_GT(dwivedi_variance(albedo, 1, FirstFlight::stretched), 10 * bar) << "a bar that means nothing";
    }
}

TEST(PlanarVariance, EightModesLeaveNone) {
    for (const double albedo : albedos) {
        const double v = variance(half_space(albedo, "modes"), albedo > 0.98 ? 5000 : 20000);
        EXPECT_LE(v, 2e-8) << albedo;
        EXPECT_LT(v, 1e-4 * classical_variance(albedo, 1)) << albedo;
    }
    // Where plain Dwivedi loses.
    EXPECT_GT(dwivedi_variance(0.2, 1, FirstFlight::stretched), classical_variance(0.2, 1));
}

TEST(PlanarVariance, FallsWithTheNumberOfModes) {
    double before = dwivedi_variance(0.8, 1, FirstFlight::stretched);
    for (const int modes : {1, 2, 4, 8}) {
        const double v = variance(half_space(0.8, "modes", modes), 20000);
        EXPECT_LT(v, 0.3 * before) << modes;
        before = v;
    }
}

/// Classical variance over that of `modes`. A part of the classical walks suffices.
double ratio(PlanarExperiment e, std::uint64_t walks) {
    const double guided = variance(e, walks);
    e.sampler = "classical";
    return run(e, walks / 2).channels[0].variance() / guided;
}

TEST(SlowPlanarVariance, AnisotropicScattering) {
    struct Bar {
        double g;
        int modes;
        double albedo;
        double ratio;
    };
    for (const Bar& b : {Bar{0.5, 12, 0.8, 1e4},
                         {0.5, 12, 0.95, 1e4},
                         {0.5, 12, 0.99, 1e4},
                         {-0.3, 12, 0.8, 1e4},
                         {-0.3, 12, 0.95, 1e4},
                         {-0.3, 12, 0.99, 1e4},
                         {0.8, 24, 0.8, 1e4},
                         {0.8, 24, 0.95, 5e3},
                         {0.8, 24, 0.99, 1e3},
                         {0.9, 32, 0.8, 1e4},
                         {0.9, 32, 0.95, 2e3},
                         {0.9, 32, 0.99, 500}}) {
        PlanarExperiment e = half_space(b.albedo, "modes", b.modes);
        e.g = b.g;
        EXPECT_GE(ratio(e, 4000), b.ratio) << "g " << b.g << ", albedo " << b.albedo;
    }
}

TEST(PlanarVariance, RefractiveBoundaries) {
    struct Bar {
        double ior, roughness, g;
        double ratio;
    };
    for (const Bar& b : {Bar{1.33, 0, 0, 1e5}, {1.5, 0, 0, 1e5}, {1.33, 0, 0.8, 50}, {1.5, 0, 0.8, 50}}) {
        for (const double albedo : {0.8, 0.95}) {
            PlanarExperiment e = half_space(albedo, "modes", 24);
            e.ior = b.ior;
            e.g = b.g;
            EXPECT_GE(ratio(e, 4000), b.ratio) << "ior " << b.ior << ", g " << b.g << ", albedo " << albedo;
        }
    }
}

TEST(PlanarVariance, RoughBoundaries) {
    for (const double ior : {1.33, 1.5}) {
        PlanarExperiment e = half_space(0.95, "modes", 12);
        e.ior = ior;
        e.roughness = 0.3;
        const PlanarResult guided = run(e, 10000);
        EXPECT_TRUE(test::is_exact(guided, test::reference_error(e)));
        e.sampler = "classical";
        EXPECT_GE(run(e, 5000).channels[0].variance() / guided.channels[0].variance(), 50) << ior;
    }
}

TEST(PlanarVariance, ShieldsLetThroughWithoutNoise) {
    // One in a billion gets through 20 mean free paths of albedo 0.5.
    for (const double albedo : {0.5, 0.8, 0.95}) {
        const PlanarResult result = run(slab(albedo, 20, Tally::transmittance, "modes"), 5000);
        EXPECT_TRUE(test::is_exact(result)) << albedo;
        EXPECT_LT(result.channels[0].relative_error(), 1e-4) << albedo;
    }
}

}  // namespace
}  // namespace wend
