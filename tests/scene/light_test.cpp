#include "small_lights.h"

#include <tests/sampling/verdicts.h>
#include <tests/scene/small_scene.h>
#include <tests/support/chi_square_sphere.h>
#include <wend/core/vector.h>
#include <wend/sampling/warp.h>
#include <wend/scene/light.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace wend {
namespace {

using test::quadric_light;
using test::radiance;

/// A place without any symmetry: three different scales and a turn.
Transform awkward_place() {
    return Transform::translate(0.5, -0.3, 2.5) * Transform::rotate(40, 1, 2, 3) * Transform::scale(1.5, 0.5, 0.8);
}

/// Irradiance at p on a facet with normal n.
Moments irradiance(const Light& light, const Vec3& p, const Vec3& n, int samples = 2000000) {
    Moments moments;
    Pcg32 random(1);
    for (int i = 0; i < samples; ++i) {
        const auto s = sample_light(light, p, random.uniform2(), random);
        moments.add(s ? s->radiance.g * std::max(0.0f, dot(n, s->direction)) / s->density : 0);
    }
    return moments;
}

TEST(PointLights, IrradianceFallsWithTheSquare) {
    const Moments e = irradiance(PointLight{{0, 0, 2}, Rgb(8)}, {0, 0, 0}, {0, 0, 1}, 10);
    EXPECT_NEAR(e.mean(), 2, 1e-6);
    EXPECT_EQ(e.variance(), 0);
    Pcg32 random(1);
    EXPECT_FALSE(sample_light(PointLight{{0, 0, 2}, Rgb(8)}, {0, 0, 2}, {0.5f, 0.5f}, random));
    const auto distant = sample_light(DistantLight{{0, 1, 0}, Rgb(3)}, {5, 5, 5}, {0.5f, 0.5f}, random);
    ASSERT_TRUE(distant);
    EXPECT_EQ(distant->distance, infinity);
    EXPECT_EQ(distant->radiance, Rgb(3));
    EXPECT_TRUE(distant->point_like);
}

TEST(SphereLights, IrradianceIsKnown) {
    // pi L (r/d)² on a facet that faces the whole sphere, from near and far.
    const Light light = quadric_light(Sphere{}, Transform());
    for (const float d : {1.5f, 2.0f, 50.0f}) {
        EXPECT_TRUE(test::is_within_one_percent(irradiance(light, {0, 0, -d}, {0, 0, 1}), pi * radiance.g / (d * d)))
            << d;
    }
}

TEST(SphereLights, InsideATwoSidedSphereEverythingShines) {
    const Light light = quadric_light(Sphere{}, Transform(), true);
    EXPECT_TRUE(test::is_within_one_percent(irradiance(light, {0.3f, -0.4f, 0.2f}, {0, 0, 1}), pi * radiance.g));
    const Light one_sided = quadric_light(Sphere{}, Transform());
    EXPECT_EQ(irradiance(one_sided, {0.3f, -0.4f, 0.2f}, {0, 0, 1}, 100).mean(), 0);
    const Light flipped = quadric_light(Sphere{}, Transform(), false, true);
    EXPECT_TRUE(test::is_within_one_percent(irradiance(flipped, {0.3f, -0.4f, 0.2f}, {0, 0, 1}), pi * radiance.g));
}

TEST(DiskLights, IrradianceIsKnown) {
    const Light light = quadric_light(Disk{3, 1.5f, 0}, Transform(), true);
    const double expected = pi * radiance.g * 2.25 / (2.25 + 9);
    EXPECT_TRUE(test::is_within_one_percent(irradiance(light, {0, 0, 0}, {0, 0, 1}), expected));
    const Light annulus = quadric_light(Disk{3, 1.5f, 0.5f, pi}, Transform(), true);
    EXPECT_TRUE(test::is_within_one_percent(irradiance(annulus, {0, 0, 0}, {0, 0, 1}),
                                            0.5 * (expected - pi * radiance.g * 0.25 / 9.25)));
}

TEST(DiskLights, ShineAlongTheirNormal) {
    // +z by itself, the other way when flipped or mirrored back and forth.
    EXPECT_EQ(irradiance(quadric_light(Disk{3, 1.5f, 0}, Transform()), {0, 0, 0}, {0, 0, 1}, 100).mean(), 0);
    EXPECT_GT(irradiance(quadric_light(Disk{3, 1.5f, 0}, Transform(), false, true), {0, 0, 0}, {0, 0, 1}, 100).mean(),
              0);
    EXPECT_GT(irradiance(quadric_light(Disk{3, 1.5f, 0}, Transform()), {0, 0, 5}, {0, 0, -1}, 100).mean(), 0);
}

/// Irradiance by quadrature over the points of a stretched sphere or part of one, seen from the given point.
double irradiance_by_area(const Sphere& sphere, const Transform& place, const Vec3& p, const Vec3& n, bool two_sided,
                          bool flip = false) {
    constexpr int steps = 1000;
    double sum = 0;
    const double z_low = std::max(sphere.z_min, -sphere.radius), z_high = std::min(sphere.z_max, sphere.radius);
    for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < steps; ++j) {
            const double z = z_low + (i + 0.5) / steps * (z_high - z_low), phi = (j + 0.5) / steps * sphere.phi_max;
            const double r = std::sqrt(sphere.radius * sphere.radius - z * z);
            const Vec3 q(static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)),
                         static_cast<float>(z));
            const Vec3 du = place.vector(Vec3(-q.y, q.x, 0));
            const Vec3 dv = place.vector(
                Vec3(static_cast<float>(-z / r * std::cos(phi)), static_cast<float>(-z / r * std::sin(phi)), 1));
            const Vec3 area = cross(du, dv), d = place.point(q) - p;
            const double facing = -dot(area, d) * (place.swaps_handedness() != flip ? -1 : 1);
            const double d2 = length_squared(d);
            sum += (two_sided ? std::abs(facing) : std::max(0.0, facing)) * std::max(0.0f, dot(n, d)) / (d2 * d2);
        }
    }
    return radiance.g * sum * (z_high - z_low) * sphere.phi_max / (static_cast<double>(steps) * steps);
}

