// White furnaces over a matrix of media, boundaries, shapes and presets. Under a uniform sky an object that absorbs
// nothing cannot be seen, however it scatters; one that absorbs looks the same whatever draws its walks.
//
// What such objects look like by classical walks is in furnaces.csv, which this writes anew (half an hour):
//     test_integrator --gtest_also_run_disabled_tests --gtest_filter='*WriteReferences'
#include <tests/support/channel_means.h>
#include <tests/support/covering_array.h>
#include <tests/support/paths.h>
#include <tests/support/scenes.h>

#include <wend/stats/significance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace wend {
namespace {

enum class Boundary { matched, smooth, rough };
enum class Body { ball, thin_slab, cube, two_boxes };

struct Furnace {
    static constexpr float albedos[] = {1, 0.999f, 0.99f, 0.9f};
    static constexpr float mean_cosines[] = {-0.5f, 0, 0.5f, 0.9f};
    static constexpr float sizes[] = {0.3f, 3, 10, 100};  // in mean free paths
    // Two of them twice: the references are those of the pairs of seven, of which some have become dispensable.
    static constexpr const char* subsurfaces[] = {"classical", "dwivedi", "closest", "incident",
                                                  "closest",   "auto",    "auto"};
    static constexpr const char* samplings[] = {"classical", "scatter",   "distance", "direction",
                                                "roulette",  "splitting", "full"};
    static constexpr int passes[] = {4, 16, 64, 256};  // samples per pixel
    static constexpr int samples_of_render = 1 << 12;

    float albedo, g, size;
    Boundary boundary;
    Body body;
    bool coloured, grid;
    const char* subsurface;
    const char* sampling;
    int samples;
    int least_resolution = 1;

    static std::vector<int> levels() { return {4, 4, 4, 3, 4, 2, 2, 7, 7, 4}; }
    explicit Furnace(const std::vector<int>& row)
        : albedo(albedos[row[0]]),
          g(mean_cosines[row[1]]),
          size(sizes[row[2]]),
          boundary(static_cast<Boundary>(row[3])),
          body(static_cast<Body>(row[4])),
          coloured(row[5] != 0),
          grid(row[6] != 0),
          subsurface(subsurfaces[row[7]]),
          sampling(samplings[row[8]]),
          samples(passes[row[9]]) {}

    /// All but how it is rendered.
    std::string object() const {
        constexpr const char* boundaries[] = {"matched", "smooth", "rough"};
        constexpr const char* bodies[] = {"ball", "slab", "cube", "two boxes"};
        std::ostringstream out;
        out << "albedo " << albedo << ", g " << g << ", size " << size << ", " << boundaries[static_cast<int>(boundary)]
            << ' ' << bodies[static_cast<int>(body)] << (coloured ? ", coloured" : "") << (grid ? ", grid" : "");
        return out.str();
    }
    /// Whether a channel has the radiance of the sky. Rough boundaries lose what facets scatter more than once.
    bool is_lossless(int channel) const {
        return boundary != Boundary::rough && (albedo == 1 || (coloured && channel == 2));
    }

    friend void PrintTo(const Furnace& f, std::ostream* out) {
        *out << f.object() << ", --subsurface " << f.subsurface << " --sampling " << f.sampling << " --spp "
             << f.samples << (f.least_resolution > 1 ? ", in a picture that is large enough to choose" : "");
    }
};

/// Rows in which each pair of levels meets.
std::vector<std::vector<int>> furnace_rows() {
    const auto rows = test::covering_array(Furnace::levels());
    auto told_apart = rows;
    for (auto& row : told_apart) {
        const std::string_view name = Furnace::subsurfaces[row[7]];
        row[7] = static_cast<int>(std::find(std::begin(Furnace::subsurfaces), std::end(Furnace::subsurfaces), name) -
                                  Furnace::subsurfaces);
    }
    const auto needed = test::needed_rows(told_apart);
    std::vector<std::vector<int>> result;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (needed[i]) {
            result.push_back(told_apart[i]);
        }
    }
    return result;
}

