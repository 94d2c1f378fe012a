// `wend halfspace` and `wend slab`: options, results, and what is refused.
#include <tests/support/text.h>

#include "program_support.h"
#include "xml_support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

using nlohmann::json;
using test::contains;
using test::keys;
using test::run_wend;

test::ProgramResult run_with(const std::string& command, std::vector<std::string> more) {
    more.insert(more.begin(), command);
    if (command == "slab") {
        more.insert(more.end(), {"--thickness", "2"});
    }
    return run_wend(more);
}

const std::vector<std::string> result_keys = {"collisions_per_walk", "exact",     "fom",      "mean",
                                              "rejected_samples",    "sampler",   "seconds",  "settings",
                                              "setup_seconds",       "std_error", "variance", "walks"};

TEST(PlanarCommands, SayHowTheyAreUsed) {
    for (const std::string command : {"halfspace", "slab"}) {
        const auto help = run_wend({command, "--help"});
        EXPECT_EQ(help.status, 0);
        for (const char* option :
             {"--albedo",    "--extinction",   "--g",       "--ior",          "--roughness",    "--mu0",
              "--incidence", "--sampler",      "--stretch", "--first-flight", "--exponentials", "--moments",
              "--modes",     "--guide-albedo", "--window",  "--adjoint",      "--walks",        "--seed",
              "--threads",   "--json",         "--quiet"}) {
            EXPECT_TRUE(contains(help.out, option)) << command << ' ' << option;
        }
        EXPECT_TRUE(contains(help.out, "Example")) << command;
        EXPECT_TRUE(contains(help.out, "wend " + command)) << command;
        EXPECT_EQ(contains(help.out, "--thickness"), command == "slab");
        EXPECT_EQ(contains(help.out, "--tally"), command == "slab");
        EXPECT_EQ(contains(help.out, "--table"), command == "halfspace");
    }
}

TEST(PlanarCommands, ReportTheKeysOfTheContract) {
    for (const std::string command : {"halfspace", "slab"}) {
        const auto result = run_with(command, {"--walks", "2000", "--albedo", "0.8", "--json", "-", "--seed", "3"});
        ASSERT_EQ(result.status, 0) << result.err;
        const json report = result.json();
        EXPECT_EQ(keys(report), result_keys);
        EXPECT_EQ(report["sampler"], "classical");
        EXPECT_EQ(report["walks"], 2000);
        EXPECT_EQ(report["rejected_samples"], 0);
        for (const char* key : {"mean", "std_error", "variance", "collisions_per_walk", "seconds", "fom", "exact"}) {
            EXPECT_TRUE(report[key].is_number() && report[key] > 0) << command << ' ' << key << report[key];
        }
        EXPECT_NEAR(report["mean"].get<double>(), report["exact"].get<double>(), 5 * report["std_error"].get<double>());
        EXPECT_EQ(report["settings"]["seed"], 3);
        EXPECT_EQ(report["settings"]["thickness"].is_null(), command == "halfspace");
    }
}

TEST(PlanarCommands, OptionsReachTheExperiment) {
    const auto result = run_with("slab", {"--albedo",
                                          "0.5",
                                          "--g",
                                          "-0.3",
                                          "--ior",
                                          "1.5",
                                          "--roughness",
                                          "0.3",
                                          "--incidence",
                                          "diffuse",
                                          "--tally",
                                          "transmittance",
                                          "--sampler",
                                          "dwivedi",
                                          "--first-flight",
                                          "classical",
                                          "--exponentials",
                                          "2",
                                          "--moments",
                                          "12",
                                          "--modes",
                                          "4",
                                          "--stretch",
                                          "0.25",
                                          "--window",
                                          "adjoint",
                                          "--guide-albedo",
                                          "0.6",
                                          "--walks",
                                          "1e2",
                                          "--threads",
                                          "1",
                                          "--json",
                                          "-"});
    ASSERT_EQ(result.status, 0) << result.err;
    const json expected = {{"albedo", {0.5}},
                           {"extinction", {1.0}},
                           {"g", -0.3},
                           {"ior", 1.5},
                           {"roughness", 0.3},
                           {"thickness", 2.0},
                           {"tally", "transmittance"},
                           {"incidence", "diffuse"},
                           {"mu0", nullptr},
                           {"sampler", "dwivedi"},
                           {"stretch", 0.25},
                           {"first_flight", "classical"},
                           {"exponentials", 2},
                           {"moments", "12"},
                           {"modes", 4},
                           {"adjoint", nullptr},
                           {"guide_albedo", 0.6},
                           {"window", "adjoint"},
                           {"seed", 0},
                           {"threads", 1}};
    EXPECT_EQ(result.json()["settings"], expected);
    EXPECT_EQ(result.json()["walks"], 100);
    const json oblique = run_with("halfspace", {"--mu0", "0.5", "--walks", "100", "--json", "-"}).json()["settings"];
    EXPECT_EQ(oblique["incidence"], "oblique");
    EXPECT_EQ(oblique["mu0"], 0.5);
}

