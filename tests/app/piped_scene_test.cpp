// Scenes that a pipe tells, as another program writes them.
#include "program_support.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace wend {
namespace {

using test::run_wend;

class PipedScene : public testing::Test {
protected:
    PipedScene() { mkfifo(pipe_.c_str(), 0600); }

    /// `wend render` of the text, two samples of each pixel.
    test::ProgramResult render(const std::string& text, const std::string& picture,
                               const std::vector<std::string>& more = {}) const {
        std::vector<std::string> all = {"render", pipe_, "-o", folder_.file(picture), "--spp", "2", "--quiet"};
        all.insert(all.end(), more.begin(), more.end());
        std::thread writer([&] { std::ofstream(pipe_) << text; });
        const auto result = run_wend(all);
        // Where nothing has read it, who writes would wait for ever.
        const int reader = open(pipe_.c_str(), O_RDONLY | O_NONBLOCK);
        writer.join();
        close(reader);
        return result;
    }
    int merge(const std::string& a, const std::string& b) const {
        return run_wend({"merge", folder_.file("out.exr"), folder_.file(a), folder_.file(b), "--quiet"}).status;
    }

    test::ScratchFolder folder_;
    std::string pipe_ = folder_.file("pipe");
    const std::string one_ = test::small_scene();
    const std::string another_ = test::small_scene("LightSource \"infinite\" \"float scale\" [ 2 ]\n");
};

TEST_F(PipedScene, IsToldFromOthers) {
    const std::string checkpoint = folder_.file("room.checkpoint");
    ASSERT_EQ(render(one_, "a.exr", {"--seed", "1", "--checkpoint", checkpoint}).status, 0);
    ASSERT_EQ(render(one_, "b.exr", {"--seed", "2"}).status, 0);
    ASSERT_EQ(render(another_, "c.exr", {"--seed", "3"}).status, 0);
    EXPECT_EQ(merge("a.exr", "b.exr"), 0);
    EXPECT_EQ(merge("a.exr", "c.exr"), 2);
    const auto refused = render(another_, "d.exr", {"--seed", "1", "--resume", checkpoint});
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.err.find("the scene's text, or a parameter of it, has changed"), std::string::npos)
        << refused.err;
    EXPECT_EQ(render(one_, "d.exr", {"--seed", "1", "--resume", checkpoint}).status, 0);
}

TEST_F(PipedScene, HasItsFilesInTheCurrentFolder) {
    std::filesystem::create_directory(folder_.file("here"));
    folder_.write("here/room.txt", one_);
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(folder_.file("here"));
    const auto result = render("Include \"room.txt\"\n", "a.exr");
    std::filesystem::current_path(before);
    EXPECT_EQ(result.status, 0) << result.err;
}

}  // namespace
}  // namespace wend
