// `wend merge`: what it joins, what it keeps, and what it refuses.
#include <tests/support/text.h>

#include "program_support.h"

#include <wend/io/image_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace wend {
namespace {

using nlohmann::json;
using test::contains;
using test::run_wend;

Layer& layer(Picture& picture, const std::string& name) {
    return *std::find_if(picture.layers.begin(), picture.layers.end(), [&](const Layer& l) { return l.name == name; });
}

class MergeCommand : public testing::Test {
protected:
    /// The name of a small render's picture.
    std::string render(const std::string& name, int seed, std::vector<std::string> more = {}) const {
        more.insert(more.begin(), {"render", scene_, "-o", folder_.file(name), "--quiet", "--sampling", "classical",
                                   "--seed", std::to_string(seed)});
        if (std::find(more.begin(), more.end(), "--spp") == more.end()) {
            more.insert(more.end(), {"--spp", "4"});
        }
        const auto result = run_wend(more);
        EXPECT_EQ(result.status, 0) << result.err;
        return folder_.file(name);
    }
    /// The name of a picture that is another one, changed.
    std::string changed(const std::string& name, const std::string& other,
                        const std::function<void(Picture&)>& change) const {
        Picture picture = read_picture(other);
        change(picture);
        write_picture(folder_.file(name), picture);
        return folder_.file(name);
    }
    test::ProgramResult merge(std::vector<std::string> inputs, const std::string& output = "out.exr") const {
        inputs.insert(inputs.begin(), {"merge", folder_.file(output)});
        return run_wend(inputs);
    }
    void expect_refused(const std::vector<std::string>& inputs, const std::vector<std::string>& parts) const {
        const auto result = merge(inputs);
        EXPECT_EQ(result.status, 2) << parts.front();
        EXPECT_TRUE(result.out.empty());
        for (const std::string& part : parts) {
            EXPECT_TRUE(contains(result.err, part)) << part << " is not in: " << result.err;
        }
        EXPECT_FALSE(std::filesystem::exists(folder_.file("out.exr"))) << parts.front();
    }