TEST(PlanarCommands, ChromaticMediaHaveThreeOfEach) {
    const auto result =
        run_with("halfspace", {"--albedo", "0.9,0.8,0.5", "--extinction", "1,1.5,2", "--walks", "1000", "--json", "-"});
    ASSERT_EQ(result.status, 0) << result.err;
    const json report = result.json();
    for (const char* key : {"mean", "std_error", "variance", "fom", "exact"}) {
        ASSERT_TRUE(report[key].is_array()) << key;
        EXPECT_EQ(report[key].size(), 3u) << key;
    }
    EXPECT_TRUE(report["seconds"].is_number());
    const auto text = run_with("halfspace", {"--albedo", "0.9,0.8,0.5", "--walks", "1000"});
    EXPECT_TRUE(contains(text.out, "albedo 0.9, 0.8, 0.5")) << text.out;
}

TEST(PlanarCommands, PrintATableWithUnits) {
    const auto result = run_with("slab", {"--sampler", "modes", "--modes", "4", "--walks", "1000"});
    ASSERT_EQ(result.status, 0) << result.err;
    for (const char* part : {"slab of 2 mean free paths", "modes, 4 transients", "1000 walks", "mean", "standard error",
                             "exact", "variance of one walk", "1/s", "collisions", "seconds", "set-up"}) {
        EXPECT_TRUE(contains(result.out, part)) << part << " in:\n" << result.out;
    }
    EXPECT_TRUE(result.err.empty()) << result.err;
}

TEST(PlanarCommands, RefuseWhatCannotBeAndNameIt) {
    struct Case {
        std::vector<std::string> arguments;
        std::vector<std::string> parts;
    };
    std::vector<Case> cases = {
        {{"--sampler", "psychic"}, {"psychic", "analog", "classical", "modes"}},
        {{"--incidence", "sideways"}, {"sideways", "normal", "diffuse"}},
        {{"--first-flight", "short"}, {"short", "stretched", "classical"}},
        {{"--exponentials", "3"}, {"3", "1, 2"}},
        {{"--moments", "34"}, {"34", "01, 12"}},
        {{"--window", "open"}, {"open", "none", "adjoint", "weight"}},
        {{"--albedo", "0.5,0.6"}, {"0.5,0.6", "three"}},
        {{"--albedo", "0.5,,0.6"}, {"--albedo"}},
        {{"--extinction", "1,2"}, {"1,2", "three"}},
        {{"--walks", "0"}, {"--walks", "whole number"}},
        {{"--walks", "-5"}, {"--walks"}},
        {{"--walks", "1.5"}, {"--walks", "whole number"}},
        {{"--walks", "1e30"}, {"--walks", "1e+10"}},
        {{"--modes", "many"}, {"--modes"}},
        {{"--mu0", "0.5", "--incidence", "normal"}, {"--mu0", "--incidence"}},
        {{"--albedo", "1.5"}, {"albedo"}},
        {{"--albedo", "-0.1"}, {"albedo"}},
        {{"--extinction", "0"}, {"extinction"}},
        {{"--g", "1"}, {"g"}},
        {{"--ior", "0.5"}, {"ior"}},
        {{"--ior", "1.5", "--roughness", "-1"}, {"roughness"}},
        {{"--mu0", "0"}, {"mu0"}},
        {{"--mu0", "2"}, {"mu0"}},
        {{"--modes", "-1"}, {"modes"}},
        {{"--modes", "1000"}, {"modes"}},
        {{"--sampler", "stretched", "--stretch", "1"}, {"stretch"}},
        {{"--guide-albedo", "2"}, {"albedo"}},
    };
    for (const char* option : {"--albedo", "--extinction", "--g", "--ior", "--roughness", "--mu0", "--stretch",
                               "--guide-albedo", "--walks"}) {
        for (const char* value : {"nan", "inf", "-inf", "1e999", "", "one", "0.5x"}) {
            cases.push_back({{option, value}, {option}});
        }
    }
    for (const std::string command : {"halfspace", "slab"}) {
        for (const Case& c : cases) {
            const auto result = run_with(command, c.arguments);
            EXPECT_EQ(result.status, 2) << command << ' ' << c.arguments[0] << ' ' << c.arguments[1] << result.out;
            EXPECT_TRUE(result.out.empty());
            for (const std::string& part : c.parts) {
                EXPECT_TRUE(contains(result.err, part)) << part << " in: " << result.err;
            }
        }
    }
}

