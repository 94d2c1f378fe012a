// Lamps that are seen edge on: where shadow rays begin must not decide whether they meet them.
#include <tests/support/channel_means.h>
#include <tests/support/scenes.h>

#include <wend/stats/significance.h>

#include <gtest/gtest.h>

namespace wend {
namespace {

constexpr float size = 0.5f, radiance = 100, albedo = 0.8f;

class EdgeOn : public testing::TestWithParam<float> {};

// Up to 64 renders of 16 x 16 pixels by 64 samples: a million samples.
TEST_P(EdgeOn, ALampLightsAFloorThatItNearlyTouches) {
    const float height = GetParam();
    const Vec3 corner(0.3f, height, -0.2f);
    constexpr int resolution = 16;
    // All pixels see the same place on the floor, far enough from the origin for positions to be rounded.
    const Vec3 origin(20, 3, -30);
    SceneDescription s = test::scene_with_camera(origin + Vec3(-1, 2, 0.5f), origin, 1e-3f, resolution);
    test::add_parallelogram(s, origin + Vec3(-3, 0, -3), {0, 0, 6}, {6, 0, 0}, test::add_diffuse(s, Rgb(albedo)));
    test::add_lamp(s, origin + corner, size, Rgb(radiance), test::add_diffuse(s, Rgb(0.0f)));
    const Scene scene(std::move(s));

    // Of the triangle with its legs along x and z, in strips: radiance times both cosines over the square of the way.
    double expected = 0;
    constexpr int n = 1000;
    const double step = static_cast<double>(size) / n, h = static_cast<double>(height);
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n - i; ++j) {
            const double x = static_cast<double>(corner.x) + (i + 0.5) * step;
            const double z = static_cast<double>(corner.z) + (j + 0.5) * step;
            const double square = x * x + h * h + z * z;
            const double part = j == n - i - 1 ? 0.5 : 1.0;
            expected += part * step * step * h * h / (square * square);
        }
    }
    expected *= static_cast<double>(albedo / pi * radiance);

    RenderSettings settings;
    settings.samples = 64;
    settings.max_depth = 1;
    const auto scale = [&](double) { return expected; };
    const test::ChannelMeans means = test::render_until(scene, settings, resolution, 0.0015, 64, scale);
    EXPECT_TRUE(agrees(means[0], expected, 4))
        << means[0].mean() / expected << " +- " << means[0].standard_error() / expected;
    EXPECT_LT(means[0].standard_error(), 0.002 * expected) << "too few samples to see a bias of 1 %";
}

INSTANTIATE_TEST_SUITE_P(Heights, EdgeOn, testing::Values(0.1f, 1e-2f, 1e-3f));

}  // namespace
}  // namespace wend
