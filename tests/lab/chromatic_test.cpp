// Three channels at once, and results that do not depend on who computes them.
#include <tests/lab/experiments.h>

#include <vector>

namespace wend {
namespace {

using test::half_space;
using test::is_exact;
using test::run;
using test::slab;

const char* const chromatic_samplers[] = {"classical", "stretched", "dwivedi", "boundary", "modes"};

/// By every sampler, each channel's mean is exact, and one that is off by 8 % is refused. (4 standard errors, of which
/// one in 16,000 is farther off, since more than a hundred means are compared.)
void expect_exact_channels(PlanarExperiment e, std::uint64_t walks) {
    for (const char* sampler : chromatic_samplers) {
        e.sampler = sampler;
        PlanarResult result = run(e, walks);
        const double exactness = test::reference_error(e);
        EXPECT_TRUE(is_exact(result, exactness, 1, 4)) << sampler;
        for (std::size_t c = 0; c < 3; ++c) {
            PlanarResult wrong = result;
            wrong.exact[c] *= 1.08;
            EXPECT_FALSE(is_exact(wrong, exactness, 1, 4))
                << sampler << ", channel " << c << ": " << result.channels[c].relative_error();
        }
    }
}

TEST(ChromaticPlanar, AlbedosDiffer) {
    PlanarExperiment e = half_space(0, "");
    e.albedo = {0.95, 0.8, 0.4};
    expect_exact_channels(e, 60000);
    e.mu0.reset();
    expect_exact_channels(e, 60000);
}

TEST(ChromaticPlanar, ExtinctionsDiffer) {
    PlanarExperiment e = half_space(0, "");
    e.albedo = {0.9, 0.8, 0.6};
    e.extinction = {1, 2, 0.5};
    expect_exact_channels(e, 60000);
    e.thickness = 2;
    expect_exact_channels(e, 60000);
    e.tally = Tally::transmittance;
    expect_exact_channels(e, 60000);
}

TEST(SlowChromaticPlanar, BoundariesRefract) {
    PlanarExperiment e = half_space(0, "");
    e.albedo = {0.95, 0.8, 0.6};
    e.extinction = {1, 1.5, 0.7};
    e.ior = 1.5;
    expect_exact_channels(e, 40000);
    e.g = 0.5;
    e.thickness = 3;
    expect_exact_channels(e, 40000);
}

TEST(SlowChromaticPlanar, BoundariesAreRough) {
    PlanarExperiment e = half_space(0, "");
    e.albedo = {0.95, 0.8, 0.6};
    e.ior = 1.4;
    e.roughness = 0.3;
    expect_exact_channels(e, 20000);
}

TEST(ChromaticPlanar, ThreeEqualChannelsAreOne) {
    PlanarExperiment e = half_space(0, "modes");
    e.albedo = {0.8, 0.8, 0.8};
    const PlanarResult result = run(e, 10000);
    for (const Moments& channel : result.channels) {
        EXPECT_LT(channel.variance(), 2e-8);
        EXPECT_EQ(channel.mean(), result.channels[0].mean());
    }
}

// No channel gets more than its own sampler would have given it, over its share: absorption may be zero, or total.
TEST(ChromaticPlanar, ExtremesStayFinite) {
    PlanarExperiment e = half_space(0, "");
    for (const std::vector<double>& albedo : {std::vector<double>{0, 0, 0}, {1, 0.5, 0}, {0.9999, 1e-6, 0.5}}) {
        e.albedo = albedo;
        e.extinction = {1, 30, 0.1};
        for (const char* sampler : chromatic_samplers) {
            e.sampler = sampler;
            const PlanarResult result = run(e, 500);
            EXPECT_EQ(result.rejected, 0u) << sampler;
            for (std::size_t c = 0; c < 3; ++c) {
                EXPECT_TRUE(std::isfinite(result.channels[c].variance())) << sampler;
            }
        }
    }
}

TEST(PlanarLab, ResultsDoNotDependOnThreads) {
    PlanarExperiment three = half_space(0, "modes");
    three.albedo = {0.95, 0.8, 0.4};
    for (const PlanarExperiment& e : {half_space(0.8, "classical"), half_space(0.8, "modes"), three}) {
        const PlanarResult one = run(e, 10000, 3, 1);
        for (const int threads : {2, 3}) {
            const PlanarResult other = run(e, 10000, 3, threads);
            for (std::size_t c = 0; c < one.channels.size(); ++c) {
                EXPECT_EQ(one.channels[c].mean(), other.channels[c].mean());
                EXPECT_EQ(one.channels[c].variance(), other.channels[c].variance());
            }
            EXPECT_EQ(one.collisions_per_walk, other.collisions_per_walk);
        }
        EXPECT_NE(run(e, 10000, 4).channels[0].mean(), one.channels[0].mean()) << "seeds make no difference";
    }
}

}  // namespace
}  // namespace wend
