// What guided walks tell of unguided ones: the mean square of what those bring, by which it is judged whether guiding
// pays.
#include <tests/support/kept_means.h>
#include <tests/support/scenes.h>

#include <wend/decision/guided_distance.h>
#include <wend/render/preset.h>
#include <wend/render/render.h>
#include <wend/stats/moments.h>
#include <wend/transport/path_tracer.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace wend {
namespace {

/// A room full of fog, into which the sun falls by a hole in its roof. Only connections find the sun, so
/// that walks guided or not bring the same on the same way.
SceneDescription room_with_hole() {
    SceneDescription s = test::scene_with_camera({-0.8f, -0.3f, -0.8f}, {-0.5f, 0, 1}, 70, 32);
    const MediumId fog = test::add_homogeneous(s, Rgb(0.05f, 0.1f, 0.1f), Rgb(0.8f, 0.7f, 0.6f), 0.5f);
    s.camera_medium = fog;
    const int wall = test::add_diffuse(s, Rgb(0.7f, 0.6f, 0.5f));
    const auto side = [&](const Vec3& corner, const Vec3& a, const Vec3& b) {
        test::add_parallelogram(s, corner, a, b, wall, fog, fog);
    };
    side({-1, -1, -1}, {2, 0, 0}, {0, 0, 2});
    side({-1, -1, -1}, {0, 2, 0}, {0, 0, 2});
    side({1, -1, -1}, {0, 2, 0}, {0, 0, 2});
    side({-1, -1, -1}, {2, 0, 0}, {0, 2, 0});
    side({-1, -1, 1}, {2, 0, 0}, {0, 2, 0});
    side({-1, 1, -1}, {1, 0, 0}, {0, 0, 2});
    test::add_sphere(s, {0, 0, 0}, 4, test::add_interface(s), fog);
    s.lights.push_back(DistantLight{normalize(Vec3(0.1f, 1, 0.2f)), Rgb(2.0f)});
    return s;
}

constexpr int most_vertices = 8;

class UnguidedSquare : public testing::Test {
protected:
    std::shared_ptr<const guide::Fields> learned() const {
        Film film({32, 32}, {{0, 0}, {32, 32}});
        RenderSettings settings;
        settings.preset = parse_preset("distance+direction+roulette+splitting");
        settings.samples = 63;
        settings.max_depth = most_vertices;
        settings.keeps_fields = true;
        return render(scene_, film, settings).fields;
    }

    template <class Decisions>
    Moments means(const Decisions& decisions, float expected, int walks, bool squares) const {
        const PathTracer tracer(scene_, decisions, no_guides_, lights_, reflections_, most_vertices);
        Moments means;
        for (int i = 0; i < walks; ++i) {
            Sampler sampler(SamplerKind::independent, 1, 0, static_cast<std::uint32_t>(i));
            const WalkResult walk = tracer.trace({{-0.8f, -0.3f, -0.8f}, {0, 0, 1}}, expected, sampler);
            means.add(squares ? walk.unguided_square : static_cast<double>(mean_value(walk.sample.radiance)));
        }
        return means;
    }

    const Scene scene_{room_with_hole()};
    const SubsurfaceGuides no_guides_;
    const LightSelection lights_{scene_};
    const ReflectionProbability reflections_{scene_.bounds()};
    const ClassicalDecisions classical_{{}, {}, unguided_walks_end};
};

using SlowUnguidedSquare = UnguidedSquare;

TEST_F(UnguidedSquare, OfUnguidedWalksIsTheirOwn) {
    const PathTracer tracer(scene_, classical_, no_guides_, lights_, reflections_, most_vertices);
    double all = 0;
    for (std::uint32_t i = 0; i < 2000; ++i) {
        Sampler sampler(SamplerKind::independent, 1, 0, i);
        const WalkResult walk = tracer.trace({{-0.8f, -0.3f, -0.8f}, {0, 0, 1}}, 0, sampler);
        const double brought = static_cast<double>(mean_value(walk.sample.radiance));
        ASSERT_NEAR(walk.unguided_square, brought * brought, 1e-4 * brought * brought);
        all += brought;
    }
    EXPECT_GT(all, 0);
}

TEST_F(SlowUnguidedSquare, OfGuidedWalksIsThatOfUnguidedOnesInTheMean) {
    constexpr int few = 80000;
    // The mean square of unguided walks, how much the square varies, and what walks bring.
    const auto known = test::kept_means("unguided_square", [&] {
        constexpr int many = 30 * few;
        const Moments squares = means(classical_, 0, many, true), brought = means(classical_, 0, many / 6, false);
        return std::vector{test::KnownMean{squares.mean(), squares.standard_error()},
                           test::KnownMean{squares.variance(), 0},
                           test::KnownMean{brought.mean(), brought.standard_error()}};
    });
    const test::KnownMean& unguided = known[0];
    const double unguided_variance = known[1].mean;
    const auto mean = static_cast<float>(known[2].mean);
    const auto fields = learned();
    const GuidedDirection<guide::Field> direction(&fields->surface, &fields->volume);
    const GuidedDistance distance(&fields->surface, &fields->volume, classical_flights,
                                  DistanceGuiding::scatter_and_distance);
    const GuidedDecisions guided{distance, direction, AdjointRouletteSplitting(true, true, 1)};
    const Moments found = means(guided, mean, few, true);
    const double error = std::hypot(unguided.standard_error, found.standard_error());
    EXPECT_NEAR(found.mean(), unguided.mean, 4 * error);
    EXPECT_LT(4 * error, 0.04 * unguided.mean);
    EXPECT_LT(16 * found.variance(), unguided_variance) << "they tell more of unguided walks than those do";
    // Guided walks have less of it themselves.
    const Moments brought = means(guided, mean, few, false);
    EXPECT_LT(brought.variance() + brought.mean() * brought.mean(), 0.7 * unguided.mean);
}

}  // namespace
}  // namespace wend
