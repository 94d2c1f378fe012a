#include <tests/scene/small_scene.h>
#include <wend/core/random.h>
#include <wend/sampling/warp.h>
#include <wend/scene/curve.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

CurveSet straight(CurveSet::Kind kind, float width0 = 0.5f, float width1 = 0.5f) {
    CurveSegment segment;
    for (int i = 0; i < 4; ++i) {
        segment.points[static_cast<std::size_t>(i)] = Vec3(-1 + 2 * static_cast<float>(i) / 3, 0, 0);
    }
    segment.width = {width0, width1};
    segment.normals = {Vec3(0, 0, 1), Vec3(0, 0, 1)};
    return {kind, 4, {segment}};
}

/// A thick S that comes back close to itself.
CurveSet bent(CurveSet::Kind kind) {
    CurveSegment segment;
    segment.points = {Vec3(-1, 0, 0), Vec3(1.5f, 0.2f, 1.5f), Vec3(-1.5f, 0, -1.5f), Vec3(1, 0, 0)};
    segment.width = {0.3f, 0.1f};
    segment.normals = {Vec3(0, 1, 0), Vec3(0, 0.6f, 0.8f)};
    return {kind, 8, {segment, segment}};
}

Scene scene_of(CurveSet curves) {
    auto description = test::two_materials();
    test::add(description, std::move(curves));
    return Scene(std::move(description));
}

TEST(Curve, FacesEveryRay) {
    const Scene scene = scene_of(straight(CurveSet::Kind::flat, 0.6f, 0.2f));
    Pcg32 random(1);
    int hits = 0, wrong = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 from = to_sphere(random.uniform2()) * 3.0f, to = to_sphere(random.uniform2()) * 0.8f;
        const Vec3 w = normalize(to - from);
        // Where the lines of the ray and the axis are nearest to each other.
        const Vec3 across = cross(w, Vec3(1, 0, 0));
        const float distance = std::abs(dot(from, across)) / length(across);
        const float t = -(from.y * w.y + from.z * w.z) / (w.y * w.y + w.z * w.z);
        const float x = from.x + w.x * t, u = 0.5f + 0.5f * x;
        const float width = 0.6f + (0.2f - 0.6f) * u;
        // Not near an edge.
        if (std::abs(distance - 0.5f * width) < 1e-4f || std::abs(std::abs(x) - 1) < 1e-3f) {
            continue;
        }
        const auto hit = scene.intersect({from, w});
        wrong += hit.has_value() != (distance < 0.5f * width && std::abs(x) < 1);
        if (hit) {
            ++hits;
            EXPECT_NEAR(hit->distance, t, 1e-4f);
            EXPECT_NEAR(hit->uv.x, u, 1e-4f);
            EXPECT_NEAR(std::abs(hit->uv.y - 0.5f), distance / width, 1e-3f);
            EXPECT_NEAR(dot(hit->normal, normalize(w - Vec3(w.x, 0, 0))), 1, 1e-4f);
            EXPECT_NEAR(std::abs(hit->shading.s.x), 1, 1e-4f);
        }
    }
    EXPECT_GT(hits, 2000);
    EXPECT_EQ(wrong, 0);
}

TEST(Curve, CylindersHaveRoundNormals) {
    const Scene scene = scene_of(straight(CurveSet::Kind::cylinder));
    for (const float y : {-0.2f, -0.1f, 0.05f, 0.24f}) {
        const auto hit = scene.intersect({{0.3f, y, 2}, {0, 0, -1}});
        ASSERT_TRUE(hit);
        // As in pbrt, the angle goes with v evenly.
        const float angle = (hit->uv.y - 0.5f) * pi;
        EXPECT_NEAR(std::abs(hit->uv.y - 0.5f), std::abs(y) / 0.5f, 1e-4f);
        EXPECT_NEAR(std::abs(hit->normal.z), std::cos(angle), 1e-4f);
        EXPECT_NEAR(hit->normal.y, std::copysign(std::sin(std::abs(angle)), y), 1e-4f);
    }
}

TEST(Curve, TubesAreMetWhereTheyAre) {
    const Scene scene = scene_of(straight(CurveSet::Kind::round));
    Pcg32 random(4);
    int hits = 0;
    for (int i = 0; i < 5000; ++i) {
        const Vec3 from = to_sphere(random.uniform2()) * 3.0f, to = to_sphere(random.uniform2()) * 0.5f;
        const Vec3 w = normalize(to - from);
        // Those along the axis come in by an end; exact down to 30 degrees.
        if (std::hypot(w.y, w.z) < 0.501f) {
            continue;
        }
        if (const auto hit = scene.intersect({from, w})) {
            ++hits;
            const Vec3 p = hit->position;
            EXPECT_NEAR(std::hypot(p.y, p.z), 0.25f, 1e-4f);
            // Inside, as of all curves.
            EXPECT_LT(length(hit->normal + Vec3(0, p.y, p.z) / 0.25f), 1e-2f);
            EXPECT_FALSE(scene.is_occluded({p, -hit->normal}, 10))
                << "a tube does not shadow what it turns to the light";
        }
    }
    EXPECT_GT(hits, 1000);
}

