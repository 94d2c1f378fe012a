// Pictures of what moves while the shutter is open.
#include <tests/support/channel_means.h>
#include <tests/support/loaded_settings.h>
#include <wend/io/pbrt/parser.h>
#include <wend/render/render.h>
#include <wend/stats/significance.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

namespace wend {
namespace {

LoadedScene load(const std::string& text) {
    return load_scene(pbrt::parse_string(text, ".", "test.pbrt"));
}

/// Shows each of `count` pictures, with seeds from `seed` on, to `take`.
template <class Take>
void render_each_moving(const std::string& text, const char* preset, int samples, int count, std::uint64_t seed,
                        const Take& take, SamplerKind sampler = SamplerKind::independent) {
    LoadedScene loaded = load(text);
    RenderSettings settings = test::settings_of(loaded, preset, samples);
    settings.subsurface = parse_subsurface(settings.preset.is_classical() ? "classical" : "auto");
    settings.sampler = sampler;
    const Scene scene(std::move(loaded.scene));
    settings.seed = seed;
    for (int i = 0; i < count; ++i, ++settings.seed) {
        Film film(loaded.resolution, loaded.crop);
        render(scene, film, settings);
        take(film.beauty());
    }
}

std::vector<Moments> pixel_means(const std::string& text, const char* preset, int samples, int count,
                                 std::uint64_t seed = 1) {
    std::vector<Moments> means;
    render_each_moving(text, preset, samples, count, seed, [&](const Image& image) {
        means.resize(image.pixels.size());
        for (std::size_t i = 0; i < means.size(); ++i) {
            means[i].add(static_cast<double>(mean(image.pixels[i])));
        }
    });
    return means;
}

/// A row of 16 pixels from x = -4 to 4, and a bright background.
std::string row(const std::string& camera = "") {
    return R"(Film "rgb" "integer xresolution" 16 "integer yresolution" 1
PixelFilter "box"
Integrator "path" "integer maxdepth" 1
LookAt 0 0 5  0 0 0  0 1 0
Scale -1 1 1
Camera "orthographic" "float screenwindow" [-4 4 -.25 .25] )" +
           camera + R"(
WorldBegin
LightSource "infinite" "rgb L" [1 1 1]
Material "diffuse" "rgb reflectance" [0 0 0]
)";
}

/// A black strip from x = -1 to 1 that moves from -2 to 2.
const std::string strip = R"(ActiveTransform StartTime
Translate -2 0 0
ActiveTransform EndTime
Translate 2 0 0
ActiveTransform All
Shape "bilinearmesh" "point3 P" [-1 -1 0  1 -1 0  -1 1 0  1 1 0]
)";

/// The mean in each pixel of what a strip leaves of the background, whose middle is where `middle` says at uniform
/// numbers.
template <class Middle>
std::vector<double> left_of_background(const Middle& middle) {
    constexpr int moments = 20000;
    std::vector<double> left;
    for (int k = 0; k < 16; ++k) {
        const double from = -4 + 0.5 * k;
        double covered = 0;
        for (int i = 0; i < moments; ++i) {
            const double x = middle((i + 0.5) / moments);
            covered += std::max(0.0, std::min(from + 0.5, x + 1) - std::max(from, x - 1)) / 0.5 / moments;
        }
        constexpr double rounding = 1e-9;
        left.push_back(covered > 1 - rounding ? 0.0 : 1 - covered);
    }
    return left;
}

void expect_pixels(const std::string& text, const std::vector<double>& expected) {
    const auto means = pixel_means(text, "classical", 1000, 16);
    ASSERT_EQ(means.size(), expected.size());
    for (std::size_t i = 0; i < means.size(); ++i) {
        EXPECT_TRUE(agrees(means[i], expected[i], 4.5, 1e-5))
            << "pixel " << i << ": " << means[i].mean() << " +- " << means[i].standard_error() << ", right is "
            << expected[i];
        EXPECT_LT(means[i].standard_error(), 0.007);
    }
}

TEST(MotionBlur, AStripCoversEachPixelForItsTime) {
    expect_pixels(row() + strip, left_of_background([](double u) { return -2 + 4 * u; }));
}

TEST(MotionBlur, ItIsThatWhileTheShutterIsOpen) {
    expect_pixels(row("\"float shutteropen\" 0.5 \"float shutterclose\" 0.75") + strip,
                  left_of_background([](double u) { return 1 * u; }));
}