TEST(SphereLights, StretchedAndCutOnesAgreeWithQuadrature) {
    const Vec3 p(0.2f, 0.1f, 0), n = normalize(Vec3(0.1f, -0.2f, 1));
    const Transform mirrored = awkward_place() * Transform::scale(-1, 1, 1);
    const Sphere cut{1, -0.4f, 0.7f, 4};
    for (const Transform& place : {awkward_place(), mirrored}) {
        EXPECT_TRUE(test::is_within_one_percent(irradiance(quadric_light(Sphere{}, place), p, n),
                                                irradiance_by_area(Sphere{}, place, p, n, false), 1e-4));
        EXPECT_TRUE(test::is_within_one_percent(irradiance(quadric_light(cut, place, false, true), p, n),
                                                irradiance_by_area(cut, place, p, n, false, true), 1e-4));
        EXPECT_TRUE(test::is_within_one_percent(irradiance(quadric_light(cut, place, true), p, n),
                                                irradiance_by_area(cut, place, p, n, true), 1e-4));
    }
}

/// Lambert's formula for a polygon above the horizon.
double irradiance_of_triangle(const std::array<Vec3, 3>& corners, const Vec3& p, const Vec3& n) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 a = normalize(corners[i] - p), b = normalize(corners[(i + 1) % 3] - p);
        sum += std::acos(std::clamp(dot(a, b), -1.0f, 1.0f)) * dot(normalize(cross(a, b)), n);
    }
    return 0.5 * std::abs(sum) * radiance.g;
}

TEST(TriangleLights, IrradianceIsKnown) {
    const std::array<Vec3, 3> t = {Vec3(-1, 0.5f, 2), Vec3(1.5f, -0.2f, 1), Vec3(0.3f, 1.5f, 3)};
    const Vec3 p(0.1f, 0.2f, -0.3f), n(0, 0, 1);
    const double expected = irradiance_of_triangle(t, p, n);
    EXPECT_TRUE(test::is_within_one_percent(
        irradiance(make_triangle_light(t[0], t[1], t[2], false, radiance, true), p, n), expected));
    // One-sided ones shine along cross(p1 - p0, p2 - p0), or against it.
    const bool faces = dot(cross(t[1] - t[0], t[2] - t[0]), p - t[0]) > 0;
    const auto one_sided = [&](bool flip) {
        return irradiance(make_triangle_light(t[0], t[1], t[2], flip, radiance, false), p, n);
    };
    EXPECT_TRUE(test::is_within_one_percent(one_sided(!faces), expected));
    EXPECT_EQ(one_sided(faces).mean(), 0);
    EXPECT_FALSE(agrees(one_sided(!faces), 1.01 * expected, 4));
}

TEST(InfiniteLights, UniformIrradianceIsPi) {
    EXPECT_TRUE(
        test::is_within_one_percent(irradiance(UniformInfiniteLight{radiance}, Vec3(0), {0, 1, 0}), pi * radiance.g));
}

