// Estimators against answers in closed form and against independently computed reference values.
#include <tests/support/kept_means.h>
#include <tests/support/scenes.h>
#include <tests/support/slab_references.h>

#include <wend/stats/significance.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

using test::Measured;

/// |mean - expected| within z standard errors, and the standard error small enough that a bias of 1 % would be seen.
void expect_agrees(const Measured& m, double expected, double z = 4) {
    EXPECT_TRUE(agrees(m.mean, m.standard_error, expected, z, 2e-6))
        << m.mean << " +- " << m.standard_error << " expected " << expected;
    EXPECT_LT(z * m.standard_error, 0.01 * expected) << "too few walks to see a bias of 1 %";
}

TEST(WhiteFurnace, MediaAndSurfacesReturnTheEnvironment) {
    // Albedo 1 everywhere in an environment of radiance 1: the radiance is 1 along every ray.
    SceneDescription s;
    const MediumId fog = test::add_homogeneous(s, Rgb(0.0f), Rgb(2.0f), 0.6f);
    const MediumId cloud = test::add_uniform_grid(s, Box3(Vec3(1, -1, -1), Vec3(3, 1, 1)), Rgb(0.0f), Rgb(3.0f), -0.3f);
    test::add_box(s, Box3(Vec3(-1.5f), Vec3(-0.5f)), test::add_diffuse(s, Rgb(1.0f)));
    test::add_sphere(s, {-2, 1, 1}, 0.8f, test::add_interface(s), fog);
    test::add_box(s, Box3(Vec3(1, -1, -1), Vec3(3, 1, 1)), test::add_interface(s), cloud);
    test::add_sphere(s, {0, 0, 0}, 0.6f, test::add_dielectric(s, 1.5f), fog);
    test::add_sphere(s, {0, 2, 0}, 0.6f, test::add_dielectric(s, 1.4f, 0.0f), cloud);
    test::add_environment(s, Rgb(1.0f));
    const Scene scene(std::move(s));
    Pcg32 random(7);
    double sum = 0;
    double error2 = 0;
    constexpr int rays = 100;
    for (int i = 0; i < rays; ++i) {
        const Vec3 origin = Vec3(0, 0, -6) + Vec3(random.uniform() - 0.5f, random.uniform() - 0.5f, 0);
        const Vec3 target(4 * random.uniform() - 2, 4 * random.uniform() - 2, 0);
        const Measured m = test::measure_radiance(scene, {origin, normalize(target - origin)}, 10000, 1 << 30,
                                                  100 + static_cast<std::uint64_t>(i));
        sum += m.mean;
        error2 += m.standard_error * m.standard_error;
        EXPECT_TRUE(agrees(m.mean, m.standard_error, 1, 4.5, 1e-5))
            << "ray " << i << ": " << m.mean << " +- " << m.standard_error;
    }
    EXPECT_TRUE(agrees(sum / rays, std::sqrt(error2) / rays, 1, 4, 1e-5))
        << sum / rays << " +- " << std::sqrt(error2) / rays;
}

TEST(Transmittance, HomogeneousSlabFollowsBeer) {
    SceneDescription s;
    const MediumId m = test::add_homogeneous(s, {0.5f, 1.0f, 2.0f}, Rgb(0.0f));
    test::add_box(s, Box3(Vec3(-1e3f, -1e3f, 0), Vec3(1e3f, 1e3f, 1)), test::add_interface(s), m);
    test::add_environment(s, Rgb(1.0f));
    const Scene scene(std::move(s));
    for (const float cosine : {1.0f, 0.5f}) {
        const Ray ray{{0, 0, -1}, {std::sqrt(1 - cosine * cosine), 0, cosine}};
        const double expected = (std::exp(-0.5 / cosine) + std::exp(-1.0 / cosine) + std::exp(-2.0 / cosine)) / 3;
        expect_agrees(test::measure_radiance(scene, ray, {1000000, 0.0023}), expected);
    }
}

TEST(Transmittance, OfAWhiteSkyOverAFloorUnderAnAbsorber) {
    // What arrives from all sides is 2 E3(tau) of the sky, what leaves upwards is attenuated again. Connections to the
    // sky and directions that run into it share the work.
    const Rgb depth(0.2f, 0.7f, 2);
    constexpr float reflectance = 0.6f;
    double expected = 0;
    for (int c = 0; c < 3; ++c) {
        const double tau = double{depth[c]};
        const double e1 = -std::expint(-tau), e2 = std::exp(-tau) - tau * e1, e3 = (std::exp(-tau) - tau * e2) / 2;
        expected += double{reflectance} * 2 * e3 * std::exp(-tau) / 3;
    }
    for (const bool grid : {false, true}) {
        SceneDescription s;
        const Box3 box(Vec3(-1e3f, -1e3f, 0), Vec3(1e3f, 1e3f, 1));
        const MediumId m =
            grid ? test::add_uniform_grid(s, box, depth, Rgb(0.0f), 0) : test::add_homogeneous(s, depth, Rgb(0.0f));
        test::add_box(s, box, test::add_interface(s), m);
        test::add_parallelogram(s, Vec3(-1e3f, -1e3f, 1.001f), Vec3(2e3f, 0, 0), Vec3(0, 2e3f, 0),
                                test::add_diffuse(s, Rgb(reflectance)));
        test::add_environment(s, Rgb(1.0f));
        expect_agrees(test::measure_radiance(Scene(std::move(s)), {{0.1f, 0.2f, -1}, {0, 0, 1}}, {1000000, 0.0023}),
                      expected);
    }
}

