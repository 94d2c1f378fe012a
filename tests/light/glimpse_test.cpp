// Lights seen through glass, against rays traced by hand, and what guides make of them.
#include <tests/support/repeated_renders.h>
#include <tests/support/scenes.h>

#include <wend/light/glimpse.h>
#include <wend/medium/fresnel.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace wend {
namespace {

constexpr float ior = 1.5f;
constexpr float lamp_size = 0.1f;

std::optional<Glimpse> look(const SceneDescription& description, const Vec3& from, const Vec3& at,
                            MediumId medium = vacuum) {
    const Scene scene{SceneDescription(description)};
    Pcg32 random(1);
    const Vec3 way = at - from;
    return glimpse(scene, {from, normalize(way)}, length(way), MediumState(medium), random);
}

/// Under a triangle of a lamp in the plane y = 4, and what lies between.
SceneDescription under_lamp(const Vec3& corner, const std::function<void(SceneDescription&)>& add) {
    SceneDescription s = test::scene_with_camera({0, 0, 0}, {0, 1, 1}, 40, 8);
    test::add_lamp(s, corner, lamp_size, Rgb(1.0f), test::add_diffuse(s, Rgb(0.0f)));
    add(s);
    return s;
}

Vec3 middle_of(const Vec3& corner) {
    return corner + Vec3(lamp_size, 0, lamp_size) * 0.3f;
}

void expect_on_lamp(const Vec3& met, const Vec3& corner) {
    const Vec3 beyond = met - corner;
    EXPECT_GT(std::min(beyond.x, beyond.z), -1e-4f);
    EXPECT_LT(beyond.x + beyond.z, lamp_size + 1e-4f);
}

/// How far from the way's foot a ray is at height 4 that leaves at the sine `sine` to the vertical and passes a pane.
float away_behind_pane(float sine, float thickness) {
    const float inside = sine / ior;
    return (4 - thickness) * sine / std::sqrt(1 - sine * sine) + thickness * inside / std::sqrt(1 - inside * inside);
}

TEST(Glimpse, GoesStraightThroughAPane) {
    const Vec3 corner(1.5f, 4, -0.7f);
    const SceneDescription s = under_lamp(corner, [](SceneDescription& d) {
        test::add_box(d, Box3(Vec3(-9, 1, -9), Vec3(9, 1.8f, 9)), test::add_dielectric(d, ior));
    });
    const auto seen = look(s, {0, 0, 0}, middle_of(corner));
    ASSERT_TRUE(seen);
    const Vec3 w = seen->direction;
    const float sine = std::hypot(w.x, w.z), away = away_behind_pane(sine, 0.8f);
    expect_on_lamp(Vec3(w.x, 0, w.z) * (away / sine) + Vec3(0, 4, 0), corner);
    const float once = 1 - fresnel_dielectric(w.y, ior);
    EXPECT_NEAR(seen->transmittance.r, once * once, 1e-4f);
}

TEST(Glimpse, IsDeflectedByABall) {
    const Vec3 corner(0.5f, 4, 0.3f), centre(0.2f, 1.6f, 0);
    constexpr float radius = 0.5f, weak = 1.1f;
    const SceneDescription s = under_lamp(
        corner, [&](SceneDescription& d) { test::add_sphere(d, centre, radius, test::add_dielectric(d, weak)); });
    const auto seen = look(s, {0, 0, 0}, middle_of(corner));
    ASSERT_TRUE(seen);
    EXPECT_LT(dot(seen->direction, normalize(middle_of(corner))), 0.9999f) << "not where it seems to be";
    // In the plane of the ball's centre, a chord turns the ray by the same angle at either end.
    const Vec3 w = seen->direction;
    const float along = dot(centre, w);
    const Vec3 across = (centre - w * along) / length(centre - w * along);
    const float before = std::asin(length(centre - w * along) / radius),
                turned = before - std::asin(std::sin(before) / weak);
    const float first = along - radius * std::cos(before);
    const auto rotated = [&](float angle) { return w * std::cos(angle) + across * std::sin(angle); };
    const Vec3 chord = rotated(turned), last = rotated(2 * turned);
    const Vec3 out = w * first + chord * (2 * radius * std::cos(before - turned));
    expect_on_lamp(out + last * ((4 - out.y) / last.y), corner);
}

TEST(Glimpse, LooksOutOfALiquid) {
    const Vec3 corner(1.5f, 4, -0.7f);
    constexpr float absorption = 0.3f;
    MediumId liquid = vacuum;
    const SceneDescription s = under_lamp(corner, [&](SceneDescription& d) {
        liquid = test::add_homogeneous(d, Rgb(absorption), Rgb(0.0f));
        test::add_box(d, Box3(Vec3(-9, -9, -9), Vec3(9, 1, 9)), test::add_dielectric(d, ior), liquid);
    });
    const auto seen = look(s, {0, 0, 0}, middle_of(corner), liquid);
    ASSERT_TRUE(seen);
    const Vec3 w = seen->direction;
    const float sine = std::hypot(w.x, w.z), outside = sine * ior;
    const float away = sine / w.y + 3 * outside / std::sqrt(1 - outside * outside);
    expect_on_lamp(Vec3(w.x, 0, w.z) * (away / sine) + Vec3(0, 4, 0), corner);
    EXPECT_NEAR(seen->transmittance.g, (1 - fresnel_dielectric(-w.y, ior)) * std::exp(-absorption / w.y), 1e-4f);
}

TEST(Glimpse, FindsDistantLightBehindAPrism) {
    SceneDescription s = test::scene_with_camera({0, 0, 0}, {0, 1, 1}, 40, 8);
    test::add_environment(s, Rgb(1.0f));
    const Vec3 tilted = normalize(Vec3(0.2f, 1, 0));
    const int glass = test::add_dielectric(s, ior);
    test::add_parallelogram(s, {-9, 1, -9}, {18, 0, 0}, {0, 0, 18}, glass);
    test::add_parallelogram(s, {-9, 3.8f, -9}, {0, 0, 18}, {18, -3.6f, 0}, glass);
    const Scene scene{std::move(s)};
    Pcg32 random(1);
    const Vec3 target = normalize(Vec3(0.1f, 1, 0.3f));
    const auto seen = glimpse(scene, {{0, 0, 0}, target}, infinity, {}, random);
    ASSERT_TRUE(seen);
    const auto in = refract(-seen->direction, {0, -1, 0}, ior);
    ASSERT_TRUE(in);
    const auto out = refract(-in->direction, tilted, ior);
    ASSERT_TRUE(out);
    EXPECT_GT(dot(out->direction, target), 0.9997f);
    EXPECT_LT(dot(seen->direction, target), 0.9997f);
}

TEST(Glimpse, IsNothingWhereTheWayIsBlockedOrClear) {
    const Vec3 corner(0.5f, 4, 0.3f);
    const auto pane = [](SceneDescription& d) {
        test::add_box(d, Box3(Vec3(-9, 1, -9), Vec3(9, 1.2f, 9)), test::add_dielectric(d, ior));
    };
    const auto plate = [](SceneDescription& d) {
        test::add_box(d, Box3(Vec3(-9, 2, -9), Vec3(9, 2.2f, 9)), test::add_diffuse(d, Rgb(0.5f)));
    };
    EXPECT_TRUE(look(under_lamp(corner, pane), {0, 0, 0}, middle_of(corner)));
    EXPECT_FALSE(look(under_lamp(corner, [](SceneDescription&) {}), {0, 0, 0}, middle_of(corner)));
    EXPECT_FALSE(look(under_lamp(corner, plate), {0, 0, 0}, middle_of(corner)));
    const SceneDescription both = under_lamp(corner, [&](SceneDescription& d) {
        pane(d);
        plate(d);
    });
    EXPECT_FALSE(look(both, {0, 0, 0}, middle_of(corner)));
}

// Three ways, eight renders of 8 x 8 pixels by 4096 samples each: 6 million samples.
TEST(SlowGlimpse, TeachesTheGuideOfALampBehindGlass) {
    constexpr int resolution = 8;
    constexpr float thickness = 0.2f, size = 0.3f, radiance = 10, albedo = 0.5f;
    const Vec3 corner(1.2f, 4, -0.4f);
    // All pixels see the same place on the floor.
    SceneDescription s = test::scene_with_camera({0, 0.9f, -2}, {0, 0, 0}, 0.3f, resolution);
    const int grey = test::add_diffuse(s, Rgb(albedo));
    test::add_parallelogram(s, {-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, grey);
    test::add_box(s, Box3(Vec3(-9, 1.2f, -9), Vec3(9, 1.2f + thickness, 9)), test::add_dielectric(s, ior));
    test::add_lamp(s, corner, size, Rgb(radiance), grey);
    const Scene scene(std::move(s));

    double expected = 0;
    constexpr int n = 2000;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            // The projected hemisphere, as a square.
            const Vec2 disk(2 * (static_cast<float>(i) + 0.5f) / n - 1, 2 * (static_cast<float>(j) + 0.5f) / n - 1);
            const float sine = std::hypot(disk.x, disk.y);
            if (sine >= 0.9f) {
                continue;
            }
            const Vec2 met = disk * (away_behind_pane(sine, thickness) / sine) - Vec2(corner.x, corner.z);
            if (met.x > 0 && met.y > 0 && met.x + met.y < size) {
                const float through = 1 - fresnel_dielectric(std::sqrt(1 - sine * sine), ior);
                expected += static_cast<double>(albedo / pi * radiance * through * through * sqr(2.0f / n));
            }
        }
    }

    RenderSettings settings;
    settings.samples = 4096;
    // The floor and both sides of the pane: what is reflected in between is left out.
    settings.max_depth = 3;
    settings.seed = 1000;
    test::expect_right_and_quieter(scene, settings, resolution, expected, 0.02);
}

}  // namespace
}  // namespace wend