TEST(PlanarCommands, AnAdjointOfOnesOwnIsAFile) {
    const test::ScratchFolder folder;
    const std::string file = folder.write("adjoint.csv", "# length, near, far, shape\n2.5,1,0,1,-0.6\n\n1,0.5,0,1\n");
    const std::vector<std::string> arguments = {"--albedo", "0.9", "--sampler", "modes", "--json", "-"};
    const auto with = [&](const std::string& adjoint) {
        std::vector<std::string> all = arguments;
        all.insert(all.end(), {"--adjoint", adjoint});
        return run_with("halfspace", all);
    };
    const auto result = with(file);
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.json()["settings"]["adjoint"], json({{2.5, 1, 0, 1, -0.6}, {1, 0.5, 0, 1}}));
    EXPECT_EQ(result.json()["sampler"], "modes");
    const double error = result.json()["std_error"];
    EXPECT_NEAR(result.json()["mean"].get<double>(), result.json()["exact"].get<double>(), 4.5 * error);
    for (const auto& [content, part] :
         {std::pair("1,1,0,1\n1,1,x,1\n", ":2"), {"1,1,0\n", "3 numbers"}, {"", "modes"}}) {
        const auto wrong = with(folder.write("wrong.csv", content));
        EXPECT_EQ(wrong.status, 2);
        EXPECT_TRUE(contains(wrong.err, part)) << wrong.err;
    }
    EXPECT_EQ(with(folder.file("absent.csv")).status, 2);
}

TEST(PlanarCommands, ASlabNeedsAThickness) {
    const auto missing = run_wend({"slab", "--albedo", "0.8"});
    EXPECT_EQ(missing.status, 2);
    EXPECT_TRUE(contains(missing.err, "--thickness")) << missing.err;
    for (const char* value : {"0", "-1", "nan", "inf", "thick"}) {
        const auto result = run_wend({"slab", "--thickness", value});
        EXPECT_EQ(result.status, 2) << value;
        EXPECT_TRUE(contains(result.err, "thickness")) << result.err;
    }
    EXPECT_EQ(run_wend({"slab", "--thickness", "1", "--tally", "absorptance"}).status, 2);
}

TEST(PlanarCommands, TheTableComesWithPlotsAndAPage) {
    const test::ScratchFolder folder;
    const auto result =
        run_wend({"halfspace", "--table", "--out", folder.file("shown"), "--walks", "50", "--json", "-", "--quiet"});
    ASSERT_EQ(result.status, 0) << result.err;
    const json rows = result.json()["rows"];
    std::vector<std::string> expected = result_keys;
    expected.insert(expected.end(), {"albedo", "closed_form_variance", "fom_ratio", "name"});
    std::sort(expected.begin(), expected.end());
    for (const json& row : rows) {
        EXPECT_EQ(keys(row), expected);
        EXPECT_EQ(row["closed_form_variance"].is_number(),
                  row["sampler"] == "analog" || row["sampler"] == "classical" || row["sampler"] == "dwivedi");
        if (row["sampler"] == "classical") {
            EXPECT_EQ(row["fom_ratio"], 1);
        }
    }
    for (const std::string sampler : {"analog", "classical", "dwivedi", "boundary", "modes"}) {
        EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [&](const json& row) { return row["sampler"] == sampler; }))
            << sampler;
    }
    const std::string page = test::read_text(folder.path() / "shown" / "index.html");
    for (const std::string file : {"depth.svg", "direction.svg", "walks.svg", "variance.svg"}) {
        const std::string svg = test::read_text(folder.path() / "shown" / file);
        EXPECT_FALSE(svg.empty()) << file;
        EXPECT_EQ(test::xml_problem(svg), "") << file;
        EXPECT_TRUE(contains(page, svg)) << file;
    }
    EXPECT_TRUE(contains(page, "albedo 0.95") && contains(page, "boundary, 2 exponentials"));
}

TEST(PlanarCommands, TheTableRefusesBeforeItRuns) {
    const test::ScratchFolder folder;
    const auto varied =
        run_wend({"halfspace", "--table", "--albedo", "0.5", "--walks", "1e10", "--out", folder.file("a")});
    EXPECT_EQ(varied.status, 2);
    EXPECT_TRUE(contains(varied.err, "--albedo")) << varied.err;
    const auto file = run_wend({"halfspace", "--table", "--walks", "1e10", "--out", folder.write("file", "")});
    EXPECT_EQ(file.status, 2) << "the folder to write into is a file";
    EXPECT_EQ(run_wend({"halfspace", "--out", folder.file("b")}).status, 2) << "there is nothing to write";
    EXPECT_EQ(folder.names(), std::vector<std::string>{"file"});
}

}  // namespace
}  // namespace wend
