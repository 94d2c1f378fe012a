// Light that smooth surfaces lead to a place, against walks and closed forms, and what guides make of it.
#include <tests/support/repeated_renders.h>
#include <tests/support/scenes.h>

#include <wend/light/caustic_photons.h>
#include <wend/medium/fresnel.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

/// What is seen of a light from a place by way of what refracts or reflects it.
struct CausticSight {
    Vec3 towards{0, 0, 0};  ///< from the place, unit length
    float distance = 0;     ///< of the light, along the way
    Rgb fluence;            ///< an estimate of that of all such light
};

/// Of what caustic lobes lie in, where they lie on a surface with that normal, and otherwise in all directions.
float extent(const Vec3& size, const Vec3& normal) {
    const float volume = size.x * size.y * size.z;
    if (normal == Vec3(0, 0, 0)) {
        return volume;
    }
    const Vec3 n(std::abs(normal.x), std::abs(normal.y), std::abs(normal.z));
    return n.x > n.y && n.x > n.z ? size.y * size.z / n.x : n.y > n.z ? size.x * size.z / n.y : size.x * size.y / n.z;
}

/// What one group of photons, by chance of those close by, tells of a place on a surface, on the side of the normal, or
/// in a medium, where the normal is zero. Nothing if there is none.
std::optional<CausticSight> look(const CausticPhotons& photons, const Vec3& position, const Vec3& normal,
                                 Pcg32& random) {
    const bool in_volume = normal == Vec3(0, 0, 0);
    const CausticMap::Cell* cell = (in_volume ? photons.in_media() : photons.on_surfaces()).find(position);
    if (!cell) {
        return std::nullopt;
    }
    const CausticMap::Group& group =
        cell->groups[static_cast<std::size_t>(random.uniform() * static_cast<float>(cell->count))];
    // As a plane mirror shows it: a field takes distances for those of what lies straight ahead.
    const Vec3 way = group.image - position;
    const float distance = length(way);
    const Vec3 towards = way * (1 / distance);
    const float cosine = in_volume ? 1.0f : dot(towards, normal);
    const float size = extent(cell->extent, normal) * std::max(cosine, 0.1f);
    if (!(cosine > 0) || !(size > 0) || !(distance > 0)) {
        return std::nullopt;
    }
    return CausticSight{towards, distance, group.light * (static_cast<float>(cell->count) / size)};
}

constexpr float ior = 1.5f;
constexpr int photons = 1 << 18;

/// A triangle that shines with radiance 1, and a black ground for it.
SceneDescription with_lamp(const Vec3& corner, float size, int resolution = 1) {
    SceneDescription s = test::scene_with_camera({0, 2, -4}, {0, 2, 0}, 1, resolution);
    test::add_lamp(s, corner, size, Rgb(1.0f), test::add_diffuse(s, Rgb(0.0f)));
    return s;
}

/// The mean of what photons tell of the light that arrives around a place, times `weight` of its direction.
template <class Weight>
double mean_light(const CausticPhotons& caustics, const Vec3& centre, const Vec3& normal, float radius,
                  const Weight& weight) {
    constexpr int n = 20000;
    Pcg32 random(2);
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        const Vec2 away = to_disk(random.uniform2()) * radius;
        if (const auto seen = look(caustics, centre + Vec3(away.x, 0, away.y), normal, random)) {
            sum += static_cast<double>(mean_value(seen->fluence) * weight(seen->towards));
        }
    }
    return sum / n;
}

