// Furnaces in thermal equilibrium: media that shine as much as they absorb, lamps that shine as the sky does. Whatever
// stands in them, and wherever the camera is, all has the radiance of the sky, times the square of the refractive index
// (Kirchhoff's law). So the right value is known for media that absorb, too.
#include <tests/support/channel_means.h>
#include <tests/support/covering_array.h>
#include <tests/support/scenes.h>

#include <wend/stats/significance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

namespace wend {
namespace {

enum class Inside { nothing, lamp, other_medium, glass, other_medium_in_glass };

constexpr float ior = 1.4f;
constexpr float ior_inside = 1.2f;

struct Equilibrium {
    static constexpr float albedos[] = {1, 0.99f, 0.9f, 0.5f};
    static constexpr float mean_cosines[] = {-0.5f, 0, 0.5f, 0.9f};
    static constexpr float sizes[] = {1, 10, 30};  // in mean free paths
    static constexpr const char* subsurfaces[] = {"classical", "dwivedi", "incident", "auto"};
    static constexpr const char* samplings[] = {"classical", "direction", "splitting", "full"};
    static constexpr int passes[] = {4, 16, 64};  // samples per pixel
    static constexpr int samples_of_render = 1 << 10;

    float albedo, g, size;
    bool refracts, is_cube, coloured, camera_inside;
    Inside inside;
    const char* subsurface;
    const char* sampling;
    int samples;
    int least_resolution = 1;

    static std::vector<int> levels() { return {4, 4, 3, 2, 2, 2, 2, 5, 4, 4, 3}; }
    explicit Equilibrium(const std::vector<int>& row)
        : albedo(albedos[row[0]]),
          g(mean_cosines[row[1]]),
          size(sizes[row[2]]),
          refracts(row[3] != 0),
          is_cube(row[4] != 0),
          coloured(row[5] != 0),
          camera_inside(row[6] != 0),
          inside(static_cast<Inside>(row[7])),
          subsurface(subsurfaces[row[8]]),
          sampling(samplings[row[9]]),
          samples(passes[row[10]]) {}

    friend void PrintTo(const Equilibrium& e, std::ostream* out) {
        constexpr const char* insides[] = {"nothing", "a lamp", "another medium", "glass", "another medium in glass"};
        *out << "albedo " << e.albedo << ", g " << e.g << ", size " << e.size << (e.refracts ? ", smooth" : ", matched")
             << (e.is_cube ? " cube" : " ball") << (e.coloured ? ", coloured" : "")
             << (e.camera_inside ? ", camera inside" : "") << ", in it " << insides[static_cast<int>(e.inside)]
             << ", --subsurface " << e.subsurface << " --sampling " << e.sampling << " --spp " << e.samples
             << (e.least_resolution > 1 ? ", in a picture that is large enough to choose" : "");
    }
};

/// Small pictures leave nothing to choose (GuidingChoice): `full` guides everywhere there. So its rows are there once
/// more, in pictures that are tried and chosen in.
std::vector<Equilibrium> equilibria() {
    std::vector<Equilibrium> all, chosen;
    for (const auto& row : test::covering_array(Equilibrium::levels())) {
        all.emplace_back(row);
        if (all.back().sampling == std::string("full")) {
            chosen.push_back(all.back());
            chosen.back().samples = 31;
            chosen.back().least_resolution = 32;
        }
    }
    all.insert(all.end(), chosen.begin(), chosen.end());
    return all;
}

/// A medium in equilibrium with this radiance.
MediumId add_medium(SceneDescription& s, const Rgb& extinction, const Rgb& albedo, float g, float radiance) {
    const MediumId medium = test::add_homogeneous(s, extinction - albedo * extinction, albedo * extinction, g);
    auto& added = std::get<HomogeneousMedium>(s.media.back());
    added.emission = added.absorption * radiance;
    return medium;
}

Scene scene_of(const Equilibrium& e, int resolution) {
    const Vec3 eye = e.camera_inside ? Vec3(0.1f, -0.75f, 0.2f) : Vec3(0.4f, 0.3f, -5);
    SceneDescription s = test::scene_with_camera(eye, {0.1f, 0.05f, 0}, e.camera_inside ? 60 : 6, resolution);
    const float radiance = e.refracts ? sqr(ior) : 1;
    // One channel is thin.
    const Rgb extinction = (e.coloured ? Rgb(1, 0.3f, 0.02f) : Rgb(1.0f)) * (e.size / 2);
    const MediumId medium = add_medium(s, extinction, Rgb(e.albedo), e.g, radiance);
    const int boundary = e.refracts ? test::add_dielectric(s, ior) : test::add_interface(s);
    if (e.is_cube) {
        test::add_box(s, Box3(Vec3(-1), Vec3(1)), boundary, medium);
    } else {
        test::add_sphere(s, {0, 0, 0}, 1, boundary, medium);
    }
    s.camera_medium = e.camera_inside ? medium : vacuum;
    const float in_glass = radiance * sqr(ior_inside);
    switch (e.inside) {
        case Inside::nothing:
            break;
        case Inside::lamp:
            test::add_lamp(s, {0.1f, 0.1f, 0}, 0.4f, Rgb(radiance), test::add_diffuse(s, Rgb(0.0f)));
            break;
        case Inside::other_medium:
            test::add_sphere(s, {0, 0.2f, 0}, 0.5f, test::add_interface(s),
                             add_medium(s, Rgb(3.0f), Rgb(0.7f, 0.9f, 1), 0.3f, radiance), medium);
            break;
        case Inside::glass:
            test::add_sphere(s, {0, 0.2f, 0}, 0.5f, test::add_dielectric(s, ior_inside), vacuum, medium);
            break;
        case Inside::other_medium_in_glass:
            test::add_sphere(s, {0, 0.2f, 0}, 0.5f, test::add_dielectric(s, ior_inside),
                             add_medium(s, Rgb(3.0f), Rgb(0.7f, 0.9f, 1), 0.3f, in_glass), medium);
            break;
    }
    test::add_environment(s, Rgb(1.0f));
    return Scene(std::move(s));
}

class Equilibria : public testing::TestWithParam<Equilibrium> {};

TEST_P(Equilibria, AreAsBrightAsTheSky) {
    const Equilibrium& e = GetParam();
    const double right = e.camera_inside && e.refracts ? static_cast<double>(sqr(ior)) : 1;
    const int resolution = std::max(
        e.least_resolution, static_cast<int>(std::lround(std::sqrt(Equilibrium::samples_of_render / e.samples))));
    const Scene scene = scene_of(e, resolution);
    RenderSettings settings;
    settings.preset = parse_preset(e.sampling);
    settings.subsurface = parse_subsurface(e.subsurface);
    settings.samples = e.samples;
    settings.max_depth = 100000;
    const auto scale = [&](double) { return right; };
    const test::ChannelMeans means = test::render_until(scene, settings, resolution, 0.00248, 2048, scale);
    for (int c = 0; c < 3; ++c) {
        EXPECT_TRUE(agrees(means[c], right, 4, 1e-5))
            << "channel " << c << ": " << means[c].mean() << " +- " << means[c].standard_error() << ", not " << right;
    }
    EXPECT_LT(4 * means.worst_error(scale), 0.01) << "too few samples to see a bias of 1 %";
}

INSTANTIATE_TEST_SUITE_P(SlowPairs, Equilibria, testing::ValuesIn(equilibria()));

}  // namespace
}  // namespace wend
