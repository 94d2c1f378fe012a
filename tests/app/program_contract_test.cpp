// The command line as scripts rely on it: options, names, JSON keys, streams and exit status.
#include <tests/support/text.h>

#include "program_support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

using nlohmann::json;
using test::contains;
using test::keys;
using test::run_wend;

class Program : public testing::Test {
protected:
    Program() : scene_(folder_.write("room.pbrt", test::small_scene())) {}

    /// `wend render` of the room with more arguments; the picture goes to the scratch folder.
    test::ProgramResult render(std::vector<std::string> more, const std::string& picture = "room.exr") const {
        more.insert(more.begin(), {"render", scene_, "-o", folder_.file(picture)});
        return run_wend(more);
    }
    /// The pair of files of a reference called "room".
    void make_reference() const {
        ASSERT_EQ(render({"--spp", "64", "--seed", "11"}, "room.ref-a.exr").status, 0);
        ASSERT_EQ(render({"--spp", "64", "--seed", "12"}, "room.ref-b.exr").status, 0);
    }

    test::ScratchFolder folder_;
    std::string scene_;
};

TEST_F(Program, SaysHowItIsUsed) {
    const auto general = run_wend({"--help"});
    EXPECT_EQ(general.status, 0);
    EXPECT_TRUE(general.err.empty());
    for (const std::string command :
         {"render", "compare", "metric", "merge", "denoise", "demo", "halfspace", "slab", "field"}) {
        EXPECT_TRUE(contains(general.out, command));
        const auto help = run_wend({command, "--help"});
        EXPECT_EQ(help.status, 0);
        for (const char* option : {"--json", "--seed", "--threads", "--quiet"}) {
            EXPECT_TRUE(contains(help.out, option)) << command << ' ' << option;
        }
    }
    for (const char* option : {"--config", "--version", "completion"}) {
        EXPECT_TRUE(contains(general.out, option)) << option;
    }
    for (const char* option : {"--output", "--spp", "--time", "--resolution", "--sampling", "--crop", "--passes",
                               "--max-depth", "--frames", "--carry-field"}) {
        EXPECT_TRUE(contains(run_wend({"render", "--help"}).out, option)) << option;
    }
    for (const char* option : {"--time", "--sampling", "--reference", "--out"}) {
        EXPECT_TRUE(contains(run_wend({"compare", "--help"}).out, option)) << option;
    }
    const auto version = run_wend({"--version"});
    EXPECT_EQ(version.status, 0);
    EXPECT_EQ(version.out.rfind("wend ", 0), 0u) << version.out;
}

TEST_F(Program, UnknownNamesListTheKnownOnes) {
    struct Case {
        std::vector<std::string> arguments;
        std::vector<std::string> expected;
    };
    for (const Case& c :
         {Case{{"paint"}, {"'paint'", "render", "compare", "metric", "demo"}},
          Case{{}, {"render", "compare", "metric", "demo"}},
          Case{{"render", scene_, "--sampling", "psychic"}, {"'psychic'", "classical", "direction"}},
          Case{{"render", scene_, "--sampling", "direction+"}, {"'direction+'", "classical", "direction"}},
          Case{{"compare", scene_, "--sampling", "classical,psychic"}, {"'psychic'", "classical", "direction"}},
          Case{{"render", scene_, "--live", "99999"}, {"'99999' is no port"}},
          Case{{"render", "--live", scene_, "-o", folder_.file("room.exr")}, {scene_ + "' is no port"}},
          Case{{"view", scene_, "--port", "http"}, {"'http' is no port"}},
          Case{{"render", scene_, "--sampler", "dice"}, {"'dice'", "sobol", "independent"}},
          Case{{"render", scene_, "-o", folder_.file("room.bmp")}, {"room.bmp", ".exr", ".png", ".jpg"}}}) {
        const auto result = run_wend(c.arguments);
        EXPECT_EQ(result.status, 2) << result.err;
        EXPECT_TRUE(result.out.empty());
        for (const std::string& part : c.expected) {
            EXPECT_TRUE(contains(result.err, part)) << part << " in: " << result.err;
        }
    }
}

