// wend compare: what it judges by, what it shows.
#include "program_support.h"

#include <wend/app/comparison.h>
#include <wend/app/reference_render.h>
#include <wend/core/colour.h>
#include <wend/io/image_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <sstream>
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

    const auto of_folder = compare({"--sampling", "classical", "--reference", folder_.file("report")});
    EXPECT_EQ(of_folder.json()["reference"]["files"], second.json()["reference"]["files"]);
    std::filesystem::create_directory(folder_.path() / "report" / "room");
    const auto still = compare({"--sampling", "classical", "--reference", folder_.file("report/room")});
    EXPECT_EQ(still.json()["reference"]["files"], second.json()["reference"]["files"]) << "the pair before the folder";
}

TEST_F(Compare, TellsHowFarItIsWithinAPass) {
    // Larger than what half a second is enough for.
    const SceneOptions options{scene_, "1200x900", "", 64, ""};
    CommonOptions common;
    common.threads = 1;
    std::ostringstream nobody;
    const Session session(options, common, {nobody, nobody});
    const Image grey(1200, 900, Rgb(1));
    struct Seen {};
    const auto watch = [](const RenderProgress& progress) {
        if (progress.seconds > 0 && progress.samples == 0) {
            throw Seen();
        }
    };
    EXPECT_THROW(compare_presets(session, {{{Preset(), SubsurfacePreset()}}, 0.6, 1}, {{grey, grey}, {}, {}},
                                 [&](const WayOfSampling&, int, const RenderProgress& progress) { watch(progress); }),
                 Seen);
    EXPECT_THROW(render_reference(session, {0, 0.6}, {}, [&](int, const RenderProgress& progress) { watch(progress); }),
                 Seen);
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

TEST_F(Compare, HasEveryRunAndEveryPictureOnItsWay) {
    const auto result = compare({"--sampling", "classical,full", "--reference-spp", "8"}, "3");
    ASSERT_EQ(result.status, 0) << result.err;
    const auto json = result.json();
    ASSERT_EQ(json["rows"].size(), 2u);
    for (const auto& row : json["rows"]) {
        EXPECT_EQ(row["scene"], scene_);
        ASSERT_EQ(row["runs"].size(), 3u);
        double sum = 0;
        for (const auto& run : row["runs"]) {
            sum += run["relmse"].get<double>();
            ASSERT_GE(run["points"].size(), 1u);
            double samples = 0, work = 0;
            for (const auto& point : run["points"]) {
                EXPECT_GE(point["spp"], samples);
                EXPECT_GT(point["work"], work) << "every pass walks";
                EXPECT_TRUE(point["relmse_trimmed"].is_number());
                samples = point["spp"];
                work = point["work"];
            }
            EXPECT_EQ(run["points"].back()["relmse"], run["relmse"]);
            EXPECT_EQ(run["points"].back()["seconds"], run["seconds"]);
            EXPECT_EQ(work, run["work"]);
        }
        const auto& spread = row["spread"]["relmse"];
        EXPECT_EQ(spread["count"], 3);
        EXPECT_EQ(spread["median"], row["relmse"]) << "of three runs the median is one of them";
        EXPECT_LT(spread["min"], spread["max"]);
        EXPECT_NEAR(spread["mean"].get<double>(), sum / 3, 1e-9 * sum);
        EXPECT_GT(spread["std_error"], 0);
        EXPECT_NE(row["runs"][0]["seed"], row["runs"][1]["seed"]);
    }
    EXPECT_EQ(json["rows"][0]["spread"]["ratio"]["max"], 1) << "classical against itself";
}

TEST_F(Compare, ErrorsOfPixelsAreMeansOverTheRuns) {
    const auto result = compare({"--sampling", "classical", "--out", folder_.file("report")}, "2");
    ASSERT_EQ(result.status, 0) << result.err;
    const Picture errors = read_picture(folder_.file("report/classical-error.exr"));
    ASSERT_EQ(errors.layers.size(), 3u);
    const auto runs = result.json()["rows"][0]["runs"];
    const auto mean = [&](const std::string& name) {
        const Layer& layer = *std::find_if(errors.layers.begin(), errors.layers.end(),
                                           [&](const Layer& one) { return one.name == name; });
        return std::accumulate(layer.values.begin(), layer.values.end(), 0.0) /
               static_cast<double>(layer.values.size());
    };
    const auto mean_of_runs = [&](const char* key) {
        return (runs[0][key].get<double>() + runs[1][key].get<double>()) / 2;
    };
    EXPECT_NEAR(mean("relative_squared"), mean_of_runs("relmse"), 1e-5 * mean_of_runs("relmse"));
    EXPECT_NEAR(mean("relative"), mean_of_runs("mape"), 1e-5 * mean_of_runs("mape"));
    double squared = 0;
    for (const Rgb& pixel : errors.image.pixels) {
        squared += static_cast<double>(mean_value(pixel)) / static_cast<double>(errors.image.pixels.size());
    }
    EXPECT_NEAR(squared, mean_of_runs("mse"), 1e-5 * mean_of_runs("mse"));
    EXPECT_EQ(errors.metadata.at("wend:renders"), "2");
}

TEST_F(Compare, SaysHowItsReferenceWasRenderedAndHowNoisyItIs) {
    for (const char* half : {"a", "b"}) {
        ASSERT_EQ(run_wend({"render", scene_, "-o", folder_.file(std::string("room.ref-") + half + ".exr"), "--spp",
                            "1", "--seed", half[0] == 'a' ? "1" : "2"})
                      .status,
                  0);
    }
    const auto read = compare({"--sampling", "classical"}).json()["reference"];
    EXPECT_EQ(read["source"], "files");
    EXPECT_EQ(read["files"].size(), 2u);
    EXPECT_TRUE(read["halves"].empty());
    const auto rendered =
        compare({"--sampling", "classical", "--reference", "render", "--reference-spp", "64"}).json()["reference"];
    EXPECT_EQ(rendered["source"], "rendered") << "although there is a pair beside the scene";
    ASSERT_EQ(rendered["halves"].size(), 2u);
    EXPECT_EQ(rendered["halves"][0]["spp"], 64);
    EXPECT_LT(rendered["noise"].get<double>(), read["noise"].get<double>() / 4) << "64 samples against one";

    const auto one = compare({"--sampling", "classical", "--reference", folder_.file("room.ref-a.exr")});
    EXPECT_TRUE(one.json()["reference"]["noise"].is_null()) << "one picture does not know its noise";
    const auto both = compare({"--reference", folder_.file("room"), "--reference-time", "0.1"});
    EXPECT_EQ(both.status, 2);
    EXPECT_NE(both.err.find("is rendered, and --reference"), std::string::npos) << both.err;
}

TEST_F(Compare, TakesAnyResolutionAndRefusesAReferenceOfAnother) {
    for (const char* half : {"a", "b"}) {
        ASSERT_EQ(run_wend({"render", scene_, "-o", folder_.file(std::string("room.ref-") + half + ".exr"), "--spp",
                            "1", "--seed", half[0] == 'a' ? "1" : "2"})
                      .status,
                  0);
    }
    const auto beside = compare({"--sampling", "classical", "--resolution", "7x5"});
    EXPECT_EQ(beside.status, 2);
    EXPECT_NE(beside.err.find("room.ref-a.exr has 16 x 12 pixels, the picture 7 x 5: choose --resolution 16x12"),
              std::string::npos)
        << beside.err;
    const auto rendered =
        compare({"--sampling", "classical", "--resolution", "7x5", "--reference", "render", "--reference-spp", "8"});
    ASSERT_EQ(rendered.status, 0) << rendered.err;
    EXPECT_EQ(rendered.json()["reference"]["resolution"], (nlohmann::json{7, 5}));
    const auto asked = compare({"--sampling", "classical", "--resolution", "7x5", "--reference", folder_.file("room")});
    EXPECT_EQ(asked.status, 2);
    EXPECT_NE(asked.err.find("16 x 12 pixels, the picture 7 x 5: choose --resolution 16x12"), std::string::npos)
        << asked.err;
    ASSERT_EQ(
        run_wend({"render", scene_, "-o", folder_.file("room.ref-b.exr"), "--spp", "1", "--resolution", "8x8"}).status,
        0);
    const auto halves = compare({"--sampling", "classical", "--reference", folder_.file("room")});
    EXPECT_EQ(halves.status, 2);
    EXPECT_NE(halves.err.find("room.ref-b.exr: error: has 8 x 8 pixels"), std::string::npos) << halves.err;
}

class CompareScenes : public Compare {
protected:
    CompareScenes() : second_(folder_.write("hall.pbrt", test::small_scene())) {}

    test::ProgramResult compare_all(std::vector<std::string> more) const {
        more.insert(more.begin(), {"compare", scene_, second_, "--time", "0.02", "--seeds", "2", "--sampling",
                                   "classical,full", "--reference-spp", "8"});
        return run_wend(more);
    }

    std::string second_;
};

TEST_F(CompareScenes, MakesOneReportOfAll) {
    const auto result = compare_all({"--report", folder_.file("report"), "--json", folder_.file("all.json")});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.out.find("gain over classical"), std::string::npos) << result.out;
    const auto json = nlohmann::json::parse(test::read_text(folder_.file("all.json")));
    EXPECT_EQ(json["rows"].size(), 4u);
    EXPECT_EQ(json["scenes"].size(), 2u);
    ASSERT_EQ(json["gains"].size(), 1u);
    EXPECT_EQ(json["gains"][0]["scenes"].size() + json["gains"][0]["unknown"].size(), 2u);
    EXPECT_EQ(nlohmann::json::parse(test::read_text(folder_.file("report/comparison.json"))), json);
    for (const char* name : {"report/index.html", "report/room/index.html", "report/hall/full-error.exr",
                             "report/hall/hall.ref-a.exr", "report/rows.csv"}) {
        EXPECT_TRUE(std::filesystem::exists(folder_.file(name))) << name;
    }
    const auto lines = [&](const char* name) {
        const std::string text = test::read_text(folder_.file(name));
        return std::count(text.begin(), text.end(), '\n');
    };
    EXPECT_EQ(lines("report/rows.csv"), 1 + 4);
    EXPECT_EQ(lines("report/runs.csv"), 1 + 8);
    EXPECT_GE(lines("report/curves.csv"), 1 + 8);

    const auto again = run_wend({"compare", scene_, second_, "--time", "0.02", "--seeds", "1", "--sampling",
                                 "classical", "--reference", folder_.file("report/room"), "--quiet"});
    EXPECT_EQ(again.status, 2) << "the folder has no hall.ref-a.exr";
    EXPECT_NE(again.err.find("1 of 2 scenes failed"), std::string::npos) << again.err;
}