TEST(MotionBlur, BeforeAndAfterItsTimesItIsAtRest) {
    expect_pixels("TransformTimes 0.5 0.75\n" + row() + strip,
                  left_of_background([](double u) { return -2 + 4 * std::clamp((u - 0.5) * 4, 0.0, 1.0); }));
}

// Negative twin: a strip that stands half way.
TEST(MotionBlur, AStandingStripIsAnother) {
    const auto means = pixel_means(row() + strip, "classical", 1000, 16);
    const auto still = left_of_background([](double) { return 0.0; });
    int different = 0;
    for (std::size_t i = 0; i < means.size(); ++i) {
        different += agrees(means[i], still[i], 4.5, 1e-5) ? 0 : 1;
    }
    EXPECT_GT(different, 6);
}

TEST(MotionBlur, AShapeThatTurnsCoversAnglesForTheirTime) {
    // A wedge of 30 degrees turns by 90. Seen are points at 60, at 20 and at 105 degrees.
    constexpr double degree = std::numbers::pi / 180;
    const struct { double angle, covered; } cases[] = {{60, 30.0 / 90}, {20, 20.0 / 90}, {105, 15.0 / 90}};
    for (const auto& [angle, covered] : cases) {
        const double x = std::cos(angle * degree), y = std::sin(angle * degree), size = 1e-4;
        const std::string text = fmt::format(
            R"(Film "rgb" "integer xresolution" 1 "integer yresolution" 1
PixelFilter "box"
Integrator "path" "integer maxdepth" 1
LookAt 0 0 5  0 0 0  0 1 0
Scale -1 1 1
Camera "orthographic" "float screenwindow" [{} {} {} {}]
WorldBegin
LightSource "infinite" "rgb L" [1 1 1]
Material "diffuse" "rgb reflectance" [0 0 0]
ActiveTransform EndTime
Rotate 90 0 0 1
ActiveTransform All
Shape "trianglemesh" "point3 P" [0 0 0  3 0 0  {} 1.5 0] "integer indices" [0 1 2]
)",
            x - size, x + size, y - size, y + size, 3 * std::cos(30 * degree));
        const auto means = pixel_means(text, "classical", 8000, 16);
        EXPECT_TRUE(agrees(means[0], 1 - covered, 4, 3e-4)) << angle << ": " << means[0].mean();
        EXPECT_LT(means[0].standard_error(), 0.01 * covered);
    }
}

void expect_same_pixels(const std::vector<Moments>& a, const std::vector<Moments>& b) {
    ASSERT_EQ(a.size(), b.size());
    double total = 0, total_error = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double error = std::hypot(a[i].standard_error(), b[i].standard_error());
        EXPECT_NEAR(a[i].mean(), b[i].mean(), 4.5 * error + 1e-5) << "pixel " << i;
        total += a[i].mean();
        total_error = std::hypot(total_error, error);
    }
    EXPECT_LT(4 * total_error, 0.01 * total);
}

/// Things of several kinds, each with the transform before it. They have none of their own, which would be part of what
/// is interpolated: a shape that turns with the world goes straight on.
std::string things(const std::string& transform) {
    const std::string before = "AttributeBegin\n" + transform;
    return before + R"(Material "diffuse" "rgb reflectance" [.8 .5 .2]
Shape "sphere" "float radius" .8
AttributeEnd
)" + before +
           R"(Material "diffuse" "rgb reflectance" [.2 .5 .8]
Shape "cylinder" "float radius" .3 "float zmin" -1.4
Shape "bilinearmesh" "point3 P" [-1.5 -.5 0  -.5 -.5 0  -1.5 .5 .3  -.5 .5 0]
AttributeEnd
)";
}

std::string still_camera(const std::string& motion = "") {
    return R"(Film "rgb" "integer xresolution" 8 "integer yresolution" 8
PixelFilter "box"
Integrator "path" "integer maxdepth" 2
)" + motion +
           R"(Translate 0 0 4
Camera "perspective" "float fov" 40
WorldBegin
LightSource "infinite" "rgb L" [.3 .3 .3]
)";
}

const std::string motion = R"(ActiveTransform StartTime
Translate -.4 .1 0
ActiveTransform EndTime
Translate .3 0 -.5
Rotate 70 0 1 1
ActiveTransform All
)";

TEST(SlowMotionBlur, AMovingCameraIsAWorldThatMovesTheOtherWay) {
    // The light is the same from everywhere, so that the world can move without it.
    const std::string of_camera = R"(ActiveTransform StartTime
Translate -.5 0 0
ActiveTransform EndTime
Translate .5 .2 -1
ActiveTransform All
)";
    expect_same_pixels(pixel_means(still_camera(of_camera) + things(""), "classical", 300, 16),
                       pixel_means(still_camera() + things(of_camera), "classical", 300, 16, 100));
}

