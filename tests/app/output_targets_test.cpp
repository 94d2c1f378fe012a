// What outputs may be written to, and what stays of it.
#include "program_support.h"

#include <wend/app/program.h>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <sstream>
#include <thread>

namespace wend {
namespace {

namespace fs = std::filesystem;
using test::run_wend;

class OutputTargets : public testing::Test {
protected:
    test::ProgramResult render(std::vector<std::string> more) const {
        more.insert(more.begin(), {"render", scene_, "--spp", "1", "--resolution", "4x4", "--quiet"});
        return run_wend(more);
    }

    test::ScratchFolder folder_;
    std::string scene_ = folder_.write("scene.pbrt", test::small_scene());
};

TEST_F(OutputTargets, APipeIsWrittenToAndStays) {
    const std::string pipe = folder_.file("pipe");
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    std::string told;
    std::thread reader([&] { told = test::read_text(pipe); });
    const auto result = render({"-o", folder_.file("a.exr"), "--json", pipe});
    reader.join();
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(nlohmann::json::parse(told)["spp"], 1);
    EXPECT_TRUE(fs::is_fifo(pipe));
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"a.exr", "pipe", "scene.pbrt"}));
}

TEST_F(OutputTargets, APictureGoesIntoAPipeAsOpenExr) {
    const std::string pipe = folder_.file("pipe");
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    std::string picture;
    std::thread reader([&] { picture = test::read_text(pipe); });
    const auto result = render({"-o", pipe});
    reader.join();
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(picture.starts_with("\x76\x2f\x31\x01"));
}

TEST_F(OutputTargets, LinksStayAndModesAreKept) {
    fs::create_directory(folder_.file("there"));
    const std::string target = folder_.write("there/old.json", "");
    ASSERT_EQ(chmod(target.c_str(), 0640), 0);
    fs::create_symlink("there/old.json", folder_.file("link.json"));
    fs::create_symlink("link.json", folder_.file("link_to_link.json"));
    fs::create_symlink("there/new.json", folder_.file("dangling.json"));
    for (const char* name : {"link_to_link.json", "dangling.json"}) {
        EXPECT_EQ(render({"-o", folder_.file("a.exr"), "--json", folder_.file(name)}).status, 0);
        EXPECT_TRUE(fs::is_symlink(folder_.file(name)));
        EXPECT_EQ(nlohmann::json::parse(test::read_text(folder_.file(name)))["spp"], 1);
    }
    EXPECT_FALSE(test::read_text(target).empty());
    EXPECT_EQ(static_cast<int>(fs::status(target).permissions()), 0640);
    EXPECT_TRUE(fs::is_regular_file(folder_.file("there/new.json")));
}

TEST_F(OutputTargets, OneNameForTwoIsRefused) {
    const std::string a = folder_.file("a.exr");
    fs::create_symlink("a.exr", folder_.file("b.exr"));
    for (const std::vector<std::string>& options :
         {std::vector<std::string>{"-o", a, "--json", a},
          {"-o", a, "--json", folder_.file("./a.exr")},
          {"-o", a, "--save-field", folder_.file("b.exr")},
          {"-o", a, "--save-field", folder_.file("f"), "--save-records", folder_.file("f")}}) {
        const auto result = render(options);
        EXPECT_EQ(result.status, 2);
        EXPECT_NE(result.err.find("would be written twice"), std::string::npos) << result.err;
    }
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"b.exr", "scene.pbrt"}));
}

TEST_F(OutputTargets, WhatIsReadIsNotWrittenOver) {
    const std::string before = test::read_text(scene_);
    const auto result = render({"-o", folder_.file("a.exr"), "--json", scene_});
    EXPECT_EQ(result.status, 2);
    EXPECT_NE(result.err.find("is read from"), std::string::npos) << result.err;
    EXPECT_EQ(test::read_text(scene_), before);
    const std::string picture = folder_.file("a.exr");
    ASSERT_EQ(render({"-o", picture}).status, 0);
    EXPECT_EQ(run_wend({"metric", picture, picture, "--json", picture}).status, 2);
}

TEST_F(OutputTargets, AFullStandardOutputIsAFailure) {
    const std::string picture = folder_.file("a.exr");
    for (const std::vector<const char*>& arguments :
         {std::vector<const char*>{"wend", "render", scene_.c_str(), "--spp", "1", "--resolution", "4x4", "--quiet",
                                   "-o", picture.c_str(), "--json", "-"},
          {"wend", "--help"}}) {
        std::ofstream full("/dev/full");
        std::ostringstream err;
        EXPECT_EQ(run_program(static_cast<int>(arguments.size()), arguments.data(), full, err), 1);
        EXPECT_EQ(err.str(), "error: cannot write to the standard output\n");
    }
}

TEST_F(OutputTargets, SeedsAndThreadsOutOfRangeAreRefused) {
    for (const char* seed : {"-1", "1.5", "1e30", "18446744073709551616", "99999999999999999999999", "x"}) {
        EXPECT_EQ(render({"-o", folder_.file("a.exr"), "--seed", seed}).status, 2) << seed;
    }
    EXPECT_EQ(render({"-o", folder_.file("a.exr"), "--seed", "18446744073709551615"}).status, 0);
    for (const char* threads : {"-1", "1000000", "99999999999999999999", "x"}) {
        EXPECT_EQ(render({"-o", folder_.file("a.exr"), "--threads", threads}).status, 2) << threads;
    }
}

}  // namespace
}  // namespace wend
