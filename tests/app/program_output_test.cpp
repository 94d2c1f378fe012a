// What a render leaves on the disk: layers, metadata, whole files or none, also when it is stopped.
#include "program_support.h"

#include <wend/io/image_file.h>

#include <gtest/gtest.h>

#include <cmath>
#include <csignal>

namespace wend {
namespace {

using test::run_wend;

class ProgramOutput : public testing::Test {
protected:
    ProgramOutput() : scene_(folder_.write("room.pbrt", test::small_scene())) {}

    test::ProgramResult render(const std::string& picture, std::vector<std::string> more) const {
        more.insert(more.begin(), {"render", scene_, "-o", folder_.file(picture), "--quiet"});
        return run_wend(more);
    }
    /// A render that nobody will wait for the end of.
    std::vector<std::string> endless(const std::string& picture) const {
        return {"render",  scene_,   "-o", folder_.file(picture), "--spp", "100000000", "--resolution",
                "160x120", "--json", "-"};
    }

    test::ScratchFolder folder_;
    std::string scene_;
};

const Layer& layer(const Picture& picture, const std::string& name) {
    for (const Layer& l : picture.layers) {
        if (l.name == name) {
            return l;
        }
    }
    throw std::runtime_error("no layer " + name);
}

TEST_F(ProgramOutput, LayersAndMetadataCanBeReadBack) {
    ASSERT_EQ(render("room.exr", {"--spp", "64", "--seed", "5", "--sampling", "direction"}).status, 0);
    const Picture picture = read_picture(folder_.file("room.exr"));
    ASSERT_EQ(picture.image.width, 16);
    ASSERT_EQ(picture.image.height, 12);
    EXPECT_EQ(picture.full_size, Vec2i(16, 12));
    EXPECT_EQ(layer(picture, "albedo").channels, (std::vector<std::string>{"R", "G", "B"}));
    EXPECT_EQ(layer(picture, "normal").channels, (std::vector<std::string>{"X", "Y", "Z"}));
    EXPECT_EQ(layer(picture, "depth").channels, (std::vector<std::string>{"Z"}));
    EXPECT_EQ(layer(picture, "variance").channels, (std::vector<std::string>{"R", "G", "B"}));
    for (const float n : layer(picture, "samples").values) {
        EXPECT_EQ(n, 64);
    }
    for (const float a : layer(picture, "albedo").values) {
        EXPECT_TRUE(a >= 0 && a <= 1) << a;
    }
    for (const float v : layer(picture, "variance").values) {
        EXPECT_TRUE(v >= 0 && std::isfinite(v)) << v;
    }
    float farthest = 0;
    for (const float d : layer(picture, "depth").values) {
        EXPECT_TRUE(d >= 0 && std::isfinite(d)) << d;
        farthest = std::max(farthest, d);
    }
    EXPECT_GT(farthest, 2) << "fog shortens what surfaces begin 4.2 away";
    EXPECT_LT(farthest, 7) << "nothing of the room is farther from the eye";
    EXPECT_EQ(picture.metadata.at("wend:scene"), scene_);
    EXPECT_EQ(picture.metadata.at("wend:seed"), "5");
    EXPECT_EQ(picture.metadata.at("wend:spp"), "64");
    EXPECT_FALSE(picture.metadata.at("wend:version").empty());
    EXPECT_EQ(picture.metadata.at("wend:scene_digest").size(), 16u);
    const auto settings = nlohmann::json::parse(picture.metadata.at("wend:settings"));
    EXPECT_EQ(settings["sampling"], "direction");
    EXPECT_EQ(settings["max_depth"], 8);
}

TEST_F(ProgramOutput, TheVarianceLayerTellsTheNoise) {
    // Independent samples, so that the scatter within a picture is that between pictures.
    constexpr int renders = 24;
    Picture picture;
    std::vector<double> sum(16 * 12), squares(16 * 12), told(16 * 12);
    for (int seed = 0; seed < renders; ++seed) {
        ASSERT_EQ(
            render("room.exr", {"--spp", "32", "--sampler", "independent", "--seed", std::to_string(seed)}).status, 0);
        picture = read_picture(folder_.file("room.exr"));
        for (std::size_t i = 0; i < sum.size(); ++i) {
            const double v = picture.image.pixels[i].g;
            sum[i] += v;
            squares[i] += v * v;
            told[i] += layer(picture, "variance").values[3 * i + 1];
        }
    }
    double between = 0, within = 0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
        between += (squares[i] - sum[i] * sum[i] / renders) / (renders - 1);
        within += told[i] / renders;
    }
    EXPECT_NEAR(within / between, 1, 0.25);
}

TEST_F(ProgramOutput, TheExtensionChoosesTheFormat) {
    ASSERT_EQ(render("room.exr", {"--spp", "64"}).status, 0);
    const Image exact = read_image(folder_.file("room.exr"));
    struct Format {
        const char* file;
        std::string start;
        float tolerance;
    };
    for (const Format& format : {Format{"room.png", "\x89PNG", 0.01f}, Format{"room.jpg", "\xff\xd8\xff", 0.2f},
                                 Format{"ROOM.JPEG", "\xff\xd8\xff", 0.2f}, Format{"UPPER.PNG", "\x89PNG", 0.01f}}) {
        ASSERT_EQ(render(format.file, {"--spp", "64"}).status, 0);
        EXPECT_EQ(test::read_text(folder_.file(format.file)).rfind(format.start, 0), 0u) << format.file;
        const Image image = read_image(folder_.file(format.file));
        ASSERT_EQ(image.pixels.size(), exact.pixels.size());
        double error = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            error += std::abs(image.pixels[i].g - std::min(exact.pixels[i].g, 1.0f));
        }
        EXPECT_LT(error / static_cast<double>(image.pixels.size()), format.tolerance) << format.file;
    }
}

