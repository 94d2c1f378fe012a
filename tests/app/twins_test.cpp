// Every way of sampling gives the same picture of every scene: small twins of the scenes, some with larger lamps or
// thinner shields, so that a test can afford to see a bias of 1 %.
#include <tests/support/block_means.h>
#include <tests/support/paths.h>

#include <wend/io/load/load_scene.h>
#include <wend/io/pbrt/parser.h>
#include <wend/render/render.h>
#include <wend/stats/significance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace wend {
namespace {

constexpr Vec2i resolution(32, 18);
constexpr int block = 6;

struct Twin {
    const char* scene;
    int samples;  ///< per pixel and render
    std::vector<std::pair<const char*, const char*>> changes;
    /// As classical sampling has it: 96 renders, of the seeds from 100000 on, with the standard errors by their
    /// scatter.
    test::BlockReference reference;
};

void PrintTo(const Twin& twin, std::ostream* out) {
    *out << twin.scene;
}

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
    overrides.resolution = resolution;
    return load_scene(pbrt::parse_string(std::move(text), folder, twin.scene), overrides);
}

class Twins : public testing::TestWithParam<std::tuple<Twin, const char*>> {};

TEST_P(Twins, LookAsClassicalSamplingHasThem) {
    const auto& [twin, sampling] = GetParam();
    LoadedScene loaded = load_twin(twin);
    RenderSettings settings;
    settings.preset = parse_preset(sampling);
    settings.samples = twin.samples;
    settings.max_depth = loaded.max_depth;
    settings.filter = loaded.filter;
    settings.seed = 200;
    const Scene scene(std::move(loaded.scene));
    const test::BlockMeans means = test::render_until(scene, settings, resolution, block, twin.reference, 0.0032, 48);
    const double expected = twin.reference.whole.mean, error = means.error(twin.reference);
    EXPECT_LT(3 * error, 0.01 * expected) << "too few samples to see a bias of 1 %";
    EXPECT_TRUE(agrees(means.whole().mean() - expected, error, 0, 3.5))
        << means.whole().mean() << " +- " << error << ", not " << expected;
    EXPECT_GT(means.p_value(twin.reference), 1e-3);
    EXPECT_LT(means.p_value(twin.reference, 1.05), 1e-3) << "the test could not see a bias of 5 % in all blocks";
}