TEST(Transmittance, OfAnAbsorberWhoseBoundaryIsPartlyThere) {
    // What is not there for a ray is passed, as if there were no boundary: what gets in only gets out again where the
    // next one is there. Connections to the sky and directions that run into it see the same.
    constexpr float reflectance = 0.6f;
    for (const float there : {0.0f, 0.5f, 0.9f}) {
        SceneDescription s;
        const MediumId m = test::add_homogeneous(s, Rgb(1.0f), Rgb(0.0f));
        test::add_box(s, Box3(Vec3(-1e3f, -1e3f, 0), Vec3(1e3f, 1e3f, 1)), test::add_interface(s), m);
        s.surfaces.back().alpha = s.textures.add_constant(Rgb(there));
        test::add_parallelogram(s, Vec3(-1e3f, -1e3f, 1.5f), Vec3(2e3f, 0, 0), Vec3(0, 2e3f, 0),
                                test::add_diffuse(s, Rgb(reflectance)));
        test::add_environment(s, Rgb(1.0f));
        const double e1 = -std::expint(-1.0), e2 = std::exp(-1.0) - e1, e3 = (std::exp(-1.0) - e2) / 2;
        const double passes = 1 - double{there} + sqr(double{there}) * 2 * e3;
        expect_agrees(test::measure_radiance(Scene(std::move(s)), {{0.1f, 0.2f, 1.2f}, {0, 0, 1}}, {1000000, 0.0023}),
                      double{reflectance} * passes);
    }
}

TEST(SingleScattering, OfASlabUnderParallelLight) {
    // Light from behind the camera at normal incidence, one scattering event: albedo * phase(-1) * E * (1 - exp(-2
    // tau)) / 2.
    SceneDescription s;
    const float tau = 1.3f;
    const float g = 0.4f;
    const MediumId m = test::add_homogeneous(s, Rgb(0.3f * tau), Rgb(0.7f * tau), g);
    test::add_box(s, Box3(Vec3(-1e3f, -1e3f, 0), Vec3(1e3f, 1e3f, 1)), test::add_interface(s), m);
    s.lights.push_back(DistantLight{{0, 0, -1}, Rgb(2.0f)});
    const Scene scene(std::move(s));
    const double phase = HenyeyGreenstein{g}.evaluate(-1);
    const double expected = 0.7 * phase * 2.0 * (1 - std::exp(-2 * tau)) / 2;
    expect_agrees(test::measure_radiance(scene, {{0.1f, 0.2f, -2}, {0, 0, 1}}, {200000, 0.0023}, 1), expected);
}

struct Known {
    const char* name;
    float albedo, thickness, g, ior;
    double value;  ///< radiance returned under a white sky of radiance 1, normal view, specular reflection included
};

void PrintTo(const Known& k, std::ostream* out) {
    *out << k.name;
}

/// Radiance of the upper side of a slab under a white sky that shines on it from above only.
Measured reflected(const Known& k, const test::WalkBudget& walks) {
    SceneDescription s;
    const MediumId medium =
        test::add_homogeneous(s, Rgb((1 - k.albedo) * k.thickness), Rgb(k.albedo * k.thickness), k.g);
    const int boundary = k.ior == 1 ? test::add_interface(s) : test::add_dielectric(s, k.ior);
    test::add_box(s, Box3(Vec3(-1e4f, -1e4f, 0), Vec3(1e4f, 1e4f, 1)), boundary, medium);
    // A black floor under it: what goes through is lost.
    test::add_parallelogram(s, Vec3(-1e6f, -1e6f, 1.5f), Vec3(2e6f, 0, 0), Vec3(0, 2e6f, 0),
                            test::add_diffuse(s, Rgb(0.0f)));
    test::add_environment(s, Rgb(1.0f));
    const Scene scene(std::move(s));
    return test::measure_radiance(scene, {{0.3f, 0.1f, -2}, {0, 0, 1}}, walks);
}

class DiffuseReflectance : public testing::TestWithParam<Known> {};

TEST_P(DiffuseReflectance, MatchesPublishedAndDeterministicValues) {
    const Known& k = GetParam();
    const Measured m = reflected(k, {1500000, 0.0024});
    EXPECT_TRUE(agrees(m.mean, m.standard_error, k.value, 4, 1e-5)) << m.mean << " +- " << m.standard_error;
    EXPECT_LT(4 * m.standard_error, 0.01 * k.value) << "too few walks to see a bias of 1 %";
}