TEST(SlowCausticPhotons, TellTheIrradianceBehindAPane) {
    constexpr float albedo = 0.5f;
    SceneDescription s = with_lamp({0.2f, 4, -0.4f}, 1);
    test::add_box(s, Box3(Vec3(-1, 1, -1), Vec3(1, 1.2f, 1)), test::add_dielectric(s, ior));
    // Too small to be lit past the pane.
    test::add_parallelogram(s, {-0.4f, 0, -0.4f}, {0, 0, 0.8f}, {0.8f, 0, 0}, test::add_diffuse(s, Rgb(albedo)));
    const Scene scene(std::move(s));

    const CausticPhotons caustics(scene, photons, 1, 0);
    const double told = mean_light(caustics, {0, 0, 0}, {0, 1, 0}, 0.3f, [](const Vec3& towards) { return towards.y; });
    const Vec3 eye(0, 0.5f, -0.5f);
    const auto walked = test::measure_radiance(scene, {eye, normalize(-eye)}, 3'000'000, 20);
    const double irradiance = walked.mean * static_cast<double>(pi / albedo);
    EXPECT_LT(walked.standard_error, 0.01 * walked.mean);
    EXPECT_NEAR(told, irradiance, 0.05 * irradiance);
}

TEST(CausticPhotons, TellTheFluenceInALiquid) {
    constexpr float size = 0.2f, height = 3, depth = 0.5f;
    const Rgb absorption(0.3f), scattering(0.7f);
    SceneDescription s = with_lamp({-size / 3, height, -size / 3}, size);
    const MediumId liquid = test::add_homogeneous(s, absorption, scattering);
    test::add_box(s, Box3(Vec3(-1, -2, -1), Vec3(1, 0, 1)), test::add_dielectric(s, ior), liquid);
    const Scene scene(std::move(s));

    const CausticPhotons caustics(scene, 8 * photons, 1, 0);
    const double told =
        mean_light(caustics, {0, -depth, 0}, {0, 0, 0}, 0.2f, [](const Vec3& towards) { return towards.y > 0; });
    // Beneath the surface the lamp seems to be farther away, by the index.
    const float above = 0.5f * sqr(size / height) * (1 - fresnel_dielectric(1.0f, ior));
    const float expected = above * sqr(height / (height + depth / ior)) * std::exp(-depth);
    EXPECT_NEAR(told, expected, 0.08 * expected);
}

TEST(CausticPhotons, SeeTheLampInAMirror) {
    constexpr float height = 2, size = 0.5f;
    const Vec3 corner(0.3f, height, -0.2f);
    SceneDescription s = with_lamp(corner, size);
    // What refracts does not come back.
    const MediumId dark = test::add_homogeneous(s, Rgb(100.0f), Rgb(0.0f));
    test::add_box(s, Box3(Vec3(-3, -1, -3), Vec3(3, 0, 3)), test::add_dielectric(s, ior), dark);
    test::add_parallelogram(s, {-3, 3, -3}, {6, 0, 0}, {0, 0, 6}, test::add_diffuse(s, Rgb(0.5f)));
    const Scene scene(std::move(s));

    const CausticPhotons caustics(scene, photons, 1, 0);
    Pcg32 random(3);
    Vec3 sum(0, 0, 0);
    constexpr int n = 4000;
    for (int i = 0; i < n; ++i) {
        const Vec2 u = random.uniform2() * 2.0f - Vec2(1, 1);
        const auto sight = look(caustics, {u.x, 3, u.y}, {0, -1, 0}, random);
        ASSERT_TRUE(sight);
        EXPECT_FALSE(look(caustics, {u.x, 3, u.y}, {0, 1, 0}, random)) << "nothing comes from above";
        const Vec3 met = Vec3(u.x, 3, u.y) + sight->towards * sight->distance;
        EXPECT_NEAR(met.y, -height, 1e-3f);
        sum += met;
    }
    // A photon arrived beside the place that asks, on any side of it.
    EXPECT_NEAR(sum.x / n, corner.x + size / 3, 0.03f);
    EXPECT_NEAR(sum.z / n, corner.z + size / 3, 0.03f);
}

TEST(CausticPhotons, AreNoneWhereNothingIsSmooth) {
    SceneDescription s = with_lamp({0, 4, 0}, 1);
    test::add_box(s, Box3(Vec3(-1, 1, -1), Vec3(1, 1.2f, 1)), test::add_dielectric(s, ior, 0.3f));
    test::add_sphere(s, {0, 0, 0}, 0.5f, test::add_diffuse(s, Rgb(0.5f)));
    const Scene scene(std::move(s));
    const CausticPhotons caustics(scene, photons, 1, 0);
    EXPECT_EQ(caustics.size(), 0u);
    Pcg32 random(1);
    EXPECT_FALSE(look(caustics, {0, 0.5f, 0}, {0, 1, 0}, random));
    EXPECT_FALSE(look(CausticPhotons(), {0, 0.5f, 0}, {0, 0, 0}, random));
}

