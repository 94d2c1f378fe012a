// What walks inside a dense object are told of its boundary and of the lights around it.
#include <tests/support/scenes.h>

#include <wend/core/parallel.h>
#include <wend/medium/fresnel.h>
#include <wend/transport/boundary_field.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

constexpr MediumId ball_medium = 0;
constexpr int points = 400;
constexpr float ball_ior = 1.5f;
const Vec3 lamp_at(3, 4, 0);

/// A ball of radius 1 under one small lamp.
SceneDescription lit_ball() {
    SceneDescription s;
    EXPECT_EQ(test::add_homogeneous(s, Rgb(1.0f), Rgb(10.0f)), ball_medium);
    test::add_sphere(s, {0, 0, 0}, 1, test::add_dielectric(s, ball_ior), ball_medium);
    const Vec3 to_ball = normalize(-lamp_at);
    const Frame frame = Frame::from_z(to_ball);
    const Vec3 a = frame.s * 0.1f, b = frame.t * 0.1f;
    s.lights.push_back(make_triangle_light(lamp_at, lamp_at + a, lamp_at + b, false, Rgb(100.0f), false));
    Surface lamp{TriangleMesh{{lamp_at, lamp_at + a, lamp_at + b}, {}, {}, {0, 1, 2}}, test::add_diffuse(s, Rgb(0.0f))};
    lamp.first_light = 0;
    s.world_surfaces.push_back(static_cast<int>(s.surfaces.size()));
    s.surfaces.push_back(std::move(lamp));
    return s;
}

std::vector<LitPoint> lit(const Scene& scene, const BoundarySurface& boundary) {
    Pcg32 random(1);
    return lit_points(scene, boundary_points(scene.description(), ball_medium, points, 1), boundary, 64, random);
}

TEST(LitPoints, SeeLampsThroughTheBoundary) {
    const Scene scene(lit_ball());
    int seen = 0;
    for (const LitPoint& p : lit(scene, {ball_ior, 0})) {
        const Vec3 way = lamp_at - p.point.position;
        const Vec3 towards = normalize(way);
        const float cosine = dot(towards, p.point.normal);
        if (cosine < 0.3f) {
            EXPECT_TRUE(p.emitter_count == 0 || cosine > -0.05f);
            continue;
        }
        ++seen;
        ASSERT_EQ(p.emitter_count, 1);
        const BoundaryEmitter& lamp = p.lamps[0];
        // Snell's law, and the lamp's light through the boundary.
        const float inside = safe_sqrt(1 - (1 - sqr(cosine)) / sqr(ball_ior));
        EXPECT_NEAR(lamp.cosine, inside, 0.02f);
        EXPECT_GT(dot(cross(towards, p.point.normal), cross(lamp.lobe.mean, p.point.normal)), -1e-3f);
        const float irradiance = 100 * 0.005f * cosine / length_squared(way);
        const float expected = irradiance * (1 - fresnel_dielectric(cosine, ball_ior)) / inside;
        // A fifth, for what lies behind is certain (boundary_light.cpp).
        EXPECT_NEAR(lamp.fluence, 0.2f * expected, 0.15f * 0.2f * expected);
        EXPECT_GT(lamp.lobe.kappa, 100);
        EXPECT_FLOAT_EQ(lamp.peak, vmf_peak(lamp.lobe.kappa));
        EXPECT_GT(p.irradiance, 0.85f * irradiance);
    }
    EXPECT_GT(seen, points / 4);
}

/// A ball high above the floor, if there is one, in sunlight.
SceneDescription ball_in_the_sun(float reflectance) {
    SceneDescription s;
    EXPECT_EQ(test::add_homogeneous(s, Rgb(1.0f), Rgb(10.0f)), ball_medium);
    test::add_sphere(s, {0, 0, 0}, 1, test::add_interface(s), ball_medium);
    s.lights.push_back(DistantLight{normalize(Vec3(1, 1, 0)), Rgb(2.0f)});
    if (reflectance > 0) {
        test::add_parallelogram(s, {-1e4f, -20, -1e4f}, {0, 0, 2e4f}, {2e4f, 0, 0},
                                test::add_diffuse(s, Rgb(reflectance)));
    }
    return s;
}

