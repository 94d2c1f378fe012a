// Frames of a film: many scenes in one call of wend render.
#include <tests/support/text.h>

#include "program_support.h"

#include <wend/app/frames.h>
#include <wend/core/error.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

namespace wend {
namespace {

using test::contains;
using test::run_wend;

TEST(FrameNames, AreNumbersWithDigits) {
    EXPECT_EQ(parse_frames("7"), std::vector<int>{7});
    EXPECT_EQ(parse_frames("0-3"), (std::vector<int>{0, 1, 2, 3}));
    EXPECT_EQ(parse_frames("08-12x3"), (std::vector<int>{8, 11}));
    EXPECT_EQ(parse_frames("5-5"), std::vector<int>{5});
    EXPECT_EQ(parse_frames("999999998-999999999").size(), 2u);
    EXPECT_EQ(with_frame_number("a.####.pbrt", 7), "a.0007.pbrt");
    EXPECT_EQ(with_frame_number("a#", 12), "a12") << "no digit is lost";
    EXPECT_EQ(with_frame_number("##/a.exr", 3), "03/a.exr");
    EXPECT_EQ(with_frame_number("a.exr", 3), "a.exr");
    EXPECT_THROW(with_frame_number("#/a.##", 3), InputError);
}

TEST(FrameNames, RefuseWhatIsNoRange) {
    for (const char* text : {"", "-", "1-", "-3", "1-2-3", "a", "1-48x", "1-48x0", "1-48y2", " 1", "1 ", "1,2", "5-1",
                             "1-999999999999", "99999999999999999999", "1-999999999", "7x2x2"}) {
        EXPECT_THROW(parse_frames(text), InputError) << text;
    }
}

class Frames : public testing::Test {
protected:
    Frames() {
        for (const char* number : {"08", "09", "10"}) {
            folder_.write(std::string("room.") + number + ".pbrt", test::small_scene());
        }
    }

