// Choices of OpenEXR files on the command line, and that all commands read whatever is written by them.
#include "program_support.h"

#include <wend/film/merged_layers.h>
#include <wend/io/image_file.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace wend {
namespace {

using test::run_wend;

class PictureOptionsOfCommands : public testing::Test {
protected:
    std::string render(const std::string& name, std::vector<std::string> more) const {
        more.insert(more.begin(),
                    {"render", scene_, "-o", folder_.file(name), "--quiet", "--sampling", "classical", "--spp", "4"});
        const auto result = run_wend(more);
        EXPECT_EQ(result.status, 0) << result.err;
        return folder_.file(name);
    }

    test::ScratchFolder folder_;
    std::string scene_ = folder_.write("room.pbrt", test::small_scene());
};

void expect_same(const Picture& a, const Picture& b) {
    EXPECT_EQ(a.image.pixels, b.image.pixels);
    EXPECT_EQ(a.metadata, b.metadata);
    ASSERT_EQ(a.layers.size(), b.layers.size());
    for (const Layer& layer : a.layers) {
        const Layer* const other = find_layer(b.layers, layer.name);
        ASSERT_TRUE(other) << layer.name;
        EXPECT_EQ(other->values, layer.values) << layer.name;
    }
}

TEST_F(PictureOptionsOfCommands, ThatDoNothingForAPictureAreNamed) {
    const auto notes = [&](const std::string& name, std::vector<std::string> more) {
        more.insert(more.begin(), {"render", scene_, "-o", folder_.file(name), "--spp", "1"});
        const auto result = run_wend(more);
        EXPECT_EQ(result.status, 0) << result.err;
        return result.err;
    };
    EXPECT_NE(
        notes("a.png", {"--layers", "volume", "--alpha"}).find("only an .exr has what --layers, --alpha asks for"),
        std::string::npos);
    EXPECT_EQ(notes("a.png", {}).find("only an .exr"), std::string::npos);
    EXPECT_EQ(notes("a.exr", {"--layers", "volume", "--alpha"}).find("only an .exr"), std::string::npos);
}

TEST_F(PictureOptionsOfCommands, AllCommandsReadAllNames) {
    const std::string plain = render("plain.exr", {"--seed", "1"}), second = render("second.exr", {"--seed", "2"});
    ASSERT_EQ(run_wend({"merge", folder_.file("merged.exr"), plain, second, "--quiet"}).status, 0);
    for (const std::string names : {"pbrt", "blender"}) {
        const std::string named = render(names + ".exr", {"--seed", "1", "--layer-names", names});
        expect_same(read_picture(named), read_picture(plain));
        const auto metric = run_wend({"metric", plain, named, "--json", "-"});
        ASSERT_EQ(metric.status, 0) << metric.err;
        EXPECT_EQ(metric.json()["rows"][0]["mse"], 0);
        const std::string merged = folder_.file("merged-" + names + ".exr");
        const auto merge = run_wend({"merge", merged, named, second, "--quiet", "--layer-names", names});
        ASSERT_EQ(merge.status, 0) << merge.err;
        expect_same(read_picture(merged), read_picture(folder_.file("merged.exr")));
    }
}

TEST_F(PictureOptionsOfCommands, DefaultsKeepEveryBit) {
    const std::string plain = render("plain.exr", {"--seed", "1"});
    const std::string half = render("half.exr", {"--seed", "1", "--exr", "half", "--alpha"});
    const Picture full = read_picture(plain), rounded = read_picture(half);
    EXPECT_NE(full.image.pixels, rounded.image.pixels);
    EXPECT_EQ(find_layer(full.layers, "variance")->values, find_layer(rounded.layers, "variance")->values);
    EXPECT_EQ(find_layer(full.layers, "depth")->values, find_layer(rounded.layers, "depth")->values);
    EXPECT_TRUE(read_image_with_opacity(plain).opacity.empty()) << "no channel A unless it is asked for";
    EXPECT_EQ(find_layer(full.layers, "alpha")->values, std::vector<float>(16 * 12, 1.0f))
        << "the room has walls all around";
}

TEST_F(PictureOptionsOfCommands, SecondsAreKeptWhereTheyAreAskedFor) {
    const std::string a = render("a.exr", {"--seed", "1", "--record-time"});
    const std::string b = render("b.exr", {"--seed", "2", "--record-time"});
    const std::string untimed = render("c.exr", {"--seed", "3"});
    const auto seconds = [](const std::string& file) {
        return std::stod(read_picture(file).metadata.at("wend:seconds"));
    };
    EXPECT_GT(seconds(a), 0);
    EXPECT_EQ(read_picture(untimed).metadata.count("wend:seconds"), 0u) << "the same picture is the same file";
    const std::string merged = folder_.file("merged.exr");
    ASSERT_EQ(run_wend({"merge", merged, a, b, "--quiet"}).status, 0);
    EXPECT_DOUBLE_EQ(seconds(merged), seconds(a) + seconds(b));
    ASSERT_EQ(run_wend({"merge", merged, a, untimed, "--quiet"}).status, 0);
    EXPECT_EQ(read_picture(merged).metadata.count("wend:seconds"), 0u) << "of one it is not known";
}

TEST_F(PictureOptionsOfCommands, WhatThereIsNotIsRefused) {
    const std::vector<std::string> start = {"render", scene_, "-o", folder_.file("a.exr"), "--quiet"};
    for (const std::vector<std::string>& wrong : std::vector<std::vector<std::string>>{
             {"--layer-names", "maya"}, {"--exr", "double"}, {"--half", "--alpha"}, {"--half", "--exr", "half"}}) {
        std::vector<std::string> arguments = start;
        arguments.insert(arguments.end(), wrong.begin(), wrong.end());
        EXPECT_EQ(run_wend(arguments).status, 2) << wrong[0];
    }
    EXPECT_FALSE(std::filesystem::exists(folder_.file("a.exr")));
}

}  // namespace
}  // namespace wend
