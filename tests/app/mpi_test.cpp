// Several processes that render one picture.
#include "program_support.h"

#include <wend/core/random.h>

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace wend {
namespace {

class SlowMpiRender : public testing::Test {
protected:
    void SetUp() override {
        if (std::system("mpirun --version > /dev/null 2>&1") != 0) {
            GTEST_SKIP() << "there is no mpirun (Debian's openmpi-bin)";
        }
        // More ranks than cores, also as root in a container; nothing but shared memory.
        for (const char* setting : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM",
                                    "OMPI_MCA_rmaps_base_oversubscribe", "OMPI_MCA_mpi_yield_when_idle"}) {
            setenv(setting, "1", 0);
        }
        setenv("OMPI_MCA_btl", "self,vader", 0);
        if (render(2, "small.exr", "--spp 1") != 0 &&
            bytes("errors.txt").find("built without MPI") != std::string::npos) {
            GTEST_SKIP() << "wend was built without MPI";
        }
    }

    int run(int ranks, const std::string& arguments, const std::string& output) const {
        const std::string command = "mpirun -n " + std::to_string(ranks) + " '" + test::wend_program() + "' " +
                                    arguments + " > '" + folder_.file(output) + "' 2> '" + folder_.file("errors.txt") +
                                    "'";
        return WEXITSTATUS(std::system(command.c_str()));
    }
    int render(int ranks, const std::string& picture, const std::string& arguments) const {
        return run(ranks,
                   "render '" + scene_ + "' --resolution 48x36 --quiet --json - -o '" + folder_.file(picture) + "' " +
                       arguments,
                   "told.json");
    }
    std::string bytes(const std::string& name) const { return test::read_text(folder_.file(name)); }

    test::ScratchFolder folder_;
    std::string scene_ = folder_.write("room.pbrt", test::small_scene(R"(
AttributeBegin
  MakeNamedMedium "wax" "string type" "homogeneous"
    "rgb sigma_a" [ 0.5 1 2 ] "rgb sigma_s" [ 30 28 25 ] "float g" [ 0.3 ]
  MediumInterface "wax" "fog"
  Translate -0.4 0.35 0.3
  Material "dielectric" "float eta" [ 1.4 ]
  Shape "sphere" "float radius" [ 0.3 ]
AttributeEnd
AttributeBegin
  MakeNamedMedium "smoke" "string type" "uniformgrid" "integer nx" [ 2 ] "integer ny" [ 2 ] "integer nz" [ 2 ]
    "float density" [ 1 0 2 1 0 3 1 1 ] "rgb sigma_a" [ 0.5 0.5 0.5 ] "rgb sigma_s" [ 3 3 3 ]
    "point3 p0" [ -0.3 0.9 -0.3 ] "point3 p1" [ 0.3 1.5 0.3 ]
  MediumInterface "smoke" "fog"
  Translate 0 1.2 0
  Material "interface"
  Shape "sphere" "float radius" [ 0.3 ]
AttributeEnd
)"));
};

// Walks inside a dense medium, a grid, and a caustic of a ball of glass.
TEST_F(SlowMpiRender, IsTheSameFileForAnyNumberOfRanks) {
    ASSERT_EQ(test::run_wend(
                  {"render", scene_, "--resolution", "48x36", "--quiet", "--spp", "40", "-o", folder_.file("one.exr")})
                  .status,
              0);
    for (const int ranks : {2, 3, 4}) {
        ASSERT_EQ(render(ranks, "all.exr", "--spp 40 --threads 1"), 0) << bytes("errors.txt");
        EXPECT_TRUE(bytes("all.exr") == bytes("one.exr")) << ranks << " ranks";
        const auto told = nlohmann::json::parse(bytes("told.json"));
        EXPECT_EQ(told["ranks"], ranks) << "one rank alone tells";
        EXPECT_GT(told["bytes_per_pass"], 0);
        EXPECT_GT(told["bytes_per_rank"], 1 << 20);
    }
}

TEST_F(SlowMpiRender, LayersAreTheSameToo) {
    const std::string layers = "direct,indirect,volume,emission,background,lights,halves,geometry,cryptomatte";
    ASSERT_EQ(test::run_wend({"render", scene_, "--resolution", "48x36", "--quiet", "--spp", "20", "--layers", layers,
                              "-o", folder_.file("one.exr")})
                  .status,
              0);
    ASSERT_EQ(render(3, "all.exr", "--spp 20 --threads 1 --layers " + layers), 0) << bytes("errors.txt");
    EXPECT_TRUE(bytes("all.exr") == bytes("one.exr"));
}

TEST_F(SlowMpiRender, FramesAreTheSameFilesToo) {
    for (const char* frame : {"film.1.pbrt", "film.2.pbrt"}) {
        std::filesystem::copy_file(scene_, folder_.file(frame));
    }
    const std::vector<std::string> film = {"render",
                                           folder_.file("film.#.pbrt"),
                                           "--frames",
                                           "1-2",
                                           "--carry-field",
                                           "--spp",
                                           "9",
                                           "--sampling",
                                           "direction",
                                           "--quiet",
                                           "-o"};
    std::string arguments;
    for (const std::string& argument : film) {
        arguments += "'" + argument + "' ";
    }
    std::vector<std::string> alone = film;
    alone.push_back(folder_.file("one.#.exr"));
    ASSERT_EQ(test::run_wend(alone).status, 0);
    ASSERT_EQ(run(2, arguments + "'" + folder_.file("all.#.exr") + "' --threads 1", "told.txt"), 0)
        << bytes("errors.txt");
    for (const char* end : {".1.exr", ".2.exr"}) {
        EXPECT_TRUE(bytes(std::string("all") + end) == bytes(std::string("one") + end)) << end;
    }
}

TEST_F(SlowMpiRender, ALostRankEndsTheJobAndAnyNumberResumes) {
    ASSERT_EQ(test::run_wend(
                  {"render", scene_, "--resolution", "48x36", "--quiet", "--spp", "80", "-o", folder_.file("one.exr")})
                  .status,
              0);
    // The last rank is killed once there is a checkpoint.
    const std::string checkpoint = folder_.file("room.checkpoint");
    const std::string killed = folder_.write("killed.sh",
                                             "if [ $OMPI_COMM_WORLD_RANK = 2 ]; then\n"
                                             "  (until [ -e '" +
                                                 checkpoint +
                                                 "' ]; do sleep 0.02; done; kill -9 $$) &\n"
                                                 "fi\nexec \"$@\"\n");
    const std::string command = "mpirun -n 3 bash '" + killed + "' '" + test::wend_program() + "' render '" + scene_ +
                                "' --resolution 48x36 --quiet --threads 1 --spp 80 -o '" + folder_.file("all.exr") +
                                "' --checkpoint '" + checkpoint + "' --checkpoint-every 0.1 > /dev/null 2> '" +
                                folder_.file("errors.txt") + "'";
    EXPECT_NE(WEXITSTATUS(std::system(command.c_str())), 0);
    EXPECT_FALSE(std::filesystem::exists(folder_.file("all.exr")));
    EXPECT_NE(bytes("errors.txt").find("rank 2"), std::string::npos) << bytes("errors.txt");
    for (const int ranks : {2, 4}) {
        ASSERT_EQ(render(ranks, "all.exr", "--spp 80 --threads 1 --resume '" + checkpoint + "'"), 0)
            << bytes("errors.txt");
        EXPECT_TRUE(bytes("all.exr") == bytes("one.exr")) << ranks << " ranks";
    }
}

// Jobs of 1 to 3 ranks, one of which is killed after a while; each goes on with what the last one has kept.
TEST_F(SlowMpiRender, KilledAgainAndAgainItIsTheSameFile) {
    constexpr int kills = 20;
    const std::string options = " --resolution 48x36 --quiet --spp 400 ";
    ASSERT_EQ(test::run_wend(
                  {"render", scene_, "--resolution", "48x36", "--quiet", "--spp", "400", "-o", folder_.file("one.exr")})
                  .status,
              0);
    const std::string checkpoint = folder_.file("room.checkpoint");
    // The rank VICTIM is killed DELAY seconds after it has begun.
    const std::string killed = folder_.write("killed.sh",
                                             "if [ $OMPI_COMM_WORLD_RANK = $VICTIM ]; then\n"
                                             "  (sleep $DELAY; kill -9 $$) > /dev/null 2>&1 &\n"
                                             "fi\nexec \"$@\"\n");
    Pcg32 random(5);
    const auto run_job = [&](const std::string& before) {
        const int ranks = 1 + static_cast<int>(random.next() % 3);
        const int victim = static_cast<int>(random.next()) & 1 ? ranks - 1 : 0;
        const double delay = 0.2 + 0.6 * random.uniform_double();
        const std::string resume =
            std::filesystem::exists(checkpoint) ? " --resume '" + checkpoint + "'" : std::string();
        const std::string command =
            "VICTIM=" + std::to_string(victim) + " DELAY=" + std::to_string(delay) + " mpirun -n " +
            std::to_string(ranks) + ' ' + before + " '" + test::wend_program() + "' render '" + scene_ + "'" + options +
            "--threads 1 -o '" + folder_.file("all.exr") + "' --checkpoint '" + checkpoint +
            "' --checkpoint-every 0.05" + resume + " > /dev/null 2> '" + folder_.file("errors.txt") + "'";
        return WEXITSTATUS(std::system(command.c_str()));
    };
    int times = 0;
    for (int i = 0; i < kills && !std::filesystem::exists(folder_.file("all.exr")); ++i) {
        times += run_job("bash '" + killed + "'") != 0 ? 1 : 0;
    }
    EXPECT_GT(times, 2) << "the render is too short for the test";
    ASSERT_TRUE(std::filesystem::exists(checkpoint));
    ASSERT_EQ(run_job(""), 0) << bytes("errors.txt");
    EXPECT_TRUE(bytes("all.exr") == bytes("one.exr")) << "killed " << times << " times";
}

}  // namespace
}  // namespace wend