TEST_F(Program, RefusesArgumentsThatMakeNoSense) {
    for (const std::vector<std::string>& more :
         std::vector<std::vector<std::string>>{{"--spp", "0"},
                                               {"--spp", "-3"},
                                               {"--spp", "many"},
                                               {"--spp", "99999999999999"},
                                               {"--time", "0"},
                                               {"--time", "nan"},
                                               {"--time", "-1"},
                                               {"--noise", "0"},
                                               {"--noise", "nan"},
                                               {"--noise", "inf"},
                                               {"--spp", "1", "--time", "1"},
                                               {"--passes", ""},
                                               {"--passes", "1,,2"},
                                               {"--passes", "1,0"},
                                               {"--passes", "2000000000,9999"},
                                               {"--resolution", "32"},
                                               {"--resolution", "0x0"},
                                               {"--resolution", "-1x5"},
                                               {"--resolution", "32x18x3"},
                                               {"--resolution", "1000000x1000000"},
                                               {"--resolution", "99999999999x1"},
                                               {"--crop", "0,1"},
                                               {"--crop", "0.5,0.5,0,1"},
                                               {"--crop", "0,2,0,1"},
                                               {"--crop", "nan,1,0,1"},
                                               {"--threads", "-1"},
                                               {"--threads", "100000"},
                                               {"--seed", "-1"},
                                               {"--live", "99999"},
                                               {"--max-depth", "-1"},
                                               {"--frobnicate"},
                                               {"another.pbrt"}}) {
        const auto result = render(more);
        EXPECT_EQ(result.status, 2) << more[0] << ' ' << more.back();
        EXPECT_FALSE(result.err.empty());
        EXPECT_TRUE(result.out.empty()) << result.out;
        EXPECT_FALSE(std::filesystem::remove(folder_.file("room.exr"))) << "nothing may have been written";
    }
}

TEST_F(Program, RenderReportsTheKeysOfTheContract) {
    for (const std::string sampling : {"classical", "direction", "direction+roulette", "full"}) {
        const auto result = render({"--json", "-", "--spp", "3", "--sampling", sampling, "--seed", "7"});
        ASSERT_EQ(result.status, 0) << result.err;
        const json report = result.json();
        EXPECT_EQ(keys(report),
                  (std::vector<std::string>{"field_bytes", "guiding", "interrupted", "paths", "rejected_samples",
                                            "seconds", "segments", "settings", "spp", "training_seconds"}));
        EXPECT_EQ(report["spp"], 3);
        EXPECT_EQ(report["paths"], 3 * 16 * 12);
        EXPECT_GE(report["segments"], report["paths"]);
        EXPECT_GT(report["seconds"], 0);
        EXPECT_LE(report["training_seconds"], report["seconds"]);
        EXPECT_EQ(report["field_bytes"] > 0, sampling != "classical");
        EXPECT_EQ(report["rejected_samples"], 0);
        EXPECT_EQ(report["interrupted"], false);
        const json& settings = report["settings"];
        EXPECT_EQ(settings["sampling"], sampling);
        EXPECT_EQ(settings["seed"], 7);
        EXPECT_EQ(settings["max_depth"], 8);
        EXPECT_EQ(settings["resolution"], json({16, 12}));
        EXPECT_EQ(settings["passes"], json({1, 2}));
    }
}

TEST_F(Program, QuietSaysNothingButWhatIsWrong) {
    const auto noisy = render({"--spp", "1"});
    EXPECT_EQ(noisy.status, 0);
    EXPECT_TRUE(noisy.out.empty()) << "results on stdout only if asked for";
    EXPECT_TRUE(contains(noisy.err, "room.exr"));
    const auto quiet = render({"--spp", "1", "--quiet"});
    EXPECT_EQ(quiet.status, 0);
    EXPECT_EQ(quiet.out + quiet.err, "");
    const auto wrong = run_wend({"render", folder_.file("absent.pbrt"), "--quiet"});
    EXPECT_EQ(wrong.status, 2);
    EXPECT_TRUE(contains(wrong.err, "absent.pbrt"));
}