TEST(SlowMotionBlur, ACameraThatTurnsIsAWorldThatTurnsAroundIt) {
    const auto scene = [](const std::string& of_camera, const std::string& of_world) {
        return R"(Film "rgb" "integer xresolution" 8 "integer yresolution" 8
PixelFilter "box"
Integrator "path" "integer maxdepth" 2
)" + of_camera +
               R"(Camera "perspective" "float fov" 60
WorldBegin
LightSource "infinite" "rgb L" [.3 .3 .3]
)" + of_world +
               R"(Shape "bilinearmesh" "point3 P" [-1.5 -.5 4  -.5 -.5 3  -1.5 .5 3  -.5 .5 4]
Shape "trianglemesh" "point3 P" [0 0 3  1 .3 3  .2 1.3 4] "integer indices" [0 1 2]
)";
    };
    const std::string turn = "ActiveTransform EndTime\nRotate 25 0 1 .2\nActiveTransform All\n";
    expect_same_pixels(pixel_means(scene(turn, ""), "classical", 300, 16),
                       pixel_means(scene("", turn), "classical", 300, 16, 100));
}

TEST(SlowMotionBlur, AnInstanceMovesAsItsShapesWould) {
    const std::string object = "ObjectBegin \"things\"\n" + things("") + "ObjectEnd\n";
    const auto shapes = pixel_means(still_camera() + things(motion), "classical", 300, 16, 100);
    expect_same_pixels(
        pixel_means(still_camera() + object + motion + "ObjectInstance \"things\"\n", "classical", 300, 16), shapes);
    // The shapes in an object that stands.
    const std::string of_moving = "ObjectBegin \"things\"\n" + things(motion) + "ObjectEnd\n";
    expect_same_pixels(pixel_means(still_camera() + of_moving + "ObjectInstance \"things\"\n", "classical", 300, 16),
                       shapes);
}

TEST(SlowMotionBlur, WhatMovesInAMovingInstanceDoesBoth) {
    const std::string shift = "ActiveTransform EndTime\nTranslate .8 0 0\nActiveTransform All\n";
    const std::string rise = "ActiveTransform EndTime\nTranslate 0 .8 0\nActiveTransform All\n";
    const std::string object = "ObjectBegin \"things\"\n" + things(rise) + "ObjectEnd\n";
    expect_same_pixels(
        pixel_means(still_camera() + object + shift + "ObjectInstance \"things\"\n", "classical", 300, 16),
        pixel_means(still_camera() + things(shift + rise), "classical", 300, 16, 100));
}

/// Guided, pictures have the means of unguided ones, so that 3 % would be seen.
void expect_guided_agrees(const char* name, const std::string& scene, int samples) {
    SCOPED_TRACE(name);
    const auto means = [&](const char* preset, int count, std::uint64_t seed) {
        test::ChannelMeans found;
        render_each_moving(
            scene, preset, samples, count, seed, [&](const Image& image) { found.add(image); }, SamplerKind::sobol);
        return found;
    };
    const auto expected = test::kept_means(name, [&] { return means("classical", 50, 1000).known(); });
    constexpr double bias = 0.03;
    const auto guided = test::means_until_seen(bias, expected, 24, [&](std::uint64_t seed) {
        Image picture;
        render_each_moving(
            scene, "full", samples, 1, seed, [&](const Image& image) { picture = image; }, SamplerKind::sobol);
        return picture;
    });
    test::expect_known(guided, expected, bias);
}

const std::string foggy = R"(Film "rgb" "integer xresolution" 10 "integer yresolution" 10
PixelFilter "box"
Integrator "volpath" "integer maxdepth" 200
LookAt 0 -5 1  0 0 .6  0 0 1
Camera "perspective" "float fov" 35
WorldBegin
MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_s" [2 3 4] "rgb sigma_a" [.1 .1 .1] "float g" .4
AttributeBegin
Translate 0 0 4
Rotate 180 1 0 0
AreaLightSource "diffuse" "rgb L" [8 7 6]
Shape "disk" "float radius" 1
AttributeEnd
LightSource "infinite" "rgb L" [.05 .1 .2]
Material "diffuse" "rgb reflectance" [.5 .5 .5]
Shape "bilinearmesh" "point3 P" [-3 -3 -1  3 -3 -1  -3 3 -1  3 3 -1]
)";

