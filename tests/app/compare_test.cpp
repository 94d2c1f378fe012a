// wend compare: what it judges by, what it shows.
#include "program_support.h"

#include <wend/io/image_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>

namespace wend {
namespace {

using test::run_wend;

class Compare : public testing::Test {
protected:
    Compare() : scene_(folder_.write("room.pbrt", test::small_scene())) {}

    test::ProgramResult compare(std::vector<std::string> more, const std::string& seeds = "1") const {
        more.insert(more.begin(), {"compare", scene_, "--time", "0.02", "--seeds", seeds, "--json", "-"});
        return run_wend(more);
    }

    test::ScratchFolder folder_;
    std::string scene_;
};

TEST_F(Compare, RendersAReferenceWhereThereIsNoneAndKeepsIt) {
    const auto first = compare({"--sampling", "classical", "--out", folder_.file("report")});
    ASSERT_EQ(first.status, 0) << first.err;
    EXPECT_NE(first.err.find("two halves of 0.16 s"), std::string::npos) << first.err;
    const Picture a = read_picture(folder_.file("report/room.ref-a.exr"));
    const Picture b = read_picture(folder_.file("report/room.ref-b.exr"));
    EXPECT_TRUE(a.layers.empty());
    EXPECT_NE(a.image.pixels, b.image.pixels) << "the halves must be independent";
    EXPECT_NE(a.metadata.at("wend:seed"), b.metadata.at("wend:seed"));

    const auto second = compare({"--sampling", "classical", "--reference", folder_.file("report/room")});
    ASSERT_EQ(second.status, 0) << second.err;
    EXPECT_EQ(second.err.find("two halves"), std::string::npos) << second.err;
    EXPECT_TRUE(second.json()["rows"][0]["relmse"].is_number());
}

TEST_F(Compare, LeavesNoReferenceWhereThereIsNoFolder) {
    const auto result = compare({"--sampling", "classical", "--quiet"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(folder_.names(), std::vector<std::string>{"room.pbrt"});
}

TEST_F(Compare, TakesThePairBesideTheScene) {
    for (const char* half : {"a", "b"}) {
        ASSERT_EQ(run_wend({"render", scene_, "--half", "-o", folder_.file(std::string("room.ref-") + half + ".exr"),
                            "--spp", "64", "--seed", half[0] == 'a' ? "1" : "2"})
                      .status,
                  0);
    }
    EXPECT_TRUE(read_picture(folder_.file("room.ref-a.exr")).layers.empty());
    const auto result = compare({"--sampling", "classical"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err.find("two halves"), std::string::npos) << result.err;
}

TEST_F(Compare, NamesAHalfThatIsAlone) {
    const auto none = compare({"--sampling", "classical"});
    ASSERT_EQ(none.status, 0) << none.err;
    EXPECT_NE(none.err.find("no room.ref-a.exr beside the scene"), std::string::npos) << none.err;
    EXPECT_EQ(none.err.find("without"), std::string::npos) << none.err;

    for (const auto& [there, absent] :
         {std::pair("room.ref-a.exr", "room.ref-b.exr"), std::pair("room.ref-b.exr", "room.ref-a.exr")}) {
        const std::string what = std::string(there) + " without " + absent;
        ASSERT_EQ(run_wend({"render", scene_, "-o", folder_.file(there), "--spp", "1"}).status, 0);
        const auto result = compare({"--sampling", "classical"});
        ASSERT_EQ(result.status, 0) << result.err;
        EXPECT_NE(result.err.find(what + " beside the scene: rendering"), std::string::npos) << result.err;
        const auto asked = compare({"--sampling", "classical", "--reference", folder_.file("room")});
        EXPECT_EQ(asked.status, 2);
        EXPECT_NE(asked.err.find(what), std::string::npos) << asked.err;
        std::filesystem::remove(folder_.path() / there);
    }
}

TEST_F(Compare, HalfFloatsAreForExrFiles) {
    for (const std::vector<std::string>& more :
         std::vector<std::vector<std::string>>{{}, {"-o", folder_.file("room.png")}}) {
        std::vector<std::string> arguments = {"render", scene_, "--half", "--spp", "1"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        EXPECT_EQ(run_wend(arguments).status, 2);
    }
    EXPECT_EQ(folder_.names(), std::vector<std::string>{"room.pbrt"});
}

TEST_F(Compare, AnAblationIsATableOfEachDecision) {
    const auto result = run_wend({"compare", scene_, "--time", "0.01", "--seeds", "1", "--sampling",
                                  "ablation,full,classical", "--json", folder_.file("rows.json")});
    ASSERT_EQ(result.status, 0) << result.err;
    const auto rows = nlohmann::json::parse(test::read_text(folder_.file("rows.json")))["rows"];
    ASSERT_EQ(rows.size(), 14u) << "each once";
    EXPECT_EQ(rows[0]["sampling"], "classical");
    EXPECT_EQ(rows[7]["sampling"], "full");
    EXPECT_EQ(rows[13]["sampling"], "distance+direction+roulette+splitting");
    for (const char* role :
         {"only distance", "only splitting", "only adaptive", "no distance", "no splitting", "no adaptive"}) {
        EXPECT_NE(result.out.find(role), std::string::npos) << result.out;
    }
}

TEST_F(Compare, PoolsTheErrorsOfAllRuns) {
    const auto result = compare({"--sampling", "classical"}, "2");
    ASSERT_EQ(result.status, 0) << result.err;
    const auto row = result.json()["rows"][0];
    EXPECT_GE(row["error_p9999"], row["relmse"]) << "the largest of few pixels is above their mean";
}

TEST_F(Compare, ShowsWhatWalksDid) {
    const auto result = compare({"--sampling", "classical,full", "--out", folder_.file("report")});
    ASSERT_EQ(result.status, 0) << result.err;
    const std::string page = test::read_text(folder_.path() / "report" / "index.html");
    for (const char* text : {"<b>reference</b>", "<b>classical</b>", "spp, relMSE", "<h2>Error</h2>",
                             "<h2>Scattering</h2>", "<h2>Walk length</h2>", "<h2>Guiding</h2>", "<h2>Splitting</h2>"}) {
        EXPECT_NE(page.find(text), std::string::npos) << text;
    }
    const Picture picture = read_picture(folder_.file("report/classical.exr"));
    ASSERT_EQ(picture.layers.size(), 4u);
    for (const Layer& layer : picture.layers) {
        const auto [least, most] = std::minmax_element(layer.values.begin(), layer.values.end());
        if (layer.name == "scatter") {
            EXPECT_GE(*least, 0);
            EXPECT_LE(*most, 1);
            EXPECT_GT(*most, 0) << "the room is foggy";
        } else if (layer.name == "guided") {
            EXPECT_EQ(*most, 0) << "classical walks are not guided";
        } else if (layer.name == "branches") {
            EXPECT_EQ(*least, 1);
            EXPECT_EQ(*most, 1) << "classical walks are not split";
        } else {
            EXPECT_EQ(layer.name, "segments");
            EXPECT_GE(*least, 1);
        }
    }
}

}  // namespace
}  // namespace wend
