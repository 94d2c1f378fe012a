// Options from a file: wend --config.
#include <tests/support/text.h>

#include "program_support.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace wend {
namespace {

using test::contains;
using test::run_wend;

class ConfigFile : public testing::Test {
protected:
    ConfigFile() : scene_(folder_.write("room.pbrt", test::small_scene())) {}

    /// `wend --config FILE render` with this text in the file, and more arguments.
    test::ProgramResult render(const std::string& text, const std::vector<std::string>& more = {}) const {
        std::vector<std::string> all = {"--config", folder_.write("x.toml", text), "render"};
        all.insert(all.end(), more.begin(), more.end());
        return run_wend(all);
    }
    std::vector<std::string> with_scene(const std::vector<std::string>& more = {}) const {
        std::vector<std::string> all = {scene_, "-o", folder_.file("room.exr"), "--json", "-"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }

    test::ScratchFolder folder_;
    std::string scene_;
};

TEST_F(ConfigFile, GivesOptions) {
    const auto result = render(
        "\xef\xbb\xbf# Mine.\r\n\n[render]\r\nspp=4\n  seed = 7 ; a number\nquiet = true\nsampling = \"direction\" # "
        "one\n"
        "crop = '0,0.5,0,1'\n\n[compare]\ntime = 3\n",
        with_scene());
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    const auto report = result.json();
    EXPECT_EQ(report["spp"], 4);
    EXPECT_EQ(report["settings"]["seed"], 7);
    EXPECT_EQ(report["settings"]["sampling"], "direction");
    EXPECT_EQ(report["settings"]["crop"], nlohmann::json({0, 8, 0, 12}));
}

TEST_F(ConfigFile, TheCommandLineCountsBeforeIt) {
    EXPECT_EQ(render("[render]\nspp = 4\n", with_scene({"--spp", "2"})).json()["spp"], 2);
    // An option that the file's one does not go with, too.
    const auto other = render("[render]\nspp = 4\n", with_scene({"--passes", "1,1"}));
    EXPECT_EQ(other.json()["settings"]["passes"], nlohmann::json({1, 1})) << other.err;
}

TEST_F(ConfigFile, MayComeAfterTheSubcommand) {
    const auto result = run_wend({"render", scene_, "-o", folder_.file("room.exr"), "--config",
                                  folder_.write("y.toml", "[render]\nspp = 3\n"), "--json", "-"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.json()["spp"], 3);
}

TEST_F(ConfigFile, NamesMayHoldAnything) {
    const std::string odd = folder_.write("a #1; \"b\".pbrt", test::small_scene());
    const std::string text =
        "[render]\nscene = '" + odd + "'\noutput = " + folder_.file("c.#.exr") + " # bare\nspp=1\n";
    const auto result = render(text);
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(std::filesystem::exists(folder_.file("c.#.exr")));
    EXPECT_EQ(render("[render]\nspp=1\noutput=\"" + folder_.file("d\\\\\\\"e.exr") + "\"\n", {scene_}).status, 0);
    EXPECT_TRUE(std::filesystem::exists(folder_.file("d\\\"e.exr")));
}

TEST_F(ConfigFile, SeveralValuesStandInBrackets) {
    ASSERT_EQ(render("[render]\nspp = 1\n", with_scene()).status, 0);
    const std::string picture = folder_.file("room.exr");
    const std::string text =
        "[metric]\nreference = " + picture + "\nimages = [ " + picture + " , '" + picture + "' ] # two\njson = \"-\"\n";
    const auto result = run_wend({"--config", folder_.write("x.toml", text), "metric"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.json()["rows"].size(), 2u);
}

TEST_F(ConfigFile, WhatIsWrongIsNamedWithItsPlace) {
    struct Case {
        std::string text;
        std::vector<std::string> expected;
    };
    for (const Case& c :
         {Case{"spp = 4\n", {"x.toml:1:", "[render]"}}, Case{"\n[rendr]\n", {"x.toml:2:", "'rendr'"}},
          Case{"[render\n", {"x.toml:1:", "']'"}}, Case{"[render] x\n", {"x.toml:1:", "'x'"}},
          Case{"[render]\nspb = 4\n", {"x.toml:2:", "'wend render'", "'spb'"}},
          Case{"[render]\nhelp = true\n", {"x.toml:2:", "'help'"}}, Case{"[render]\nspp 4\n", {"x.toml:2:", "'='"}},
          Case{"[render]\nspp =\n", {"x.toml:2:", "value is missing"}},
          Case{"[render]\nspp = \"4\n", {"x.toml:2:", "quotation mark"}},
          Case{"[render]\nspp = \"4\" 5\n", {"x.toml:2:", "'5'"}},
          Case{"[render]\nspp = [1, 2\n", {"x.toml:2:", "']'"}}, Case{"[render]\nspp = [1, 2]\n", {"--spp", "x.toml"}},
          Case{"[render]\nspp = many\n", {"--spp", "many", "x.toml"}},
          Case{"[render]\nspp = 1\nspp = 2\n", {"x.toml:3:", "twice"}},
          Case{std::string("[render]\n\0spp", 13), {"x.toml: error"}},
          Case{std::string(2000000, '['), {"x.toml: error"}}}) {
        const auto result = render(c.text, with_scene());
        EXPECT_EQ(result.status, 2) << c.text.substr(0, 80);
        for (const std::string& part : c.expected) {
            EXPECT_TRUE(contains(result.err, part)) << part << " in: " << result.err;
        }
        EXPECT_FALSE(std::filesystem::exists(folder_.file("room.exr")));
    }
    for (const std::string& file : {folder_.file("absent.toml"), folder_.path().string(), std::string("/dev/zero")}) {
        const auto result = run_wend({"--config", file, "render", scene_, "-o", folder_.file("room.exr")});
        EXPECT_EQ(result.status, 2);
        EXPECT_TRUE(contains(result.err, file)) << result.err;
        EXPECT_FALSE(contains(result.err, "also taken")) << result.err;
    }
}

}  // namespace
}  // namespace wend
