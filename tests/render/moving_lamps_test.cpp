// Lamps that move while the shutter is open: what they light, and how they are seen.
#include <tests/support/channel_means.h>
#include <tests/support/loaded_settings.h>
#include <wend/io/pbrt/parser.h>
#include <wend/stats/significance.h>

#include <Imath/ImathVec.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

namespace wend {
namespace {

using Imath::V3d;
constexpr double pi_d = std::numbers::pi;

/// Shows each of `count` pictures of independent walks to `take`.
template <class Take>
void render_each(const std::string& text, const char* preset, int samples, int count, std::uint64_t seed,
                 const Take& take) {
    LoadedScene loaded = load_scene(pbrt::parse_string("Sampler \"independent\"\n" + text, ".", "test.pbrt"));
    EXPECT_TRUE(loaded.warnings.empty()) << loaded.warnings[0];
    RenderSettings settings = test::settings_of(loaded, preset, samples);
    const Scene scene(std::move(loaded.scene));
    EXPECT_EQ(scene.lights().empty(), false);
    for (settings.seed = seed; settings.seed < seed + static_cast<std::uint64_t>(count); ++settings.seed) {
        Film film(loaded.resolution, loaded.crop);
        render(scene, film, settings);
        take(film.beauty());
    }
}

test::ChannelMeans picture_means(const std::string& text, const char* preset, int samples, int count,
                                 std::uint64_t seed = 1) {
    test::ChannelMeans means;
    render_each(text, preset, samples, count, seed, [&](const Image& image) { means.add(image); });
    return means;
}

/// Irradiance at the origin, facing up, from a small piece of a lamp of radiance 1: `normal` has the piece's area as
/// its length, on the side that shines.
double from_piece(const V3d& place, const V3d& normal, bool two_sided) {
    const double d2 = place.length2(), d = std::sqrt(d2);
    const double leaving = -normal.dot(place) / d;
    return std::max(0.0, place.z / d) * (two_sided ? std::abs(leaving) : std::max(0.0, leaving)) / d2;
}

/// A disk of radius 0.3 that goes from x = -1 to 2, at first faces down, and turns by 80 degrees away.
double from_disk(double time) {
    const double turn = 80 * time * pi_d / 180, radius = 0.3;
    const V3d centre(-1 + 3 * time, 0.5, 1), normal(std::sin(turn), 0, -std::cos(turn));
    const V3d aside(std::cos(turn), 0, std::sin(turn)), along(0, 1, 0);
    constexpr int rings = 24, sectors = 48;
    double sum = 0;
    for (int i = 0; i < rings; ++i) {
        for (int k = 0; k < sectors; ++k) {
            const double r = radius * std::sqrt((i + 0.5) / rings), phi = 2 * pi_d * (k + 0.5) / sectors;
            const double area = pi_d * radius * radius / (rings * sectors);
            sum += from_piece(centre + aside * (r * std::cos(phi)) + along * (r * std::sin(phi)), normal * area, false);
        }
    }
    return sum;
}

constexpr std::array<std::array<double, 3>, 3> triangle_start = {{{-0.5, -1, 1}, {-0.5, -1.6, 1}, {0.1, -1.3, 1}}};
constexpr std::array<std::array<double, 3>, 3> triangle_end = {{{0.5, -0.6, 1.5}, {0.5, -1.9, 1.2}, {1.6, -1.2, 0.7}}};

/// A triangle that changes its shape and shines on both sides.
double from_triangle(double time) {
    V3d p[3];
    for (std::size_t k = 0; k < 3; ++k) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            p[k][axis] = triangle_start[k][a] * (1 - time) + triangle_end[k][a] * time;
        }
    }
    const V3d normal = (p[1] - p[0]).cross(p[2] - p[0]) * 0.5;
    constexpr int n = 24;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < n - i; ++k) {
            for (const double shift : {1 / 3.0, 2 / 3.0}) {
                if (i + k + 2 * shift < n) {
                    const double u = (i + shift) / n, v = (k + shift) / n;
                    sum += from_piece(p[0] * (1 - u - v) + p[1] * u + p[2] * v, normal / double{n * n}, true);
                }
            }
        }
    }
    return sum;
}