/// Small pictures leave nothing to choose (GuidingChoice): `full` guides everywhere there. So media that do not take
/// long are there once more, in pictures that are tried and chosen in.
std::vector<Furnace> furnaces() {
    std::vector<Furnace> all, chosen;
    for (const auto& row : furnace_rows()) {
        all.emplace_back(row);
        if (const Furnace& f = all.back(); f.sampling == std::string("full") && f.size <= 10) {
            chosen.push_back(f);
            chosen.back().samples = 31;
            chosen.back().least_resolution = 32;
        }
    }
    all.insert(all.end(), chosen.begin(), chosen.end());
    return all;
}

/// A medium whose density varies from voxel to voxel, from nearly nothing to twice the mean.
MediumId add_uneven_grid(SceneDescription& s, const Rgb& absorption, const Rgb& scattering, float g) {
    constexpr int n = 8;
    auto grid = std::make_shared<Grid>(
        Vec3i(0, 0, 0), Vec3i(n, n, n), [](const Vec3i&, const Vec3i&) { return true; },
        [](int x, int y, int z) { return 0.05f + static_cast<float>((3 * x + 5 * y + 7 * z) % 8) * 0.27f; });
    const Transform index_from_world =
        Transform::translate(n / 2 - 0.5, n / 2 - 0.5, n / 2 - 0.5) * Transform::scale(3, 3, 3);
    s.media.push_back(GridMedium(grid, index_from_world, Box3(Vec3(0), Vec3(n - 1)), absorption, scattering,
                                 PhaseFunction(HenyeyGreenstein{g})));
    return static_cast<MediumId>(s.media.size()) - 1;
}

Scene scene_of(const Furnace& f, int resolution) {
    SceneDescription s = test::scene_with_camera({0.4f, 0.3f, -5}, {0.1f, 0.05f, 0}, 6, resolution);
    const float thickness = f.body == Body::thin_slab ? 0.2f : 2.0f;
    // One channel is thin, and absorbs nothing.
    const Rgb extinction = (f.coloured ? Rgb(1, 0.3f, 0.02f) : Rgb(1.0f)) * (f.size / thickness);
    const Rgb albedo = f.coloured ? Rgb(f.albedo, f.albedo, 1) : Rgb(f.albedo);
    const Rgb scattering = albedo * extinction;
    const MediumId medium = f.grid ? add_uneven_grid(s, extinction - scattering, scattering, f.g)
                                   : test::add_homogeneous(s, extinction - scattering, scattering, f.g);
    const int material = f.boundary == Boundary::matched  ? test::add_interface(s)
                         : f.boundary == Boundary::smooth ? test::add_dielectric(s, 1.4f)
                                                          : test::add_dielectric(s, 1.4f, 0.3f);
    switch (f.body) {
        case Body::ball:
            test::add_sphere(s, {0, 0, 0}, 1, material, medium);
            break;
        case Body::thin_slab:
            test::add_box(s, Box3(Vec3(-1, -1, -0.1f), Vec3(1, 1, 0.1f)), material, medium);
            break;
        case Body::cube:
            test::add_box(s, Box3(Vec3(-1), Vec3(1)), material, medium);
            break;
        case Body::two_boxes:
            test::add_box(s, Box3(Vec3(-1), Vec3(0.1f, 1, 1)), material, medium);
            test::add_box(s, Box3(Vec3(0.1f, -1, -1), Vec3(1)), material, medium);
            break;
    }
    test::add_environment(s, Rgb(1.0f));
    return Scene(std::move(s));
}

/// What errors are relative to: the value, or a third of the sky where it is darker.
double scale_of(double value) {
    return std::max(value, 1.0 / 3);
}

struct Effort {
    const char* subsurface;
    const char* sampling;
    int samples;   ///< per pixel
    double error;  ///< relative, that is enough
    int most_renders;
};

test::ChannelMeans measure(const Furnace& f, const Effort& effort) {
    const int resolution = std::max(
        f.least_resolution, static_cast<int>(std::lround(std::sqrt(Furnace::samples_of_render / effort.samples))));
    RenderSettings settings;
    settings.preset = parse_preset(effort.sampling);
    settings.subsurface = parse_subsurface(effort.subsurface);
    settings.samples = effort.samples;
    settings.max_depth = 100000;
    return test::render_until(scene_of(f, resolution), settings, resolution, effort.error, effort.most_renders,
                              scale_of);
}

