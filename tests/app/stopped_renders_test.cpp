// Renders that are stopped, killed and resumed by the command line, and what they tell while they run.
#include "program_support.h"

#include <wend/core/random.h>
#include <wend/io/image_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <thread>

namespace wend {
namespace {

using nlohmann::json;
using test::run_wend;

class SlowStoppedRender : public testing::Test {
protected:
    SlowStoppedRender() : scene_(folder_.write("room.pbrt", test::small_scene())) {}

    std::vector<std::string> arguments(const std::string& picture, int samples,
                                       const std::vector<std::string>& more = {}) const {
        std::vector<std::string> all = {
            "render", scene_, "-o", folder_.file(picture), "--spp", std::to_string(samples)};
        all.insert(all.end(), {"--resolution", "48x36", "--quiet"});
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    std::string bytes(const std::string& name) const { return test::read_text(folder_.file(name)); }
    bool exists(const std::string& name) const { return std::filesystem::exists(folder_.path() / name); }
    bool wait_for(const std::string& name) const {
        for (int i = 0; i < 3000 && !exists(name); ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return exists(name);
    }

    test::ScratchFolder folder_;
    std::string scene_;
};

// 20 processes that live for 50 to 300 ms, and one that ends what they began.
TEST_F(SlowStoppedRender, KilledAgainAndAgainItIsTheSameFile) {
    constexpr int samples = 400, kills = 20;
    ASSERT_EQ(run_wend(arguments("whole.exr", samples)).status, 0);
    Pcg32 random(3);
    const auto next = [&] {
        std::vector<std::string> more = {
            "--checkpoint",       folder_.file("room.checkpoint"),
            "--checkpoint-every", "0.05",
            "--threads",          std::vector<std::string>{"1", "2", "5"}[random.next() % 3]};
        if (exists("room.checkpoint")) {
            more.insert(more.end(), {"--resume", folder_.file("room.checkpoint")});
        }
        return arguments("room.exr", samples, more);
    };
    int killed = 0;
    while (killed < kills && !exists("room.exr")) {
        test::WendProcess process(next(), folder_);
        std::this_thread::sleep_for(std::chrono::milliseconds(50 + random.next() % 250));
        process.signal(SIGKILL);
        killed += process.wait().status == -SIGKILL ? 1 : 0;
    }
    EXPECT_GT(killed, 2) << "the render is too short for the test";
    ASSERT_TRUE(exists("room.checkpoint"));
    test::WendProcess last(next(), folder_);
    ASSERT_EQ(last.wait().status, 0);
    EXPECT_TRUE(bytes("room.exr") == bytes("whole.exr")) << "killed " << killed << " times";
}

TEST_F(SlowStoppedRender, StoppedBySignalItGoesOnWhereItWas) {
    ASSERT_EQ(run_wend(arguments("whole.exr", 150)).status, 0);
    const std::vector<std::string> kept = {"--checkpoint", folder_.file("room.checkpoint"), "--checkpoint-every",
                                           "1000"};
    {
        std::vector<std::string> more = kept;
        // On one thread it takes long enough to be stopped.
        more.insert(more.end(), {"--write-every", "1000", "--threads", "1"});
        test::WendProcess process(arguments("room.exr", 150, more), folder_);
        ASSERT_TRUE(wait_for("room.exr")) << "the first pass leaves a picture";
        process.signal(SIGTERM);
        EXPECT_EQ(process.wait().status, 128 + SIGTERM);
    }
    EXPECT_FALSE(bytes("room.exr") == bytes("whole.exr"));
    std::vector<std::string> more = kept;
    more.insert(more.end(), {"--resume", folder_.file("room.checkpoint")});
    ASSERT_EQ(run_wend(arguments("room.exr", 150, more)).status, 0);
    EXPECT_TRUE(bytes("room.exr") == bytes("whole.exr"));
    // What has ended can go on, too.
    ASSERT_EQ(run_wend(arguments("more.exr", 181, more)).status, 0);
    EXPECT_EQ(read_picture(folder_.file("more.exr")).metadata.at("wend:spp"), "181");
}

TEST_F(SlowStoppedRender, AFullDiskKeepsTheLastGoodCheckpoint) {
    const std::vector<std::string> kept = {"--checkpoint",       folder_.file("room.checkpoint"),
                                           "--checkpoint-every", "0.05",
                                           "--resume",           folder_.file("room.checkpoint")};
    {
        test::WendProcess process(arguments("room.exr", 150, {kept.begin(), kept.begin() + 4}), folder_);
        ASSERT_TRUE(wait_for("room.checkpoint"));
        process.signal(SIGTERM);
        ASSERT_EQ(process.wait().status, 128 + SIGTERM);
    }
    std::filesystem::remove(folder_.file("stdout.txt"));
    const std::string good = bytes("room.checkpoint");
    // No file may be as large as a checkpoint; pictures are smaller, the whole one and those before it.
    ASSERT_EQ(run_wend(arguments("whole.exr", 150)).status, 0);
    const std::uint64_t most = std::filesystem::file_size(folder_.file("whole.exr")) * 3 / 2;
    ASSERT_LT(most, good.size());
    std::signal(SIGXFSZ, SIG_IGN);
    test::ProgramResult result;
    {
        const test::ResourceLimit limit(RLIMIT_FSIZE, most);
        result = run_wend(arguments("room.exr", 150, kept));
    }
    std::signal(SIGXFSZ, SIG_DFL);
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.err.find("room.checkpoint: cannot write"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("the render goes on"), std::string::npos) << result.err;
    EXPECT_TRUE(bytes("room.checkpoint") == good);
    EXPECT_TRUE(bytes("room.exr") == bytes("whole.exr"));
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"room.checkpoint", "room.exr", "room.pbrt", "whole.exr"}));
}

TEST_F(SlowStoppedRender, WherePicturesCannotBeWrittenTheCheckpointIsLeft) {
    ASSERT_EQ(run_wend(arguments("whole.exr", 150)).status, 0);
    std::filesystem::create_directory(folder_.path() / "gone");
    const std::vector<std::string> kept = {"--checkpoint", folder_.file("room.checkpoint"), "--checkpoint-every",
                                           "1000"};
    {
        std::vector<std::string> more = kept;
        // On one thread it takes long enough to be stopped.
        more.insert(more.end(), {"--write-every", "1000", "--threads", "1"});
        test::WendProcess process(arguments("gone/room.exr", 150, more), folder_);
        ASSERT_TRUE(wait_for("gone/room.exr"));
        std::filesystem::remove_all(folder_.path() / "gone");
        process.signal(SIGTERM);
        const auto result = process.wait();
        EXPECT_EQ(result.status, 1);
        EXPECT_NE(result.err.find("gone/room.exr"), std::string::npos) << result.err;
    }
    std::vector<std::string> more = kept;
    more.insert(more.end(), {"--resume", folder_.file("room.checkpoint")});
    ASSERT_EQ(run_wend(arguments("room.exr", 150, more)).status, 0);
    EXPECT_TRUE(bytes("room.exr") == bytes("whole.exr"));
}

TEST_F(SlowStoppedRender, AnotherRenderIsRefusedByWhatIsDifferent) {
    const std::string file = folder_.file("room.checkpoint");
    ASSERT_EQ(run_wend(arguments("room.exr", 9, {"--checkpoint", file, "--seed", "3"})).status, 0);
    const auto refused = [&](std::vector<std::string> more, const std::string& what) {
        more.insert(more.end(), {"--resume", file});
        const auto result = run_wend(arguments("room.exr", 9, more));
        EXPECT_EQ(result.status, 2);
        EXPECT_NE(result.err.find("room.checkpoint: error"), std::string::npos) << result.err;
        EXPECT_NE(result.err.find(what), std::string::npos) << result.err;
    };
    refused({}, "seed was 3 and is 0");
    refused({"--seed", "3", "--sampling", "direction"}, "sampling was \"full\" and is \"direction\"");
    refused({"--seed", "3", "--max-depth", "2"}, "max_depth was 8 and is 2");
    refused({"--seed", "3", "--crop", "0,0.5,0,1"}, "crop was");
    refused({"--seed", "3", "--layers", "volume"}, "layers was none and is [\"volume\"]");
    folder_.write("room.pbrt", test::small_scene() + "\n# A word more.\n");
    refused({"--seed", "3"}, "room.pbrt has changed");
    folder_.write("room.pbrt", test::small_scene());
    EXPECT_EQ(run_wend(arguments("room.exr", 9, {"--seed", "3", "--threads", "1", "--resume", file})).status, 0);
    // Not a byte may be missing or different.
    const std::string good = bytes("room.checkpoint");
    Pcg32 random(1);
    for (int i = 0; i < 40; ++i) {
        std::string bad = good;
        const std::size_t place = random.next() % bad.size();
        if (i % 2 == 0) {
            bad.resize(place);
        } else {
            bad[place] = static_cast<char>(bad[place] + 1);
        }
        folder_.write("room.checkpoint", bad);
        const auto result = run_wend(arguments("room.exr", 9, {"--seed", "3", "--resume", file}));
        EXPECT_EQ(result.status, 2) << place;
        EXPECT_NE(result.err.find("room.checkpoint: error"), std::string::npos) << result.err;
    }
}

TEST_F(SlowStoppedRender, ProgressForProgramsIsALineOfJsonEach) {
    const std::string file = folder_.file("progress.jsonl");
    for (const bool to_file : {false, true}) {
        const auto result = run_wend(arguments("room.exr", 40,
                                               to_file ? std::vector<std::string>{"--progress-file", file}
                                                       : std::vector<std::string>{"--progress", "json"}));
        ASSERT_EQ(result.status, 0) << result.err;
        std::istringstream lines(to_file ? bytes("progress.jsonl") : result.err);
        std::vector<json> read;
        for (std::string line; std::getline(lines, line);) {
            read.push_back(json::parse(line));
        }
        ASSERT_GE(read.size(), 2u);
        for (const json& line : read) {
            for (const char* key : {"fraction", "spp", "noise", "seconds", "left", "phase"}) {
                EXPECT_TRUE(line.contains(key)) << key;
            }
        }
        EXPECT_EQ(read.back()["phase"], "done");
        EXPECT_EQ(read.back()["fraction"], 1);
        EXPECT_EQ(read.back()["spp"], 40);
        EXPECT_GT(read.back()["noise"], 0);
    }
}

TEST_F(SlowStoppedRender, GoesOnWhereNobodyReadsItsProgressAnyMore) {
    const std::string picture = folder_.file("room.exr"), status = folder_.file("status.txt");
    const std::string command = "{ '" + test::wend_program() + "' render '" + scene_ +
                                "' --resolution 48x36 --spp 40 -o '" + picture + "' --progress json; echo $? > '" +
                                status + "'; } 2>&1 | true";
    EXPECT_EQ(std::system(command.c_str()), 0);
    ASSERT_TRUE(wait_for("room.exr"));
    ASSERT_TRUE(wait_for("status.txt"));
    EXPECT_EQ(bytes("status.txt"), "0\n");
}

TEST_F(SlowStoppedRender, ResumesWithTheFieldThatItBeganWith) {
    const std::string field = folder_.file("room.field"), file = folder_.file("room.checkpoint");
    ASSERT_EQ(run_wend(arguments("taught.exr", 15, {"--save-field", field})).status, 0);
    const std::vector<std::string> kept = {"--load-field", field, "--checkpoint", file, "--checkpoint-every", "1000"};
    ASSERT_EQ(run_wend(arguments("whole.exr", 150, kept)).status, 0);
    std::filesystem::remove(file);
    {
        std::vector<std::string> more = kept;
        // On one thread it takes long enough to be stopped.
        more.insert(more.end(), {"--write-every", "1000", "--threads", "1"});
        test::WendProcess process(arguments("room.exr", 150, more), folder_);
        ASSERT_TRUE(wait_for("room.exr"));
        process.signal(SIGTERM);
        ASSERT_EQ(process.wait().status, 128 + SIGTERM);
    }
    // The very command that a farm starts again.
    std::vector<std::string> more = kept;
    more.insert(more.end(), {"--resume", file});
    const auto result = run_wend(arguments("room.exr", 150, more));
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(bytes("room.exr") == bytes("whole.exr"));
}

TEST_F(SlowStoppedRender, SaysItIsDoneWhenThereIsAPicture) {
    const auto failed = run_wend({"render", scene_, "-o", "/dev/full", "--spp", "1", "--quiet", "--progress", "json"});
    EXPECT_EQ(failed.status, 1);
    EXPECT_EQ(failed.err.find("done"), std::string::npos) << failed.err;
}

TEST_F(SlowStoppedRender, SaysOnceThatNobodyCanReadItsProgress) {
    const auto result = run_wend(arguments("room.exr", 40, {"--progress-file", "/dev/full"}));
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "warning: /dev/full: cannot write: No space left on device; the render goes on\n");
}

TEST_F(SlowStoppedRender, EndsAtTheNoiseThatIsAskedFor) {
    const auto result = run_wend({"render", scene_, "-o", folder_.file("room.exr"), "--resolution", "48x36", "--quiet",
                                  "--noise", "0.1", "--progress", "json", "--json", "-"});
    ASSERT_EQ(result.status, 0) << result.err;
    const json last = json::parse(result.err.substr(result.err.rfind('\n', result.err.size() - 2) + 1));
    EXPECT_LE(last["noise"], 0.1);
    EXPECT_GT(last["noise"], 0.03) << "it did not render for long after";
    EXPECT_EQ(result.json()["interrupted"], false);
    EXPECT_GT(result.json()["spp"], 16);
}

}  // namespace
}  // namespace wend