TEST_F(Program, WarningsAreNotesBesideTheResult) {
    const std::string odd = folder_.write("odd.pbrt", test::small_scene("Material \"diffuse\" \"float glow\" [ 1 ]\n"));
    const auto result = run_wend({"render", odd, "-o", folder_.file("odd.exr"), "--json", "-", "--spp", "1"});
    EXPECT_EQ(result.status, 0);
    EXPECT_TRUE(contains(result.err, "odd.pbrt:") && contains(result.err, "warning") && contains(result.err, "glow"))
        << result.err;
    EXPECT_TRUE(result.json().is_object());
}

TEST_F(Program, JsonGoesToAFileToo) {
    const auto result = render({"--spp", "1", "--json", folder_.file("result.json")});
    EXPECT_EQ(result.status, 0);
    EXPECT_TRUE(result.out.empty());
    EXPECT_EQ(json::parse(test::read_text(folder_.file("result.json")))["spp"], 1);
}

TEST_F(Program, FileNamesNeedNotBeUnicode) {
    const std::string scene = folder_.write("caf\xe9.pbrt", test::small_scene());
    const auto result = run_wend({"render", scene, "-o", folder_.file("caf\xe9.exr"), "--spp", "1", "--json", "-"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(result.json().is_object());
    EXPECT_TRUE(std::filesystem::exists(folder_.file("caf\xe9.exr")));
}

TEST_F(Program, ATimedRunCanBeRepeated) {
    const auto timed = render({"--time", "0.05", "--sampling", "direction", "--json", "-"}, "timed.exr");
    ASSERT_EQ(timed.status, 0) << timed.err;
    const json report = timed.json();
    EXPECT_GT(report["seconds"], 0);
    std::string passes;
    int samples = 0;
    for (const int pass : report["settings"]["passes"]) {
        passes += passes.empty() ? "" : ",";
        passes += std::to_string(pass);
        samples += pass;
    }
    EXPECT_EQ(samples, report["spp"]);
    const auto again = render({"--passes", passes, "--sampling", "direction", "--json", "-"}, "again.exr");
    // A pass that a busy machine drags out is stopped, and not among those that are told.
    if (report["interrupted"] == false) {
        EXPECT_EQ(again.json()["segments"], report["segments"]);
    }
}

TEST_F(Program, TheSceneNamesThePictureIfNobodyElseDoes) {
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(folder_.path());
    const auto result = run_wend({"render", "room.pbrt", "--spp", "1", "--json", "-"});
    std::filesystem::current_path(before);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.json()["settings"]["output"], "room.exr");
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "room.exr"));
}

TEST_F(Program, MetricReportsTheKeysOfTheContract) {
    make_reference();
    ASSERT_EQ(render({"--spp", "2", "--seed", "3"}, "two.exr").status, 0);
    ASSERT_EQ(render({"--spp", "32", "--seed", "4"}, "many.exr").status, 0);
    const auto result =
        run_wend({"metric", folder_.file("room"), folder_.file("two.exr"), folder_.file("many.exr"), "--json", "-"});
    ASSERT_EQ(result.status, 0) << result.err;
    const json rows = result.json()["rows"];
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(keys(rows[0]),
              (std::vector<std::string>{"error_p9999", "flip", "image", "mape", "mse", "relmse", "relmse_trimmed"}));
    EXPECT_EQ(rows[0]["image"], folder_.file("two.exr"));
    for (const char* measure : {"relmse", "mse", "mape", "flip"}) {
        EXPECT_GT(rows[0][measure], rows[1][measure]) << measure << ": more samples are nearer to the reference";
    }
    const auto table = run_wend({"metric", folder_.file("room.ref-a.exr"), folder_.file("room.ref-a.exr")});
    EXPECT_EQ(table.status, 0);
    EXPECT_TRUE(contains(table.out, "relMSE") && contains(table.out, "room.ref-a.exr")) << table.out;
}

