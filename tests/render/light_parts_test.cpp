// Parts of pictures, by what paths did and by where light comes from: they add up, and are what they are said to be.
#include <tests/support/scenes.h>

#include <wend/render/render.h>
#include <wend/stats/moments.h>
#include <wend/stats/significance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace wend {
namespace {

constexpr int parts_resolution = 12;

enum Part { emission, background, direct, indirect, volume };

/// All parts by path, and behind them one for each light.
PartsPlan all_parts(const Scene& scene) {
    PartsPlan plan;
    std::iota(plan.by_path.begin(), plan.by_path.end(), 0);
    plan.count = static_cast<int>(path_parts);
    for (const Light& light : scene.lights()) {
        plan.is_at_infinity.push_back(is_at_infinity(light));
        plan.by_light.push_back(plan.count++);
    }
    plan.by_medium.assign(scene.media().size(), plan.count++);
    return plan;
}

Film film_of_parts(const PartsPlan& plan = {}, bool halves = false) {
    return Film({parts_resolution, parts_resolution}, {{0, 0}, {parts_resolution, parts_resolution}},
                {std::vector<std::string>(static_cast<std::size_t>(plan.count), "part"), halves, false});
}

RenderSettings settings_of_parts(const char* preset, int samples) {
    RenderSettings settings;
    settings.preset = parse_preset(preset);
    settings.samples = samples;
    settings.max_depth = 20;
    settings.seed = 3;
    return settings;
}

/// The parts of a film's picture in their order.
std::vector<const Layer*> parts_of(const Picture& picture) {
    std::vector<const Layer*> parts;
    for (const Layer& layer : picture.layers) {
        if (layer.name == "part") {
            parts.push_back(&layer);
        }
    }
    return parts;
}

struct Rendered {
    Picture picture;
    std::vector<const Layer*> parts;

