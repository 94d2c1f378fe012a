#include <tests/medium/smooth_medium.h>
#include <tests/sampling/verdicts.h>
#include <wend/medium/transmittance.h>

#include <gtest/gtest.h>

#include <array>

namespace wend {
namespace {

constexpr float length_of_ray = 3.5f;

std::array<Moments, 3> estimate(const GridMedium& medium, const Ray& ray, float length, int samples) {
    std::array<Moments, 3> moments;
    Pcg32 random(1);
    for (int i = 0; i < samples; ++i) {
        const Rgb t = estimate_transmittance(medium, ray, length, random);
        for (int c = 0; c < 3; ++c) {
            moments[static_cast<std::size_t>(c)].add(t[c]);
        }
    }
    return moments;
}

/// Extinctions at density 1, for optical thicknesses of 0.1 to 2.
class ResidualRatioTracking : public testing::TestWithParam<Rgb> {};

TEST_P(ResidualRatioTracking, MeanIsTheTransmittance) {
    const Rgb extinction = GetParam();
    const GridMedium medium = test::smooth_medium(extinction * 0.25f, extinction * 0.75f);
    const Ray ray = test::ray_through_smooth_medium();
    for (const float length : {length_of_ray, 0.55f * length_of_ray}) {
        const double density = test::DensityAlong(medium, ray, length).total();
        const auto moments = estimate(medium, ray, length, 1000000);
        for (int c = 0; c < 3; ++c) {
            EXPECT_TRUE(test::is_within_one_percent(moments[static_cast<std::size_t>(c)],
                                                    std::exp(-extinction[c] * density), 1e-4))
                << "channel " << c << ", optical thickness " << extinction[c] * density;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(GreyAndChromatic, ResidualRatioTracking,
                         testing::Values(Rgb(0.3f), Rgb(2.0f), Rgb(0.3f, 1.0f, 3.0f), Rgb(3.0f, 0.0f, 2.0f)));

TEST(ResidualRatioTracking, RouletteInThickMediaLeavesTheMean) {
    const GridMedium medium = test::smooth_medium(Rgb(0), Rgb(5));
    const Ray ray = test::ray_through_smooth_medium();
    const double density = test::DensityAlong(medium, ray, length_of_ray).total();
    EXPECT_TRUE(
        test::is_within_one_percent(estimate(medium, ray, length_of_ray, 3000000)[0], std::exp(-5 * density), 1e-4));
}

TEST(ResidualRatioTracking, AnOpticalThicknessWrongByOnePercentIsRejected) {
    const GridMedium medium = test::smooth_medium(Rgb(0), Rgb(5));
    const Ray ray = test::ray_through_smooth_medium();
    const double density = test::DensityAlong(medium, ray, length_of_ray).total();
    const auto moments = estimate(medium, ray, length_of_ray, 200000);
    EXPECT_FALSE(agrees(moments[0], std::exp(-5 * 1.01 * density), 4));
}

TEST(ResidualRatioTracking, ConstantDensityHasNoVariance) {
    const auto grid = std::make_shared<Grid>(
        Vec3i(0), Vec3i(20), [](const Vec3i&, const Vec3i&) { return true; }, [](int, int, int) { return 0.5f; });
    const GridMedium medium(grid, Transform(), Box3(Vec3(2), Vec3(18)), Rgb(0.01f), Rgb(0.02f), PhaseFunction());
    const auto moments = estimate(medium, {{0, 9, 9}, {1, 0, 0}}, 100, 100);
    EXPECT_EQ(moments[0].variance(), 0);
    EXPECT_NEAR(moments[0].mean(), std::exp(-16 * 0.5 * 0.03), 1e-6);
}

TEST(ResidualRatioTracking, VacuumPassesAll) {
    const Ray beside{{5, 5, 5}, {1, 0, 0}};
    Pcg32 random(1);
    EXPECT_EQ(estimate_transmittance(test::smooth_medium(Rgb(1), Rgb(1)), beside, 10, random), Rgb(1));
    EXPECT_EQ(
        estimate_transmittance(test::smooth_medium(Rgb(0), Rgb(0)), test::ray_through_smooth_medium(), 10, random),
        Rgb(1));
}

TEST(Transmittance, OfAHomogeneousMediumIsExact) {
    const HomogeneousMedium medium{Rgb(0.5f, 0, 1), Rgb(1.5f, 1, 0), Rgb(0), PhaseFunction()};
    const Rgb t = transmittance(medium, 0.7f);
    EXPECT_FLOAT_EQ(t.r, std::exp(-1.4f));
    EXPECT_FLOAT_EQ(t.g, std::exp(-0.7f));
    Pcg32 random(1);
    EXPECT_EQ(estimate_transmittance(Medium(medium), Ray{{0, 0, 0}, {0, 0, 1}}, 0.7f, random), t);
}

}  // namespace
}  // namespace wend