TEST_F(Program, MetricNamesThePictureThatDoesNotFit) {
    make_reference();
    ASSERT_EQ(render({"--spp", "1", "--resolution", "8x8"}, "small.exr").status, 0);
    const auto size = run_wend({"metric", folder_.file("room"), folder_.file("small.exr")});
    EXPECT_EQ(size.status, 2);
    EXPECT_TRUE(contains(size.err, "small.exr")) << size.err;
    const auto absent = run_wend({"metric", folder_.file("nowhere"), folder_.file("small.exr")});
    EXPECT_EQ(absent.status, 2);
    EXPECT_TRUE(contains(absent.err, "nowhere") && contains(absent.err, "ref-a.exr")) << absent.err;
}

void expect_rows_of_compare(const json& rows, const char* guided) {
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0]["sampling"], "classical");
    EXPECT_EQ(rows[1]["sampling"], guided);
    for (const json& row : rows) {
        for (const char* key : {"sampling", "spp", "seconds", "relmse", "error_p9999", "ratio"}) {
            EXPECT_TRUE(row.contains(key)) << key;
        }
        EXPECT_GE(row["spp"], 1);
        EXPECT_GT(row["seconds"], 0);
        EXPECT_TRUE(row["relmse"].is_number());
    }
    EXPECT_NEAR(rows[0]["ratio"].get<double>(), 1, 1e-9) << "classical sampling against itself";
    const auto product = [](const json& row) { return row["relmse"].get<double>() * row["seconds"].get<double>(); };
    EXPECT_NEAR(rows[1]["ratio"].get<double>() * product(rows[1]), product(rows[0]), 1e-6 * std::abs(product(rows[0])));
}

TEST_F(Program, CompareReportsTheKeysOfTheContractAndAPage) {
    make_reference();
    const auto result = run_wend({"compare", scene_, "--time", "0.05", "--seeds", "1", "--sampling",
                                  "classical,direction", "--out", folder_.file("report"), "--json", "-", "--quiet"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(result.err.empty()) << result.err;
    expect_rows_of_compare(result.json()["rows"], "direction");
    const std::string page = test::read_text(folder_.path() / "report" / "index.html");
    EXPECT_TRUE(contains(page, "classical") && contains(page, "direction") && contains(page, "</html>"));
    for (const char* file : {"classical.png", "classical-error.png", "classical.exr", "direction.png"}) {
        EXPECT_TRUE(std::filesystem::exists(folder_.path() / "report" / file)) << file;
    }
}

TEST_F(Program, CompareRefusesBeforeItRenders) {
    const auto none = run_wend({"compare", scene_, "--time", "100", "--reference", folder_.file("hall")});
    EXPECT_EQ(none.status, 2);
    EXPECT_TRUE(contains(none.err, "hall.ref-a.exr")) << none.err;
    make_reference();
    const auto size = run_wend({"compare", scene_, "--time", "100", "--resolution", "8x8"});
    EXPECT_EQ(size.status, 2);
    EXPECT_TRUE(contains(size.err, "8 x 8") && contains(size.err, "16 x 12")) << size.err;
    const auto folder = run_wend({"compare", scene_, "--time", "100", "--out", scene_});
    EXPECT_EQ(folder.status, 2) << "the folder to write into is a file";
}

TEST_F(Program, DemoReportsTheRowsOfCompare) {
    make_reference();
    for (const char* half : {"a", "b"}) {
        const std::string end = std::string(".ref-") + half + ".exr";
        std::filesystem::rename(folder_.path() / ("room" + end), folder_.path() / ("demo" + end));
    }
    folder_.write("demo.pbrt", test::small_scene());
    const auto result = run_wend(
        {"demo", "--scenes", folder_.path().string(), "--time", "0.05", "--out", folder_.file("shown"), "--json", "-"});
    ASSERT_EQ(result.status, 0) << result.err;
    expect_rows_of_compare(result.json()["rows"], "full");
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "shown" / "index.html"));
    const auto absent = run_wend({"demo", "--scenes", folder_.file("nowhere")});
    EXPECT_EQ(absent.status, 2);
    EXPECT_TRUE(contains(absent.err, "nowhere")) << absent.err;
}

}  // namespace
}  // namespace wend