TEST(LitPoints, KnowWhatIsReflectedOntoThem) {
    constexpr float reflectance = 0.6f;
    const Scene scene(ball_in_the_sun(reflectance));
    const float reflected = reflectance * 2 * std::sqrt(0.5f);
    double found = 0, expected = 0;
    for (const LitPoint& p : lit(scene, {1, 0})) {
        const Vec3& n = p.point.normal;
        if (n.x + n.y < -0.1f) {
            found += p.irradiance;
            // The floor fills the part of the hemisphere around n that is below the horizon.
            expected += reflected * (1 - n.y) / 2;
        }
    }
    EXPECT_NEAR(found, expected, 0.04 * expected);
}

TEST(LitPoints, ExpectNextToNothingWhereNoLightCanCome) {
    int dark = 0;
    const Scene alone(ball_in_the_sun(0));
    for (const LitPoint& p : lit(alone, {1, 0})) {
        EXPECT_GT(p.irradiance, 0);
        if (p.point.normal.x + p.point.normal.y < -0.1f) {
            EXPECT_LT(p.irradiance, 1e-15f);
            ++dark;
        }
    }
    EXPECT_GT(dark, points / 4);
    // Fog around it scatters light to every side.
    SceneDescription fog = ball_in_the_sun(0);
    fog.camera_medium = test::add_homogeneous(fog, Rgb(0.0f), Rgb(0.1f));
    const Scene hazy(std::move(fog));
    for (const LitPoint& p : lit(hazy, {1, 0})) {
        EXPECT_GT(p.irradiance, 0.005f);
    }
}

TEST(LitPoints, BlurLampsByTheRoughnessOfTheBoundary) {
    const Scene scene(lit_ball());
    const std::vector<LitPoint> smooth = lit(scene, {ball_ior, 0}), rough = lit(scene, {ball_ior, 0.4f});
    for (std::size_t i = 0; i < smooth.size(); ++i) {
        if (smooth[i].emitter_count > 0 && rough[i].emitter_count > 0) {
            EXPECT_LT(rough[i].lamps[0].lobe.kappa, 0.5f * smooth[i].lamps[0].lobe.kappa);
        }
    }
}

TEST(LitPoints, BlurGrazingLampsMost) {
    const Scene scene(lit_ball());
    double straight = 0, grazing = 0;
    int straight_count = 0, grazing_count = 0;
    for (const LitPoint& p : lit(scene, {ball_ior, 0.3f})) {
        const float cosine = dot(normalize(lamp_at - p.point.position), p.point.normal);
        if (cosine > 0.9f) {
            straight += p.lamps[0].lobe.kappa;
            ++straight_count;
        } else if (cosine > 0.3f && cosine < 0.5f && p.emitter_count > 0) {
            grazing += p.lamps[0].lobe.kappa;
            ++grazing_count;
        }
    }
    ASSERT_GT(straight_count, 10);
    ASSERT_GT(grazing_count, 10);
    // Facets that are tilted by t turn the refracted direction by (1 - cos i / (n cos i')) t.
    EXPECT_LT(grazing / grazing_count, 0.6 * straight / straight_count);
}

BoundaryField field_of(const std::vector<LitPoint>& all, float decay = 5) {
    std::vector<BoundaryPoint> on;
    for (const LitPoint& p : all) {
        on.push_back(p.point);
    }
    return {bounds_of(on), all, decay};
}

TEST(BoundaryField, TellsTheClosestBoundaryAndWhereLightComesFrom) {
    const Scene scene(lit_ball());
    const BoundaryField field = field_of(lit(scene, {ball_ior, 0}));
    for (const Vec3& direction : {Vec3(1, 0, 0), normalize(Vec3(1, 1, 1)), normalize(lamp_at), normalize(-lamp_at)}) {
        const BoundaryField::View view = field.at(direction * 0.9f);
        EXPECT_GT(dot(view.closest().normal, direction), 0.97f);
        EXPECT_NEAR(view.lamps(Rgb(1.0f), Rgb(0.0f)).depth, 0.1f, 0.03f);
    }
    EXPECT_GT(dot(field.at(Vec3(0.0f)).incident().normal, normalize(lamp_at)), 0.95f);
    const Vec3 bright = normalize(lamp_at) * 0.9f;
    const Rgb returned(0.1f, 0.2f, 0.3f), decay(1, 2, 4);
    const EmitterView lit_side = field.at(bright).lamps(returned, decay);
    const EmitterView dark_side = field.at(-bright).lamps(returned, decay);
    EXPECT_EQ(lit_side.lamps.size(), 1u);
    EXPECT_EQ(dark_side.lamps.size(), 0u);
    EXPECT_GT(lit_side.diffuse.g, 5 * dark_side.diffuse.g);
    EXPECT_NEAR(lit_side.diffuse.b / lit_side.diffuse.r, 3 * std::exp(-3 * lit_side.depth), 1e-4f);
    const BoundaryField::View view = field.at(bright);
    EXPECT_NEAR(view.closest().steepness, steepness(5, 1, 0.1f), 0.02f);
}