TEST(Curve, RibbonsLieInTheirPlane) {
    const Scene scene = scene_of(straight(CurveSet::Kind::ribbon));
    Pcg32 random(2);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const float angle = random.uniform() * 2 * pi, y = random.uniform() - 0.5f;
        const Vec3 w(0, std::cos(angle), std::sin(angle));
        if (std::abs(std::abs(y) - 0.25f) < 1e-3f || std::abs(w.z) < 0.01f) {
            continue;
        }
        const auto hit = scene.intersect({Vec3(0.2f, y, 0) - w * 5.0f, w});
        EXPECT_EQ(hit.has_value(), std::abs(y) < 0.25f);
        if (hit) {
            ++hits;
            EXPECT_NEAR(hit->normal.z, 1, 1e-4f);
        }
    }
    EXPECT_GT(hits, 500);
}

TEST(Curve, IsNotMetAgainWhereARayLeavesIt) {
    for (const auto kind :
         {CurveSet::Kind::flat, CurveSet::Kind::cylinder, CurveSet::Kind::ribbon, CurveSet::Kind::round}) {
        const Scene scene = scene_of(bent(kind));
        Pcg32 random(3);
        int hits = 0, at_once = 0, later = 0;
        for (int i = 0; i < 20000; ++i) {
            const Vec3 from = to_sphere(random.uniform2()) * 3.0f, to = to_sphere(random.uniform2()) * 0.8f;
            const TracedRay ray = Ray{from, normalize(to - from)};
            const auto hit = scene.intersect(ray);
            if (!hit) {
                continue;
            }
            ++hits;
            EXPECT_TRUE(is_finite(hit->normal) && is_finite(hit->shading.s) && is_finite(hit->position));
            EXPECT_NEAR(length(hit->normal), 1, 1e-4f);
            EXPECT_GT(hit->thickness, 0);
            const Vec3 w = to_sphere(random.uniform2());
            const TracedRay next = ray.leave(*hit, w);
            if (const auto again = scene.intersect(next)) {
                ++later;
                at_once += again->distance < 0.01f;
                EXPECT_TRUE(scene.is_occluded(next, again->distance * 1.01f));
            }
        }
        EXPECT_GT(hits, 1500);
        EXPECT_LE(at_once, hits / 200);
        EXPECT_GT(later, hits / 200) << "it does not meet its other parts";
        EXPECT_LT(later, hits / 2);
    }
}

TEST(Curve, BoundsHoldAllOfIt) {
    const CurveSet curves = bent(CurveSet::Kind::flat);
    for (std::uint32_t primitive = 0; primitive < curves.primitive_count(); ++primitive) {
        const Box3 box = bounds(curves, primitive);
        for (float w = 0; w <= 1; w += 0.125f) {
            const float u = (static_cast<float>(primitive % curves.pieces) + w) / static_cast<float>(curves.pieces);
            const Vec3 p = curves.segment_of(primitive).at(u);
            EXPECT_TRUE(box.intersects(p + Vec3(0, 0.49f, 0) * curves.segments[0].width_at(u)));
        }
    }
    EXPECT_TRUE(bounds(curves).intersects(bounds(curves, 5)));
}

TEST(Curve, InstancesAreMetInTheirPlace) {
    auto description = test::two_materials();
    description.surfaces.push_back({straight(CurveSet::Kind::flat), 0});
    description.objects.push_back({{0}});
    description.instances.push_back({0, Transform::translate(0, 0, 5) * Transform::scale(2, 2, 2)});
    const Scene scene(std::move(description));
    const TracedRay ray = Ray{{0, 0.4f, 0}, {0, 0, 1}};
    const auto hit = scene.intersect(ray);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 5, 1e-4f);
    EXPECT_NEAR(hit->normal.z, 1, 1e-4f);
    EXPECT_FALSE(scene.intersect({{0, 0.6f, 0}, {0, 0, 1}}));
    EXPECT_FALSE(scene.intersect(ray.leave(*hit, normalize(Vec3(0, -0.3f, -1)))));
}

}  // namespace
}  // namespace wend