TEST_F(ProgramOutput, ACropWindowIsThatPartOfThePictureBitForBit) {
    // Guided walks follow what the walks of all pixels found.
    ASSERT_EQ(render("full.exr", {"--spp", "5", "--sampling", "classical"}).status, 0);
    ASSERT_EQ(render("crop.exr", {"--spp", "5", "--sampling", "classical", "--crop", "0.25,0.75,0.5,1"}).status, 0);
    const Picture full = read_picture(folder_.file("full.exr"));
    const Picture crop = read_picture(folder_.file("crop.exr"));
    ASSERT_EQ(crop.offset, Vec2i(4, 6));
    EXPECT_EQ(crop.full_size, Vec2i(16, 12));
    ASSERT_EQ(crop.image.width, 8);
    ASSERT_EQ(crop.image.height, 6);
    for (int y = 0; y < 6; ++y) {
        for (int x = 0; x < 8; ++x) {
            EXPECT_EQ(crop.image.at(x, y), full.image.at(x + 4, y + 6)) << x << ' ' << y;
            EXPECT_EQ(layer(crop, "depth").values[static_cast<std::size_t>(y * 8 + x)],
                      layer(full, "depth").values[static_cast<std::size_t>((y + 6) * 16 + x + 4)]);
        }
    }
}

TEST_F(ProgramOutput, TheCropWindowOfTheSceneIsTheSame) {
    std::string text = test::small_scene();
    const std::string film = "Film \"rgb\"";
    text.replace(text.find(film), film.size(), film + " \"float cropwindow\" [ 0.25 0.75 0.5 1 ]");
    const std::string cropped = folder_.write("cropped.pbrt", text);
    ASSERT_EQ(run_wend({"render", cropped, "-o", folder_.file("scene.exr"), "--quiet"}).status, 0);
    ASSERT_EQ(render("option.exr", {"--crop", "0.25,0.75,0.5,1"}).status, 0);
    EXPECT_EQ(read_image(folder_.file("scene.exr")).pixels, read_image(folder_.file("option.exr")).pixels);
}