/// A point of a light and its normal there.
struct SurfacePoint {
    Vec3 position, normal;
};

/// Where a ray meets the shining side of a quadric light.
std::vector<SurfacePoint> shining_hits(const Light& light, const Vec3& p, const Vec3& w) {
    const auto& l = std::get<QuadricLight>(light);
    const Vec3 origin = l.quadric->object_from_world.point(p), direction = l.quadric->object_from_world.vector(w);
    std::vector<SurfacePoint> points;
    for (const auto& crossing : crossings(*l.quadric, origin, direction)) {
        if (!(crossing.t > 0)) {
            continue;
        }
        const auto point = project(*l.quadric, origin + direction * crossing.t);
        const Vec3 normal = normalize(l.quadric->object_from_world.transposed_vector(point.normal)) * l.flip;
        if (!is_black(emitted_radiance(light, normal, {0, 0}, -w))) {
            points.push_back({l.quadric->world_from_object.point(point.position), normal});
        }
    }
    return points;
}

/// Density of a direction: that of each point where its ray meets the shining side.
double direction_density(const Light& light, const Vec3& p, const Vec3& w) {
    double sum = 0;
    for (const SurfacePoint& hit : shining_hits(light, p, w)) {
        sum += light_density(light, p, w, hit.position, hit.normal);
    }
    return sum;
}

test::SphereTestOptions coarse() {
    test::SphereTestOptions options;
    options.samples = 100000;
    options.cosine_cells = 10;
    options.azimuth_cells = 16;
    return options;
}

test::SphereTest direction_test(const Light& light, const Vec3& p, const test::DirectionDensity& density) {
    return test::chi_square_sphere(
        [&](Pcg32& random) -> std::optional<Vec3> {
            const auto s = sample_light(light, p, random.uniform2(), random);
            return s ? std::optional(s->direction) : std::nullopt;
        },
        density, coarse());
}

/// Whether directions from a light's sampler follow its density, over a flat grid around the direction `middle`: fine
/// midpoints cope with the light's edges, where the density jumps, to better than 1 %.
testing::AssertionResult directions_follow(const Light& light, const Vec3& p, const Vec3& middle,
                                           const test::DirectionDensity& density) {
    constexpr int samples = 100000, cells = 24, points = 20;
    constexpr float half_width = 2.5f, cell = 2 * half_width / cells;
    const Frame frame = Frame::from_z(normalize(middle));
    std::vector<std::uint64_t> observed(cells * cells + 1);
    Pcg32 random(1);
    for (int i = 0; i < samples; ++i) {
        const auto s = sample_light(light, p, random.uniform2(), random);
        const Vec3 w = s ? frame.to_local(s->direction) : Vec3(0);
        const Vec2 q = w.z > 0 ? Vec2(w.x / w.z + half_width, w.y / w.z + half_width) / cell : Vec2(-1);
        const bool inside = q.x >= 0 && q.y >= 0 && q.x < cells && q.y < cells;
        ++(inside ? observed[static_cast<std::size_t>(static_cast<int>(q.y) * cells + static_cast<int>(q.x))]
                  : observed.back());
    }
    std::vector<double> expected;
    double total = 0;
    for (int i = 0; i < cells * cells; ++i) {
        double sum = 0;
        for (int k = 0; k < points * points; ++k) {
            const float x =
                (static_cast<float>(i % cells) + (static_cast<float>(k % points) + 0.5f) / points) * cell - half_width;
            const float y =
                (static_cast<float>(i / cells) + (static_cast<float>(k / points) + 0.5f) / points) * cell - half_width;
            const double d2 = 1 + x * x + y * y;
            sum += density(frame.to_world(normalize(Vec3(x, y, 1)))) / (d2 * std::sqrt(d2));
        }
        // A corner of the light that falls between the points is not impossible.
        expected.push_back(samples * sum * sqr(cell / points) + 0.01);
        total += expected.back();
    }
    const double inside = samples - static_cast<double>(observed.back());
    if (std::abs(total - inside) > 0.01 * inside) {
        return testing::AssertionFailure() << inside << " samples where " << total << " are expected";
    }
    for (double& count : expected) {
        count *= inside / total;
    }
    observed.pop_back();
    const double p_value = chi_square_test(observed, expected).p_value;
    return (p_value >= test::passing ? testing::AssertionSuccess() : testing::AssertionFailure()) << "p = " << p_value;
}

