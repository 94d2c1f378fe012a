#include <wend/core/vector.h>
#include <wend/scene/camera.h>
#include <wend/scene/lens_system.h>
#include <wend/stats/moments.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace wend {
namespace {

constexpr double film_radius = 0.0175;
constexpr double focal_length = 0.1;
constexpr double opening = 0.005;

/// A thin lens of glass.
std::vector<LensSurface> thin_lens(double front_opening = opening, double rear_opening = opening) {
    return {{focal_length, 5e-4, 1.5, front_opening}, {-focal_length, 0.1, 1, rear_opening}};
}

/// From the lens to the film, where that is focused on what is at a distance from the film.
double image_distance(double distance) {
    return (distance - std::sqrt(distance * (distance - 4 * focal_length))) / 2;
}

/// Calls f(sample) for uniform points of the lens; nothing for those that are held up.
template <class F>
void for_each_sample(const LensSystem& lenses, const Vec2& film, int side, F&& f) {
    for (int i = 0; i < side * side; ++i) {
        f(lenses.sample(film, {(static_cast<float>(i % side) + 0.5f) / static_cast<float>(side),
                               (static_cast<float>(i / side) + 0.5f) / static_cast<float>(side)}));
    }
}

double irradiance(const LensSystem& lenses, const Vec2& film, int side = 300) {
    double sum = 0;
    for_each_sample(lenses, film, side, [&](const auto& sample) { sum += sample ? double{sample->weight} : 0.0; });
    return sum / (side * side);
}

TEST(LensSystem, WhatIsInFocusIsAPoint) {
    for (const double distance : {0.6, 2.0, 10.0}) {
        // Near the axis a single lens has hardly an error.
        constexpr double small = 0.001;
        const LensSystem lenses(thin_lens(small, small), distance, film_radius);
        EXPECT_NEAR(lenses.back_focus(), image_distance(distance), 1e-3 * focal_length);
        for (const Vec2& film : {Vec2(0, 0), Vec2(4e-4f, 0), Vec2(-2e-4f, 3e-4f)}) {
            Moments x, y, nearer;
            for_each_sample(lenses, film, 40, [&](const auto& sample) {
                if (sample) {
                    const Vec3 w = sample->ray.direction;
                    const auto at = [&](double z) {
                        return sample->ray.origin + w * ((static_cast<float>(z) - sample->ray.origin.z) / w.z);
                    };
                    x.add(double{at(distance).x});
                    y.add(double{at(distance).y});
                    nearer.add(double{at(distance / 2).x});
                }
            });
            // The picture is upside down, and larger by the ratio of the distances.
            const double image = image_distance(distance), scale = -(distance - image) / image;
            EXPECT_NEAR(x.mean(), scale * double{film.x}, 0.01 * std::abs(scale) * 4e-4);
            EXPECT_NEAR(y.mean(), scale * double{film.y}, 0.01 * std::abs(scale) * 4e-4);
            EXPECT_LT(std::sqrt(x.variance()), 0.05 * std::sqrt(nearer.variance())) << distance;
        }
    }
}

TEST(LensSystem, TheMiddleSeesTheLensByItsSolidAngle) {
    for (const double distance : {0.6, 2.0, 30.0}) {
        const LensSystem lenses(thin_lens(), distance, film_radius);
        const double z = lenses.back_focus();
        const double expected = std::numbers::pi * opening * opening / (opening * opening + z * z);
        EXPECT_NEAR(irradiance(lenses, {0, 0}), expected, 0.005 * expected);
    }
}

TEST(LensSystem, OutwardsItGetsDarkerByTheFourthPowerOfTheCosine) {
    const LensSystem lenses(thin_lens(1.5 * opening), 2, film_radius);
    const double middle = irradiance(lenses, {0, 0}), z = lenses.back_focus();
    for (const float r : {0.005f, 0.01f, 0.017f}) {
        const double cosine2 = z * z / (z * z + double{r} * double{r});
        // Whatever the direction from the middle.
        for (const Vec2& film : {Vec2(r, 0), Vec2(-0.6f * r, 0.8f * r)}) {
            EXPECT_NEAR(irradiance(lenses, film), middle * cosine2 * cosine2, 0.005 * middle) << r;
        }
    }
}

TEST(LensSystem, ARingBehindTheLensCutsTheEdge) {
    // A surface of air that is next to flat is a ring. It and the lens are disks as the film sees them.
    constexpr double ring = 0.005, between = 0.03;
    std::vector<LensSurface> surfaces = thin_lens(1.5 * opening);
    surfaces.back().thickness = between;
    surfaces.push_back({1e4, 0.07, 1, ring});
    const LensSystem lenses(surfaces, 2, film_radius);
    const double z = lenses.back_focus(), scale = z / (z + between);
    for (const float r : {0.0f, 0.008f, 0.013f, 0.017f}) {
        // The integral over what both let through in the plane of the ring.
        constexpr int side = 1000;
        const double step = 2 * ring / side;
        double expected = 0, unvignetted = 0;
        for (int i = 0; i < side * side; ++i) {
            const double x = -ring + (i % side + 0.5) * step, y = -ring + (i / side + 0.5) * step;
            const double cosine2 = z * z / (z * z + (x - r) * (x - r) + y * y);
            const double part = cosine2 * cosine2 * step * step / (z * z);
            const bool in_lens = std::hypot(x - r * (1 - scale), y) < opening * scale;
            unvignetted += in_lens ? part : 0;
            expected += in_lens && std::hypot(x, y) < ring ? part : 0;
        }
        EXPECT_NEAR(irradiance(lenses, {0, r}), expected, 0.01 * unvignetted) << r;
        if (r > 0.012f) {
            EXPECT_LT(expected, 0.9 * unvignetted) << "the ring must matter";
        }
    }
}

TEST(LensSystem, AStopLetsThroughWhatItsPictureDoes) {
    std::vector<LensSurface> surfaces = thin_lens(2 * opening);
    surfaces.insert(surfaces.begin() + 2, {0, 0.1, 1, opening / 2});
    surfaces[1].thickness = 0.001;
    surfaces[1].aperture = 2 * opening;
    const LensSystem round(surfaces, 2, film_radius);
    // The upper left quarter of a square alone.
    Image picture(2, 2);
    picture.at(0, 0) = Rgb(1.0f);
    const LensSystem quarter(surfaces, 2, film_radius, picture);
    Moments x, y;
    for_each_sample(quarter, {0, 0}, 200, [&](const auto& sample) {
        if (sample) {
            // Of what is in focus, rays from the upper left of the lens go right and down.
            x.add(double{sample->ray.direction.x});
            y.add(double{sample->ray.direction.y});
        }
    });
    EXPECT_GT(x.mean(), 0);
    EXPECT_LT(y.mean(), 0);
    // All of the square, with the light of a disk.
    const LensSystem square(surfaces, 2, film_radius, Image(64, 64, Rgb(std::numbers::pi_v<float> / 4)));
    EXPECT_NEAR(irradiance(square, {0, 0}), irradiance(round, {0, 0}), 0.02 * irradiance(round, {0, 0}));
}

TEST(LensSystem, RefusesWhatIsNoLens) {
    EXPECT_THROW(LensSystem(thin_lens(), 0.3, film_radius), std::domain_error);
    EXPECT_THROW(LensSystem({{-0.1, 1e-3, 1.5, 0.005}, {0.1, 0.1, 1, 0.005}}, 2, film_radius), std::domain_error);
    EXPECT_THROW(LensSystem({{0.1, 1e-3, 1.5, 1e-9}, {-0.1, 0.1, 1, 1e-9}}, 2, film_radius), std::domain_error);
}

TEST(LensSystem, TheCameraSeesTheWorldUpright) {
    const auto lenses = std::make_shared<const LensSystem>(thin_lens(), 2, film_radius);
    const Camera camera(RealisticCamera{lenses, {0.028f, 0.021f}}, Motion(), 400, 300);
    const CameraRay corner = camera.ray({20, 30}, {0.5f, 0.5f});
    EXPECT_GT(corner.weight, 0);
    EXPECT_LT(corner.direction.x, -0.05f);
    EXPECT_GT(corner.direction.y, 0.05f);
    EXPECT_GT(corner.origin.z, 0.1f) << "before the lenses";
    EXPECT_NEAR(camera.middle().direction.z, 1, 1e-6f);
    // The corner of what is sampled is outside of the round pupil.
    EXPECT_EQ(camera.ray({200, 150}, {0.001f, 0.001f}).weight, 0);
}

}  // namespace
}  // namespace wend
