// The doubles and adapters of tests/support are measuring instruments: they are tested as such.
#include <tests/support/chi_square_sphere.h>
#include <tests/support/paths.h>
#include <tests/support/scripted_random.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace wend::test {
namespace {

Vec3 uniform_direction(const Vec2& u) {
    const float z = 1 - 2 * u.x, r = safe_sqrt(1 - z * z);
    return {r * std::cos(2 * pi * u.y), r * std::sin(2 * pi * u.y), z};
}
Vec3 cosine_direction(const Vec2& u) {
    const float r = std::sqrt(u.x);
    return {r * std::cos(2 * pi * u.y), r * std::sin(2 * pi * u.y), safe_sqrt(1 - u.x)};
}
double uniform_density(const Vec3&) {
    return inv_4pi;
}
double cosine_density(const Vec3& v) {
    return v.z > 0 ? v.z * inv_pi : 0.0;
}

TEST(ScriptedRandom, ReplaysAndThenThrows) {
    ScriptedRandom random{0.0f, 0.25f, one_minus_epsilon};
    EXPECT_EQ(random.uniform(), 0.0f);
    EXPECT_EQ(random.uniform2(), Vec2(0.25f, one_minus_epsilon));
    EXPECT_EQ(random.remaining(), 0u);
    EXPECT_THROW(random.uniform(), std::out_of_range);
}

TEST(CountingRandom, PassesNumbersOnAndCountsThem) {
    Pcg32 plain(3);
    CountingRandom counting{Pcg32(3)};
    EXPECT_EQ(counting.uniform(), plain.uniform());
    EXPECT_EQ(counting.uniform2(), plain.uniform2());
    EXPECT_EQ(counting.count(), 3u);
}

TEST(ChiSquareSphere, AcceptsSamplersOfTheirDensity) {
    EXPECT_TRUE(follows_density(chi_square_sphere(uniform_direction, uniform_density), "uniform", 4));
    EXPECT_TRUE(follows_density(chi_square_sphere(cosine_direction, cosine_density), "cosine", 4));
}

TEST(ChiSquareSphere, AcceptsANarrowLobe) {
    // Density proportional to cos^n about x, n = 4000: all of it in a few cells.
    const auto sample = [](const Vec2& u) {
        const float z = std::pow(u.x, 1.0f / 4001), r = safe_sqrt(1 - z * z);
        return Vec3(z, r * std::cos(2 * pi * u.y), r * std::sin(2 * pi * u.y));
    };
    const auto density = [](const Vec3& v) {
        return v.x > 0 ? 4001 / (2 * M_PI) * std::pow(static_cast<double>(v.x), 4000) : 0.0;
    };
    const SphereTestOptions fine{.cosine_cells = 100, .azimuth_cells = 200};
    EXPECT_TRUE(follows_density(chi_square_sphere(sample, density, fine), "narrow", 4));
}

TEST(ChiSquareSphere, CountsMissingSamplesAgainstMissingDensity) {
    const auto sample = [](Pcg32& random) {
        return random.uniform() < 0.75f ? std::optional<Vec3>(uniform_direction(random.uniform2())) : std::nullopt;
    };
    const auto density = [](const Vec3&) { return 0.75 * inv_4pi; };
    EXPECT_TRUE(follows_density(chi_square_sphere(sample, density), "partial", 4));
    EXPECT_EQ(chi_square_sphere(sample, uniform_density).result.p_value, 0);
}

TEST(ChiSquareSphere, RejectsATwoPercentError) {
    const auto density = [](const Vec3& v) { return inv_4pi * (1 + 0.02 * v.z); };
    const SphereTest test = chi_square_sphere(uniform_direction, density, {.samples = 4000000});
    EXPECT_LT(test.result.p_value, 1e-6);
}

TEST(ChiSquareSphere, RejectsADensityThatIntegratesToMoreThanOne) {
    EXPECT_LT(chi_square_sphere(uniform_direction, [](const Vec3&) { return 1.1 * inv_4pi; }).result.p_value, 1e-6);
}

TEST(ChiSquareSphere, LeavesItsCountsUponFailure) {
    const std::filesystem::path file = build_dir() / "chi_square" / "negative_twin.csv";
    std::filesystem::remove(file);
    EXPECT_FALSE(follows_density(chi_square_sphere(cosine_direction, uniform_density), "negative_twin"));
    EXPECT_TRUE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace wend::test