    test::ScratchFolder folder_;
    std::string scene_ = folder_.write("room.pbrt", test::small_scene());
};

TEST_F(MergeCommand, KeepsLayersAndSumsUpMetadata) {
    const std::string a = render("a.exr", 1), b = render("b.exr", 2, {"--spp", "12", "--sampler", "independent"});
    const auto result = merge({a, b, "--json", "-", "--quiet"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(result.err.empty()) << result.err;
    const json told = result.json();
    EXPECT_EQ(told["inputs"], (json{a, b}));
    EXPECT_EQ(told["output"], folder_.file("out.exr"));
    EXPECT_EQ(told["spp"], 16);
    EXPECT_NEAR(told["weights"][0].get<double>() + told["weights"][1].get<double>(), 1, 1e-9);

    Picture first = read_picture(a), merged = read_picture(folder_.file("out.exr"));
    ASSERT_EQ(merged.layers.size(), first.layers.size());
    for (const Layer& l : first.layers) {
        EXPECT_EQ(layer(merged, l.name).channels, l.channels) << l.name;
        EXPECT_EQ(layer(merged, l.name).values.size(), l.values.size()) << l.name;
    }
    for (const float n : layer(merged, "samples").values) {
        EXPECT_EQ(n, 16);
    }
    ASSERT_TRUE(first.view && merged.view);
    EXPECT_EQ(merged.view->camera_from_world, first.view->camera_from_world);
    EXPECT_EQ(merged.view->ndc_from_world, first.view->ndc_from_world);
    EXPECT_EQ(merged.metadata.at("wend:scene"), scene_);
    EXPECT_EQ(merged.metadata.at("wend:seed"), "1,2");
    EXPECT_EQ(merged.metadata.at("wend:spp"), "16");
    EXPECT_EQ(merged.metadata.at("wend:version"), first.metadata.at("wend:version"));
    json settings = json::parse(first.metadata.at("wend:settings"));
    settings["seed"] = {1, 2};
    EXPECT_EQ(json::parse(merged.metadata.at("wend:settings")), settings);
}

TEST_F(MergeCommand, MergedPicturesCanBeMergedAgain) {
    const std::string a = render("a.exr", 1), b = render("b.exr", 2), c = render("c.exr", 3);
    ASSERT_EQ(merge({a, b}, "ab.exr").status, 0);
    ASSERT_EQ(merge({folder_.file("ab.exr"), c}, "abc.exr").status, 0);
    const Picture merged = read_picture(folder_.file("abc.exr"));
    EXPECT_EQ(merged.metadata.at("wend:seed"), "1,2,3");
    EXPECT_EQ(merged.metadata.at("wend:spp"), "12");
    EXPECT_EQ(json::parse(merged.metadata.at("wend:settings"))["seed"], (json{1, 2, 3}));
    expect_refused({folder_.file("ab.exr"), b}, {"b.exr: error", "seed 2", "ab.exr"});
    expect_refused({a, folder_.file("abc.exr")}, {"abc.exr: error", "seed 1", "a.exr"});
}

TEST_F(MergeCommand, WritesPicturesOfEightBits) {
    const std::string a = render("a.exr", 1), b = render("b.exr", 2);
    for (const char* name : {"out.png", "out.jpg"}) {
        ASSERT_EQ(merge({a, b}, name).status, 0);
        EXPECT_EQ(read_image(folder_.file(name)).width, 16);
    }
    EXPECT_EQ(merge({a, b}, "out.bmp").status, 2);
}

TEST_F(MergeCommand, RefusesOneSeedTwice) {
    const std::string a = render("a.exr", 7), b = render("b.exr", 7, {"--spp", "8"});
    expect_refused({a, b}, {"b.exr: error", "seed 7", "a.exr"});
    expect_refused({a, a}, {"seed 7"});
}

TEST_F(MergeCommand, RefusesRendersOfOtherPictures) {
    const std::string a = render("a.exr", 1);
    expect_refused({a, render("b.exr", 2, {"--max-depth", "3"})}, {"b.exr: error", "max_depth", "3", "8", "a.exr"});
    expect_refused({a, render("b.exr", 2, {"--resolution", "8x8"})}, {"b.exr: error", "8x8", "16x12", "a.exr"});
    expect_refused({a, render("b.exr", 2, {"--crop", "0,0.5,0,1"})}, {"b.exr: error", "0 to 8", "0 to 16", "a.exr"});
    const auto set = [](const std::string& name, const std::string& value) {
        return [=](Picture& picture) { picture.metadata["wend:" + name] = value; };
    };
    const std::string b = render("b.exr", 2);
    const auto named = [](const std::string& scene) {
        return [=](Picture& picture) {
            picture.metadata["wend:scene"] = scene;
            picture.metadata.erase("wend:scene_digest");
        };
    };
    expect_refused({a, changed("c.exr", b, named("/else/other.pbrt"))},
                   {"c.exr: error", "other.pbrt", "room.pbrt", "a.exr"});
    EXPECT_EQ(merge({a, changed("c.exr", b, named("/else/room.pbrt"))}).status, 0) << "a copy of the scene";

    // Contents count more than names.
    std::filesystem::remove(folder_.file("out.exr"));
    const std::string one = changed("one.exr", a, set("scene_digest", "abc"));
    expect_refused({one, changed("c.exr", b, set("scene_digest", "abd"))}, {"c.exr: error", "abd", "abc", "one.exr"});
    const std::string moved = changed("c.exr", b, [](Picture& picture) {
        picture.metadata["wend:scene"] = "moved.pbrt";
        picture.metadata["wend:scene_digest"] = "abc";
    });
    EXPECT_EQ(merge({one, moved}).status, 0);
    EXPECT_EQ(read_picture(folder_.file("out.exr")).metadata.at("wend:scene_digest"), "abc");
}

TEST_F(MergeCommand, RefusesPicturesThatDoNotSayEnough) {
    const std::string a = render("a.exr", 1);
    expect_refused({a, render("half.exr", 2, {"--half"})}, {"half.exr: error", "no layer", "--half"});
    const std::string b = render("b.exr", 2);
    for (const std::string name : {"scene", "seed", "spp", "settings"}) {
        expect_refused({a, changed("c.exr", b, [&](Picture& p) { p.metadata.erase("wend:" + name); })},
                       {"c.exr: error", "'wend:" + name + "'"});
    }
    const std::string deep(100000, '[');
    for (const auto& [name, value] : {std::pair<std::string, std::string>{"seed", ""},
                                      {"seed", "1,,2"},
                                      {"seed", "-1"},
                                      {"seed", "18446744073709551616"},
                                      {"spp", "1e3"},
                                      {"spp", "18446744073709551615"},
                                      {"settings", "[]"},
                                      {"settings", "{"},
                                      {"settings", deep}}) {
        expect_refused({a, changed("c.exr", b, [&](Picture& p) { p.metadata["wend:" + name] = value; })},
                       {"c.exr: error"});
    }
    // What is nested too deep to be written is dropped.
    const std::string nested = "{\"max_depth\":8,\"x\":" + deep + std::string(deep.size(), ']') + "}";
    EXPECT_EQ(merge({changed("c.exr", b, [&](Picture& p) { p.metadata["wend:settings"] = nested; }), a}).status, 0);
}

TEST_F(MergeCommand, RefusesNumbersThatCannotBe) {
    const std::string a = render("a.exr", 1), b = render("b.exr", 2);
    for (const char* name : {"samples", "variance"}) {
        const std::string c = changed("c.exr", b, [&](Picture& p) { layer(p, name).values[5] = -1; });
        expect_refused({a, c}, {"c.exr: error", name});
    }
    expect_refused({a, folder_.write("c.exr", test::read_text(b).substr(0, 2000))}, {"c.exr: error"});
    expect_refused({a, scene_}, {"room.pbrt: error"});
    expect_refused({a, folder_.file("none.exr")}, {"none.exr: error: cannot open: No such file"});
    expect_refused({a, folder_.path().string()}, {folder_.path().string() + ": error: is a folder"});
}

TEST_F(MergeCommand, WritesOverNoRender) {
    const std::string a = render("a.exr", 1), b = render("b.exr", 2), c = render("c.exr", 3);
    const std::string before = test::read_text(a);
    EXPECT_EQ(merge({a, b}, "a.exr").status, 2);
    // As `wend merge *.exr` would.
    const auto result = merge({b, c}, "a.exr");
    EXPECT_EQ(result.status, 2);
    EXPECT_TRUE(contains(result.err, "a.exr: error") && contains(result.err, "seed 1")) << result.err;
    EXPECT_EQ(run_wend({"merge", folder_.file("out.exr"), b, c, "--json", b}).status, 2);
    EXPECT_EQ(merge({a}).status, 2) << "one picture is nothing to merge";
    EXPECT_EQ(test::read_text(a), before);
    // A merged picture may be made again.
    EXPECT_EQ(merge({a, b}).status, 0);
    EXPECT_EQ(merge({b, c}).status, 0);
}

}  // namespace
}  // namespace wend
