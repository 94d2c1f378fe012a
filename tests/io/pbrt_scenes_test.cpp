#include <tests/support/paths.h>
#include <wend/io/pbrt/parser.h>

#include <gtest/gtest.h>

#include <filesystem>

namespace wend::pbrt {
namespace {

TEST(PbrtScenes, RealScenesParse) {
    const std::filesystem::path scenes = test::shared_dir() / "scenes";
    if (!std::filesystem::exists(scenes)) {
        GTEST_SKIP() << "no collection of real scenes beside the checkout";
    }
    int count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(scenes)) {
        if (entry.path().extension() != ".pbrt") {
            continue;
        }
        SCOPED_TRACE(entry.path().string());
        const Description d = parse_file(entry.path());
        EXPECT_FALSE(d.shapes.empty());
        EXPECT_TRUE(d.camera.parameters.has("fov"));
        EXPECT_TRUE(d.warnings.empty());
        ++count;
    }
    EXPECT_GT(count, 0);
}

TEST(PbrtScenes, TheFogBoxIsAsWritten) {
    const Description d = parse_file(test::source_dir() / "tests/references/fog-box.pbrt");
    EXPECT_EQ(d.integrator.type, "volpath");
    EXPECT_EQ(d.shapes.size(), 8u);
    ASSERT_EQ(d.media.size(), 1u);
    EXPECT_FALSE(d.camera.medium) << "the medium is set only after the camera";
    EXPECT_EQ(d.shapes.front().interior, 0u);
    EXPECT_EQ(d.shapes.front().exterior, 0u);
    EXPECT_TRUE(d.shapes[5].area_light);
    EXPECT_FALSE(d.shapes[6].area_light);
    EXPECT_EQ(d.materials[d.shapes[6].material].type, "conductor");
}

}  // namespace
}  // namespace wend::pbrt
