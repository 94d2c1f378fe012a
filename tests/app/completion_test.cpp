// Completions for shells, and the manual page.
#include <tests/support/text.h>

#include "program_support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

namespace wend {
namespace {

using test::contains;
using test::run_wend;

using Words = std::vector<std::string>;

class Completion : public testing::Test {
protected:
    /// Runs a command by bash; what it writes.
    std::string run(const std::string& command) const {
        const std::string script = folder_.write("command.sh", command);
        const std::string out = folder_.file("out.txt");
        status_ = std::system(("bash '" + script + "' > '" + out + "' 2>&1").c_str());
        return test::read_text(out);
    }
    /// What bash offers for the last of these words, as its readline divides them.
    Words offered(const Words& words) const {
        const auto printed = run_wend({"completion", "bash"});
        EXPECT_EQ(printed.status, 0);
        std::string command = "set -u\nsource '" + folder_.write("wend.bash", printed.out) + "'\nCOMP_WORDS=(";
        for (const std::string& word : words) {
            command += " '" + word + "'";
        }
        command += " )\nCOMP_CWORD=" + std::to_string(words.size() - 1) +
                   "\n_wend\nfor word in \"${COMPREPLY[@]}\"; do echo \"$word\"; done\n";
        std::istringstream lines(run(command));
        EXPECT_EQ(status_, 0);
        Words all;
        for (std::string line; std::getline(lines, line);) {
            all.push_back(line);
        }
        return all;
    }
    static bool has(const Words& words, const std::string& word) {
        return std::find(words.begin(), words.end(), word) != words.end();
    }

    test::ScratchFolder folder_;
    mutable int status_ = -1;
};

TEST_F(Completion, BashOffersWhatThereIs) {
    const Words options = offered({"wend", "render", "--s"});
    EXPECT_TRUE(has(options, "--spp") && has(options, "--sampling")) << options.size();
    for (const std::string& option : options) {
        EXPECT_EQ(option.rfind("--s", 0), 0u) << option;
    }
    const Words commands = offered({"wend", ""});
    EXPECT_TRUE(has(commands, "render") && has(commands, "completion"));
    EXPECT_FALSE(has(commands, "man-page")) << "it is hidden";
    EXPECT_EQ(offered({"wend", "--co"}), Words{"--config"});
    EXPECT_EQ(offered({"wend", "render", "a.pbrt", "--progress", ""}), (Words{"bar", "json", "none"}));
    EXPECT_EQ(offered({"wend", "render", "--progress", "=", "j"}), Words{"json"});
    EXPECT_EQ(offered({"wend", "render", "--progress", "="}), (Words{"bar", "json", "none"}));
    EXPECT_EQ(offered({"wend", "--config", "render", "slab", "--sampler", "d"}), Words{"dwivedi"});
    EXPECT_EQ(offered({"wend", "completion", "b"}), Words{"bash"});
    // Where nothing is known bash offers files.
    EXPECT_EQ(offered({"wend", "render", "room"}), Words{});
    EXPECT_EQ(offered({"wend", "render", "--output", "room"}), Words{});
}

TEST_F(Completion, EveryOptionIsInEveryShellsScript) {
    for (const std::string command :
         {"render", "compare", "metric", "merge", "denoise", "demo", "halfspace", "slab", "field"}) {
        const Words words = offered({"wend", command, "--"});
        for (const char* shell : {"zsh", "fish"}) {
            const std::string script = run_wend({"completion", shell}).out;
            for (const std::string& word : words) {
                EXPECT_TRUE(contains(script, std::string(shell) == "zsh" ? word : "-l " + word.substr(2)))
                    << shell << ' ' << word;
            }
        }
        const std::string help = run_wend({command, "--help"}).out;
        EXPECT_GE(words.size(), 5u);
        for (const std::string& word : words) {
            EXPECT_TRUE(contains(help, word)) << word;
        }
    }
}

TEST_F(Completion, ShellsReadTheirScripts) {
    for (const std::string shell : {"bash", "zsh", "fish"}) {
        const std::string script = folder_.write("script", run_wend({"completion", shell}).out);
        const std::string said =
            run("if command -v " + shell + " > /dev/null; then " + shell + " -n '" + script + "'; fi");
        EXPECT_EQ(said, "");
        EXPECT_EQ(status_, 0) << shell;
    }
    EXPECT_EQ(run_wend({"completion"}).status, 2);
    const auto unknown = run_wend({"completion", "csh"});
    EXPECT_EQ(unknown.status, 2);
    EXPECT_TRUE(contains(unknown.err, "csh") && contains(unknown.err, "fish")) << unknown.err;
}

TEST_F(Completion, TheManualPageHasAllOfHelp) {
    const auto page = run_wend({"man-page"});
    ASSERT_EQ(page.status, 0) << page.err;
    EXPECT_FALSE(contains(run_wend({"--help"}).out, "man-page"));
    for (const std::string command :
         {"render", "compare", "metric", "merge", "denoise", "demo", "halfspace", "slab", "field"}) {
        EXPECT_TRUE(contains(page.out, ".SS wend " + command + "\n")) << command;
    }
    for (const char* text : {"\\fB\\-o\\fR, \\fB\\-\\-output\\fR \\fITEXT\\fR\n", "\\fB\\-\\-carry\\-field\\fR\n",
                             "\\fBbar\\fR | \\fBjson\\fR | \\fBnone\\fR", ".SH EXIT STATUS"}) {
        EXPECT_TRUE(contains(page.out, text)) << text;
    }
    folder_.write("wend.1", page.out);
    EXPECT_EQ(run("if command -v groff > /dev/null; then groff -man -Tutf8 -ww '" + folder_.file("wend.1") +
                  "' 2>&1 > /dev/null; fi"),
              "");
}

TEST_F(Completion, TheTreeAsJsonHasAllOfHelp) {
    const auto printed = run_wend({"man-page", "--format", "json"});
    ASSERT_EQ(printed.status, 0) << printed.err;
    std::size_t commands = 0;
    for (const auto& command : nlohmann::json::parse(printed.out)) {
        const std::string name = command.at("name");
        EXPECT_NE(name, "man-page") << "it is hidden";
        const std::string help = (name.empty() ? run_wend({"--help"}) : run_wend({name, "--help"})).out;
        EXPECT_TRUE(contains(help, command.at("description").get<std::string>())) << name;
        for (const auto& option : command.at("options")) {
            for (const char* part : {"description", "range", "group"}) {
                EXPECT_TRUE(contains(help, option.at(part).get<std::string>())) << option;
            }
            for (const char* others : {"names", "needs", "excludes", "choices"}) {
                for (const auto& other : option.at(others)) {
                    EXPECT_TRUE(contains(help, other.get<std::string>())) << option;
                }
            }
        }
        ++commands;
    }
    EXPECT_GE(commands, 10u);
    EXPECT_TRUE(contains(printed.out, "\"range\": \"INT in [1 - 1073741824]\""));
}

}  // namespace
}  // namespace wend
