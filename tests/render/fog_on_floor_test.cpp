// A box of fog stands on a floor: its underside and the floor are in one place, and which of them a ray meets first
// must not matter.
#include <tests/support/scenes.h>

#include <wend/render/render.h>
#include <wend/stats/moments.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

constexpr int spot_side = 8;
constexpr float fog_height = 2, floor_reflectance = 0.6f;
const Vec3 sun = normalize(Vec3(0.3f, 4, 0.8f));

enum class First { fog, floor };

/// Seen along (0, 5, -6) + `above` the origin; the floor is at y = 0, the fog begins at `gap`.
Scene fog_on_floor(First first, float gap, const Rgb& absorption, const Rgb& scattering, float fov, float above = 0) {
    SceneDescription s = test::scene_with_camera({0, 5 + above, -6}, {0, above, 0}, fov, spot_side);
    const MediumId fog = test::add_homogeneous(s, absorption, scattering);
    const auto add_fog = [&] {
        test::add_box(s, Box3(Vec3(-1.5f, gap, -3), Vec3(1.5f, gap + fog_height, 3)), test::add_interface(s), fog);
    };
    if (first == First::fog) {
        add_fog();
    }
    test::add_parallelogram(s, {-9, 0, -9}, {0, 0, 18}, {18, 0, 0}, test::add_diffuse(s, Rgb(floor_reflectance)));
    if (first == First::floor) {
        add_fog();
    }
    s.lights.push_back(DistantLight{sun, Rgb(3.0f)});
    return Scene(std::move(s));
}

Moments mean_of(const Scene& scene, const char* preset, int samples) {
    Moments result;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        Film film({spot_side, spot_side}, {{0, 0}, {spot_side, spot_side}});
        RenderSettings settings;
        settings.samples = samples;
        settings.preset = parse_preset(preset);
        settings.seed = seed;
        render(scene, film, settings);
        double sum = 0;
        for (const Rgb& pixel : film.beauty().pixels) {
            sum += static_cast<double>(pixel.r);
        }
        result.add(sum / (spot_side * spot_side));
    }
    return result;
}

// Down to a spot of 0.1 mm, if the box is 2 m high, around the origin.
TEST(FogOnFloor, AbsorbsOnTheWayToTheFloorAndBack) {
    constexpr float absorption = 0.7f;
    const float towards = fog_height / normalize(Vec3(0, 5, -6)).y, away = fog_height / sun.y;
    const double expected =
        static_cast<double>(3 * floor_reflectance / pi * sun.y * std::exp(-absorption * (towards + away)));
    for (const First first : {First::fog, First::floor}) {
        for (const float gap : {0.0f, 1e-6f, 1e-3f, -1e-3f}) {
            for (const float fov : {0.5f, 0.05f, 0.0007f}) {
                for (const char* preset : {"classical", "full"}) {
                    const Moments measured =
                        mean_of(fog_on_floor(first, gap, Rgb(absorption), Rgb(0.0f), fov), preset, 4);
                    EXPECT_NEAR(measured.mean(), expected, 4e-3 * expected)
                        << (first == First::fog ? "fog" : "floor") << " first, " << gap << ' ' << fov << ' ' << preset;
                }
            }
        }
    }
}

TEST(FogOnFloor, ScattersAsWhereItBeginsAboveOrBelowTheFloor) {
    const auto measured = [](First first, float gap, const char* preset) {
        return mean_of(fog_on_floor(first, gap, Rgb(0.07f), Rgb(0.63f), 30, 0.3f), preset, 256);
    };
    for (const char* preset : {"classical", "full"}) {
        const Moments lifted = measured(First::fog, 1e-3f, preset);
        for (const First first : {First::fog, First::floor}) {
            for (const float gap : {0.0f, -1e-3f}) {
                const Moments other = measured(first, gap, preset);
                const double error = std::hypot(lifted.standard_error(), other.standard_error());
                EXPECT_NEAR(other.mean(), lifted.mean(), 4 * error + 1e-3 * lifted.mean())
                    << (first == First::fog ? "fog" : "floor") << " first, " << gap << ' ' << preset;
                EXPECT_LT(error, 2e-3 * lifted.mean());
            }
        }
    }
}

}  // namespace
}  // namespace wend
