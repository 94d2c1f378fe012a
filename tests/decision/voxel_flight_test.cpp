// Flights and transmittance in media whose voxels have coefficients of their own.
#include <wend/decision/distance.h>
#include <wend/medium/transmittance.h>
#include <wend/stats/significance.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <span>

namespace wend {
namespace {

constexpr int side = 4;

/// A grid of 4 x 4 x 4 uneven values up to `largest`.
Grid uneven_grid(std::uint64_t seed, float largest) {
    const VoxelBox all{Vec3i(0), Vec3i(side - 1)};
    return {Vec3i(0), Vec3i(side), std::span(&all, 1),
            [&](int x, int y, int z) { return largest * Pcg32(hash_of(seed, x, y, z)).uniform(); }};
}

struct Coefficients {
    std::shared_ptr<const VoxelCoefficients> voxels;
    std::shared_ptr<const Grid> bound;
};

Coefficients uneven_coefficients() {
    auto voxels = std::make_shared<VoxelCoefficients>();
    voxels->absorption = ColourGrid({uneven_grid(1, 2), uneven_grid(2, 0.3f), uneven_grid(3, 0.8f)});
    voxels->scattering = ColourGrid({uneven_grid(4, 0.5f), uneven_grid(5, 3), uneven_grid(6, 1)});
    const VoxelBox all{Vec3i(0), Vec3i(side - 1)};
    auto bound = std::make_shared<const Grid>(Vec3i(0), Vec3i(side), std::span(&all, 1), [&](int x, int y, int z) {
        const Vec3 p(Vec3i(x, y, z));
        return max_value(voxels->absorption.interpolate(p) + voxels->scattering.interpolate(p)) * 1.0001f;
    });
    return {voxels, bound};
}

GridMedium uneven_medium(std::shared_ptr<const GridEmission> emission = nullptr) {
    const Coefficients c = uneven_coefficients();
    return {c.bound,         Transform(), Box3(Vec3(0.0f), Vec3(side - 1)), c.voxels, Rgb(1.0f), Rgb(1.0f),
            PhaseFunction(), emission};
}

const Ray ray{{-0.5f, 0.4f, 0.9f}, normalize(Vec3(2, 0.6f, 0.7f))};
constexpr float length_of_ray = 3.4f;

/// Of one channel along the ray, by midpoints: transmittance to the end, and what is scattered and emitted on the way.
struct Along {
    double passed = 1, scattered = 0, emitted = 0;
};
Along along(const GridMedium& medium, int channel) {
    constexpr int steps = 20000;
    constexpr double step = double{length_of_ray} / steps;
    Along sum;
    double depth = 0;
    for (int i = 0; i < steps; ++i) {
        const Vec3 p = ray.at(static_cast<float>((i + 0.5) * step));
        const bool inside = p.x > 0 && p.y > 0 && p.z > 0 && p.x < side - 1 && p.y < side - 1 && p.z < side - 1;
        const double a = inside ? static_cast<double>(medium.voxels()->absorption.interpolate(p)[channel]) : 0.0;
        const double s = inside ? static_cast<double>(medium.voxels()->scattering.interpolate(p)[channel]) : 0.0;
        const double here = std::exp(-depth - 0.5 * (a + s) * step) * step;
        sum.scattered += s * here;
        sum.emitted += medium.emission() ? a * here * static_cast<double>(medium.emission()->at(p)[channel]) : 0.0;
        depth += (a + s) * step;
    }
    sum.passed = std::exp(-depth);
    return sum;
}

TEST(VoxelFlight, TransmittanceIsRightInEachChannel) {
    const GridMedium medium = uneven_medium();
    std::array<Moments, 3> passed;
    Pcg32 random(1);
    for (int i = 0; i < 200000; ++i) {
        const Rgb estimate = estimate_transmittance(medium, ray, length_of_ray, random);
        for (int c = 0; c < 3; ++c) {
            passed[static_cast<std::size_t>(c)].add(static_cast<double>(estimate[c]));
        }
    }
    for (int c = 0; c < 3; ++c) {
        const Moments& m = passed[static_cast<std::size_t>(c)];
        EXPECT_TRUE(agrees(m, along(medium, c).passed, 4)) << c << ' ' << m.mean();
        EXPECT_FALSE(agrees(m, 1.03 * along(medium, c).passed, 4)) << c;
    }
}

TEST(VoxelFlight, WeightsOfFlightsAreRightInEachChannel) {
    auto emission = std::make_shared<GridEmission>();
    emission->radiance = Rgb(2.0f);
    emission->colours = std::make_shared<const ColourGrid>(
        std::array<Grid, 3>{uneven_grid(7, 1), uneven_grid(8, 2), uneven_grid(9, 3)});
    emission->field_from_world = AffineMap(Transform());
    for (const GridMedium& medium : {uneven_medium(), uneven_medium(emission)}) {
        std::array<Moments, 3> passed, scattered, emitted;
        Pcg32 random(2);
        const Rgb throughput(0.2f, 1, 0.5f);
        for (int i = 0; i < 200000; ++i) {
            const Flight flight = ClassicalDistance().sample(medium, {ray, length_of_ray, throughput, 1, {}}, random);
            for (int c = 0; c < 3; ++c) {
                const auto k = static_cast<std::size_t>(c);
                const auto weight = static_cast<double>(flight.weight[c]);
                passed[k].add(flight.scatters ? 0 : weight);
                scattered[k].add(flight.scatters ? weight : 0);
                emitted[k].add(static_cast<double>(flight.emitted[c]));
            }
        }
        for (int c = 0; c < 3; ++c) {
            const auto k = static_cast<std::size_t>(c);
            const Along expected = along(medium, c);
            EXPECT_TRUE(agrees(passed[k], expected.passed, 4)) << c;
            EXPECT_TRUE(agrees(scattered[k], expected.scattered, 4)) << c;
            EXPECT_FALSE(agrees(scattered[k], 1.03 * expected.scattered, 4)) << c;
            if (medium.emission()) {
                EXPECT_TRUE(agrees(emitted[k], expected.emitted, 4)) << c;
                EXPECT_FALSE(agrees(emitted[k], 1.03 * expected.emitted, 4)) << c;
            } else {
                EXPECT_EQ(emitted[k].mean(), 0);
            }
        }
    }
}

}  // namespace
}  // namespace wend
