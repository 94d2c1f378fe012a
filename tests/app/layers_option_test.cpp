// `wend render --layers`: what it adds, what it leaves as it is, and what goes with it.
#include "program_support.h"

#include <wend/app/denoiser.h>
#include <wend/core/error.h>
#include <wend/film/cryptomatte.h>
#include <wend/film/merged_layers.h>
#include <wend/io/image_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace wend {
namespace {

using test::run_wend;

class LayersOption : public testing::Test {
protected:
    test::ProgramResult render(const std::string& name, std::vector<std::string> more,
                               const std::string& spp = "15") const {
        more.insert(more.begin(), {"render", scene_, "-o", folder_.file(name), "--quiet", "--spp", spp});
        return run_wend(more);
    }
    Picture rendered(const std::string& name, const std::vector<std::string>& more) const {
        const auto result = render(name, more);
        EXPECT_EQ(result.status, 0) << result.err;
        return read_picture(folder_.file(name));
    }

    test::ScratchFolder folder_;
    std::string scene_ = folder_.write("room.pbrt", test::small_scene(R"(
AttributeBegin
  LightSource "point" "point3 from" [ 0 1.5 1 ] "rgb I" [ 1 0 0 ] "string lightgroup" "key"
  AreaLightSource "diffuse" "rgb L" [ 0 3 0 ] "string lightgroup" "rim-2"
  Translate -0.5 0.5 0
  Shape "sphere" "float radius" [ 0.1 ]
AttributeEnd
)"));
};

void expect_sum(const Picture& picture, const std::vector<std::string>& names) {
    for (std::size_t i = 0; i < 3 * picture.image.pixels.size(); ++i) {
        float sum = 0;
        for (const std::string& name : names) {
            sum += find_layer(picture.layers, name)->values[i];
        }
        const float beauty = picture.image.pixels[i / 3][static_cast<int>(i % 3)];
        ASSERT_NEAR(sum, beauty, 1e-5f * beauty) << i;
    }
}

TEST_F(LayersOption, PartsAddUpAndThePictureStays) {
    const Picture plain = rendered("plain.exr", {});
    const Picture all =
        rendered("all.exr", {"--layers", "emission,background,direct,indirect,volume,lights,halves,geometry"});
    EXPECT_EQ(all.image.pixels, plain.image.pixels);
    for (const Layer& layer : plain.layers) {
        EXPECT_EQ(find_layer(all.layers, layer.name)->values, layer.values) << layer.name;
    }
    EXPECT_EQ(find_layer(plain.layers, "direct"), nullptr);
    expect_sum(all, {"emission", "background", "direct", "indirect", "volume"});
    expect_sum(all, {"light_key", "light_rim-2", "light_rest"});
    // The key light is red, and the rim green.
    const auto& key = find_layer(all.layers, "light_key")->values;
    const auto& rim = find_layer(all.layers, "light_rim-2")->values;
    for (std::size_t i = 0; i < key.size(); i += 3) {
        EXPECT_TRUE(key[i] > 0 && key[i + 1] == 0 && rim[i] == 0) << i;
    }
    const Picture some = rendered("some.exr", {"--layers", "volume"});
    EXPECT_EQ(find_layer(some.layers, "volume")->values, find_layer(all.layers, "volume")->values);
    EXPECT_EQ(find_layer(some.layers, "direct"), nullptr);
}

TEST_F(LayersOption, CheckpointsKeepThem) {
    const std::vector<std::string> layers = {
        "--layers", "direct,indirect,volume,emission,background,lights,halves,geometry,cryptomatte"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.end(), layers.begin(), layers.end());
        return more;
    };
    rendered("whole.exr", with({}));
    const std::string checkpoint = folder_.file("c");
    ASSERT_EQ(render("part.exr", with({"--checkpoint", checkpoint}), "7").status, 0);
    ASSERT_EQ(render("resumed.exr", with({"--resume", checkpoint})).status, 0);
    EXPECT_EQ(test::read_text(folder_.file("resumed.exr")), test::read_text(folder_.file("whole.exr")));
    const auto other = render("other.exr", {"--resume", checkpoint, "--layers", "direct"});
    EXPECT_EQ(other.status, 2);
    EXPECT_NE(other.err.find("layers was"), std::string::npos) << other.err;
    EXPECT_EQ(render("other.exr", {"--resume", checkpoint}).status, 2);
}

TEST_F(LayersOption, MergedPicturesAddUpToo) {
    const std::vector<std::string> layers = {"--layers", "direct,indirect,volume,emission,halves", "--seed"};
    std::vector<std::string> inputs;
    for (const char* seed : {"1", "2"}) {
        std::vector<std::string> more = layers;
        more.emplace_back(seed);
        rendered(std::string(seed) + ".exr", more);
        inputs.push_back(folder_.file(std::string(seed) + ".exr"));
    }
    ASSERT_EQ(run_wend({"merge", folder_.file("m.exr"), inputs[0], inputs[1], "--quiet"}).status, 0);
    const Picture merged = read_picture(folder_.file("m.exr"));
    expect_sum(merged, {"direct", "indirect", "volume", "emission"});
    for (std::size_t i = 0; i < 3 * merged.image.pixels.size(); ++i) {
        const float a = find_layer(merged.layers, "half_a")->values[i],
                    b = find_layer(merged.layers, "half_b")->values[i];
        const float beauty = merged.image.pixels[i / 3][static_cast<int>(i % 3)];
        ASSERT_NEAR(0.5f * (a + b), beauty, 1e-6f * (std::abs(a) + std::abs(b)));
    }
}

TEST_F(LayersOption, ObjectsHaveTheirNames) {
    const std::string scene = folder_.write("named.pbrt", test::small_scene(R"(
Shape "sphere" "string name" "ball" "float radius" [ 0.3 ]
)"));
    std::vector<std::string> inputs;
    for (const char* seed : {"1", "2"}) {
        inputs.push_back(folder_.file(std::string(seed) + ".exr"));
        const auto result = run_wend({"render", scene, "-o", inputs.back(), "--quiet", "--spp", "15", "--seed", seed,
                                      "--layers", "cryptomatte", "--layer-names", *seed == '1' ? "wend" : "blender"});
        ASSERT_EQ(result.status, 0) << result.err;
        EXPECT_EQ(result.err, "") << "the parameter is known";
    }
    ASSERT_EQ(run_wend({"merge", folder_.file("m.exr"), inputs[0], inputs[1], "--quiet"}).status, 0);
    for (const std::string& file : {inputs[0], folder_.file("m.exr")}) {
        const Picture picture = read_picture(file);
        std::string manifest;
        for (const auto& [key, text] : picture.metadata) {
            if (key.starts_with("cryptomatte/") && key.ends_with("/manifest")) {
                manifest = text;
            }
        }
        const auto names = nlohmann::json::parse(manifest);
        EXPECT_TRUE(names.contains("ball") && names.contains("fog") && names.contains("named.pbrt:14")) << manifest;
        const std::string ball = names["ball"];
        float most = 0;
        const Layer& layer = *find_layer(picture.layers, "CryptoObject00");
        const Layer& alpha = *find_layer(picture.layers, "alpha");
        for (std::size_t i = 0; i < alpha.values.size(); ++i) {
            const float* v = &layer.values[4 * i];
            EXPECT_LE(v[1] + v[3], alpha.values[i] * (1 + 1e-5f));
            // Before the ball there is fog, which covers more.
            most = hexadecimal(std::bit_cast<std::uint32_t>(v[2])) == ball ? std::max(most, v[3]) : most;
        }
        EXPECT_GT(most, 0.05f) << "the ball is seen";
    }
}

TEST_F(LayersOption, OtherNamesAreThoseOfOthers) {
    const std::vector<std::string> layers = {"--layers", "emission,background,lights,geometry"};
    const Picture plain = rendered("plain.exr", layers);
    for (const char* names : {"pbrt", "blender"}) {
        std::vector<std::string> more = layers;
        more.insert(more.end(), {"--layer-names", names});
        const Picture named = rendered("named.exr", more);
        ASSERT_EQ(named.layers.size(), plain.layers.size());
        for (const Layer& layer : plain.layers) {
            ASSERT_TRUE(find_layer(named.layers, layer.name)) << names << ' ' << layer.name;
            if (layer.name != "variance") {  // which 15 samples do not scale exactly
                EXPECT_EQ(find_layer(named.layers, layer.name)->values, layer.values) << names << ' ' << layer.name;
            }
        }
    }
}

TEST_F(LayersOption, WhatThereIsNotIsRefused) {
    const auto unknown = render("a.exr", {"--layers", "direct,diffuse"});
    EXPECT_EQ(unknown.status, 2);
    EXPECT_NE(unknown.err.find("'diffuse'"), std::string::npos) << unknown.err;
    EXPECT_NE(unknown.err.find("emission, background, direct"), std::string::npos) << unknown.err;
    for (const char* name : {"a.b", "", "rest", "two words"}) {
        const std::string scene = folder_.write(
            "bad.pbrt",
            test::small_scene(std::string("LightSource \"point\" \"string lightgroup\" \"") + name + "\"\n"));
        const auto bad = run_wend({"render", scene, "-o", folder_.file("a.exr"), "--quiet"});
        EXPECT_EQ(bad.status, 2) << name;
        EXPECT_NE(bad.err.find("bad.pbrt:26:"), std::string::npos) << bad.err;
    }
}

/// `render --denoise`, and how it goes on; skipped where the library is not.
class DenoisedLayers : public LayersOption {
protected:
    void SetUp() override {
        try {
            const Denoiser denoiser;
        } catch (const InputError&) {
            GTEST_SKIP() << "Open Image Denoise is not installed";
        }
    }
};

TEST_F(DenoisedLayers, LightOfMediaIsRecordedWhereThereAreMedia) {
    const Picture automatic = rendered("automatic.exr", {"--denoise"}), raw = rendered("raw.exr", {});
    const Picture asked = rendered("asked.exr", {"--denoise", "--layers", "volume"});
    ASSERT_NE(find_layer(automatic.layers, "volume"), nullptr);
    EXPECT_TRUE(automatic.image.pixels == asked.image.pixels);
    EXPECT_EQ(find_layer(raw.layers, "volume"), nullptr);
    const Layer* const noisy = find_layer(automatic.layers, "noisy");
    ASSERT_NE(noisy, nullptr);
    for (std::size_t i = 0; i < raw.image.pixels.size(); ++i) {
        ASSERT_EQ(noisy->values[3 * i], raw.image.pixels[i].r) << "what was is the picture without --denoise";
    }
}

TEST_F(DenoisedLayers, ARenderGoesOnWithTheLayersItBeganWith) {
    const std::string with = folder_.file("with.checkpoint"), without = folder_.file("without.checkpoint");
    rendered("begun.exr", {"--denoise", "--checkpoint", with});
    rendered("raw.exr", {"--checkpoint", without});
    EXPECT_NE(find_layer(rendered("again.exr", {"--denoise", "--resume", with}).layers, "volume"), nullptr);
    EXPECT_EQ(render("raw_again.exr", {"--resume", with}).status, 2) << "nobody asks for the layer";
    EXPECT_NE(find_layer(rendered("asked.exr", {"--layers", "volume", "--resume", with}).layers, "volume"), nullptr);
    const Picture late = rendered("late.exr", {"--denoise", "--resume", without});
    EXPECT_EQ(find_layer(late.layers, "volume"), nullptr);
    EXPECT_NE(find_layer(late.layers, "noisy"), nullptr);
    const auto other = render("other.exr", {"--denoise", "--layers", "halves", "--resume", with});
    EXPECT_EQ(other.status, 2) << "other layers than it began with";
    EXPECT_NE(other.err.find("layers"), std::string::npos) << other.err;
}

}  // namespace
}  // namespace wend