    double mean(std::size_t part) const {
        const std::vector<float>& v = parts[part]->values;
        return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
    }
    double mean() const {
        double sum = 0;
        for (const Rgb& pixel : picture.image.pixels) {
            sum += static_cast<double>(pixel.r + pixel.g + pixel.b);
        }
        return sum / (3 * static_cast<double>(picture.image.pixels.size()));
    }
    /// Of mean(), at most: as if all channels of a pixel had one noise.
    double standard_error() const {
        const Layer& variance = *std::find_if(picture.layers.begin(), picture.layers.end(),
                                              [](const Layer& l) { return l.name == "variance"; });
        double sum = 0;
        for (std::size_t i = 0; i < variance.values.size(); i += 3) {
            double deviation = 0;
            for (std::size_t c = 0; c < 3; ++c) {
                deviation += std::sqrt(static_cast<double>(variance.values[i + c]));
            }
            sum += deviation * deviation;
        }
        return std::sqrt(sum) / static_cast<double>(variance.values.size());
    }
};

Rendered rendered(const Scene& scene, RenderSettings settings) {
    settings.parts = all_parts(scene);
    Film film = film_of_parts(settings.parts);
    render(scene, film, settings);
    Rendered result{film.picture(), {}};
    result.parts = parts_of(result.picture);
    return result;
}

/// Fog that glows, a dense block, a mirror ball, a lamp and a sky: light comes in all ways.
SceneDescription glowing_table_top() {
    SceneDescription s = test::scene_with_camera({0, 1.2f, -5}, {0, -0.2f, 0}, 40, parts_resolution);
    HomogeneousMedium fog;
    fog.absorption = Rgb(0.02f);
    fog.scattering = Rgb(0.1f);
    fog.emission = Rgb(0.3f);
    s.media.push_back(fog);
    const MediumId wax = test::add_homogeneous(s, {0.2f, 0.5f, 1.5f}, {15, 14, 12}, 0.3f);
    test::add_box(s, Box3(Vec3(-2, -1, -1.5f), Vec3(2, 1.5f, 1.5f)), test::add_interface(s), 0);
    test::add_sphere(s, {-0.8f, -0.2f, 0}, 0.6f, test::add_dielectric(s, 1.4f), wax, 0);
    test::add_sphere(s, {0.9f, -0.2f, 0}, 0.6f, test::add_dielectric(s, 1.5f), vacuum, 0);
    const int grey = test::add_diffuse(s, Rgb(0.5f));
    test::add_parallelogram(s, {-4, -1.001f, -4}, {0, 0, 8}, {8, 0, 0}, grey);
    test::add_lamp(s, {-1, 1, 0}, 1, {9, 4, 2}, grey);
    test::add_environment(s, {0.2f, 0.3f, 0.5f});
    s.lights.push_back(PointLight{{0, 3, -1}, Rgb(40.0f)});
    return s;
}

class LightPartsOf : public testing::TestWithParam<const char*> {};

TEST_P(LightPartsOf, APictureAddUpToItAndLeaveItAsItIs) {
    const Scene scene(glowing_table_top());
    const RenderSettings settings = settings_of_parts(GetParam(), 31);
    const Rendered all = rendered(scene, settings);
    ASSERT_EQ(all.parts.size(), path_parts + scene.lights().size() + 1);
    for (std::size_t part = 0; part < path_parts; ++part) {
        EXPECT_GT(all.mean(part), 0) << "nothing of part " << part;
    }
    // A path sums up in floats what its parts have in doubles: each of its contributions may round half a bit.
    constexpr double contributions = 256;
    for (std::size_t i = 0; i < 3 * all.picture.image.pixels.size(); ++i) {
        const double beauty = static_cast<double>(all.picture.image.pixels[i / 3][static_cast<int>(i % 3)]);
        double by_path = 0, by_light = 0;
        for (std::size_t part = 0; part < all.parts.size(); ++part) {
            (part < path_parts ? by_path : by_light) += static_cast<double>(all.parts[part]->values[i]);
        }
        ASSERT_NEAR(by_path, beauty, contributions * 0x1p-25 * beauty) << i;
        ASSERT_NEAR(by_light, beauty, contributions * 0x1p-25 * beauty) << i;
    }
    Film plain = film_of_parts();
    render(scene, plain, settings);
    EXPECT_EQ(all.picture.image.pixels, plain.beauty().pixels);
}

INSTANTIATE_TEST_SUITE_P(PresetsSlow, LightPartsOf, testing::Values("classical", "full", "direction+splitting"));

TEST(LightParts, AreByWhatPathsDid) {
    // The sky alone, behind what absorbs.
    SceneDescription sky = test::scene_with_camera({0, 0, -5}, {0, 0, 0}, 30, parts_resolution);
    test::add_box(sky, Box3(Vec3(-9, -9, 0), Vec3(9, 9, 1)), test::add_interface(sky),
                  test::add_homogeneous(sky, Rgb(0.5f), Rgb(0.0f)));
    test::add_environment(sky, Rgb(1.0f));
    const Rendered seen = rendered(Scene(sky), settings_of_parts("classical", 4));
    EXPECT_FLOAT_EQ(static_cast<float>(seen.mean(background)), static_cast<float>(seen.mean()));
    EXPECT_EQ(seen.mean(emission) + seen.mean(direct) + seen.mean(indirect) + seen.mean(volume), 0);

    // A wall under a point light: nothing comes back twice.
    SceneDescription wall = test::scene_with_camera({0, 0, -5}, {0, 0, 0}, 30, parts_resolution);
    test::add_parallelogram(wall, {-9, -9, 0}, {0, 18, 0}, {18, 0, 0}, test::add_diffuse(wall, Rgb(0.5f)));
    wall.lights.push_back(PointLight{{0, 0, -4}, Rgb(1.0f)});
    const Rendered lit = rendered(Scene(wall), settings_of_parts("classical", 4));
    EXPECT_FLOAT_EQ(static_cast<float>(lit.mean(direct)), static_cast<float>(lit.mean()));
    EXPECT_EQ(lit.mean(emission) + lit.mean(background) + lit.mean(indirect) + lit.mean(volume), 0);
    // Two of them, face to face, with the light between: the rest is indirect.
    test::add_parallelogram(wall, {-9, -9, -6}, {18, 0, 0}, {0, 18, 0}, 0);
    const Rendered twice = rendered(Scene(wall), settings_of_parts("classical", 16));
    EXPECT_GT(twice.mean(indirect), 0.1 * twice.mean(direct));
    EXPECT_EQ(twice.mean(volume), 0);

    // Fog under a lamp: whatever its paths do afterwards.
    SceneDescription fog = test::scene_with_camera({0, 0, -5}, {0, 0, 0}, 10, parts_resolution);
    test::add_box(fog, Box3(Vec3(-9, -9, 0), Vec3(9, 9, 1)), test::add_interface(fog),
                  test::add_homogeneous(fog, Rgb(0.0f), Rgb(3.0f)));
    fog.lights.push_back(PointLight{{0, 0, -4}, Rgb(1.0f)});
    const Rendered foggy = rendered(Scene(fog), settings_of_parts("classical", 4));
    EXPECT_GT(foggy.mean(), 0);
    EXPECT_FLOAT_EQ(static_cast<float>(foggy.mean(volume)), static_cast<float>(foggy.mean()));
}

TEST(LightParts, AreByWhereLightComesFrom) {
    // Without each of the lights the picture is dimmer by its part. 64 samples tell means to 1 %.
    const SceneDescription all = glowing_table_top();
    const Rendered with = rendered(Scene(all), settings_of_parts("classical", 64));
    for (const std::size_t light : {all.lights.size() - 2, all.lights.size() - 1}) {
        SceneDescription without = all;
        without.lights.erase(without.lights.begin() + static_cast<std::ptrdiff_t>(light));
        RenderSettings settings = settings_of_parts("classical", 64);
        settings.seed = 4;
        const Rendered dark = rendered(Scene(without), settings);
        const double part = with.mean(path_parts + light);
        const double error = std::hypot(with.standard_error(), dark.standard_error());
        EXPECT_TRUE(agrees(with.mean() - dark.mean(), error, part, 4)) << light << ": " << part;
        EXPECT_FALSE(agrees(with.mean() - dark.mean(), error, 0.7 * part, 4)) << "the test is of no use";
    }
}

/// Mean over pixels of a quarter of the squared difference of the halves, against that of the variance, both with their
/// spread.
std::pair<Moments, Moments> noise_by_halves(SamplerKind sampler, int samples, double* worst_mean) {
    SceneDescription s = glowing_table_top();
    RenderSettings settings = settings_of_parts("classical", samples);
    settings.sampler = sampler;
    Film film = film_of_parts({}, true);
    render(Scene(s), film, settings);
    const Picture picture = film.picture();
    const auto layer = [&](const char* name) {
        return std::find_if(picture.layers.begin(), picture.layers.end(),
                            [&](const Layer& l) { return l.name == name; })
            ->values;
    };
    const std::vector<float> a = layer("half_a"), b = layer("half_b"), variance = layer("variance");
    std::pair<Moments, Moments> noise;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double beauty = static_cast<double>(picture.image.pixels[i / 3][static_cast<int>(i % 3)]);
        const double x = static_cast<double>(a[i]), y = static_cast<double>(b[i]);
        *worst_mean = std::max(*worst_mean, std::abs((x + y) / 2 - beauty) / std::max(std::abs(x), beauty));
        // Relative to the pixel, so that no bright one speaks for all.
        noise.first.add((x - y) * (x - y) / (4 * beauty * beauty));
        noise.second.add(static_cast<double>(variance[i]) / (beauty * beauty));
    }
    return noise;
}

TEST(HalvesSlow, MeetInThePictureAndTellItsNoise) {
    double worst = 0;
    // Odd numbers of samples: the halves do not count alike.
    const auto [by_halves, by_samples] = noise_by_halves(SamplerKind::independent, 101, &worst);
    EXPECT_LT(worst, 0x1p-22);
    // Of a squared normal number the standard deviation is 1.4 of its mean: 432 of them tell the noise to 7 %.
    EXPECT_NEAR(by_halves.mean(), by_samples.mean(), 4 * by_halves.standard_error());
    EXPECT_LT(by_halves.standard_error(), 0.15 * by_halves.mean());
    // Stratified, too, the halves must not be two sides of the domain: that would be a large multiple.
    const auto [stratified, overestimate] = noise_by_halves(SamplerKind::sobol, 64, &worst);
    EXPECT_LT(stratified.mean(), 1.3 * overestimate.mean());
    EXPECT_LT(worst, 0x1p-22);
}

}  // namespace
}  // namespace wend