/// A sphere that goes by and grows: pi (r/d)² cos.
double from_sphere(double time) {
    const double radius = 0.25 * (1 + time);
    const V3d centre = V3d(-2, 2, 0.8) * (1 - time) + V3d(1, 1.2, 1.5) * time;
    return pi_d * radius * radius / centre.length2() * centre.z / centre.length();
}

template <class Irradiance>
double over_time(const Irradiance& irradiance) {
    constexpr int times = 400;
    double sum = 0;
    for (int i = 0; i < times; ++i) {
        sum += irradiance((i + 0.5) / times);
    }
    return sum / times;
}

std::string numbers_of(const std::array<std::array<double, 3>, 3>& points) {
    std::string text;
    for (const auto& p : points) {
        text += fmt::format("{} {} {} ", p[0], p[1], p[2]);
    }
    return text;
}

/// The floor at the origin, seen from close above. It reflects a half.
const std::string floor_at_origin = R"(Film "rgb" "integer xresolution" 2 "integer yresolution" 2
PixelFilter "box"
Integrator "path" "integer maxdepth" 1
LookAt 0 0 .4  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-.001 .001 -.001 .001]
WorldBegin
Material "diffuse" "rgb reflectance" [.5 .5 .5]
Shape "trianglemesh" "point3 P" [-3 -3 0  3 -3 0  0 5 0] "integer indices" [0 1 2]
Material "diffuse" "rgb reflectance" [0 0 0]
)";

std::string three_lamps() {
    return floor_at_origin + R"(
AttributeBegin
  ActiveTransform StartTime
  Translate -1 .5 1
  Rotate 180 1 0 0
  ActiveTransform EndTime
  Translate 2 .5 1
  Rotate 180 1 0 0
  Rotate 80 0 1 0
  ActiveTransform All
  AreaLightSource "diffuse" "rgb L" [10 0 0]
  Shape "disk" "float radius" .3
AttributeEnd
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [0 10 0] "bool twosided" true
  Shape "trianglemesh" "integer indices" [0 1 2] "point3 P" [)" +
           numbers_of(triangle_start) + "] \"point3 P1\" [" + numbers_of(triangle_end) + R"(]
AttributeEnd
AttributeBegin
  ActiveTransform StartTime
  Translate -2 2 .8
  ActiveTransform EndTime
  Translate 1 1.2 1.5
  Scale 2 2 2
  ActiveTransform All
  AreaLightSource "diffuse" "rgb L" [0 0 10]
  Shape "sphere" "float radius" .25
AttributeEnd
)";
}

TEST(SlowMovingLamps, WhatTheyLightIsTheIntegralOverTime) {
    const double expected[3] = {over_time(from_disk), over_time(from_triangle), over_time(from_sphere)};
    // Turns are made of straight steps (Motion).
    constexpr double steps = 1e-4;
    const double at_start[3] = {from_disk(0), from_triangle(0), from_sphere(0)};
    for (const char* preset : {"classical", "full"}) {
        // 1.5 million paths.
        const test::ChannelMeans means = picture_means(three_lamps(), preset, 24000, 16);
        for (int c = 0; c < 3; ++c) {
            const double right = 0.5 / pi_d * 10 * expected[c];
            EXPECT_TRUE(agrees(means[c], right, 4, steps))
                << preset << ", channel " << c << ": " << means[c].mean() << " +- " << means[c].standard_error()
                << ", right is " << right;
            EXPECT_LT(4 * means[c].standard_error(), 0.01 * right);
            // Negative twin: lamps that stand where they are at the start.
            EXPECT_FALSE(agrees(means[c], 0.5 / pi_d * 10 * at_start[c], 4, steps));
        }
    }
}

