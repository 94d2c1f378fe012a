// Files that would take a program down: each ends by itself, with a picture or a message, in bounded time and memory.
// The program runs as a process of its own, so that its time is that of its processor and its memory its own.
#include "program_support.h"
#include "tests/support/paths.h"

#include <wend/io/gzip.h>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <vector>

namespace wend {
namespace {

namespace fs = std::filesystem;

constexpr rlim_t most_seconds = 10;    // of the processor
constexpr long most_memory = 1 << 20;  // KiB

struct Ended {
    int status = -1;  ///< minus the signal's number where one ended it
    long memory = 0;  ///< KiB
    std::string err;
};

/// `wend ARGUMENTS...` in a folder, its messages caught in a file of another.
Ended run_limited(const std::vector<std::string>& arguments, const fs::path& folder,
                  const test::ScratchFolder& scratch) {
    const std::string program = test::wend_program();
    std::vector<char*> argv{const_cast<char*>(program.c_str())};
    for (const std::string& argument : arguments) {
        argv.push_back(const_cast<char*>(argument.c_str()));
    }
    argv.push_back(nullptr);
    const std::string messages = scratch.file("messages");
    const pid_t child = fork();
    if (child == 0) {
        const rlimit seconds{most_seconds, most_seconds};
        const int file = open(messages.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
        if (setrlimit(RLIMIT_CPU, &seconds) == 0 && chdir(folder.c_str()) == 0 && dup2(file, 1) == 1 &&
            dup2(file, 2) == 2) {
            execv(program.c_str(), argv.data());
        }
        _exit(127);
    }
    int status = 0;
    rusage usage{};
    EXPECT_EQ(wait4(child, &status, 0, &usage), child);
    return {WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status), usage.ru_maxrss, read_file(messages)};
}

class HostileFiles : public testing::Test {
protected:
    Ended render(const fs::path& scene) const {
        return run_limited({"render", scene.filename().string(), "-o", folder_.file("out.exr"), "--threads", "1",
                            "--quiet", "--spp", "1"},
                           scene.parent_path(), folder_);
    }
    Ended render_world(const std::string& world) const {
        return render(folder_.write("scene.pbrt",
                                    "Camera \"perspective\"\nFilm \"rgb\" \"integer xresolution\" 8 "
                                    "\"integer yresolution\" 8\nWorldBegin\n" +
                                        world));
    }
    void expect_rendered(const Ended& ended) const {
        EXPECT_EQ(ended.status, 0) << ended.err;
        EXPECT_LT(ended.memory, most_memory) << ended.err;
    }
    void expect_refused(const Ended& ended, const std::string& part) const {
        EXPECT_EQ(ended.status, 2) << ended.err;
        EXPECT_LT(ended.memory, most_memory) << ended.err;
        EXPECT_NE(ended.err.find(part), std::string::npos) << "'" << part << "' is not in: " << ended.err;
    }

