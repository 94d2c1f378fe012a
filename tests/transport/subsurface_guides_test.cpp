// Guided walks inside dense media against known values and classical walks.
#include <tests/support/channel_means.h>
#include <tests/support/kept_means.h>
#include <tests/support/scenes.h>
#include <tests/support/slab_references.h>

#include <wend/stats/significance.h>
#include <wend/transport/path_tracer.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace wend {
namespace {

using test::KnownMean;
using test::Measured;

/// Of unguided walks along the ray, or of others where their strategies are named.
KnownMean kept_radiance(const std::string& name, const Scene& scene, const Ray& ray, int walks, int max_depth = 100000,
                        const char* strategies = "classical") {
    return test::kept_means(name,
                            [&] {
                                const Measured m = test::measure_radiance(scene, ray, walks, max_depth, 1000,
                                                                          parse_subsurface(strategies));
                                return std::vector{KnownMean{m.mean, m.standard_error}};
                            })
        .front();
}

constexpr const char* guided_strategies[] = {"dwivedi", "closest", "incident", "auto"};

struct Block {
    const char* name;
    float albedo, thickness, g, ior;
    double value;  ///< radiance returned under a white sky of radiance 1, normal view, specular reflection included
};

void PrintTo(const Block& block, std::ostream* out) {
    *out << block.name;
}

/// A mesh of a slab, lit from above only.
SceneDescription slab(const Block& k) {
    SceneDescription s;
    const MediumId medium =
        test::add_homogeneous(s, Rgb((1 - k.albedo) * k.thickness), Rgb(k.albedo * k.thickness), k.g);
    const int boundary = k.ior == 1 ? test::add_interface(s) : test::add_dielectric(s, k.ior);
    // So wide that no light gets to the sides.
    const float width = std::max(2.0f, 48 / k.thickness);
    test::add_box(s, Box3(Vec3(-width, -width, 0), Vec3(width, width, 1)), boundary, medium);
    test::add_parallelogram(s, Vec3(-1e5f, -1e5f, 1.5f), Vec3(2e5f, 0, 0), Vec3(0, 2e5f, 0),
                            test::add_diffuse(s, Rgb(0.0f)));
    test::add_environment(s, Rgb(1.0f));
    return s;
}

Measured reflected(const Block& k, const char* strategy, const test::WalkBudget& walks) {
    const Scene scene(slab(k));
    return test::measure_radiance(scene, {{0.3f, 0.1f, -2}, {0, 0, 1}}, walks, 100000, 1, parse_subsurface(strategy));
}

class GuidedSlab : public testing::TestWithParam<Block> {};

TEST_P(GuidedSlab, MatchesKnownReflectance) {
    const Block& k = GetParam();
    for (const char* strategy : guided_strategies) {
        SCOPED_TRACE(strategy);
        const Measured m = reflected(k, strategy, {600000, 0.0024});
        EXPECT_TRUE(agrees(m.mean, m.standard_error, k.value, 4, 1e-5))
            << m.mean << " +- " << m.standard_error << " expected " << k.value;
        EXPECT_LT(4 * m.standard_error, 0.01 * k.value) << "too few walks to see a bias of 1 %";
    }
}

// By H functions and adding-doubling, as in transport_test.cpp.
INSTANTIATE_TEST_SUITE_P(SlowMedia, GuidedSlab,
                         testing::Values(Block{"HalfSpace_4", 0.4f, 60, 0, 1, 0.08335728},
                                         Block{"HalfSpace_95", 0.95f, 80, 0, 1, 0.53554099},
                                         Block{"HalfSpace_95g_75", 0.95f, 150, 0.75f, 1, 0.276766},
                                         Block{"HalfSpace_95gMinus3", 0.95f, 80, -0.3f, 1, 0.584095},
                                         Block{"HalfSpace_9n1_5", 0.9f, 60, 0, 1.5f, 0.2599186},
                                         Block{"Slabb4_95g_75", 0.95f, 4, 0.75f, 1, 0.203461}),
                         [](const auto& block) { return std::string(block.param.name); });

TEST(SlowGuidedSlab, MatchesTheReferenceTable) {
    const std::vector<test::SlabReference> references = test::slab_references();
    int rows = 0;
    for (const test::SlabReference& row : references) {
        if (!row.is_normal_beam() || row.thickness < 4) {
            continue;
        }
        const Block k{"csv", static_cast<float>(row.albedo), static_cast<float>(row.thickness), 0, 1, row.reflectance};
        const Measured m = reflected(k, "auto", {300000, 0.0024});
        EXPECT_TRUE(agrees(m.mean, m.standard_error, k.value, 4, 1e-5))
            << row.text << ": " << m.mean << " +- " << m.standard_error;
        EXPECT_LT(4 * m.standard_error, 0.01 * k.value) << row.text;
        ++rows;
    }
    EXPECT_GT(rows, 0);
}

TEST(GuidedSlab, HasLessVarianceThanClassicalSampling) {
    const Block k{"", 0.95f, 80, 0, 1, 0.53554099};
    constexpr int walks = 30000;
    const double classical = reflected(k, "classical", walks).standard_error;
    const double dwivedi = reflected(k, "dwivedi", walks).standard_error;
    EXPECT_LT(dwivedi * dwivedi, classical * classical / 4);
}

TEST(SlowGuidedSlab, LeadsThroughAShieldThatABillionthPasses) {
    // Twenty mean free paths of albedo 1/2, between a white sky and a black wall; the value by analytic discrete
    // ordinates, the 2.06e-9 of light that never collides included.
    constexpr double transmittance = 1.0479658e-8;
    SceneDescription s;
    const MediumId medium = test::add_homogeneous(s, Rgb(10.0f), Rgb(10.0f), 0);
    test::add_box(s, Box3(Vec3(-3, -3, 0), Vec3(3, 3, 1)), test::add_interface(s), medium);
    test::add_parallelogram(s, {-1e5f, -1e5f, -0.5f}, {2e5f, 0, 0}, {0, 2e5f, 0}, test::add_diffuse(s, Rgb(0.0f)));
    test::add_environment(s, Rgb(1.0f));
    constexpr int resolution = 16;
    s.camera = Camera(OrthographicCamera{{-0.1f, 0.1f, -0.1f, 0.1f}, 0, 1}, Transform::translate(0.3, 0.1, -0.2),
                      resolution, resolution);
    const Scene scene(std::move(s));
    // With what renders learn: before, a few in ten million walks bring a twentieth of the light.
    for (const char* strategy : {"incident", "auto"}) {
        RenderSettings settings;
        settings.subsurface = parse_subsurface(strategy);
        settings.samples = 512;
        settings.max_depth = 100000;
        test::ChannelMeans means;
        for (settings.seed = 1; settings.seed <= 8; ++settings.seed) {
            Film film({resolution, resolution}, {{0, 0}, {resolution, resolution}});
            render(scene, film, settings);
            means.add(film.beauty());
        }
        const Moments& mean = means[1];
        EXPECT_LT(mean.standard_error(), 0.02 * transmittance) << strategy;
        EXPECT_TRUE(agrees(mean, transmittance, 4))
            << strategy << ' ' << mean.mean() << " +- " << mean.standard_error();
    }
    const Measured classical = test::measure_radiance(scene, {{0.3f, 0.1f, -0.2f}, {0, 0, 1}}, 400000, 100000, 1,
                                                      parse_subsurface("classical"));
    EXPECT_GT(classical.standard_error, 0.3 * transmittance) << "not a billionth";
}

struct Object {
    const char* name;
    float g, ior, roughness;
    Rgb absorption, scattering;
    bool is_sphere;
};

void PrintTo(const Object& object, std::ostream* out) {
    *out << object.name;
}

/// A dense object under a coloured sky, a point light and a lamp, on a grey floor.
SceneDescription lit(const Object& o) {
    SceneDescription s;
    const MediumId medium = test::add_homogeneous(s, o.absorption, o.scattering, o.g);
    const int boundary = o.ior == 1 ? test::add_interface(s) : test::add_dielectric(s, o.ior, o.roughness);
    if (o.is_sphere) {
        test::add_sphere(s, {0, 0, 0}, 1, boundary, medium);
    } else {
        test::add_box(s, Box3(Vec3(-0.8f, -1, -0.4f), Vec3(0.8f, 1, 0.4f)), boundary, medium);
    }
    test::add_parallelogram(s, {-5, -1.2f, -5}, {0, 0, 10}, {10, 0, 0}, test::add_diffuse(s, Rgb(0.5f)));
    const Vec3 p(-1, 3, 2);
    s.lights.push_back(make_triangle_light(p, p + Vec3(2, 0, 0), p + Vec3(0, 0, 2), true, Rgb(10.0f), true));
    Surface lamp{TriangleMesh{{p, p + Vec3(2, 0, 0), p + Vec3(0, 0, 2)}, {}, {}, {0, 1, 2}},
                 s.surfaces.back().material};
    lamp.first_light = 0;
    s.world_surfaces.push_back(static_cast<int>(s.surfaces.size()));
    s.surfaces.push_back(std::move(lamp));
    s.lights.push_back(PointLight{{2, 2, -3}, {3, 6, 4}});
    test::add_environment(s, {0.8f, 1.0f, 1.2f});
    return s;
}

class GuidedObject : public testing::TestWithParam<Object> {};

TEST_P(GuidedObject, IsTheSameAsTheClassicalOne) {
    const Scene scene(lit(GetParam()));
    const Ray ray{{0.2f, 0.1f, -4}, normalize(Vec3(0, 0.02f, 1))};
    const KnownMean classical = kept_radiance(std::string("guided_object_") + GetParam().name, scene, ray, 1'000'000);
    for (const char* strategy : guided_strategies) {
        SCOPED_TRACE(strategy);
        const Measured m = test::measure_radiance(scene, ray, {300000, 0.0048}, 100000, 2, parse_subsurface(strategy));
        const double error = std::hypot(m.standard_error, classical.standard_error);
        EXPECT_TRUE(agrees(m.mean - classical.mean, error, 0, 4))
            << m.mean << " and " << classical.mean << " +- " << error;
        EXPECT_LT(4 * error, 0.02 * classical.mean) << "too few walks to see a bias of 2 %";
    }
}

INSTANTIATE_TEST_SUITE_P(SlowBoundaries, GuidedObject,
                         testing::Values(Object{"MatchedChromatic", 0, 1, 0, {0.2f, 0.8f, 2}, {12, 10, 8}, true},
                                         Object{"MatchedForward", 0.8f, 1, 0, {0.2f, 0.4f, 1}, {20, 15, 12}, false},
                                         Object{"SmoothBackward", -0.5f, 1.4f, 0, {0.3f, 0.6f, 1}, {9, 9, 9}, true},
                                         Object{
                                             "RoughForward", 0.8f, 1.4f, 0.3f, {0.2f, 0.5f, 1}, {20, 15, 12}, false}),
                         [](const auto& object) { return std::string(object.param.name); });

TEST(SlowGuidedObject, MayHoldALampAndOtherObjects) {
    SceneDescription s;
    const MediumId outer = test::add_homogeneous(s, Rgb(0.2f), Rgb(8.0f), 0.3f);
    const MediumId inner = test::add_homogeneous(s, {1, 0.5f, 0.2f}, Rgb(12.0f));
    test::add_sphere(s, {0, 0, 0}, 1, test::add_dielectric(s, 1.4f, 0.2f), outer);
    test::add_sphere(s, {0.3f, 0.2f, -0.3f}, 0.35f, test::add_dielectric(s, 1.2f), inner, outer);
    test::add_lamp(s, {-0.6f, 0.1f, -0.4f}, 0.5f, Rgb(5.0f), test::add_diffuse(s, Rgb(0.4f)));
    s.surfaces.back().interior = s.surfaces.back().exterior = outer;
    test::add_environment(s, Rgb(0.5f));
    const Scene scene(std::move(s));
    const Ray ray{{0.1f, 0.1f, -4}, {0, 0, 1}};
    const KnownMean classical = kept_radiance("holds_a_lamp", scene, ray, 400'000);
    for (const char* strategy : guided_strategies) {
        const Measured m = test::measure_radiance(scene, ray, {60000, 0.024}, 100000, 2, parse_subsurface(strategy));
        const double error = std::hypot(m.standard_error, classical.standard_error);
        EXPECT_TRUE(agrees(m.mean - classical.mean, error, 0, 4))
            << strategy << ": " << m.mean << " and " << classical.mean << " +- " << error;
        EXPECT_LT(4 * error, 0.1 * classical.mean) << strategy;
    }
}

/// A slab behind a rough boundary, with a lamp behind it that only connections or luck find.
SceneDescription back_lit() {
    SceneDescription s;
    const MediumId medium = test::add_homogeneous(s, {0.1f, 0.2f, 0.4f}, {6, 6, 6});
    test::add_box(s, Box3(Vec3(-0.8f, -1, -0.3f), Vec3(0.8f, 1, 0.3f)), test::add_dielectric(s, 1.4f, 0.3f), medium);
    const Vec3 p(-0.5f, -1, 1.5f), up(0, 4, 0), aside(4, 0, 0);
    s.lights.push_back(make_triangle_light(p, p + up, p + aside, true, Rgb(3.0f), true));
    Surface lamp{TriangleMesh{{p, p + up, p + aside}, {}, {}, {0, 1, 2}}, test::add_diffuse(s, Rgb(0.0f))};
    lamp.first_light = 0;
    s.world_surfaces.push_back(static_cast<int>(s.surfaces.size()));
    s.surfaces.push_back(std::move(lamp));
    s.lights.push_back(PointLight{{-1, 0.5f, 2}, {1, 1.5f, 2}});
    return s;
}

struct Limit {
    int max_depth, walks;
    double bias;  ///< that is seen
};

/// Walks that are connected to lights against those that are not.
void expect_same_radiance(const Scene& scene, const Ray& ray, const char* connected, const KnownMean& unconnected,
                          const Limit& limit) {
    SCOPED_TRACE(limit.max_depth);
    // Of both means together the bias is eight standard errors.
    const double enough =
        std::sqrt(std::pow(limit.bias / 8.2, 2) - std::pow(unconnected.standard_error / unconnected.mean, 2));
    const Measured a =
        test::measure_radiance(scene, ray, {limit.walks, enough}, limit.max_depth, 3, parse_subsurface(connected));
    const double error = std::hypot(a.standard_error, unconnected.standard_error);
    EXPECT_TRUE(agrees(a.mean - unconnected.mean, error, 0, 4))
        << a.mean << " and " << unconnected.mean << " +- " << error;
    EXPECT_LT(8 * error, limit.bias * unconnected.mean) << "too few walks to see a bias";
    EXPECT_FALSE(agrees((1 + limit.bias) * a.mean - unconnected.mean, error, 0, 4));
}

TEST(SlowGuidedObject, ConnectsCollisionsToLampsAtARoughBoundary) {
    const Scene scene(back_lit());
    const Ray ray{{0.2f, 0.1f, -4}, normalize(Vec3(0, 0.02f, 1))};
    // Few walks get through in five collisions; to connect once too often would show there.
    expect_same_radiance(scene, ray, "learned", kept_radiance("back_lit_5", scene, ray, 1'000'000, 5, "incident"),
                         {5, 300000, 0.08});
    expect_same_radiance(scene, ray, "learned", kept_radiance("back_lit", scene, ray, 1'000'000, 100000, "incident"),
                         {100000, 500000, 0.03});
}

/// A ball behind a smooth boundary, in thin fog and under a pane, a lamp and a sky with a bright spot.
SceneDescription under_glass() {
    SceneDescription s;
    const MediumId medium = test::add_homogeneous(s, {0.1f, 0.2f, 0.4f}, {9, 8, 7}, 0.2f);
    const MediumId fog = test::add_homogeneous(s, Rgb(0.0f), Rgb(0.05f));
    const int glass = test::add_dielectric(s, 1.3f);
    test::add_sphere(s, {0, 0, 0}, 0.7f, glass, medium, fog);
    test::add_sphere(s, {0, 0.1f, 0}, 1.2f, test::add_interface(s), fog);
    test::add_box(s, Box3(Vec3(-4, 1.5f, -4), Vec3(4, 1.7f, 4)), glass);
    test::add_lamp(s, {-2.5f, 2.2f, -2.5f}, 8, Rgb(2.0f), test::add_diffuse(s, Rgb(0.0f)));
    Image sky(8, 8, Rgb(0.05f));
    sky.at(2, 5) = Rgb(6.0f);
    s.lights.push_back(ImageInfiniteLight(sky, 1, Transform()));
    return s;
}

TEST(SlowGuidedObject, ConnectsCollisionsToLightsThroughSmoothBoundaries) {
    const Scene scene(under_glass());
    const Ray ray{{0.1f, 0.1f, -4}, normalize(Vec3(0, 0.02f, 1))};
    // After the first collision a walk of five vertices has three left, of which two boundaries.
    expect_same_radiance(scene, ray, "auto", kept_radiance("under_glass_5", scene, ray, 3'000'000, 5),
                         {5, 1500000, 0.06});
    expect_same_radiance(scene, ray, "auto", kept_radiance("under_glass", scene, ray, 1'000'000),
                         {100000, 300000, 0.04});
}

/// An index-matched ball under a sky with a bright spot.
SceneDescription under_spot() {
    SceneDescription s;
    const MediumId medium = test::add_homogeneous(s, {0.3f, 0.5f, 0.8f}, Rgb(9.0f), 0.3f);
    test::add_sphere(s, {0, 0, 0}, 0.7f, test::add_interface(s), medium);
    Image sky(8, 8, Rgb(0.2f));
    sky.at(2, 5) = Rgb(4.0f);
    s.lights.push_back(ImageInfiniteLight(sky, 1, Transform()));
    return s;
}

// Whatever the shares and the preference, an interior walk brings the same in the mean: with their changes the light
// that is brought changes as much as the density of the walks does.
TEST(SlowGuidedObject, StaysKnowHowTheLightTheyBringDependsOnShares) {
    const Ray ray{{0.1f, 0.1f, -4}, normalize(Vec3(0, 0.02f, 1))};
    for (const SceneDescription& description : {under_spot(), under_glass(), back_lit()}) {
        const Scene scene(description);
        const ClassicalDecisions decisions;
        const SubsurfaceGuides subsurface(scene, parse_subsurface("auto"));
        const LightSelection lights(scene);
        const ReflectionProbability reflections(scene.bounds());
        const PathTracer tracer(scene, decisions, subsurface, lights, reflections, 100000);
        Moments brought, by_preference;
        std::array<Moments, 2> by_share;
        std::vector<InteriorWalkRecord> interior_walks;
        constexpr std::uint32_t walks = 50000;
        for (std::uint32_t i = 0; i < walks; ++i) {
            Sampler sampler(SamplerKind::independent, 1, 0, i);
            interior_walks.clear();
            tracer.trace(ray, 0, sampler, StandardRecorders({}, InteriorRecorder(&interior_walks), {}, {}));
            double light = 0, slope = 0;
            std::array<double, 2> slopes{};
            for (const InteriorWalkRecord& interior_walk : interior_walks) {
                if (interior_walk.guided) {
                    light += interior_walk.brought;
                    slope += interior_walk.slope.preference;
                    for (std::size_t k = 0; k < slopes.size(); ++k) {
                        slopes[k] += interior_walk.brought * interior_walk.relative[k] - interior_walk.slope.shares[k];
                    }
                }
            }
            brought.add(light);
            by_preference.add(slope);
            for (std::size_t k = 0; k < slopes.size(); ++k) {
                by_share[k].add(slopes[k]);
            }
        }
        const auto expect_none = [&](const Moments& m) {
            EXPECT_TRUE(agrees(m.mean(), m.standard_error(), 0, 4))
                << m.mean() << " +- " << m.standard_error() << " of " << brought.mean();
            EXPECT_LT(m.standard_error(), 0.01 * brought.mean()) << "too few walks to see a slope";
        };
        expect_none(by_preference);
        for (const Moments& m : by_share) {
            expect_none(m);
        }
    }
}

/// A box of two colours, where x is negative and where it is positive.
SceneDescription two_coloured(float ior, const Rgb& left, const Rgb& right) {
    SceneDescription s;
    const MediumId medium = test::add_homogeneous(s, {0.4f, 1, 2}, {8, 9, 10}, 0.4f);
    const int boundary = test::add_dielectric(s, ior);
    CheckerboardTexture board{s.textures.add_constant(right), s.textures.add_constant(left), 3, {}, {}};
    board.texture_from_world = AffineMap(Transform::scale(0.1, 0.1, 0.1) * Transform::translate(0, 5, 5));
    std::get<DielectricMaterial>(s.materials.back()).relative_albedo = s.textures.add(board);
    test::add_box(s, Box3(Vec3(-1, -1, -0.4f), Vec3(1, 1, 0.4f)), boundary, medium);
    test::add_environment(s, {0.8f, 1.0f, 1.2f});
    s.lights.push_back(PointLight{{2, 2, -3}, {3, 6, 4}});
    return s;
}

// A walk finds the albedo of where it entered, so that each half looks as if all were of its colour.
TEST(SlowGuidedObject, HasTheColourOfWhereItIsEntered) {
    const Rgb red(1.04f, 0.6f, 0.3f), dark(0.2f);
    constexpr float ior = 1.4f;
    const Scene both(two_coloured(ior, dark, red)), all_red(two_coloured(ior, red, red));
    const Ray to_the_right{{0.25f, 0.1f, -4}, {0, 0, 1}}, to_the_left{{-0.25f, 0.1f, -4}, {0, 0, 1}};
    const KnownMean expected = kept_radiance("all_red", all_red, to_the_right, 500'000);
    const test::WalkBudget walks(100000, 0.007);
    const Measured elsewhere = test::measure_radiance(both, to_the_left, walks);
    EXPECT_LT(elsewhere.mean, 0.8 * expected.mean);
    for (const char* strategy : {"classical", "closest", "auto"}) {
        SCOPED_TRACE(strategy);
        const Measured m = test::measure_radiance(both, to_the_right, walks, 100000, 2, parse_subsurface(strategy));
        const double error = std::hypot(m.standard_error, expected.standard_error);
        EXPECT_TRUE(agrees(m.mean - expected.mean, error, 0, 4))
            << m.mean << " and " << expected.mean << " +- " << error;
        EXPECT_LT(4 * error, 0.03 * expected.mean);
    }
    // The same as a medium that is red itself.
    SceneDescription red_medium = two_coloured(ior, Rgb(1.0f), Rgb(1.0f));
    auto& medium = std::get<HomogeneousMedium>(red_medium.media.front());
    const Rgb extinction = medium.extinction();
    medium.scattering *= red;
    medium.absorption = extinction - medium.scattering;
    const Measured m = test::measure_radiance(Scene(red_medium), to_the_right, walks, 100000, 3);
    const double error = std::hypot(m.standard_error, expected.standard_error);
    EXPECT_TRUE(agrees(m.mean - expected.mean, error, 0, 4)) << m.mean << " and " << expected.mean << " +- " << error;
}

// Where an interior walk counts as one event, that of entering, a walk that may have no more than this loses nothing.
TEST(SlowGuidedObject, MayCountAsOneVertex) {
    for (const auto& [ior, alpha] : {std::pair{1.4f, 0.0f}, {1.4f, 0.3f}}) {
        SceneDescription s;
        const MediumId medium = test::add_homogeneous(s, {0.1f, 0.2f, 0.4f}, Rgb(9.0f), 0.3f);
        test::add_sphere(s, {0, 0, 0}, 1, test::add_dielectric(s, ior, alpha), medium);
        test::add_lamp(s, {-2.5f, 2.2f, -2.5f}, 4, Rgb(2.0f), test::add_diffuse(s, Rgb(0.0f)));
        const Ray ray{{0.2f, 0.1f, -4}, {0, 0, 1}};
        const auto measure = [&](bool counts, int max_depth, const char* strategy) {
            std::get<HomogeneousMedium>(s.media.front()).counts_vertices = counts;
            return test::measure_radiance(Scene(s), ray, 3000, max_depth, 1, parse_subsurface(strategy)).mean;
        };
        for (const char* strategy : {"classical", "auto"}) {
            SCOPED_TRACE(strategy);
            const double whole = measure(true, 100000, strategy);
            EXPECT_GT(whole, 0);
            EXPECT_EQ(measure(false, 100000, strategy), whole);
            EXPECT_EQ(measure(false, 1, strategy), whole);
            EXPECT_LT(measure(true, 5, strategy), 0.9 * whole);
        }
    }
}

TEST(GuidedObject, EndsThoughItIsOpenAndAbsorbsNothing) {
    SceneDescription s;
    const MediumId medium = test::add_homogeneous(s, Rgb(0.0f), Rgb(20.0f));
    std::get<HomogeneousMedium>(s.media.front()).counts_vertices = false;
    test::add_parallelogram(s, {-1, -1, 0}, {0, 2, 0}, {2, 0, 0}, test::add_dielectric(s, 1.4f), medium);
    test::add_environment(s, Rgb(1.0f));
    const Scene scene(std::move(s));
    for (const char* strategy : {"classical", "auto"}) {
        const Measured m =
            test::measure_radiance(scene, {{0.2f, 0.1f, -4}, {0, 0, 1}}, 200, 5, 1, parse_subsurface(strategy));
        EXPECT_TRUE(std::isfinite(m.mean));
        EXPECT_GT(m.mean, 0.02);
    }
}

TEST(GuidedObject, MayBeOpenOrInsideOut) {
    for (const bool open : {true, false}) {
        SceneDescription s;
        const MediumId medium = test::add_homogeneous(s, Rgb(0.2f), Rgb(10.0f));
        const int boundary = test::add_interface(s);
        // Without its far sides; or with the medium on the wrong side of two.
        test::add_parallelogram(s, {-1, -1, -1}, {0, 2, 0}, {2, 0, 0}, boundary, medium);
        test::add_parallelogram(s, {-1, -1, -1}, {0, 0, 2}, {0, 2, 0}, boundary, medium);
        test::add_parallelogram(s, {-1, -1, -1}, {2, 0, 0}, {0, 0, 2}, boundary, medium);
        if (!open) {
            test::add_parallelogram(s, {-1, -1, 1}, {0, 2, 0}, {2, 0, 0}, boundary, medium);
            test::add_parallelogram(s, {1, -1, -1}, {0, 0, 2}, {0, 2, 0}, boundary, medium);
        }
        test::add_environment(s, Rgb(1.0f));
        const Scene scene(std::move(s));
        const Ray ray{{0.2f, 0.1f, -4}, {0, 0, 1}};
        const Measured m = test::measure_radiance(scene, ray, 20000, 1000, 1, parse_subsurface("auto"));
        EXPECT_GT(m.mean, 0.1);
        EXPECT_TRUE(std::isfinite(m.mean));
    }
}

TEST(Subsurface, AThinFogIsLeftAlone) {
    SceneDescription s;
    const MediumId fog = test::add_homogeneous(s, Rgb(0.1f), Rgb(0.6f));
    test::add_box(s, Box3(Vec3(-1), Vec3(1)), test::add_interface(s), fog);
    test::add_environment(s, Rgb(1.0f));
    const Scene scene(std::move(s));
    const Ray ray{{0.2f, 0.1f, -4}, {0, 0, 1}};
    const auto strategies = parse_subsurface("auto");
    EXPECT_EQ(test::measure_radiance(scene, ray, 1000).mean,
              test::measure_radiance(scene, ray, 1000, 100000, 1, strategies).mean);
}

TEST(Subsurface, NamesAreParsedAndOthersExplained) {
    EXPECT_TRUE(parse_subsurface("classical").is_classical());
    for (const char* name : guided_strategies) {
        EXPECT_FALSE(parse_subsurface(name).is_classical());
        EXPECT_EQ(to_string(parse_subsurface(name)), name);
    }
    const auto message = [](const char* name) -> std::string {
        try {
            parse_subsurface(name);
        } catch (const std::exception& e) {
            return e.what();
        }
        return {};
    };
    EXPECT_NE(message("dwivedy").find("unknown"), std::string::npos);
    EXPECT_NE(message("dwivedy").find("incident, auto"), std::string::npos);
}

}  // namespace
}  // namespace wend
