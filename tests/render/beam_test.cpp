// The light of a spot's beam in fog, scattered once, against its integral along the ray.
#include <tests/support/scenes.h>

#include <wend/film/film.h>
#include <wend/numeric/quadrature.h>
#include <wend/render/render.h>
#include <wend/stats/moments.h>
#include <wend/stats/significance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace wend {
namespace {

constexpr float beam_extinction = 0.25f, beam_scattering = 0.2f, beam_mean_cosine = 0.4f;
constexpr float across = 0.02f, beam_height = 0.5f;  // where the camera's ray passes the lamp by

/// A lamp above the ray of a picture of one pixel, shining down across it and along it.
SpotLight lamp() {
    const Transform light_from_world = Transform::look_at({across, beam_height, 3}, {across, -1, 3.6f}, {1, 0, 0});
    SpotLight spot;
    spot.position = {across, beam_height, 3};
    spot.intensity = Rgb(3, 2, 1);
    spot.light_from_world = AffineMap(light_from_world);
    spot.cos_inner = std::cos(0.25f);
    spot.cos_outer = std::cos(0.35f);
    return spot;
}

/// Another one, beside the ray, that outshines the beam.
PointLight bright_lamp() {
    return {{-2, 1, 4}, Rgb(40, 50, 60)};
}

/// ∫ σs p I T / r² along the ray from (0, 0, 0) in the direction z, of a lamp at a place; `intensity_of` gives I.
template <class Intensity>
Rgb exact(const Vec3& lamp, const Intensity& intensity_of) {
    const HenyeyGreenstein phase{beam_mean_cosine};
    Rgb sum(0.0f);
    constexpr int steps = 200000;
    constexpr float end = 20;
    for (int i = 0; i < steps; ++i) {
        const Vec3 p(0, 0, end * (static_cast<float>(i) + 0.5f) / steps);
        const Vec3 from_light = p - lamp;
        const float r = length(from_light);
        const Rgb intensity = intensity_of(from_light / r);
        sum += intensity * (beam_scattering * phase.evaluate(dot(Vec3(0, 0, 1), -from_light / r)) *
                            std::exp(-beam_extinction * (p.z + r)) / (r * r) * end / steps);
    }
    return sum;
}
Rgb exact() {
    return exact(lamp().position, [](const Vec3& w) { return intensity_towards(lamp(), w); });
}

/// Up to a black wall, or without an end; `others`: lights beside the beam's.
Moments rendered(const char* preset, int samples, int channel, bool has_wall = true,
                 const std::vector<Light>& others = {}) {
    SceneDescription s = test::scene_with_camera({0, 0, 0}, {0, 0, 1}, 0.001f, 1);
    const Rgb absorbed(beam_extinction - beam_scattering);
    s.camera_medium = test::add_homogeneous(s, absorbed, Rgb(beam_scattering), beam_mean_cosine);
    const Vec3 corner(-50, -50, has_wall ? 20 : -20);
    test::add_parallelogram(s, corner, {100, 0, 0}, {0, 100, 0}, test::add_diffuse(s, Rgb(0.0f)));
    s.lights.push_back(lamp());
    s.lights.insert(s.lights.end(), others.begin(), others.end());
    const Scene scene(std::move(s));
    Moments moments;
    for (std::uint64_t seed = 0; seed < 64; ++seed) {
        Film film({1, 1}, {{0, 0}, {1, 1}});
        RenderSettings settings;
        settings.preset = parse_preset(preset);
        settings.samples = samples;
        settings.seed = seed;
        settings.max_depth = 1;
        render(scene, film, settings);
        moments.add(film.beauty().at(0, 0)[channel]);
    }
    return moments;
}

TEST(SlowBeam, EveryPresetHasItsLight) {
    // 64 renders of so many samples each.
    const Rgb expected = exact();
    ASSERT_GT(expected.g, 0);
    for (const int samples : {4, 16, 256, 1024}) {
        for (const char* preset : {"classical", "direction", "distance+direction", "full"}) {
            const Moments green = rendered(preset, samples, 1);
            EXPECT_TRUE(agrees(green, static_cast<double>(expected.g), 4, 1e-3))
                << preset << ' ' << samples << ": " << green.mean() << " +- " << green.standard_error() << ", exactly "
                << expected.g;
        }
    }
    // Beams are drawn better than by chance, and by enough samples 1 % is seen.
    EXPECT_LT(2 * rendered("distance+direction", 256, 1).standard_error(),
              rendered("classical", 256, 1).standard_error());
    EXPECT_LT(2 * rendered("distance+direction", 256, 1, false).standard_error(),
              rendered("classical", 256, 1, false).standard_error());
    const Moments guided = rendered("distance+direction", 1024, 1);
    EXPECT_LT(4 * guided.standard_error(), 0.01 * static_cast<double>(expected.g));
    EXPECT_FALSE(agrees(guided, 1.02 * static_cast<double>(expected.g), 4, 1e-3));
}

// How far a beam is trusted depends on the other lamps, and what the picture shows does not.
TEST(SlowBeam, AmongBrighterLampsEveryPresetHasTheirLight) {
    const Rgb expected =
        exact() + exact(bright_lamp().position, [](const Vec3& /*w*/) { return bright_lamp().intensity; });
    for (const int samples : {1, 4, 16, 64, 256}) {
        for (const char* preset : {"classical", "direction", "distance+direction", "full"}) {
            const Moments green = rendered(preset, samples, 1, true, {bright_lamp()});
            EXPECT_TRUE(agrees(green, static_cast<double>(expected.g), 4, 1e-3))
                << preset << ' ' << samples << ": " << green.mean() << " +- " << green.standard_error() << ", exactly "
                << expected.g;
        }
    }
    const Moments guided = rendered("distance+direction", 1024, 1, true, {bright_lamp()});
    EXPECT_LT(4 * guided.standard_error(), 0.01 * static_cast<double>(expected.g));
    EXPECT_FALSE(agrees(guided, 1.02 * static_cast<double>(expected.g), 4, 1e-3));
}

}  // namespace
}  // namespace wend
