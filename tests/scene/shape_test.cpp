#include <tests/scene/small_scene.h>
#include <wend/core/random.h>
#include <wend/core/vector.h>
#include <wend/sampling/warp.h>
#include <wend/scene/shape.h>

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

namespace wend {
namespace {

using Shape3 = std::variant<Sphere, Disk>;

/// How far a point of the full surface is inside the part that is there, in shares of the radius; negative outside.
double margin(const Sphere& s, double x, double y, double z) {
    double phi = std::atan2(y, x);
    phi += phi < 0 ? 2 * M_PI : 0;
    double m = 1;
    m = s.z_min > -s.radius ? std::min(m, (z - s.z_min) / s.radius) : m;
    m = s.z_max < s.radius ? std::min(m, (s.z_max - z) / s.radius) : m;
    return s.phi_max < 6.28 ? std::min({m, s.phi_max - phi, phi}) : m;
}

double margin(const Disk& s, double x, double y, double) {
    double phi = std::atan2(y, x);
    phi += phi < 0 ? 2 * M_PI : 0;
    const double r = std::hypot(x, y);
    const double m = std::min((s.radius - r) / s.radius, s.inner_radius > 0 ? (r - s.inner_radius) / s.radius : 1.0);
    return s.phi_max < 6.28 ? std::min({m, s.phi_max - phi, phi}) : m;
}

/// Distances to the whole sphere or plane, in double precision.
std::vector<double> crossings(const Sphere& s, const Vec3& o, const Vec3& d) {
    const Imath::V3d origin(o), direction(d);
    const double a = direction.dot(direction), b = origin.dot(direction),
                 c = origin.dot(origin) - static_cast<double>(s.radius) * s.radius;
    const double discriminant = b * b - a * c;
    if (discriminant < 0) {
        return {};
    }
    return {(-b - std::sqrt(discriminant)) / a, (-b + std::sqrt(discriminant)) / a};
}

std::vector<double> crossings(const Disk& s, const Vec3& o, const Vec3& d) {
    return {(static_cast<double>(s.height) - o.z) / d.z};
}

const Shape3 parts_of_quadrics[] = {Sphere{},
                                    Sphere{2, -0.5f, 1.2f, 4},
                                    Sphere{0.01f, -0.01f, 0.004f},
                                    Sphere{1, -1, 1, 1.5f},
                                    Disk{0.5f, 1.5f},
                                    Disk{-1, 2, 0.7f, 5},
                                    Disk{0, 100, 20}};

TEST(Quadric, HitsAgreeWithDoublePrecision) {
    Pcg32 random(1);
    int hits = 0;
    for (const Shape3& shape : parts_of_quadrics) {
        const Quadric quadric(shape, Transform());
        const float size = std::visit([](const auto& s) { return s.radius; }, shape);
        for (int i = 0; i < 20000; ++i) {
            const Vec3 origin = to_sphere(random.uniform2()) * (3 * size * random.uniform());
            const Vec3 aim = to_sphere(random.uniform2()) * (size * random.uniform());
            const Vec3 direction = (aim - origin) * (0.1f + 2 * random.uniform());
            const auto nearest = std::visit(
                [&](const auto& s) -> std::optional<double> {
                    for (const double t : crossings(s, origin, direction)) {
                        const double x = origin.x + t * direction.x, y = origin.y + t * direction.y,
                                     z = origin.z + t * direction.z;
                        const double m = margin(s, x, y, z);
                        if (t > -1e-3 && (std::abs(m) < 1e-3 || std::abs(t) < 1e-3)) {
                            return -1;  // too close to an edge to tell
                        }
                        if (t > 0 && m > 0) {
                            return t;
                        }
                    }
                    return std::nullopt;
                },
                shape);
            if (nearest && *nearest < 0) {
                continue;
            }
            const std::optional<float> hit = test::first_crossing(quadric, origin, direction);
            ASSERT_EQ(hit.has_value(), nearest.has_value()) << origin << direction;
            if (hit) {
                ++hits;
                // A grazing ray's distance is worse conditioned than its point.
                ASSERT_NEAR(*hit, *nearest, 2e-3 * (1 + *nearest));
                for (const auto& crossing : crossings(quadric, origin, direction)) {
                    ASSERT_TRUE(crossing.t <= 0 || crossing.t >= *hit);
                }
            }
        }
    }
    EXPECT_GT(hits, 30000);
}

TEST(Quadric, AFarOriginKeepsItsPrecision) {
    const Quadric sphere(Sphere{}, Transform());
    const std::optional<float> hit = test::first_crossing(sphere, {0.5f, 0, -10000}, {0, 0, 1});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(*hit, 10000 - std::sqrt(0.75f), 2e-3f);
    EXPECT_FALSE(test::first_crossing(sphere, {1.001f, 0, -10000}, {0, 0, 1}));
}

TEST(Quadric, ParametersRunFromZeroToOne) {
    const Quadric sphere(Sphere{}, Transform());
    // u is the azimuth from +x, v grows from -z in pbrt's convention of theta from z_min to z_max.
    EXPECT_NEAR(parameters(sphere, {0, 1, 0}).x, 0.25f, 1e-6f);
    EXPECT_NEAR(parameters(sphere, {0, 1, 0}).y, 0.5f, 1e-6f);
    EXPECT_NEAR(parameters(sphere, {0, 0, 1}).y, 1, 1e-3f);
    EXPECT_NEAR(parameters(sphere, {0, 0, -1}).y, 0, 1e-3f);
    const Quadric disk(Disk{0, 2, 1}, Transform());
    EXPECT_NEAR(parameters(disk, {-1.25f, 0, 0}).x, 0.5f, 1e-6f);
    EXPECT_NEAR(parameters(disk, {-1.25f, 0, 0}).y, 0.75f, 1e-6f);
}

TEST(Quadric, ProjectionLiesOnTheSurfaceWithItsNormalAndTangent) {
    Pcg32 random(2);
    const Quadric sphere(Sphere{2, -2, 2}, Transform()), disk(Disk{0.5f, 1}, Transform());
    for (int i = 0; i < 100; ++i) {
        const QuadricPoint on = project(sphere, to_sphere(random.uniform2()) * 2.001f);
        EXPECT_NEAR(length(on.position), 2, 1e-5f);
        EXPECT_GT(dot(on.normal, on.position), 0);
        EXPECT_NEAR(dot(on.dpdu, on.normal), 0, 1e-5f);
    }
    EXPECT_EQ(project(disk, {0.1f, 0.2f, 0.6f}).position, Vec3(0.1f, 0.2f, 0.5f));
    EXPECT_EQ(project(disk, {0.1f, 0.2f, 0.6f}).normal, Vec3(0, 0, 1));
}

TEST(Quadric, BoundsHoldTheShape) {
    const Transform place =
        Transform::translate(1, 2, 3) * Transform::rotate(50, 1, 1, 0) * Transform::scale(1, 4, 0.5);
    const Quadric quadric(Sphere{}, place);
    const Box3 box = bounds(quadric);
    Pcg32 random(3);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 p = quadric.world_from_object.point(to_sphere(random.uniform2()));
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_GE(p[axis], box.min[axis] - 1e-5f);
            EXPECT_LE(p[axis], box.max[axis] + 1e-5f);
        }
    }
}

}  // namespace
}  // namespace wend