/// A radiance by classical walks.
struct Reference {
    double mean = 0, standard_error = 0;
};

std::filesystem::path references_path() {
    return test::source_dir() / "tests/render/furnaces.csv";
}

/// By object and channel. Lines are `"object",mean,error,mean,error,mean,error`.
std::map<std::string, std::array<Reference, 3>> read_references() {
    std::map<std::string, std::array<Reference, 3>> references;
    std::ifstream file(references_path());
    std::string object;
    while (file >> std::quoted(object)) {
        for (Reference& r : references[object]) {
            char comma;
            file >> comma >> r.mean >> comma >> r.standard_error;
        }
    }
    return references;
}

TEST(FurnaceReferences, DISABLED_WriteReferences) {
    std::map<std::string, std::array<Reference, 3>> references = read_references();
    for (const Furnace& f : furnaces()) {
        if (f.is_lossless(0) || references.contains(f.object())) {
            continue;
        }
        const test::ChannelMeans classical = measure(f, {"classical", "classical", 64, 0.0009, 4096});
        std::ofstream file(references_path(), std::ios::app);
        file << std::quoted(f.object()) << std::setprecision(6);
        for (const Moments& m : classical.channels) {
            file << ',' << m.mean() << ',' << m.standard_error();
        }
        ASSERT_TRUE(file << std::endl);
    }
}

class FurnaceMatrix : public testing::TestWithParam<Furnace> {};

TEST_P(FurnaceMatrix, IsAsBrightAsItShouldBe) {
    const Furnace& f = GetParam();
    const auto references = read_references();
    const auto known = references.find(f.object());
    ASSERT_TRUE(f.is_lossless(0) || known != references.end()) << references_path() << " has no such line";
    const auto right_of = [&](int c) {
        return f.is_lossless(c) ? Reference{1, 0} : known->second[static_cast<std::size_t>(c)];
    };
    // Of a bias of 1 % a quarter, less what the reference takes.
    double enough = 0.00247;
    for (int c = 0; c < 3; ++c) {
        const Reference right = right_of(c);
        enough =
            std::min(enough, std::sqrt(0.00247 * 0.00247 - std::pow(right.standard_error / scale_of(right.mean), 2)));
    }
    const test::ChannelMeans got = measure(f, {f.subsurface, f.sampling, f.samples, enough, 512});
    for (int c = 0; c < 3; ++c) {
        const Reference right = right_of(c);
        const Moments& mean = got[c];
        const double error = std::hypot(mean.standard_error(), right.standard_error);
        EXPECT_TRUE(agrees(mean.mean(), error, right.mean, 3.5, 1e-5))
            << "channel " << c << ": " << mean.mean() << " +- " << error << ", not " << right.mean << ", after "
            << mean.count() << " renders";
        EXPECT_LT(4 * error, 0.01 * scale_of(right.mean))
            << "channel " << c << ": too few samples to see a bias of 1 %";
    }
}

INSTANTIATE_TEST_SUITE_P(SlowPairs, FurnaceMatrix, testing::ValuesIn(furnaces()));

void expect_each_pair(const std::vector<std::vector<int>>& rows, const std::vector<int>& levels) {
    for (std::size_t i = 0; i < levels.size(); ++i) {
        for (std::size_t k = i + 1; k < levels.size(); ++k) {
            std::vector<bool> seen(static_cast<std::size_t>(levels[i] * levels[k]));
            for (const auto& row : rows) {
                seen[static_cast<std::size_t>(row[i] * levels[k] + row[k])] = true;
            }
            EXPECT_EQ(std::count(seen.begin(), seen.end(), false), 0) << i << ' ' << k;
        }
    }
}

TEST(CoveringArray, HasEachPairOfLevels) {
    const auto rows = test::covering_array(Furnace::levels());
    expect_each_pair(rows, Furnace::levels());
    EXPECT_LT(rows.size(), 100u);
    // The ways inside dense media that are told apart are the others' numbers but two.
    auto needed = furnace_rows();
    EXPECT_LT(needed.size(), rows.size());
    std::vector<int> levels = Furnace::levels();
    levels[7] = 5;
    for (auto& row : needed) {
        row[7] = std::min(row[7], 4);
    }
    expect_each_pair(needed, levels);
}

}  // namespace
}  // namespace wend