TEST_F(CompareScenes, GoesOnAfterASceneThatFails) {
    folder_.write("hall.pbrt", "WorldBegin\nShape \"nonsense\"\nFilm");
    const auto result = compare_all({"--report", folder_.file("report"), "--json", "-"});
    EXPECT_EQ(result.status, 2);
    EXPECT_NE(result.err.find("1 of 2 scenes failed"), std::string::npos) << result.err;
    const auto json = result.json();
    EXPECT_EQ(json["rows"].size(), 2u);
    ASSERT_EQ(json["failed"].size(), 1u);
    EXPECT_EQ(json["failed"][0]["scene"], second_);
    EXPECT_NE(json["failed"][0]["error"].get<std::string>().find("hall.pbrt:"), std::string::npos);
    EXPECT_NE(test::read_text(folder_.file("report/index.html")).find("Not compared"), std::string::npos);
}

TEST_F(CompareScenes, RefusesWhatIsForOneSceneBeforeAnythingIsRendered) {
    for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{
             {"--out", folder_.file("out")}, {"--out", folder_.file("out"), "--report", folder_.file("report")}}) {
        EXPECT_EQ(compare_all(more).status, 2);
    }
    const auto absent = run_wend({"compare", scene_, folder_.file("none.pbrt"), "--time", "0.02"});
    EXPECT_EQ(absent.status, 2);
    EXPECT_NE(absent.err.find("none.pbrt: error: does not exist"), std::string::npos) << absent.err;
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"hall.pbrt", "room.pbrt"}));
}

}  // namespace
}  // namespace wend
