// Points on boundaries: where they lie, and how curved the boundary is there.
#include "small_scene.h"

#include <wend/scene/boundary_points.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace wend {
namespace {

using test::interface;

std::vector<BoundaryPoint> points_of(Shape shape, bool medium_is_outside = false) {
    SceneDescription scene = test::two_materials();
    scene.media.emplace_back(HomogeneousMedium{Rgb(1.0f), Rgb(9.0f), Rgb(0.0f), PhaseFunction()});
    Surface& surface = test::add(scene, std::move(shape), interface);
    (medium_is_outside ? surface.exterior : surface.interior) = 0;
    return boundary_points(scene, 0, 1000, 1);
}

Quadric ball(float radius) {
    return Quadric(Sphere{radius, -radius, radius}, Transform::translate(3, 0, 1));
}

float mean_of(const std::vector<float>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0f) / static_cast<float>(values.size());
}

TEST(MeanCurvature, OfABallIsThatOfItsRadius) {
    const std::vector<BoundaryPoint> points = points_of(ball(0.25f));
    ASSERT_EQ(points.size(), 1000u);
    for (const float curvature : mean_curvatures(points)) {
        EXPECT_NEAR(curvature, 4, 1e-3f);
    }
}

TEST(MeanCurvature, OfAHollowIsNegative) {
    for (const float curvature : mean_curvatures(points_of(ball(0.5f), true))) {
        EXPECT_NEAR(curvature, -2, 1e-3f);
    }
}

TEST(MeanCurvature, OfAThinPlateIsNoneButAtItsEdges) {
    // The other side is nearer than most neighbours, and must not count.
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.positions.emplace_back((i & 1) ? 1.0f : -1.0f, (i & 2) ? 1.0f : -1.0f, (i & 4) ? 0.005f : -0.005f);
    }
    mesh.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                    2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    const std::vector<BoundaryPoint> points = points_of(std::move(mesh));
    const std::vector<float> curvatures = mean_curvatures(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (std::abs(points[i].normal.z) > 0.5f) {
            EXPECT_NEAR(curvatures[i], 0, 1e-4f) << points[i].position;
        }
    }
}

TEST(MeanCurvature, OfAnEllipsoidIsItsMean) {
    // The integral of the mean curvature over a convex body's boundary is 2 pi times its mean width.
    const double e = std::sqrt(1 - 1 / 2.25);
    const double pi_ = static_cast<double>(pi);
    const double area = 2 * pi_ * (1 + 1.5 / e * std::asin(e));
    // Half of the mean width: the mean of sqrt(1 + 1.25 mu²) over mu in [0, 1].
    double width = 0;
    for (int i = 0; i < 1000; ++i) {
        width += std::sqrt(1 + 1.25 * (i + 0.5) * (i + 0.5) * 1e-6) / 1000;
    }
    EXPECT_NEAR(mean_of(mean_curvatures(points_of(Quadric(Sphere{1, -1, 1}, Transform::scale(1, 1, 1.5))))),
                4 * pi_ * width / area, 0.03);
}

TEST(MeanCurvature, OfFewPointsIsNone) {
    EXPECT_TRUE(mean_curvatures({}).empty());
    const std::vector<BoundaryPoint> one = {{{1, 2, 3}, {0, 0, 1}}};
    EXPECT_EQ(mean_curvatures(one), std::vector<float>{0});
    const std::vector<BoundaryPoint> twice = {one[0], one[0]};
    EXPECT_EQ(mean_curvatures(twice), (std::vector<float>{0, 0}));
}

}  // namespace
}  // namespace wend