TEST(BoundaryField, KnowsTheNearestOfAllPoints) {
    const Scene scene(lit_ball());
    const std::vector<LitPoint> all = lit(scene, {ball_ior, 0});
    const BoundaryField field = field_of(all);
    Pcg32 random(5);
    for (int k = 0; k < 200; ++k) {
        // Beneath the surface by less than the points are apart: the nearest is next to the place.
        const Vec3 position = to_sphere(random.uniform2()) * (0.9f + 0.1f * random.uniform());
        const Vec3 normal = field.at(position).closest().normal;
        float best = -1;
        for (const LitPoint& p : all) {
            best = std::max(best, dot(p.point.normal, normalize(position)));
        }
        EXPECT_GT(dot(normal, normalize(position)), best - 0.02f) << k;
    }
}

TEST(BoundaryField, TellsTheSameInAnyUnit) {
    const Scene scene(lit_ball());
    const std::vector<LitPoint> all = lit(scene, {ball_ior, 0});
    const BoundaryField field = field_of(all);
    for (const auto& [unit, brightness] : {std::pair(1e6f, 1e-24f), std::pair(1e-6f, 1e20f)}) {
        std::vector<LitPoint> other = all;
        for (LitPoint& p : other) {
            p.point.position *= unit;
            p.irradiance *= brightness;
        }
        const BoundaryField scaled = field_of(other, 5 / unit);
        Pcg32 random(7);
        for (int k = 0; k < 100; ++k) {
            const Vec3 position = to_sphere(random.uniform2()) * 0.95f * random.uniform();
            const InteriorAim aim = field.at(position).incident(), there = scaled.at(position * unit).incident();
            EXPECT_GT(dot(aim.normal, there.normal), 0.9999f) << unit << " " << k;
            EXPECT_NEAR(aim.steepness, there.steepness, 1e-4f) << unit << " " << k;
        }
    }
}

TEST(BoundaryField, TellsTheSameWhoeverAsksFirst) {
    const Scene scene(lit_ball());
    const std::vector<LitPoint> all = lit(scene, {ball_ior, 0});
    const BoundaryField by_many = field_of(all), by_one = field_of(all);
    constexpr std::size_t places = 4000;
    std::vector<InteriorAim> aims(places);
    const auto place = [](std::size_t k) {
        Pcg32 random(k / 4);  // several ask for the same cell
        return to_sphere(random.uniform2()) * random.uniform();
    };
    parallel_for(places, 4, [&](std::size_t k) { aims[k] = by_many.at(place(k)).incident(); });
    for (std::size_t k = places; k-- > 0;) {
        const InteriorAim aim = by_one.at(place(k)).incident();
        EXPECT_EQ(aims[k].normal, aim.normal);
        EXPECT_EQ(aims[k].steepness, aim.steepness);
    }
}

/// -d ln(sinh(decay r) / r) / dr over the decay.
double of_the_fluence_in_a_ball(double decay, double r) {
    const auto logarithm = [&](double x) { return std::log(std::sinh(decay * x) / x); };
    const double h = 1e-4 * r;
    return (logarithm(r + h) - logarithm(r - h)) / (2 * h * decay);
}

TEST(Steepness, IsThatOfTheFluenceInABall) {
    for (const float decay : {0.5f, 3.0f, 20.0f}) {
        for (const float depth : {0.0f, 0.3f, 1.2f, 1.99f}) {
            EXPECT_NEAR(steepness(decay, 0.5f, depth), of_the_fluence_in_a_ball(decay, 2 - depth), 2e-3)
                << decay << " " << depth;
        }
    }
}

TEST(Steepness, IsOneBeneathPlanesAndInHollowsAndNoneInTheMiddle) {
    EXPECT_EQ(steepness(3, 0, 1), 1);
    EXPECT_EQ(steepness(3, -2, 1), 1);
    EXPECT_NEAR(steepness(1e6f, 0.5f, 0), 1, 1e-5f);
    EXPECT_EQ(steepness(3, 0.5f, 2), 0);
    EXPECT_EQ(steepness(3, 0.5f, 5), 0);
    EXPECT_EQ(steepness(3, 0.5f, -1), steepness(3, 0.5f, 0));
}

}  // namespace
}  // namespace wend
