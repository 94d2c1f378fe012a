// Several renders merged against one of as many samples.
#include <tests/support/scenes.h>
#include <wend/film/merge.h>
#include <wend/render/render.h>
#include <wend/stats/moments.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace wend {
namespace {

/// Of the pictures: in the second one all kinds of walks are tried.
constexpr int small_side = 16, large_side = 36;

/// Thin fog over a floor under a lamp that is far off: rare bright samples would hide a difference.
Scene foggy_floor(int side) {
    SceneDescription scene = test::scene_with_camera({0, 1, 4}, {0, 0.6f, 0}, 40, side);
    const MediumId fog = test::add_homogeneous(scene, Rgb(0.05f), Rgb(0.3f, 0.25f, 0.2f));
    const int grey = test::add_diffuse(scene, Rgb(0.6f));
    test::add_parallelogram(scene, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, grey);
    test::add_box(scene, {{-1, 0.2f, -1}, {1, 1.2f, 1}}, test::add_interface(scene), fog);
    test::add_lamp(scene, {-3, 8, -3}, 6, Rgb(5), grey);
    test::add_environment(scene, Rgb(0.2f));
    return Scene(std::move(scene));
}

RenderSettings settings_of(const char* sampling, int samples, std::uint64_t seed) {
    RenderSettings settings;
    settings.preset = parse_preset(sampling);
    settings.sampler = SamplerKind::independent;
    settings.samples = samples;
    settings.seed = seed;
    return settings;
}

/// A scene, and as many pixels across as along.
struct World {
    Scene scene;
    int side;

    explicit World(int pixels) : scene(foggy_floor(pixels)), side(pixels) {}

    Film new_film() const { return Film({side, side}, {{0, 0}, {side, side}}); }
};

Picture picture_of(const World& world, const RenderSettings& settings) {
    Film film = world.new_film();
    render(world.scene, film, settings);
    return film.picture();
}

using FieldsPointer = std::shared_ptr<const guide::Fields>;

FieldsPointer taught_by(const World& world, int samples, std::uint64_t seed) {
    RenderSettings settings = settings_of("full", samples, seed);
    settings.keeps_fields = true;
    Film film = world.new_film();
    return render(world.scene, film, settings).fields;
}

/// Over repetitions: relMSE, and the mean of the layer `variance`.
struct Quality {
    Moments relmse, variance;

    void add(const Picture& picture, const Image& truth) {
        double mean = 0;
        for (const Rgb& pixel : truth.pixels) {
            mean += static_cast<double>(mean_value(pixel)) / static_cast<double>(truth.pixels.size());
        }
        const auto told = std::find_if(picture.layers.begin(), picture.layers.end(),
                                       [](const Layer& layer) { return layer.name == "variance"; });
        const double values = 3 * static_cast<double>(truth.pixels.size());
        double errors = 0, variances = 0;
        for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
            for (int c = 0; c < 3; ++c) {
                const double reference = static_cast<double>(truth.pixels[i][c]);
                errors += std::pow(static_cast<double>(picture.image.pixels[i][c]) - reference, 2) /
                          (reference * reference + 0.01 * mean * mean);
                variances += static_cast<double>(told->values[3 * i + static_cast<std::size_t>(c)]);
            }
        }
        relmse.add(errors / values);
        variance.add(variances / values);
    }
};

/// That they are not 5 % apart, or more, in either direction: at two standard errors. A render of all samples knows its
/// pixels' noise earlier, and may be a per cent better.
void expect_alike(const Moments& merged, const Moments& single) {
    const double ratio = merged.mean() / single.mean();
    const double error = ratio * std::hypot(merged.relative_error(), single.relative_error());
    EXPECT_LT(std::abs(ratio - 1) + 2 * error, 0.05) << ratio << " +- " << error;
    EXPECT_LT(4 * error, 0.05) << "too few renders to see 5 %";
}

/// So many times four renders of 16 samples, merged, beside one of 64.
struct Comparison {
    Quality merged, single;

    /// `settings` gives those of a render, by its samples and its seed.
    template <class Settings>
    Comparison(const World& world, int repetitions, const Settings& settings) {
        constexpr int parts = 4, samples = 16;
        // The truth has the noise of 64 renders of 64 samples.
        const Image truth = picture_of(world, settings_of("classical", 64 * 64, 1)).image;
        std::uint64_t seed = 2;
        for (int i = 0; i < repetitions; ++i) {
            std::vector<Picture> pictures;
            for (int k = 0; k < parts; ++k) {
                pictures.push_back(picture_of(world, settings(samples, seed++)));
            }
            merged.add(merge_pictures(parts, [&](std::size_t k) { return pictures[k]; }).picture, truth);
            single.add(picture_of(world, settings(parts * samples, seed++)), truth);
        }
    }

    void expect_alike() const {
        wend::expect_alike(merged.relmse, single.relmse);
        wend::expect_alike(merged.variance, single.variance);
    }
};

TEST(MergedRendersSlow, AreAsGoodAsOneOfAsManySamples) {
    Comparison(World(small_side), 300, [](int samples, std::uint64_t seed) {
        return settings_of("classical", samples, seed);
    }).expect_alike();
}

/// As docs/farms.md has it: one render teaches, and all begin with what it knows.
void expect_alike_with_a_shared_field(int side, int repetitions) {
    const World world(side);
    const FieldsPointer shared = taught_by(world, 64, 1000000);
    ASSERT_FALSE(shared->notes.empty());
    Comparison(world, repetitions, [&](int samples, std::uint64_t seed) {
        RenderSettings settings = settings_of("full", samples, seed);
        settings.fields = shared;
        return settings;
    }).expect_alike();
}

TEST(MergedRendersSlow, AreAsGoodWithAFieldThatTheyShare) {
    expect_alike_with_a_shared_field(small_side, 170);
}

TEST(MergedRendersSlow, AreAsGoodWithAFieldThatTheyShareWhereItIsChosenHowToWalk) {
    expect_alike_with_a_shared_field(large_side, 45);
}

}  // namespace
}  // namespace wend
