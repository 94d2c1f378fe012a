#include <tests/medium/smooth_medium.h>
#include <wend/medium/medium.h>

#include <gtest/gtest.h>

namespace wend {
namespace {

TEST(Medium, AlbedoIsScatteringOverExtinction) {
    const Rgb expected(0.75f, 0, 0);
    const Rgb absorption(1, 2, 0), scattering(3, 0, 0);
    EXPECT_EQ(albedo(HomogeneousMedium{absorption, scattering, Rgb(0), PhaseFunction()}), expected);
    EXPECT_EQ(albedo(test::smooth_medium(absorption, scattering)), expected);
}

TEST(Medium, IndexRayKeepsWorldDistances) {
    const GridMedium medium = test::smooth_medium(Rgb(1), Rgb(1));
    const Ray ray = test::ray_through_smooth_medium();
    const Vec3 p = test::index_from_world().point(ray.at(1.7f));
    EXPECT_LT(length(medium.to_index(ray).at(1.7f) - p), 1e-4f);
}

TEST(Medium, PhaseFunctionIsThatOfEitherKind) {
    const PhaseFunction phase(HenyeyGreenstein{0.4f});
    EXPECT_EQ(phase_function(HomogeneousMedium{Rgb(1), Rgb(1), Rgb(0), phase}).mean_cosine(), 0.4f);
    EXPECT_EQ(phase_function(test::smooth_medium(Rgb(1), Rgb(1))).mean_cosine(), 0.0f);
}

std::shared_ptr<const Grid> constant_grid(float value) {
    return std::make_shared<Grid>(
        Vec3i(0), Vec3i(4), [](const Vec3i&, const Vec3i&) { return true; }, [value](int, int, int) { return value; });
}

TEST(GridEmission, ScalesByItsField) {
    const Vec3 inside(1, 1, 1), outside(9, 9, 9);
    GridEmission emission;
    emission.radiance = Rgb(1, 2, 3);
    EXPECT_EQ(emission.at(outside), emission.radiance);
    emission.field = constant_grid(0.5f);
    emission.field_from_world = AffineMap(Transform());
    EXPECT_EQ(emission.at(inside), emission.radiance * 0.5f);
    EXPECT_EQ(emission.at(outside), Rgb(0));
}

TEST(GridEmission, InterpolatesTheBlackBodyTable) {
    GridEmission emission;
    emission.radiance = Rgb(2);
    emission.field = constant_grid(150);
    emission.field_from_world = AffineMap(Transform());
    for (int i = 0; i < 60; ++i) {
        emission.black_body.push_back(Rgb(static_cast<float>(i * i), static_cast<float>(i), 1));
    }
    const Vec3 p(1, 1, 1);
    EXPECT_EQ(emission.at(p), Rgb(2 * 225.0f, 2 * 15.0f, 2));
    // (150 - 48) * 2 = 204 K, between the entries at 200 K and 210 K.
    emission.temperature_offset = 48;
    emission.temperature_scale = 2;
    EXPECT_NEAR(emission.at(p).g, 2 * 20.4f, 1e-4f);
    EXPECT_NEAR(emission.at(p).r, 2 * (0.6f * 400 + 0.4f * 441), 1e-2f);
    // Beyond the table its end counts, and below 100 K nothing.
    emission.temperature_scale = 1000;
    EXPECT_NEAR(emission.at(p).g, 2 * 59.0f, 1e-2f);
    emission.temperature_scale = 0.9f;
    EXPECT_EQ(emission.at(p), Rgb(0));
}

std::shared_ptr<GridEmission> glow_of_temperatures(float kelvin) {
    auto glow = std::make_shared<GridEmission>();
    glow->is_apart = true;
    glow->radiance = Rgb(1);
    glow->field = constant_grid(kelvin);
    glow->field_from_world = AffineMap(Transform());
    glow->black_body = {Rgb(0.25f), Rgb(1, 2, 3), Rgb(5, 6, 7)};
    glow->black_body_step = 1000;
    return glow;
}

TEST(GridEmission, WhatShinesApartDoesSoWhereNothingIsHotOrDense) {
    const Vec3 inside(1, 1, 1), outside(9, 9, 9);
    const auto cold = glow_of_temperatures(50), hot = glow_of_temperatures(1500);
    EXPECT_EQ(cold->at(inside), Rgb(0.25f)) << "its table begins below 100 K";
    EXPECT_EQ(hot->at(outside), Rgb(0.25f));
    EXPECT_LT(max_value(hot->at(inside) - Rgb(3, 4, 5)), 1e-5f);
    EXPECT_GT(min_value(hot->at(inside) - Rgb(3, 4, 5)), -1e-5f);

    // Neither absorption nor density is in what is emitted; of a medium that shines by absorbing, both are.
    const auto plain = std::make_shared<GridEmission>(*hot);
    plain->is_apart = false;
    const Box3 box(Vec3(0), Vec3(3));
    const auto medium = [&](std::shared_ptr<const GridEmission> emission) {
        return GridMedium(constant_grid(0.5f), Transform(), box, Rgb(0.2f), Rgb(1), PhaseFunction(),
                          std::move(emission));
    };
    EXPECT_EQ(medium(hot).emitted_at(inside), hot->at(inside));
    EXPECT_EQ(medium(plain).emitted_at(inside), Rgb(0.2f) * plain->at(inside) * 0.5f);
    // Only what absorbs is dark where there is nothing to absorb.
    const auto clear = [&](std::shared_ptr<const GridEmission> emission) {
        return GridMedium(constant_grid(0.5f), Transform(), box, Rgb(0), Rgb(1), PhaseFunction(), std::move(emission));
    };
    EXPECT_NE(clear(hot).glow(), nullptr);
    EXPECT_EQ(clear(plain).glow(), nullptr);
}

}  // namespace
}  // namespace wend