TEST(CausticPhotons, DoNotDependOnThreads) {
    SceneDescription s = with_lamp({0, 4, 0}, 1);
    test::add_box(s, Box3(Vec3(-1, 1, -1), Vec3(1, 1.2f, 1)), test::add_dielectric(s, ior));
    test::add_sphere(s, {0, 0, 0}, 0.5f, test::add_diffuse(s, Rgb(0.5f)));
    const Scene scene(std::move(s));
    const CausticPhotons one(scene, 10000, 1, 1), several(scene, 10000, 1, 3);
    ASSERT_GT(one.size(), 100u);
    EXPECT_EQ(one.size(), several.size());
    Pcg32 a(1), b(1), nowhere(1);
    EXPECT_FALSE(look(one, {0, 0.5f, 0}, {0, 0, 0}, nowhere)) << "there is no medium";
    for (int i = 0; i < 100; ++i) {
        const auto first = look(one, {0, 0.5f, 0}, {0, 1, 0}, a), second = look(several, {0, 0.5f, 0}, {0, 1, 0}, b);
        ASSERT_EQ(first.has_value(), second.has_value());
        if (first) {
            EXPECT_EQ(first->towards, second->towards);
            EXPECT_EQ(first->fluence, second->fluence);
        }
    }
}

// Four classical renders of 8 x 8 pixels by 4096 samples each, whose noise is a thousand times as much, and two ways of
// guiding by sixteen or more: 11 million samples. The guided means have standard errors of 0.15 %.
TEST(SlowCausticPhotons, TeachTheGuideOfWhatAMirrorShows) {
    constexpr int resolution = 8;
    constexpr float size = 0.5f, radiance = 20, albedo = 0.5f;
    const Vec3 corner(0.3f, 2, -0.2f), place(0, 3, 0);
    // All pixels see the same place on the ceiling.
    SceneDescription s = test::scene_with_camera({1, 1, -2}, place, 0.3f, resolution);
    test::add_lamp(s, corner, size, Rgb(radiance), test::add_diffuse(s, Rgb(0.0f)));
    const MediumId dark = test::add_homogeneous(s, Rgb(100.0f), Rgb(0.0f));
    test::add_box(s, Box3(Vec3(-3, -1, -3), Vec3(3, 0, 3)), test::add_dielectric(s, ior), dark);
    test::add_parallelogram(s, {-3, 3, -3}, {6, 0, 0}, {0, 0, 6}, test::add_diffuse(s, Rgb(albedo)));
    // Keeps the lamp from the ceiling.
    test::add_box(s, Box3(Vec3(0.25f, 2.05f, -0.25f), Vec3(0.85f, 2.1f, 0.35f)), test::add_diffuse(s, Rgb(0.0f)));
    const Scene scene(std::move(s));

    double expected = 0;
    constexpr int n = 100;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n - i; ++j) {
            // Two triangles of the lamp's picture beneath the floor, in the last row one.
            const float part = (j == n - i - 1 ? 0.5f : 1.0f) * sqr(size / n);
            const Vec3 on = corner + Vec3(static_cast<float>(i) + 0.5f, 0, static_cast<float>(j) + 0.5f) * (size / n);
            const Vec3 way = Vec3(on.x, -on.y, on.z) - place;
            const float cosine = -way.y / length(way);
            expected += static_cast<double>(albedo / pi * radiance * fresnel_dielectric(cosine, ior) * sqr(cosine) /
                                            length_squared(way) * part);
        }
    }

    RenderSettings settings;
    settings.samples = 4096;
    settings.max_depth = 2;
    settings.seed = 1000;
    test::expect_right_and_quieter(scene, settings, resolution, expected, 0.02);
}

}  // namespace
}  // namespace wend