// A strip from x = -1 to 1 that goes from -2 to 2, seen in pixels from -4 to 4.
TEST(MovingLamps, TheyAreSeenWhereTheyAreForTheirTime) {
    const std::string scene = R"(Film "rgb" "integer xresolution" 16 "integer yresolution" 1
PixelFilter "box"
Integrator "path" "integer maxdepth" 2
LookAt 0 0 5  0 0 0  0 1 0
Scale -1 1 1
Camera "orthographic" "float screenwindow" [-4 4 -.25 .25]
WorldBegin
ActiveTransform StartTime
Translate -2 0 0
ActiveTransform EndTime
Translate 2 0 0
ActiveTransform All
AreaLightSource "diffuse" "rgb L" [2 2 2] "bool twosided" true
Shape "bilinearmesh" "point3 P" [-1 -1 0  1 -1 0  -1 1 0  1 1 0]
)";
    std::vector<Moments> pixels(16);
    render_each(scene, "classical", 1000, 16, 1, [&](const Image& image) {
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            pixels[i].add(static_cast<double>(image.pixels[i].g));
        }
    });
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const double from = -4 + 0.5 * static_cast<double>(i);
        const double covered = over_time([&](double u) {
            const double x = -2 + 4 * u;
            return std::max(0.0, std::min(from + 0.5, x + 1) - std::max(from, x - 1)) / 0.5;
        });
        EXPECT_TRUE(agrees(pixels[i], 2 * covered, 4.5, 1e-3)) << i << ": " << pixels[i].mean() << " " << 2 * covered;
    }
}

/// A rough metal below a sphere that shines, whose light is found by connections and by reflected rays alike.
std::string over_metal(const std::string& place, const char* depth) {
    return fmt::format(R"(Film "rgb" "integer xresolution" 8 "integer yresolution" 8
PixelFilter "box"
Integrator "path" "integer maxdepth" {}
LookAt 0 -5 1  0 0 .6  0 0 1
Camera "perspective" "float fov" 50
WorldBegin
Material "conductor" "float roughness" .3
Shape "bilinearmesh" "point3 P" [-3 -3 -1  3 -3 -1  -3 3 -1  3 3 -1]
AttributeBegin
{}
AreaLightSource "diffuse" "rgb L" [1 2 3]
Shape "sphere" "float radius" .5
AttributeEnd
)",
                       depth, place);
}

TEST(SlowMovingLamps, ReflectedTheyAreTheMeanOfStandingOnes) {
    const std::string passing =
        "ActiveTransform StartTime\nTranslate -1.5 0 0\nActiveTransform EndTime\nTranslate 1.5 .5 .5\n"
        "Scale 1.5 .7 1\nActiveTransform All\n";
    const auto expected = test::kept_means("passing_lamp", [] {
        constexpr int times = 24;
        std::vector<test::KnownMean> means(3);
        for (int i = 0; i < times; ++i) {
            const double t = (i + 0.5) / times;
            const std::string place = fmt::format("Translate {} {} {}\nScale {} {} 1\n", -1.5 + 3 * t, .5 * t, .5 * t,
                                                  1 + .5 * t, 1 - .3 * t);
            const auto still =
                picture_means(over_metal(place, "3"), "classical", 256, 8, static_cast<std::uint64_t>(1000 + 8 * i))
                    .known();
            for (std::size_t c = 0; c < 3; ++c) {
                means[c].mean += still[c].mean / times;
                means[c].standard_error = std::hypot(means[c].standard_error, still[c].standard_error / times);
            }
        }
        return means;
    });
    for (const char* preset : {"classical", "full"}) {
        SCOPED_TRACE(preset);
        constexpr double bias = 0.03;
        const auto moving = test::means_until_seen(bias, expected, 12, [&](std::uint64_t seed) {
            Image picture;
            render_each(over_metal(passing, "3"), preset, 768, 1, seed, [&](const Image& image) { picture = image; });
            return picture;
        });
        test::expect_known(moving, expected, bias);
    }
}

}  // namespace
}  // namespace wend