    test::ScratchFolder folder_;
};

TEST_F(HostileFiles, OfTheCollectionEndByThemselves) {
    for (const auto& entry : fs::directory_iterator(test::source_dir() / "tests/hostile")) {
        if (!entry.is_directory()) {
            continue;
        }
        const Ended ended = render(entry.path() / "scene.pbrt");
        EXPECT_TRUE(ended.status == 0 || ended.status == 2) << entry.path() << ": " << ended.status << ended.err;
        EXPECT_LT(ended.memory, most_memory) << entry.path();
    }
}

TEST_F(HostileFiles, WhatIsTooFarAwayIsNamed) {
    const fs::path scene =
        folder_.write("scene.pbrt", "Translate 3e38 0 0\nCamera \"perspective\"\nWorldBegin\nShape \"sphere\"\n");
    expect_refused(render(scene), "scene.pbrt:2:1: error: the camera stands at (-3e+38, 0, 0)");
    expect_refused(render_world("Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1e30 0 ] \"integer indices\" "
                                "[ 0 1 2 ]\n"),
                   "scene.pbrt:4:1: error: Shape \"trianglemesh\" reaches to a point at (0, 1e+30, 0)");
    expect_refused(render_world("Translate 0 0 1e20\nShape \"sphere\"\n"), "scene.pbrt:5:1: error: Shape \"sphere\"");
    expect_refused(render_world("LightSource \"point\" \"point3 from\" [ 0 1e25 0 ]\n"), "scene.pbrt:4:1: error: ");
    const std::string object = "ObjectBegin \"o\"\nShape \"sphere\"\nObjectEnd\n";
    expect_refused(render_world(object + "Translate 1e15 0 0\nObjectInstance \"o\"\n"), "an instance reaches to");
    expect_refused(render_world(object + "Scale 1e-12 1 1\nObjectInstance \"o\"\n"), "an instance is made smaller");
    expect_rendered(render_world(object + "Scale 1e-6 1e-6 1e-6\nObjectInstance \"o\"\n"));
}

TEST_F(HostileFiles, AThinMediumThatFillsSpaceIsRendered) {
    for (const char* scattering : {"1e-17", "1e-20", "1e-30", "1e-38"}) {
        expect_rendered(render(folder_.write(
            "scene.pbrt", "MakeNamedMedium \"thin\" \"string type\" \"homogeneous\" \"rgb sigma_s\" [ " +
                              std::string(scattering) + " 0 0 ] \"rgb sigma_a\" [ 0 0 0 ]\nMediumInterface \"\" " +
                              "\"thin\"\nCamera \"perspective\"\nFilm \"rgb\" \"integer xresolution\" 8 \"integer "
                              "yresolution\" 8\nWorldBegin\nLightSource \"point\"\n")));
    }
}

TEST_F(HostileFiles, DenseGridsAreRendered) {
    const auto dense = [](const std::string& density) {
        return "MakeNamedMedium \"dense\" \"string type\" \"uniformgrid\" \"integer nx\" 2 \"integer ny\" 2 \"integer "
               "nz\" 2 \"float density\" [ 0 0 1 0 0 0 0 " +
               density +
               " ] \"point3 p0\" [ -1 -1 2 ] \"point3 p1\" [ 1 1 4 ]\nLightSource \"point\"\nMediumInterface \"dense\" "
               "\"\"\nMaterial \"interface\"\nTranslate 0 0 3\nShape \"sphere\" \"float radius\" 1.5\n";
    };
    for (const char* density : {"1e6", "1e8", "1e12", "1e17"}) {
        expect_rendered(render_world(dense(density)));
    }
    expect_refused(render_world(dense("1e30")),
                   "scene.pbrt:4:1: error: the medium \"dense\" has an extinction of 2e+30");
}

TEST_F(HostileFiles, MeshesWithoutTrianglesAreLeftOut) {
    const std::string vertices =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face ";
    folder_.write("none.ply",
                  vertices + "0\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n");
    folder_.write("other.ply",
                  vertices + "1\nproperty list uchar int corners\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    for (const char* file : {"none.ply", "other.ply"}) {
        const fs::path scene = folder_.write("scene.pbrt",
                                             "Camera \"perspective\"\nFilm \"rgb\" \"integer xresolution\""
                                             " 8 \"integer yresolution\" 8\nWorldBegin\nShape "
                                             "\"plymesh\" \"string filename\" \"" +
                                                 std::string(file) + "\"\n");
        const Ended ended =
            run_limited({"render", "scene.pbrt", "-o", "out.exr", "--spp", "1"}, folder_.path(), folder_);
        expect_rendered(ended);
        EXPECT_NE(ended.err.find("scene.pbrt:4:1: warning: Shape \"plymesh\" has no triangles: it is left out"),
                  std::string::npos)
            << ended.err;
    }
}

TEST_F(HostileFiles, SubdivisionIsRefusedBeforeItTakesMemory) {
    const std::string surface =
        "Shape \"loopsubdiv\" \"point3 P\" [ 0 0 3 1 0 3 0 1 3 ] \"integer indices\" [ 0 1 2 ] "
        "\"integer levels\" ";
    for (const char* levels : {"12", "30", "2147483647"}) {
        expect_refused(render_world(surface + levels + "\n"), "\"levels\" is " + std::string(levels));
    }
    // Each alone would be few enough.
    expect_refused(render_world(surface + "11\n" + surface + "10\n" + surface + "11\n"), "scene.pbrt:6:");
}

TEST_F(HostileFiles, WhatNeverEndsIsGivenUp) {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"render", "/dev/zero"},
                                                      {"field", "/dev/zero"},
                                                      {"metric", "/dev/zero", "a.exr"},
                                                      {"merge", "out.exr", "/dev/zero", "a.exr"},
                                                      {"render", "/dev/zero", "--load-field", "/dev/zero"}}) {
        expect_refused(run_limited(arguments, folder_.path(), folder_), "/dev/zero");
    }
}

}  // namespace
}  // namespace wend