const std::vector<Twin> twins = {
    Twin{"haze",
         96,
         {},
         {{0.6494264, 0.00087},
          {{5.13485, 0.012},
           {0.735675, 0.0026},
           {0.524827, 0.0014},
           {0.431915, 0.0011},
           {0.346059, 0.00099},
           {0.480004, 0.0024},
           {0.365905, 0.0015},
           {0.374403, 0.0013},
           {0.279212, 0.00089},
           {0.243051, 0.00087},
           {0.186169, 0.00089},
           {0.170553, 0.00071},
           {0.153039, 0.00074},
           {0.156883, 0.00071},
           {0.158855, 0.00066}}}},
    Twin{"cloud",
         64,
         {{"\"float radius\" [ 0.25 ]", "\"float radius\" [ 2.5 ]"},
          {"[ 1584 1338 986 ]", "[ 16 13 10 ]"},
          {"\"float radius\" [ 0.03 ]", "\"float radius\" [ 0.25 ]"},
          {"[ 220 396 704 ]", "[ 3 6 10 ]"},
          {"[ 32 32 32 ]", "[ 6 6 6 ]"}},
         {{0.283546, 0.00041},
          {{0.0029318, 0},
           {0.0759106, 0.00099},
           {0.171193, 0.0014},
           {0.627189, 0.0017},
           {0.552888, 0.0011},
           {0.0144439, 0.00045},
           {0.502547, 0.0024},
           {1.1854, 0.0032},
           {0.538, 0.0026},
           {0.206066, 0.0017},
           {0.0029318, 0},
           {0.0781914, 0.0011},
           {0.180266, 0.0015},
           {0.10415, 0.0014},
           {0.0110836, 0.00033}}}},
    Twin{"fog-door",
         288,
         {{"\"float radius\" [ 0.18 ]", "\"float radius\" [ 0.5 ]"},
          {"Rotate -55 0 1 0", "Rotate -100 0 1 0"},
          {"Translate -1.6 1.7 5.3", "Translate 0.9 1.4 4.6"}},
         {{6.473915, 0.0092},
          {{1.80084, 0.015},
           {2.8374, 0.022},
           {6.2767, 0.029},
           {6.01822, 0.023},
           {4.1419, 0.024},
           {1.80343, 0.016},
           {2.99209, 0.016},
           {42.4176, 0.12},
           {6.4833, 0.027},
           {4.05685, 0.021},
           {1.68883, 0.014},
           {2.4212, 0.017},
           {3.96676, 0.024},
           {6.55915, 0.024},
           {3.6444, 0.021}}}},
    Twin{"smoke-room",
         160,
         {{"\"float radius\" [ 0.015 ]", "\"float radius\" [ 0.1 ]"},
          {"\"float zmax\" [ 0.095 ]", "\"float zmax\" [ -0.06 ]"}},
         {{109.6561, 0.17},
          {{442.629, 2},
           {119.194, 0.39},
           {195.754, 0.54},
           {230.993, 0.74},
           {113.078, 0.86},
           {57.9371, 0.13},
           {60.4433, 0.16},
           {59.6357, 0.22},
           {75.8709, 0.32},
           {49.3171, 0.15},
           {49.4888, 0.15},
           {50.5481, 0.14},
           {49.1167, 0.13},
           {46.5267, 0.15},
           {44.3078, 0.14}}}},
    Twin{"candles",
         64,
         {{"WorldBegin\n", "WorldBegin\nLightSource \"infinite\" \"rgb L\" [ 0.4 0.4 0.4 ]\n"},
          {"\"rgb Le\" [ 1 0.5 0.16 ]", "\"rgb Le\" [ 0.07692308 0.03846154 0.01230769 ]"}},
         {{0.1212676, 6.9e-05},
          {{0.0999872, 0.00014},
           {0.103818, 0.00016},
           {0.111825, 0.00022},
           {0.110243, 0.0002},
           {0.0992174, 0.00013},
           {0.0920341, 0.00013},
           {0.137389, 0.00034},
           {0.137428, 0.00041},
           {0.11377, 0.0003},
           {0.125357, 0.00032},
           {0.143231, 0.00014},
           {0.136055, 0.00018},
           {0.134832, 0.00022},
           {0.133659, 0.00019},
           {0.140168, 0.00021}}}},
    Twin{"liquid",
         128,
         {{"\"float radius\" [ 0.085 ]", "\"float radius\" [ 0.8 ]"},
          {"[ 1800 1600 1300 ]", "[ 20 18 15 ]"},
          {"\"float radius\" [ 0.07 ]", "\"float radius\" [ 0.7 ]"},
          {"[ 520 660 840 ]", "[ 5 7 8 ]"}},
         {{0.2829555, 0.00021},
          {{0.564047, 0.00043},
           {0.214124, 0.00032},
           {0.210472, 0.00053},
           {0.232095, 0.00053},
           {0.225846, 0.00033},
           {0.377491, 0.00047},
           {0.339041, 0.00056},
           {0.227172, 0.0015},
           {0.336046, 0.00096},
           {0.395072, 0.00049},
           {0.207452, 0.0014},
           {0.142807, 0.001},
           {0.187677, 0.0013},
           {0.286117, 0.0011},
           {0.298876, 0.00066}}}},
    Twin{"shield-duct",
         160,
         {{"\"float radius\" [ 0.08 ]", "\"float radius\" [ 0.4 ]"},
          {"[ 1.2 1.6 2.0 ]", "[ 0.3 0.4 0.5 ]"},
          {"[ 4.8 4.4 4.0 ]", "[ 1.2 1.1 1 ]"}},
         {{31.11759, 0.039},
          {{60.0946, 0.2},
           {25.3396, 0.16},
           {7.0852, 0.066},
           {4.91348, 0.069},
           {3.7017, 0.055},
           {89.7653, 0.27},
           {42.9128, 0.17},
           {8.85317, 0.086},
           {6.20662, 0.077},
           {4.53153, 0.082},
           {138.805, 0.31},
           {54.4665, 0.19},
           {9.51708, 0.091},
           {6.21768, 0.055},
           {4.35363, 0.063}}}}};

std::string twin_name(const testing::TestParamInfo<Twins::ParamType>& parameter) {
    std::string name = std::string(std::get<0>(parameter.param).scene) + "_" + std::get<1>(parameter.param);
    name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
    return name;
}

INSTANTIATE_TEST_SUITE_P(SlowScenes, Twins,
                         testing::Combine(testing::ValuesIn(twins), testing::Values("classical", "direction", "full")),
                         twin_name);

}  // namespace
}  // namespace wend
