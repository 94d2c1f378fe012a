#include <tests/sampling/verdicts.h>
#include <tests/support/chi_square_sphere.h>
#include <wend/core/random.h>
#include <wend/sampling/warp.h>
#include <wend/stats/moments.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace wend {
namespace {

constexpr int samples = 200000;

/// P-value of numbers x(u) that should be uniform.
template <class Number>
double uniformity_of(const Number& number, std::uint64_t seed = 1) {
    Pcg32 random(seed);
    test::Uniformity uniformity;
    for (int i = 0; i < samples; ++i) {
        uniformity.add(number(random.uniform2()));
    }
    return uniformity.p_value();
}

/// Squared radius and azimuth of a disk's points, each over its range: uniform if the points are uniform by area.
Vec2 disk_coordinates(const Vec2& p) {
    return {p.x * p.x + p.y * p.y, std::atan2(p.y, p.x) / (2 * pi) + 0.5f};
}

TEST(Disk, IsUniform) {
    EXPECT_GE(uniformity_of([](const Vec2& u) { return disk_coordinates(to_disk(u)); }), test::passing);
}

TEST(Disk, PolarPointsWithoutTheSquareRootAreRejected) {
    EXPECT_LT(uniformity_of([](const Vec2& u) { return disk_coordinates(to_disk(u) * std::sqrt(u.x)); }),
              test::failing);
}

TEST(Disk, CentreAndCorners) {
    EXPECT_EQ(to_disk({0.5f, 0.5f}), Vec2(0, 0));
    for (const Vec2& corner : {Vec2(0, 0), Vec2(1, 0), Vec2(0, 1), Vec2(1, 1)}) {
        EXPECT_NEAR(to_disk(corner).length(), 1, 1e-6f);
    }
}

TEST(CosineHemisphere, SamplesFollowTheDensity) {
    EXPECT_TRUE(
        test::follows_density(test::chi_square_sphere([](Vec2 u) { return to_cosine_hemisphere(u); },
                                                      [](const Vec3& w) { return cosine_hemisphere_density(w.z); }),
                              "cosine_hemisphere"));
}

TEST(CosineHemisphere, AUniformDensityIsRejected) {
    const auto test = test::chi_square_sphere([](Vec2 u) { return to_cosine_hemisphere(u); },
                                              [](const Vec3& w) { return w.z > 0 ? 0.5 * inv_pi : 0.0; });
    EXPECT_LT(test.result.p_value, test::failing);
}

TEST(SphereWarp, IsUniform) {
    EXPECT_TRUE(test::follows_density(
        test::chi_square_sphere([](Vec2 u) { return to_sphere(u); }, [](const Vec3&) { return inv_4pi; }), "sphere"));
}

TEST(Cone, FillsItsSolidAngleUniformly) {
    // Down to an angle where 1 - cos is far below the precision of the cosine.
    for (const float one_minus_cosine : {2.0f, 0.7f, 1e-3f, 1e-10f}) {
        EXPECT_GE(uniformity_of([&](const Vec2& u) {
                      const Vec3 w = to_cone(u, one_minus_cosine);
                      const float x = one_minus_cosine < 0.1f ? 0.5f * (w.x * w.x + w.y * w.y) : 1 - w.z;
                      return Vec2(x / one_minus_cosine, std::atan2(w.y, w.x) / (2 * pi) + 0.5f);
                  }),
                  test::passing)
            << one_minus_cosine;
        EXPECT_FLOAT_EQ(cone_density(one_minus_cosine) * 2 * pi * one_minus_cosine, 1);
    }
}

TEST(TriangleWarp, IsUniform) {
    // The square root map inverted: 1 - (1 - b1)^2 and b2 / (1 - b1) are uniform.
    const auto square = [](const Vec2& b) { return Vec2(1 - sqr(1 - b.x), b.y / (1 - b.x)); };
    EXPECT_GE(uniformity_of([&](const Vec2& u) { return square(to_triangle(u)); }), test::passing);
    const auto wrong = [](const Vec2& u) { return u.x + u.y < 1 ? u : Vec2(u.y * 0.5f, u.x * 0.5f); };
    EXPECT_LT(uniformity_of([&](const Vec2& u) { return square(wrong(u)); }), test::failing);
}

TEST(TriangleWarp, StaysInside) {
    Pcg32 random(2);
    for (int i = 0; i < 10000; ++i) {
        const Vec2 b = to_triangle(random.uniform2());
        EXPECT_GE(std::min(b.x, b.y), 0);
        EXPECT_LE(b.x + b.y, 1);
    }
}

TEST(Exponential, DistancesFollowTheirDistribution) {
    for (const float rate : {1e-3f, 1.0f, 250.0f}) {
        EXPECT_GE(uniformity_of([&](const Vec2& u) { return -std::expm1(-rate * to_exponential(u.x, rate)); }),
                  test::passing);
        EXPECT_LT(uniformity_of([&](const Vec2& u) { return -std::expm1(-1.03f * rate * to_exponential(u.x, rate)); }),
                  test::failing);
    }
}

TEST(Exponential, EndsOfTheRangeAreFinite) {
    EXPECT_EQ(to_exponential(0, 2), 0);
    EXPECT_TRUE(std::isfinite(to_exponential(one_minus_epsilon, 2)));
    EXPECT_GT(to_exponential(1e-7f, 1), 0);
}

TEST(Exponential, OpticalDepthsReachBeyondWhatOneFloatCanTell) {
    Pcg32 random(5);
    EXPECT_GE(uniformity_of([&](const Vec2&) { return -std::expm1(-sample_optical_depth(random)); }), test::passing);
    EXPECT_LT(uniformity_of([&](const Vec2&) { return -std::expm1(-1.03f * sample_optical_depth(random)); }),
              test::failing);
    // Beyond ln 256 the distribution is that of the whole, moved.
    Moments beyond;
    for (int i = 0; i < 4000000; ++i) {
        const float depth = sample_optical_depth(random);
        if (depth > 5.545177f) {
            beyond.add(static_cast<double>(depth - 5.545177f));
        }
    }
    EXPECT_NEAR(beyond.count(), 4000000.0 / 256, 5 * std::sqrt(4000000.0 / 256));
    EXPECT_NEAR(beyond.mean(), 1, 5 * beyond.standard_error());
}

TEST(GoldenLattice, PointsUnderARandomShiftAreUniform) {
    for (const int i : {0, 5, 15}) {
        EXPECT_GE(uniformity_of([&](const Vec2& u) { return golden_lattice_point(i, 16, u); }), test::passing);
    }
    EXPECT_LT(uniformity_of([](const Vec2& u) { return golden_lattice_point(5, 16, u * 0.9f); }), test::failing);
}

TEST(GoldenLattice, AreEvenInBothCoordinatesAndInside) {
    constexpr int n = 64;
    for (const Vec2& shift : {Vec2(0, 0), Vec2(0.37f, 0.91f), Vec2(one_minus_epsilon, one_minus_epsilon)}) {
        std::vector<int> columns(n), cells(16);
        for (int i = 0; i < n; ++i) {
            const Vec2 p = golden_lattice_point(i, n, shift);
            ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
            ++columns[static_cast<std::size_t>(p.x * n)];
            ++cells[static_cast<std::size_t>(p.y * 16)];
        }
        // One in every column, up to rounding at their edges, and 4 ± 2 in every row of 16.
        EXPECT_LE(*std::max_element(columns.begin(), columns.end()), 2);
        EXPECT_GE(*std::min_element(cells.begin(), cells.end()), 2);
        EXPECT_LE(*std::max_element(cells.begin(), cells.end()), 6);
    }
}

}  // namespace
}  // namespace wend
