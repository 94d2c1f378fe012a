// The project's own scenes, and the collection of real ones where it is at hand.
#include "load_support.h"
#include "tests/support/paths.h"

#include <wend/core/error.h>

#include <gtest/gtest.h>

namespace wend {
namespace {

TEST(OwnScenes, LoadWithoutWarnings) {
    int scenes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(test::source_dir() / "scenes")) {
        if (entry.path().extension() != ".pbrt") {
            continue;
        }
        ++scenes;
        try {
            const LoadedScene loaded = load_scene(entry.path());
            EXPECT_TRUE(loaded.warnings.empty()) << loaded.warnings[0];
            EXPECT_FALSE(loaded.scene.surfaces.empty()) << entry.path();
        } catch (const InputError& error) {
            ADD_FAILURE() << error.what();
        }
    }
    EXPECT_GT(scenes, 0);
}

struct Counts {
    const char* file;
    std::size_t triangles, quadrics, lights, media, warnings;
    Vec2i resolution;
};

class RealScene : public testing::TestWithParam<Counts> {};

TEST_P(RealScene, Loads) {
    const Counts& expected = GetParam();
    const auto file = test::shared_dir() / "scenes" / expected.file;
    if (!std::filesystem::exists(file)) {
        GTEST_SKIP() << "no collection of scenes beside the checkout: " << file;
    }
    const LoadedScene loaded = load_scene(file);
    std::size_t triangles = 0, quadrics = 0;
    for (const Surface& surface : loaded.scene.surfaces) {
        const auto* mesh = std::get_if<TriangleMesh>(surface.shape.get());
        triangles += mesh ? mesh->triangle_count() : 0;
        quadrics += mesh ? 0 : 1;
    }
    EXPECT_EQ(triangles, expected.triangles);
    EXPECT_EQ(quadrics, expected.quadrics);
    EXPECT_EQ(loaded.scene.lights.size(), expected.lights);
    EXPECT_EQ(loaded.scene.media.size(), expected.media);
    EXPECT_EQ(loaded.warnings.size(), expected.warnings) << (loaded.warnings.empty() ? "" : loaded.warnings[0]);
    EXPECT_EQ(loaded.resolution, expected.resolution);
}

INSTANTIATE_TEST_SUITE_P(Shared, RealScene,
                         testing::Values(Counts{"cornell-box/scene-v4.pbrt", 36, 0, 2, 0, 0, {1024, 1024}},
                                         Counts{"volumetric-caustic/scene-v4.pbrt", 14, 1, 2, 1, 0, {512, 512}},
                                         Counts{"fog-box/fog-box.pbrt", 24, 1, 2, 1, 0, {96, 96}},
                                         Counts{"veach-ajar/scene-v4.pbrt", 382690, 0, 2, 0, 0, {1280, 720}},
                                         Counts{"smoke/smoke.pbrt", 0, 2, 2, 1, 0, {240, 240}},
                                         Counts{"cloud/cloud.pbrt", 0, 2, 2, 1, 0, {320, 180}},
                                         Counts{"cloud/cloud-grey.pbrt", 0, 1, 2, 1, 0, {96, 54}}),
                         [](const auto& parameter) {
                             std::string name = parameter.param.file;
                             for (char& c : name) {
                                 c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                             }
                             return name;
                         });

}  // namespace
}  // namespace wend
