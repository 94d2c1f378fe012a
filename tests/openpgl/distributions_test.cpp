// Sampling distributions: samples follow densities, products are what they say, and radiance adds up.
#include <tests/guide/sphere_integral.h>
#include <tests/openpgl/training.h>
#include <tests/support/chi_square_sphere.h>

#include <gtest/gtest.h>

namespace wend::test {
namespace {

const pgl_point3f somewhere{0.4f, 0.5f, 0.6f};

template <class Distribution>
SphereTest samples_against(const Distribution& samples, const DirectionDensity& density) {
    return chi_square_sphere([&](const Vec2& u) { return to_vector(samples.Sample(pgl::Point2(u.x, u.y))); }, density);
}
template <class Distribution>
DirectionDensity density_of(const Distribution& distribution) {
    return [&](const Vec3& w) { return distribution.PDF(to_pgl(w)); };
}

// 200,000 samples each; a density that is 1 % off on one side of the sphere would be 4 standard errors away.
TEST(OpenPglDistributions, SamplesFollowTheDensity) {
    TrainedRenderer renderer;
    float u = 0.5f;
    pgl::SurfaceSamplingDistribution surface(&renderer.field);
    ASSERT_TRUE(surface.Init(&renderer.field, somewhere, u));
    const SphereTest plain = samples_against(surface, density_of(surface));
    EXPECT_TRUE(follows_density(plain, "openpgl_surface", 4));
    surface.ApplyCosineProduct({0, 0.6f, 0.8f});
    EXPECT_TRUE(follows_density(samples_against(surface, density_of(surface)), "openpgl_cosine", 4));
    // The twin: without the product the density is another.
    EXPECT_FALSE(
        follows_density(samples_against(surface, [&](const Vec3& w) { return surface.IncomingRadiancePDF(to_pgl(w)); }),
                        "openpgl_twin", 4));

    pgl::VolumeSamplingDistribution volume(&renderer.field);
    ASSERT_TRUE(volume.Init(&renderer.field, somewhere, u));
    for (const float g : {0.7f, -0.4f}) {
        volume.ApplySingleLobeHenyeyGreensteinProduct({0, 0.6f, 0.8f}, g);
        EXPECT_TRUE(follows_density(samples_against(volume, density_of(volume)), "openpgl_phase", 4)) << g;
    }
}

TEST(OpenPglDistributions, ADensityComesWithItsSample) {
    TrainedRenderer renderer;
    float u = 0.25f;
    pgl::VolumeSamplingDistribution volume(&renderer.field);
    ASSERT_TRUE(volume.Init(&renderer.field, somewhere, u));
    EXPECT_EQ(u, 0.25f);
    volume.ApplySingleLobeHenyeyGreensteinProduct({1, 0, 0}, 0.5f);
    Pcg32 random(1);
    for (int i = 0; i < 100; ++i) {
        const Vec2 point = random.uniform2();
        pgl_vec3f w;
        const float density = volume.SamplePDF({point.x, point.y}, w);
        const pgl_vec3f same = volume.Sample({point.x, point.y});
        EXPECT_EQ(to_vector(w), to_vector(same));
        EXPECT_EQ(density, volume.PDF(w));
        EXPECT_NEAR(length(to_vector(w)), 1, 1e-5f);
    }
}

TEST(OpenPglDistributions, RadianceAddsUp) {
    TrainedRenderer renderer;
    float u = 0;
    pgl::VolumeSamplingDistribution volume(&renderer.field);
    ASSERT_TRUE(volume.Init(&renderer.field, somewhere, u));
    pgl::SurfaceSamplingDistribution surface(&renderer.field);
    ASSERT_TRUE(surface.Init(&renderer.field, somewhere, u));
    const Vec3 before(0.6f, 0, 0.8f), normal(0, 0.6f, 0.8f);
    const float g = 0.5f;
    const auto radiance = [&](const Vec3& w) { return volume.IncomingRadiance(to_pgl(w), true).y; };
    const double fluence = integrate_sphere(radiance), true_fluence = integrate_sphere(made_up_radiance);
    const double density = integrate_sphere([&](const Vec3& w) { return volume.IncomingRadiancePDF(to_pgl(w)); });
    const double scattered = integrate_sphere([&](const Vec3& w) {
        const float d = 1 + g * g - 2 * g * dot(before, w);
        return radiance(w) * (1 - g * g) * inv_4pi / (d * std::sqrt(d));
    });
    const double irradiance = integrate_sphere(
        [&](const Vec3& w) { return surface.IncomingRadiance(to_pgl(w), true).y * std::max(0.0f, dot(normal, w)); });
    EXPECT_NEAR(density, 1, 0.002);
    EXPECT_NEAR(volume.Fluence(true).y / fluence, 1, 0.002);
    // 20,000 samples, of which a cell has some thousand.
    EXPECT_NEAR(volume.Fluence(true).y / true_fluence, 1, 0.15);
    // What the lobes are off from the function, and from the cosine.
    EXPECT_NEAR(volume.InscatteredRadiance(to_pgl(-before), g, true).y / scattered, 1, 0.03);
    EXPECT_NEAR(surface.Irradiance(to_pgl(normal), true).y / irradiance, 1, 0.15);
    EXPECT_EQ(surface.OutgoingRadiance(to_pgl(normal)).y, 0);
    EXPECT_EQ(surface.VolumeScatterProbability(to_pgl(normal), true), -1);
}

TEST(OpenPglDistributions, AProductFavoursWhatScatters) {
    TrainedRenderer renderer;
    float u = 0;
    pgl::SurfaceSamplingDistribution surface(&renderer.field);
    ASSERT_TRUE(surface.Init(&renderer.field, somewhere, u));
    const pgl_vec3f down{0, 0, -1}, up{0, 0, 1};
    const float before = surface.IncomingRadiancePDF(up);
    surface.ApplyCosineProduct(up);
    EXPECT_GT(surface.PDF(up), before);
    EXPECT_EQ(surface.IncomingRadiancePDF(up), before);
    // The last product counts.
    surface.ApplyCosineProduct(down);
    EXPECT_LT(surface.PDF(up), before);
    EXPECT_TRUE(surface.SupportsApplyCosineProduct());
    // A normal that is none is not multiplied with.
    const float kept = surface.PDF(up);
    surface.ApplyCosineProduct({0, 0, 0});
    EXPECT_EQ(surface.PDF(up), kept);
}

TEST(OpenPglDistributions, KnowNothingBeforeAndAfter) {
    Renderer renderer;
    pgl::Field field(&renderer.device, renderer.config);
    pgl::SurfaceSamplingDistribution surface(&field);
    float u = 0.5f;
    EXPECT_FALSE(surface.Init(&field, somewhere, u));
    EXPECT_FALSE(surface.Validate());
    EXPECT_FLOAT_EQ(surface.PDF({0, 0, 1}), inv_4pi);
    renderer.add(made_up_samples(5000));
    field.Update(renderer.samples);
    EXPECT_TRUE(surface.Init(&field, somewhere, u, true));
    EXPECT_TRUE(surface.Validate());
    EXPECT_NE(surface.PDF({0, 0, 1}), inv_4pi);
    // It keeps what it knows when the field forgets.
    const float density = surface.PDF({0, 0, 1});
    field.Reset();
    EXPECT_EQ(surface.PDF({0, 0, 1}), density);
    EXPECT_FALSE(surface.Init(&field, {NAN, 0, 0}, u));
    surface.Clear();
    EXPECT_FALSE(surface.Validate());
}

TEST(OpenPglDistributions, CellsHaveNumbers) {
    TrainedRenderer renderer(200000);
    pgl::SurfaceSamplingDistribution surface(&renderer.field);
    float u = 0;
    ASSERT_TRUE(surface.Init(&renderer.field, {0.01f, 0.01f, 0.01f}, u));
    const std::uint32_t first = surface.GetId();
    ASSERT_TRUE(surface.Init(&renderer.field, {0.99f, 0.99f, 0.99f}, u));
    EXPECT_NE(surface.GetId(), first);
}

}  // namespace
}  // namespace wend::test