std::string ball_of_fog(const std::string& place, const std::string& material) {
    return "AttributeBegin\n" + place + "MediumInterface \"fog\" \"\"\n" + material + R"(
Shape "sphere" "float radius" .8
AttributeEnd
)";
}

const std::string passing_by =
    "ActiveTransform StartTime\nTranslate -1.5 0 .2\nActiveTransform EndTime\n"
    "Translate 1.5 0 .8\nActiveTransform All\n";

/// Each pixel's mean and standard error.
struct MeanPicture {
    std::vector<double> means, errors;

    MeanPicture(const std::string& scene, int samples, int count, std::uint64_t seed) {
        for (const Moments& pixel : pixel_means(scene, "classical", samples, count, seed)) {
            means.push_back(pixel.mean());
            errors.push_back(pixel.standard_error());
        }
    }

    /// In how many pixels they differ by more than chance has it in one of 10^5.
    int differences(const MeanPicture& other) const {
        int count = 0;
        for (std::size_t i = 0; i < means.size(); ++i) {
            count += std::abs(means[i] - other.means[i]) > 4.4 * std::hypot(errors[i], other.errors[i]) ? 1 : 0;
        }
        return count;
    }
};

TEST(SlowMotionBlur, FogInAMovingBallIsTheMeanOfStandingOnes) {
    const auto standing_at = [](double t, int samples, int count, std::uint64_t seed) {
        return MeanPicture(foggy + ball_of_fog(fmt::format("Translate {} 0 {}\n", -1.5 + 3 * t, .2 + .6 * t),
                                               "Material \"interface\""),
                           samples, count, seed);
    };
    const MeanPicture moving(foggy + ball_of_fog(passing_by, "Material \"interface\""), 256, 16, 1);
    // The middles of equal times have next to no error where so much is smooth. Their walks must differ.
    constexpr int times = 40;
    MeanPicture mean = standing_at(0.5 / times, 32, 6, 1000);
    for (int i = 1; i < times; ++i) {
        const MeanPicture at = standing_at((i + 0.5) / times, 32, 6, static_cast<std::uint64_t>(1000 + 6 * i));
        for (std::size_t k = 0; k < mean.means.size(); ++k) {
            mean.means[k] += at.means[k];
            mean.errors[k] = std::hypot(mean.errors[k], at.errors[k]);
        }
    }
    double error = 0;
    for (std::size_t k = 0; k < mean.means.size(); ++k) {
        mean.means[k] /= times;
        mean.errors[k] /= times;
        error += std::hypot(mean.errors[k], moving.errors[k]) / mean.means[k] / static_cast<double>(mean.means.size());
    }
    EXPECT_EQ(moving.differences(mean), 0);
    EXPECT_LT(error, 0.04);
    // Negative twin: a ball that stands half way.
    EXPECT_GT(moving.differences(standing_at(0.5, 256, 16, 2000)), 15);
}

TEST(SlowMotionBlur, GuidedFogAgrees) {
    const std::string scene = foggy + ball_of_fog(passing_by, "Material \"interface\"");
    expect_guided_agrees("moving_fog", scene, 256);
}

// The ball passes through another, so that regions are told apart at each time.
TEST(SlowMotionBlur, GuidedFogInGlassAgrees) {
    const std::string scene = foggy + ball_of_fog(passing_by, "Material \"dielectric\" \"float eta\" 1.3") +
                              "AttributeBegin\nTranslate 0 1.5 0\n" + ball_of_fog("", "Material \"interface\"") +
                              "AttributeEnd\n";
    expect_guided_agrees("moving_fog_in_glass", scene, 768);
}

// Boundaries, guides and ways to lamps through the boundary are known as they are half way.
TEST(SlowMotionBlur, GuidedWalksInAMovingDenseBodyAgree) {
    for (const char* roughness : {"0", "0.3"}) {
        const std::string scene =
            foggy +
            R"(MakeNamedMedium "wax" "string type" "homogeneous" "rgb sigma_s" [25 20 15] "rgb sigma_a" [.2 .3 .5]
AttributeBegin
)" + passing_by +
            R"(MediumInterface "wax" ""
Material "dielectric" "float eta" 1.3 "float roughness" )" +
            roughness + R"(
Shape "sphere" "float radius" .7
AttributeEnd
)";
        expect_guided_agrees(roughness[1] ? "moving_rough_wax" : "moving_wax", scene, 400);
    }
}

}  // namespace
}  // namespace wend
