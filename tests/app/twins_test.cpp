// Guided and classical sampling agree in every scene: small twins of the scenes, some with larger lamps or thinner
// shields, so that a test can afford to see a bias of 1 %.
#include <tests/support/paths.h>

#include <wend/integrator/render.h>
#include <wend/io/load/load_scene.h>
#include <wend/io/pbrt/parser.h>
#include <wend/stats/chi_square.h>
#include <wend/stats/moments.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace wend {
namespace {

struct Twin {
    const char* scene;
    int samples;  ///< per pixel and replica
    std::vector<std::pair<const char*, const char*>> changes;
};

void PrintTo(const Twin& twin, std::ostream* out) {
    *out << twin.scene;
}

constexpr int width = 32;
constexpr int height = 18;
constexpr int block = 6;
constexpr int columns = width / block;
constexpr int rows = height / block;

LoadedScene load_twin(const Twin& twin) {
    const auto folder = test::source_dir() / "scenes";
    std::ifstream file(folder / (std::string(twin.scene) + ".pbrt"));
    std::ostringstream content;
    content << file.rdbuf();
    std::string text = content.str();
    for (const auto& [from, to] : twin.changes) {
        std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << "the scene no longer says " << from;
        for (; at != std::string::npos; at = text.find(from, at + std::string(to).size())) {
            text.replace(at, std::string(from).size(), to);
        }
    }
    LoadOverrides overrides;
    overrides.resolution = Vec2i(width, height);
    return load_scene(pbrt::parse_string(std::move(text), folder, twin.scene), overrides);
}

/// Independent renders: the mean of the picture and of its blocks.
struct Replicas {
    Moments whole;
    std::vector<Moments> blocks{static_cast<std::size_t>(columns * rows)};

    void add(const Image& image, double scale = 1) {
        double total = 0;
        for (int by = 0; by < rows; ++by) {
            for (int bx = 0; bx < columns; ++bx) {
                double sum = 0;
                for (int y = by * block; y < (by + 1) * block; ++y) {
                    for (int x = bx * block; x < (bx + 1) * block; ++x) {
                        sum += scale * luminance(image.at(x, y));
                    }
                }
                blocks[static_cast<std::size_t>(by * columns + bx)].add(sum / (block * block));
                total += sum;
            }
        }
        whole.add(total / (columns * rows * block * block));
    }
};

double squared_error(const Moments& a, const Moments& b) {
    return std::pow(a.standard_error(), 2) + std::pow(b.standard_error(), 2);
}

/// The probability that the blocks differ as much by chance. The square of a ratio to an estimated error has a heavier
/// tail than that of a normal variable: n - 3 over n - 1 of n replicas brings its mean back to 1.
double same_blocks(const Replicas& a, const Replicas& b) {
    double sum = 0;
    int used = 0;
    for (std::size_t i = 0; i < a.blocks.size(); ++i) {
        const double error2 = squared_error(a.blocks[i], b.blocks[i]);
        if (error2 > 0) {
            sum += std::pow(a.blocks[i].mean() - b.blocks[i].mean(), 2) / error2;
            ++used;
        }
    }
    const double degrees = 2.0 * static_cast<double>(a.whole.count()) - 2;
    return chi_square_p_value(sum * (degrees - 2) / degrees, used);
}

class Twins : public testing::TestWithParam<Twin> {};

TEST_P(Twins, GuidedAndClassicalAgree) {
    LoadedScene loaded = load_twin(GetParam());
    RenderSettings settings;
    settings.samples = GetParam().samples;
    settings.max_depth = loaded.max_depth;
    settings.filter = loaded.filter;
    const Scene scene(std::move(loaded.scene));
    const auto render_with = [&](const char* preset, std::uint64_t seed) {
        Film film({width, height}, {{0, 0}, {width, height}});
        settings.preset = parse_preset(preset);
        settings.seed = seed;
        render(scene, film, settings);
        return film.beauty();
    };
    Replicas classical;
    constexpr std::uint64_t replicas = 24;
    for (std::uint64_t i = 0; i < replicas; ++i) {
        classical.add(render_with("classical", 100 + i));
    }
    const double mean = classical.whole.mean();
    for (const char* preset : {"direction", "full"}) {
        Replicas guided;
        Replicas biased;
        for (std::uint64_t i = 0; i < replicas; ++i) {
            const Image image = render_with(preset, 200 + i);
            guided.add(image);
            biased.add(image, 1.05);
        }
        const double error = std::sqrt(squared_error(classical.whole, guided.whole));
        EXPECT_LT(error, 0.005 * mean) << preset << ": too few samples to see 1 %";
        EXPECT_NEAR(guided.whole.mean(), mean, 0.01 * mean) << preset << ": standard error " << error / mean;
        EXPECT_GT(same_blocks(classical, guided), 1e-3) << preset;
        EXPECT_LT(same_blocks(classical, biased), 1e-3)
            << preset << ": the test could not see a bias of 5 % in all blocks";
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Twins,
                         testing::Values(Twin{"haze", 96, {}},
                                         Twin{"cloud",
                                              64,
                                              {{"\"float radius\" [ 0.25 ]", "\"float radius\" [ 2.5 ]"},
                                               {"[ 1584 1338 986 ]", "[ 16 13 10 ]"},
                                               {"\"float radius\" [ 0.03 ]", "\"float radius\" [ 0.25 ]"},
                                               {"[ 220 396 704 ]", "[ 3 6 10 ]"},
                                               {"[ 32 32 32 ]", "[ 6 6 6 ]"}}},
                                         Twin{"fog-door",
                                              288,
                                              {{"\"float radius\" [ 0.18 ]", "\"float radius\" [ 0.5 ]"},
                                               {"Rotate -55 0 1 0", "Rotate -100 0 1 0"},
                                               {"Translate -1.6 1.7 5.3", "Translate 0.9 1.4 4.6"}}},
                                         Twin{"smoke-room",
                                              160,
                                              {{"\"float radius\" [ 0.015 ]", "\"float radius\" [ 0.1 ]"},
                                               {"\"float zmax\" [ 0.095 ]", "\"float zmax\" [ -0.06 ]"}}},
                                         Twin{"candles",
                                              64,
                                              {{"WorldBegin\n",
                                                "WorldBegin\nLightSource \"infinite\" \"rgb L\" [ 0.4 0.4 0.4 ]\n"},
                                               {"\"float Lescale\" [ 260 ]", "\"float Lescale\" [ 20 ]"}}},
                                         Twin{"liquid",
                                              128,
                                              {{"\"float radius\" [ 0.085 ]", "\"float radius\" [ 0.8 ]"},
                                               {"[ 1800 1600 1300 ]", "[ 20 18 15 ]"},
                                               {"\"float radius\" [ 0.07 ]", "\"float radius\" [ 0.7 ]"},
                                               {"[ 520 660 840 ]", "[ 5 7 8 ]"}}},
                                         Twin{"shield-duct",
                                              160,
                                              {{"\"float radius\" [ 0.08 ]", "\"float radius\" [ 0.4 ]"},
                                               {"[ 1.2 1.6 2.0 ]", "[ 0.3 0.4 0.5 ]"},
                                               {"[ 4.8 4.4 4.0 ]", "[ 1.2 1.1 1 ]"}}}),
                         [](const auto& twin) {
                             std::string name = twin.param.scene;
                             name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
                             return name;
                         });

}  // namespace
}  // namespace wend