// Half-spaces (as slabs of 60 mean free paths or more) and slabs at normal incidence, by H functions and
// adding-doubling.
INSTANTIATE_TEST_SUITE_P(SlowMedia, DiffuseReflectance,
                         testing::Values(Known{"HalfSpace_8", 0.8f, 60, 0, 1, 0.28525450},
                                         Known{"HalfSpace_95", 0.95f, 80, 0, 1, 0.53554099},
                                         Known{"HalfSpace_99", 0.99f, 150, 0, 1, 0.75272072},
                                         Known{"HalfSpace_8g_5", 0.8f, 80, 0.5f, 1, 0.161535},
                                         Known{"HalfSpace_95g_75", 0.95f, 150, 0.75f, 1, 0.276766},
                                         Known{"HalfSpace_99g_9", 0.99f, 400, 0.9f, 1, 0.399541},
                                         Known{"HalfSpace_95gMinus3", 0.95f, 80, -0.3f, 1, 0.584095},
                                         Known{"HalfSpace_9n1_5", 0.9f, 60, 0, 1.5f, 0.2599186},
                                         Known{"HalfSpace_8n1_4", 0.8f, 60, 0, 1.4f, 0.1808231},
                                         Known{"Slabb2_95", 0.95f, 2, 0, 1, 0.428724},
                                         Known{"Slabb1_8", 0.8f, 1, 0, 1, 0.210847},
                                         Known{"Slabb4_95g_75", 0.95f, 4, 0.75f, 1, 0.203461}),
                         [](const auto& known) { return std::string(known.param.name); });

TEST(SlowSlabReflectance, MatchesTheReferenceTable) {
    const std::vector<test::SlabReference> references = test::slab_references();
    int rows = 0;
    for (const test::SlabReference& row : references) {
        if (!row.is_normal_beam()) {
            continue;
        }
        const Known k{"csv", static_cast<float>(row.albedo), static_cast<float>(row.thickness), 0, 1, row.reflectance};
        const Measured m = reflected(k, {400000, 0.0024});
        EXPECT_TRUE(agrees(m.mean, m.standard_error, k.value, 4, 1e-5))
            << row.text << ": " << m.mean << " +- " << m.standard_error;
        EXPECT_LT(4 * m.standard_error, 0.01 * k.value) << row.text;
        ++rows;
    }
    EXPECT_EQ(rows, 12);
}

TEST(SlowGridMedium, IsTheSameAsTheHomogeneousOne) {
    const Box3 box(Vec3(-1), Vec3(1));
    for (const float g : {0.0f, 0.8f}) {
        const auto measure = [&](bool is_grid, const test::WalkBudget& walks) {
            SceneDescription s;
            const Rgb absorption(0.1f, 0.3f, 0.8f);
            const Rgb scattering(3.0f, 1.5f, 0.4f);
            const MediumId medium = is_grid ? test::add_uniform_grid(s, box, absorption, scattering, g)
                                            : test::add_homogeneous(s, absorption, scattering, g);
            test::add_box(s, box, test::add_interface(s), medium);
            s.lights.push_back(PointLight{{0.5f, 2, -1}, Rgb(2.0f)});
            test::add_environment(s, {1.0f, 0.8f, 0.6f});
            return test::measure_radiance(Scene(std::move(s)), {{0.2f, 0.1f, -4}, normalize(Vec3(0, 0.1f, 1))}, walks,
                                          1000, is_grid ? 6 : 5);
        };
        const test::KnownMean expected = test::kept_means(g > 0 ? "forward_medium" : "isotropic_medium", [&] {
                                             const Measured m = measure(false, 2'000'000);
                                             return std::vector{test::KnownMean{m.mean, m.standard_error}};
                                         }).front();
        const Measured grid = measure(true, {500000, 0.0023});
        const double error = std::hypot(grid.standard_error, expected.standard_error);
        EXPECT_TRUE(agrees(grid.mean - expected.mean, error, 0, 4))
            << grid.mean << " and " << expected.mean << " +- " << error;
        EXPECT_LT(4 * error, 0.01 * expected.mean);
    }
}

TEST(Emission, OfAHomogeneousMediumIsItsLineIntegral) {
    SceneDescription s;
    s.media.push_back(HomogeneousMedium{{0.5f, 1.0f, 2.0f}, Rgb(0.0f), {0.5f, 1.0f, 2.0f}, {}});
    test::add_box(s, Box3(Vec3(-1), Vec3(1)), test::add_interface(s), 0);
    const Scene scene(std::move(s));
    const Measured m = test::measure_radiance(scene, {{0, 0, -3}, {0, 0, 1}}, 100);
    EXPECT_NEAR(m.mean, 1 - (std::exp(-1.0) + std::exp(-2.0) + std::exp(-4.0)) / 3, 1e-5);
}

}  // namespace
}  // namespace wend
