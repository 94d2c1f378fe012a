// Exact flights voxel by voxel: unbiased in every channel, at any density in a bounded number of steps.
#include <tests/medium/smooth_medium.h>
#include <wend/decision/channels.h>
#include <wend/decision/dense_flight.h>
#include <wend/medium/transmittance.h>
#include <wend/stats/significance.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace wend {
namespace {

constexpr float segment = 3.5f;
const Ray ray = test::ray_through_smooth_medium();

/// Through the whole segment, as if all of it were too dense.
Flight fly(const GridMedium& medium, const Rgb& throughput, Pcg32& random) {
    Flight flight;
    flight.distance = segment;
    flight.weight = Rgb(1.0f);
    flight.emitted = Rgb(0.0f);
    const FlightStart start{ray, segment, throughput, 1, {}};
    Rgb probability = channel_probabilities(throughput);
    fly_densely(medium, start, 0, segment, probability, flight, random);
    return flight;
}

struct Means {
    std::array<Moments, 3> collisions, distances, passes, emitted;
};

Means measure(const GridMedium& medium, const Rgb& throughput) {
    constexpr int samples = 80000;
    Means means;
    Pcg32 random(1);
    for (int i = 0; i < samples; ++i) {
        const Flight flight = fly(medium, throughput, random);
        for (std::size_t c = 0; c < 3; ++c) {
            const double w = flight.weight[static_cast<int>(c)];
            means.collisions[c].add(flight.scatters ? w : 0);
            means.distances[c].add(flight.scatters ? w * flight.distance : 0);
            means.passes[c].add(flight.scatters ? 0 : w);
            means.emitted[c].add(flight.emitted[static_cast<int>(c)]);
        }
    }
    return means;
}

/// What a channel should have, against extinctions `scale` times the true ones.
bool all_agree(const GridMedium& medium, const Rgb& throughput, const Means& means, double scale) {
    const test::DensityAlong density(medium, ray, segment);
    bool agree = true;
    for (std::size_t c = 0; c < 3; ++c) {
        const auto channel = static_cast<int>(c);
        if (throughput[channel] == 0) {
            continue;  // what the walk carries there is 0, whatever the weight
        }
        const double extinction = scale * medium.extinction()[channel];
        const double scattering = scale * medium.scattering()[channel];
        const auto scattered = [&](int power) {
            return density.integrate([&](double t, double depth) {
                return scattering * std::exp(-extinction * depth) * std::pow(t, power);
            });
        };
        agree = agree && agrees(means.collisions[c], scattered(0), 4.5, 1e-3) &&
                agrees(means.distances[c], scattered(1), 4.5, 1e-3) &&
                agrees(means.passes[c], std::exp(-extinction * density.total()), 4.5, 1e-3);
        if (medium.emission()) {
            const double emitted = density.integrate([&](double t, double depth) {
                return scale * medium.absorption()[channel] *
                       medium.emission()->at(ray.at(static_cast<float>(t)))[channel] * std::exp(-extinction * depth);
            });
            agree = agree && agrees(means.emitted[c], emitted, 4.5, 1e-3);
        }
    }
    return agree;
}

TEST(SlowDenseFlight, IsUnbiasedInEveryChannel) {
    const auto emission = std::make_shared<GridEmission>();
    emission->radiance = Rgb(1, 2, 3);
    for (const GridMedium& medium :
         {test::smooth_medium(Rgb(0.2f), Rgb(0.9f)), test::smooth_medium(Rgb(0.1f, 0.2f, 0), Rgb(0.3f, 0.6f, 1.2f)),
          test::smooth_medium(Rgb(0.1f, 0.2f, 0), Rgb(0, 0.6f, 9)),
          test::smooth_medium(Rgb(0.4f, 0.2f, 0.1f), Rgb(0.3f, 0.6f, 1.2f), emission)}) {
        for (const Rgb& throughput : {Rgb(1), Rgb(1, 0.5f, 2), Rgb(1, 1, 0)}) {
            SCOPED_TRACE(testing::Message() << "blue " << medium.extinction().b << ", carried " << throughput.b);
            const Means means = measure(medium, throughput);
            EXPECT_TRUE(all_agree(medium, throughput, means, 1));
            EXPECT_FALSE(all_agree(medium, throughput, means, 1.03));
        }
    }
}

/// A dense voxel in the middle of nothing, so that bounds of the density say little about most of it.
GridMedium spike(float density, const Rgb& extinction) {
    const auto grid = std::make_shared<Grid>(
        Vec3i(0), Vec3i(9), [](const Vec3i&, const Vec3i&) { return true; },
        [density](int x, int y, int z) { return x == 4 && y == 4 && z == 4 ? density : 0.0f; });
    return GridMedium(grid, Transform(), Box3(Vec3(-1), Vec3(9)), Rgb(0), extinction, PhaseFunction());
}

TEST(DenseFlight, TransmittanceThroughSteepDensitiesIsExact) {
    // Past the voxel, at a distance where little of it is left.
    const Ray beside{{-1, 4.9f, 4.95f}, {1, 0, 0}};
    const GridMedium medium = spike(1e4f, Rgb(0.02f, 0.01f, 0));
    const double depth = 1e4 * 0.1 * 0.05;  // the triangle's area is 1
    Pcg32 random(1);
    const Rgb passed = estimate_transmittance(medium, beside, 20, random);
    EXPECT_NEAR(passed.r, std::exp(-0.02 * depth), 1e-4);
    EXPECT_NEAR(passed.g, std::exp(-0.01 * depth), 1e-4);
    EXPECT_EQ(passed.b, 1);
}

TEST(DenseFlight, AnyDensityIsCrossedInFewSteps) {
    // Without an end to the steps this would not come to one: up to 1e38 of them a flight.
    const Ray into{{-1, 4.1f, 4.2f}, {1, 0, 0}};
    for (const float density : {1e6f, 1e12f, 1e38f}) {
        for (const Rgb& extinction : {Rgb(1), Rgb(1, 0, 100), Rgb(1e-3f, 1e30f, 1)}) {
            const GridMedium medium = spike(density, extinction);
            Pcg32 random(2);
            for (int i = 0; i < 200; ++i) {
                const Rgb passed = estimate_transmittance(medium, into, 20, random);
                EXPECT_EQ(passed.r, 0) << density;
                EXPECT_EQ(passed.g, extinction.g == 0 ? 1.0f : 0.0f) << density;
                // For a walk that carries little of what the medium stops most.
                const FlightStart start{into, 20, Rgb(1, 1e-20f, 1e-20f), 1, {}};
                const Flight flight = ClassicalDistance().sample(medium, start, random);
                ASSERT_TRUE(flight.scatters);
                EXPECT_GE(flight.distance, 4.0f);
                EXPECT_LE(flight.distance, 5.1f);
                EXPECT_TRUE(is_finite(flight.weight));
            }
        }
    }
}

}  // namespace
}  // namespace wend