TEST_F(ProgramOutput, OutputThatCannotBeIsRefusedBeforeRendering) {
    std::filesystem::create_directory(folder_.path() / "folder.exr");
    const auto before = folder_.names();
    for (const std::string& picture : {std::string("missing/room.exr"), std::string("folder.exr"),
                                       std::string("room.pbrt/room.exr"), std::string(300, 'x') + ".exr"}) {
        // At this size and sample count a render would last for days.
        const test::ResourceLimit limit = test::ten_more_seconds_of_work();
        const auto result = render(picture, {"--spp", "1000000", "--resolution", "1000x1000"});
        EXPECT_EQ(result.status, 2) << picture;
        EXPECT_FALSE(result.err.empty());
    }
    const auto result = render("room.exr", {"--spp", "1000000", "--json", folder_.file("missing/result.json")});
    EXPECT_EQ(result.status, 2);
    EXPECT_NE(result.err.find("missing"), std::string::npos) << result.err;
    EXPECT_EQ(folder_.names(), before);
}

TEST_F(ProgramOutput, AFailingWriteLeavesTheOldPictureAndNothingElse) {
    folder_.write("room.exr", "an older picture");
    // A disk that is full: no file may grow beyond a few bytes.
    const std::string command = "ulimit -f 1; trap '' XFSZ; exec '" + test::wend_program() + "' render '" + scene_ +
                                "' -o '" + folder_.file("room.exr") + "' --spp 1 --resolution 64x48 2> /dev/null";
    const int status = std::system(("bash -c \"" + command + "\"").c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_EQ(test::read_text(folder_.file("room.exr")), "an older picture");
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"room.exr", "room.pbrt"}));
}

TEST_F(ProgramOutput, AnInterruptEndsWithAPicture) {
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        test::WendProcess process(endless("room.exr"), folder_);
        ASSERT_TRUE(process.wait_for_progress());
        EXPECT_TRUE(process.wait_for_progress()) << "it renders on";
        process.signal(number);
        const auto result = process.wait();
        ASSERT_EQ(result.status, 128 + number) << result.err;
        const auto report = result.json();
        EXPECT_EQ(report["interrupted"], true);
        EXPECT_LT(report["spp"], 100000000);
        const Picture picture = read_picture(folder_.file("room.exr"));
        EXPECT_EQ(picture.metadata.at("wend:spp"), std::to_string(report["spp"].get<int>()));
        for (const float n : layer(picture, "samples").values) {
            ASSERT_GE(n, report["spp"]) << "whole passes, and what was done of the last";
        }
        std::filesystem::remove(folder_.file("room.exr"));
    }
}

TEST_F(ProgramOutput, AKilledProcessLeavesNoHalfWrittenPicture) {
    folder_.write("room.exr", "an older picture");
    test::WendProcess process(endless("room.exr"), folder_);
    ASSERT_TRUE(process.wait_for_progress()) << "it renders";
    process.signal(SIGKILL);
    EXPECT_EQ(process.wait().status, -SIGKILL);
    EXPECT_EQ(test::read_text(folder_.file("room.exr")), "an older picture");
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"room.exr", "room.pbrt", "stdout.txt"}));
}

TEST_F(ProgramOutput, WhenKilledAtAnyByteOfTheWritingTheOldPictureIsThere) {
    const auto draw = [&](std::uint64_t largest_file) {
        const test::ResourceLimit limit(RLIMIT_FSIZE, largest_file);
        test::WendProcess process(
            {"render", scene_, "-o", folder_.file("room.exr"), "--spp", "1", "--resolution", "96x64", "--quiet"},
            folder_);
        return process.wait().status;
    };
    ASSERT_EQ(draw(1 << 30), 0);
    const std::uint64_t size = std::filesystem::file_size(folder_.file("room.exr"));
    folder_.write("room.exr", "an older picture");
    constexpr std::uint64_t parts = 12;
    for (std::uint64_t part = 0; part <= parts; ++part) {
        const std::uint64_t bytes = std::min(part * size / parts, size - 1);
        EXPECT_EQ(draw(bytes), -SIGXFSZ) << bytes;
        EXPECT_EQ(test::read_text(folder_.file("room.exr")), "an older picture") << bytes;
    }
    EXPECT_EQ(draw(size), 0);
    EXPECT_NO_THROW(read_picture(folder_.file("room.exr")));
}

}  // namespace
}  // namespace wend