    /// `wend render` of the three frames with more arguments.
    std::vector<std::string> arguments(const std::vector<std::string>& more, const std::string& frames = "8-10",
                                       const std::string& output = "out.###.exr") const {
        std::vector<std::string> all = {"render", folder_.file("room.##.pbrt"), "--frames", frames,
                                        "-o",     folder_.file(output)};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    test::ProgramResult render(const std::vector<std::string>& more, const std::string& frames = "8-10",
                               const std::string& output = "out.###.exr") const {
        return run_wend(arguments(more, frames, output));
    }
    bool exists(const std::string& name) const { return std::filesystem::exists(folder_.path() / name); }
    std::string bytes(const std::string& name) const { return test::read_text(folder_.file(name)); }

    test::ScratchFolder folder_;
};

TEST_F(Frames, EachHasItsFiles) {
    const auto result =
        render({"--spp", "3", "--quiet", "--json", folder_.file("#.json"), "--save-field", folder_.file("#.field"),
                "--checkpoint", folder_.file("#.checkpoint"), "--progress-file", folder_.file("#.jsonl")});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.out + result.err, "");
    for (const char* name : {"8", "9", "10"}) {
        for (const char* kind : {".json", ".field", ".checkpoint", ".jsonl"}) {
            EXPECT_TRUE(exists(std::string(name) + kind)) << name << kind;
        }
    }
    EXPECT_EQ(folder_.names().size(), 3u * 6);
    // A frame is what it is alone.
    ASSERT_EQ(run_wend({"render", folder_.file("room.09.pbrt"), "-o", folder_.file("alone.exr"), "--spp", "3"}).status,
              0);
    EXPECT_TRUE(bytes("alone.exr") == bytes("out.009.exr"));
}

TEST_F(Frames, EverySecondAndOne) {
    ASSERT_EQ(render({"--spp", "1"}, "8-10x2").status, 0);
    EXPECT_TRUE(exists("out.008.exr") && !exists("out.009.exr") && exists("out.010.exr"));
    ASSERT_EQ(render({"--spp", "1"}, "9", "nine.exr").status, 0) << "one frame needs no number in its picture's name";
    EXPECT_TRUE(exists("nine.exr"));
}

TEST_F(Frames, WithoutANameThePicturesHaveTheScenes) {
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(folder_.path());
    const auto result = run_wend({"render", "room.##.pbrt", "--frames", "8-9", "--spp", "1"});
    std::filesystem::current_path(before);
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(exists("room.08.exr") && exists("room.09.exr"));
}

TEST_F(Frames, AreRefusedBeforeAnythingIsRendered) {
    const std::string room = folder_.file("room.##.pbrt");
    const std::string out = folder_.file("out.#.exr");
    struct Case {
        std::vector<std::string> arguments;
        std::vector<std::string> expected;
    };
    for (const Case& c :
         {Case{{room, "--frames", "8-11", "-o", out}, {"room.11.pbrt", "frame 11"}},
          Case{{room, "--frames", "8-10", "-o", folder_.file("out.exr")}, {"out.exr", "####"}},
          Case{{room, "--frames", "8-10", "-o", out, "--json", folder_.file("a.json")}, {"a.json", "####"}},
          Case{{room, "--frames", "8-10", "-o", out, "--checkpoint", folder_.file("a")}, {"a: error", "####"}},
          Case{{folder_.file("room.08.pbrt"), "--frames", "8-10", "-o", out}, {"room.08.pbrt", "####"}},
          Case{{folder_.file("#.##.pbrt"), "--frames", "8-10", "-o", out}, {"#.##.pbrt", "two groups"}},
          Case{{room, "--frames", "8-10", "-o", folder_.file("#/out.#.exr")}, {"two groups"}},
          Case{{room, "--frames", "8-10", "-o", folder_.file("#/out.exr")}, {"8/out.exr", "no folder"}},
          Case{{room, "--frames", "10-8", "-o", out}, {"10-8", "before the first"}},
          Case{{room, "--frames", "1-999999999999", "-o", out}, {"1-999999999999", "nine digits"}},
          Case{{room, "--frames", "1-999999999", "-o", out}, {"100000"}},
          Case{{room, "--frames", "", "-o", out}, {"--frames"}},
          Case{{room, "--frames", "8-10", "-o", out, "--crop", "0,2,0,1"}, {"--crop 0,2,0,1"}},
          Case{{room, "--frames", "8-10", "-o", out, "--sampling", "psychic"}, {"'psychic'"}},
          Case{{room, "--frames", "8-10", "-o", out, "--load-field", folder_.file("#.field")}, {"8.field"}},
          Case{{room, "--frames", "8-9", "-o", out, "--json", folder_.file("room.0#.pbrt")}, {"read from"}},
          Case{{room, "--frames", "8-10", "-o", out, "--carry-field", "--sampling", "classical"}, {"--carry-field"}},
          Case{{room, "-o", out, "--carry-field"}, {"--carry-field", "--frames"}}}) {
        std::vector<std::string> arguments = c.arguments;
        arguments.insert(arguments.begin(), "render");
        const auto result = run_wend(arguments);
        EXPECT_EQ(result.status, 2) << result.err;
        for (const std::string& part : c.expected) {
            EXPECT_TRUE(contains(result.err, part)) << part << " in: " << result.err;
        }
        EXPECT_LE(std::count(result.err.begin(), result.err.end(), '\n'), 2) << result.err;
        EXPECT_EQ(folder_.names().size(), 3u) << "nothing may have been written";
    }
}

TEST_F(Frames, NoneWritesOverAnotherOnesScene) {
    folder_.write("1.pbrt", test::small_scene());
    folder_.write("11.pbrt", test::small_scene());
    const auto result = run_wend({"render", folder_.file("#.pbrt"), "--frames", "1-11x10", "-o", folder_.file("#.exr"),
                                  "--json", folder_.file("1#.pbrt"), "--spp", "1"});
    EXPECT_EQ(result.status, 2);
    EXPECT_TRUE(contains(result.err, "11.pbrt: error: would be written over")) << result.err;
    EXPECT_FALSE(exists("1.exr"));
}

TEST_F(Frames, ABadOneIsToldAndTheOthersAreRendered) {
    folder_.write("room.08.pbrt", "Nonsense");
    const auto result = render({"--spp", "1", "--quiet"});
    EXPECT_EQ(result.status, 2);
    EXPECT_TRUE(contains(result.err, "frame 8: ") && contains(result.err, "room.08.pbrt:1")) << result.err;
    EXPECT_TRUE(contains(result.err, "1 of 3 frames failed: 8\n")) << result.err;
    EXPECT_TRUE(!exists("out.008.exr") && exists("out.009.exr") && exists("out.010.exr"));
}

TEST_F(Frames, TheStatusIsTheFirstErrors) {
    const auto render_on_a_full_disk = [&] {
        std::signal(SIGXFSZ, SIG_IGN);
        test::ProgramResult result;
        {
            const test::ResourceLimit limit(RLIMIT_FSIZE, 512);
            result = render({"--spp", "1", "--quiet"});
        }
        std::signal(SIGXFSZ, SIG_DFL);
        return result;
    };
    folder_.write("room.10.pbrt", "Nonsense");
    const auto failure = render_on_a_full_disk();
    EXPECT_EQ(failure.status, 1) << failure.err;
    EXPECT_TRUE(contains(failure.err, "3 of 3 frames failed: 8, 9, 10")) << failure.err;
    folder_.write("room.08.pbrt", "Nonsense");
    EXPECT_EQ(render_on_a_full_disk().status, 2);
    EXPECT_EQ(folder_.names().size(), 3u);
}

TEST_F(Frames, ASignalEndsAllWithThePictureAtHand) {
    test::WendProcess process(arguments({"--spp", "100000000"}), folder_);
    ASSERT_TRUE(process.wait_for_progress());
    process.signal(SIGTERM);
    const auto result = process.wait();
    EXPECT_EQ(result.status, 128 + SIGTERM) << result.err;
    EXPECT_TRUE(exists("out.008.exr"));
    EXPECT_FALSE(exists("out.009.exr") || exists("out.010.exr"));
}

TEST_F(Frames, CarryWhatTheyHaveLearned) {
    const std::vector<std::string> base = {
        "--spp", "7", "--sampling", "direction", "--quiet", "--save-field", folder_.file("#.field")};
    ASSERT_EQ(render(base).status, 0);
    std::vector<std::string> more = base;
    more.push_back("--carry-field");
    ASSERT_EQ(render(more, "8-10", "carried.##.exr").status, 0);
    // The first frame has nothing to begin with.
    EXPECT_TRUE(bytes("carried.08.exr") == bytes("out.008.exr"));
    EXPECT_FALSE(bytes("carried.09.exr") == bytes("out.009.exr"));
    // It is what --load-field does with the field of the frame before, were it not told that the scene is another one.
    const std::string field = bytes("8.field");
    folder_.write("8.field", std::string_view(field).substr(0, field.find("WENDSCENE\x1a") - sizeof(std::uint64_t)));
    ASSERT_EQ(
        run_wend({"render", folder_.file("room.09.pbrt"), "-o", folder_.file("loaded.exr"), "--spp", "7", "--sampling",
                  "direction", "--load-field", folder_.file("8.field"), "--save-field", folder_.file("again.field")})
            .status,
        0);
    EXPECT_TRUE(bytes("carried.09.exr") == bytes("loaded.exr"));
}

class SeveralScenes : public Frames {
protected:
    SeveralScenes() { std::filesystem::create_directory(folder_.file("out")); }
};

TEST_F(SeveralScenes, HaveTheirPicturesInAFolder) {
    const std::string out = folder_.file("out");
    ASSERT_EQ(run_wend({"render", folder_.file("room.10.pbrt"), folder_.file("room.08.pbrt"), "-o", out, "--spp", "2",
                        "--json", folder_.file("#.json"), "--quiet"})
                  .status,
              0);
    ASSERT_EQ(run_wend({"render", folder_.file("room.08.pbrt"), "-o", folder_.file("alone.exr"), "--spp", "2"}).status,
              0);
    EXPECT_TRUE(bytes("out/room.08.exr") == bytes("alone.exr"));
    EXPECT_TRUE(exists("out/room.10.exr") && exists("1.json") && exists("2.json"));
    // One scene as well.
    ASSERT_EQ(run_wend({"render", folder_.file("room.09.pbrt"), "-o", out + "/", "--spp", "2"}).status, 0);
    EXPECT_TRUE(exists("out/room.09.exr"));
}

TEST_F(SeveralScenes, ABadOneIsToldAndTheOthersAreRendered) {
    folder_.write("room.08.pbrt", "Nonsense");
    const auto result = run_wend({"render", folder_.file("room.08.pbrt"), folder_.file("room.09.pbrt"), "-o",
                                  folder_.file("out"), "--spp", "1", "--quiet"});
    EXPECT_EQ(result.status, 2);
    EXPECT_TRUE(contains(result.err, "room.08.pbrt:1") && contains(result.err, "1 of 2 scenes failed: ")) << result.err;
    EXPECT_TRUE(!exists("out/room.08.exr") && exists("out/room.09.exr"));
}

TEST_F(SeveralScenes, AreRefusedBeforeAnythingIsRendered) {
    const std::string a = folder_.file("room.08.pbrt"), b = folder_.file("room.09.pbrt"), out = folder_.file("out");
    std::filesystem::create_directory(folder_.file("other"));
    const std::string same = folder_.write("other/room.08.pbrt", test::small_scene());
    struct Case {
        std::vector<std::string> arguments;
        std::string expected;
    };
    for (const Case& c :
         {Case{{a, b, "-o", folder_.file("out.exr")}, "is no folder"},
          Case{{a, b, "-o", folder_.file("none/")}, "no folder"}, Case{{a, same, "-o", out}, "room.08.exr"},
          Case{{a, folder_.file("no.pbrt"), "-o", out}, "no.pbrt"},
          Case{{a, b, "-o", out, "--json", folder_.file("a.json")}, "all scenes would write it"},
          Case{{a, b, "-o", out, "--frames", "1-2"}, "a second scene"}}) {
        std::vector<std::string> arguments = c.arguments;
        arguments.insert(arguments.begin(), "render");
        const auto result = run_wend(arguments);
        EXPECT_EQ(result.status, 2) << result.err;
        EXPECT_TRUE(contains(result.err, c.expected)) << c.expected << " in: " << result.err;
        EXPECT_TRUE(std::filesystem::is_empty(out));
    }
}

}  // namespace
}  // namespace wend