TEST(QuadricLights, SampledDirectionsFollowTheDensity) {
    const Vec3 outside(0.2f, 0.1f, 0.5f), middle = Vec3(0.5f, -0.3f, 2.5f) - outside;
    const Light disk = quadric_light(Disk{0.2f, 1.5f, 0.3f, 5}, awkward_place(), true);
    const auto density = [&](const Vec3& w) { return direction_density(disk, outside, w); };
    EXPECT_TRUE(directions_follow(disk, outside, middle, density));
    EXPECT_FALSE(directions_follow(disk, outside, middle, [&](const Vec3& w) { return 1.03 * density(w); }));
    EXPECT_FALSE(directions_follow(disk, outside, middle, [&](const Vec3& w) { return (1 + 0.2 * w.x) * density(w); }));
    const Vec3 inside(0.6f, -0.3f, 2.6f);
    const Light around = quadric_light(Sphere{}, awkward_place(), true);
    EXPECT_TRUE(test::follows_density(
        direction_test(around, inside, [&](const Vec3& w) { return direction_density(around, inside, w); }),
        "light_inside"));
}

/// Towards the silhouette of a sphere the density grows without bound, which no quadrature of counts copes with; but
/// its inverse integrates to the solid angle.
TEST(QuadricLights, InverseDensityMeasuresSolidAngle) {
    const Vec3 p(0.2f, 0.1f, 0.5f);
    const Frame frame = Frame::from_z(normalize(Vec3(0.5f, -0.3f, 2.5f) - p));
    for (const Light& light :
         {quadric_light(Sphere{}, awkward_place()), quadric_light(Sphere{1, -0.4f, 0.7f, 4}, awkward_place(), true),
          quadric_light(Sphere{1, -0.4f, 0.7f, 4}, awkward_place(), false, true)}) {
        std::array<double, 3> solid_angle{};
        constexpr int n = 700;
        constexpr float half_width = 2.5f, cell = 2 * half_width / n;
        for (int i = 0; i < n * n; ++i) {
            const float x = (static_cast<float>(i % n) + 0.5f) * cell - half_width,
                        y = (static_cast<float>(i / n) + 0.5f) * cell - half_width;
            const Vec3 local = normalize(Vec3(x, y, 1));
            const double size =
                sqr(cell) * local.z * local.z * local.z * shining_hits(light, p, frame.to_world(local)).size();
            solid_angle[0] += size;
            solid_angle[1] += size * (1 + local.x);
            solid_angle[2] += size * (1 + local.y);
        }
        std::array<Moments, 3> measured;
        Pcg32 random(1);
        for (int i = 0; i < 1000000; ++i) {
            const auto s = sample_light(light, p, random.uniform2(), random);
            const Vec3 local = s ? frame.to_local(s->direction) : Vec3(0);
            const double size = s ? 1 / s->density : 0;
            measured[0].add(size);
            measured[1].add(size * (1 + local.x));
            measured[2].add(size * (1 + local.y));
        }
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_TRUE(test::is_within_one_percent(measured[k], solid_angle[k], 1e-3)) << k;
        }
    }
}

TEST(QuadricLights, ADensityThatIgnoresTheStretchIsRejected) {
    const Light light = quadric_light(Sphere{}, awkward_place(), true);
    const auto& l = std::get<QuadricLight>(light);
    const Vec3 p(0.6f, -0.3f, 2.6f);
    const auto wrong = [&](const Vec3& w) {
        const Vec3 origin = l.quadric->object_from_world.point(p), direction = l.quadric->object_from_world.vector(w);
        const Vec3 stretched = direction / length(direction);
        const float t = *test::first_crossing(*l.quadric, origin, stretched);
        return t * t / (4 * pi * std::abs(dot(origin + stretched * t, stretched)));
    };
    EXPECT_LT(direction_test(light, p, wrong).result.p_value, test::failing);
}

