// Surfaces that scatter what two materials do together, in an even sky.
#include <tests/support/channel_means.h>
#include <tests/support/scenes.h>

#include <wend/render/render.h>

#include <gtest/gtest.h>

namespace wend {
namespace {

constexpr int sum_side = 8;

int add_sum(SceneDescription& s, int first, int second, float amount) {
    s.materials.push_back(MixMaterial{first, second, s.textures.add_constant(Rgb(amount)), true});
    return static_cast<int>(s.materials.size()) - 1;
}

Rgb mean_radiance(const SceneDescription& description, const char* preset) {
    const Scene scene(description);
    Film film({sum_side, sum_side}, {{0, 0}, {sum_side, sum_side}});
    RenderSettings settings;
    settings.samples = 256;
    settings.preset = parse_preset(preset);
    settings.max_depth = 1 << 30;
    render(scene, film, settings);
    const Image picture = film.beauty();
    Rgb sum(0.0f);
    for (int y = 0; y < sum_side; ++y) {
        for (int x = 0; x < sum_side; ++x) {
            sum += picture.at(x, y) / float{sum_side * sum_side};
        }
    }
    return sum;
}

TEST(SumOfMaterials, ABallReflectsWhatBothDo) {
    SceneDescription s = test::scene_with_camera({0, 5, 0}, {0, 0, 0}, 5, sum_side);
    const int first = test::add_diffuse(s, Rgb(0.9f, 0.3f, 0.1f)), second = test::add_diffuse(s, Rgb(0.6f));
    test::add_box(s, Box3(Vec3(-9, -1, -9), Vec3(9, 0, 9)), add_sum(s, first, second, 0.3f));
    test::add_environment(s, Rgb(1.0f));
    for (const char* preset : {"classical", "direction", "full"}) {
        const Rgb mean = mean_radiance(s, preset);
        EXPECT_NEAR(mean.r, 1.5f, 0.03f) << preset;
        EXPECT_NEAR(mean.g, 0.9f, 0.02f) << preset;
        EXPECT_NEAR(mean.b, 0.7f, 0.02f) << preset;
    }
}

// Of a sum within a sum all three are there, and what is a mirror as well.
TEST(SumOfMaterials, MirrorsAndSumsAreParts) {
    SceneDescription s = test::scene_with_camera({0, 5, 0}, {0, 0, 0}, 5, sum_side);
    ConductorMaterial mirror;
    mirror.reflectance = s.textures.add_constant(Rgb(0.4f));
    mirror.roughness.u = mirror.roughness.v = s.textures.add_constant(Rgb(0.0f));
    s.materials.push_back(mirror);
    const int metal = static_cast<int>(s.materials.size()) - 1;
    const int inner = add_sum(s, test::add_diffuse(s, Rgb(0.3f)), test::add_diffuse(s, Rgb(0.2f)), 0.5f);
    test::add_box(s, Box3(Vec3(-9, -1, -9), Vec3(9, 0, 9)), add_sum(s, inner, metal, 0.4f));
    test::add_environment(s, Rgb(1.0f));
    for (const char* preset : {"classical", "direction"}) {
        EXPECT_NEAR(mean_radiance(s, preset).g, 0.9f, 0.02f) << preset;
    }
}

}  // namespace
}  // namespace wend