TEST(AreaLights, SampleReportsTheDensityOfItsPoint) {
    Pcg32 random(2);
    const Vec3 p(0.2f, 0.1f, 0);
    for (const Light& light :
         {quadric_light(Sphere{}, awkward_place()), quadric_light(Sphere{1, -0.4f, 0.7f, 4}, awkward_place(), true),
          quadric_light(Disk{0.2f, 1.5f, 0.3f}, awkward_place(), true)}) {
        const Quadric& quadric = *std::get<QuadricLight>(light).quadric;
        for (int i = 0; i < 2000; ++i) {
            if (const auto s = sample_light(light, p, random.uniform2(), random)) {
                const Vec3 hit = p + s->direction * s->distance;
                const auto point = project(quadric, quadric.object_from_world.point(hit));
                const Vec3 normal = normalize(quadric.object_from_world.transposed_vector(point.normal));
                if (abs_dot(normal, s->direction) > 0.02f) {
                    EXPECT_NEAR(light_density(light, p, s->direction, hit, normal), s->density, 2e-3f * s->density);
                }
            }
        }
    }
    const Light triangle = make_triangle_light({-1, 0.5f, 2}, {1.5f, -0.2f, 1}, {0.3f, 1.5f, 3}, false, radiance, true);
    const Vec3 normal = std::get<TriangleLight>(triangle).normal;
    for (int i = 0; i < 2000; ++i) {
        const auto s = sample_light(triangle, p, random.uniform2(), random);
        ASSERT_TRUE(s);
        EXPECT_NEAR(light_density(triangle, p, s->direction, p + s->direction * s->distance, normal), s->density,
                    1e-4f * s->density);
    }
}

TEST(EqualAreaMap, RoundTrips) {
    Pcg32 random(3);
    for (int i = 0; i < 20000; ++i) {
        const Vec3 w = to_sphere(random.uniform2());
        EXPECT_LT(length(equal_area_square_to_sphere(equal_area_sphere_to_square(w)) - w), 1e-3f) << w;
        const Vec2 p = random.uniform2();
        EXPECT_LT((equal_area_sphere_to_square(equal_area_square_to_sphere(p)) - p).length(), 1e-3f) << p;
    }
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
        EXPECT_LT(length(equal_area_square_to_sphere(equal_area_sphere_to_square(axis)) - axis), 1e-5f);
        EXPECT_LT(length(equal_area_square_to_sphere(equal_area_sphere_to_square(-axis)) + axis), 1e-5f);
    }
}

TEST(EqualAreaMap, PreservesArea) {
    EXPECT_TRUE(test::follows_density(test::chi_square_sphere([](Vec2 u) { return equal_area_square_to_sphere(u); },
                                                              [](const Vec3&) { return inv_4pi; }),
                                      "equal_area"));
    test::Uniformity back;
    Pcg32 random(4);
    for (int i = 0; i < 100000; ++i) {
        back.add(equal_area_sphere_to_square(to_sphere(random.uniform2())));
    }
    EXPECT_GE(back.p_value(), test::passing);
}

ImageInfiniteLight image_light(std::uint64_t seed) {
    Image image(4, 4);
    Pcg32 random(seed);
    for (Rgb& pixel : image.pixels) {
        pixel = Rgb(random.uniform(), random.uniform(), random.uniform() < 0.3f ? 9.0f : 0.1f);
    }
    return ImageInfiniteLight(image, 2, Transform::rotate(70, 1, -1, 2));
}

TEST(ImageInfiniteLights, SamplesFollowTheDensity) {
    const Light light = image_light(5), other = image_light(6);
    const auto density = [](const Light& l) {
        return [&l](const Vec3& w) { return light_density(l, Vec3(0), w, Vec3(0), Vec3(0)); };
    };
    EXPECT_TRUE(test::follows_density(direction_test(light, Vec3(0), density(light)), "image_light"));
    EXPECT_LT(direction_test(light, Vec3(0), density(other)).result.p_value, test::failing);
}

TEST(ImageInfiniteLights, SamplesAgreeWithTheRadianceOfTheirDirection) {
    const ImageInfiniteLight image = image_light(5);
    const Light light = image;
    Pcg32 random(7);
    Moments fluence;
    for (int i = 0; i < 1500000; ++i) {
        const auto s = sample_light(light, Vec3(0), random.uniform2(), random);
        ASSERT_TRUE(s);
        EXPECT_EQ(s->radiance, environment_radiance(light, Vec3(0), s->direction));
        EXPECT_EQ(s->density, light_density(light, Vec3(0), s->direction, Vec3(0), Vec3(0)));
        fluence.add(s->radiance.r / s->density);
    }
    EXPECT_TRUE(test::is_within_one_percent(fluence, 4 * pi * image.mean_radiance().r, 1e-4));
}

TEST(LightPower, OfASphereIsItsRadiantExitanceTimesArea) {
    EXPECT_NEAR(light_power(quadric_light(Sphere{2, -2, 2}, Transform()), 0), pi * 16 * pi * mean(radiance), 1e-2);
    EXPECT_NEAR(light_power(PointLight{{}, Rgb(3)}, 0), 12 * pi, 1e-4);
}

}  // namespace
}  // namespace wend
