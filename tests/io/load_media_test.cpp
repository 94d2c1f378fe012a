#include "load_support.h"
#include "near.h"
#include "pbrt_support.h"

#include <wend/io/load/cloud.h>
#include <wend/io/spectrum/blackbody.h>
#include <wend/scene/noise.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

namespace wend {
namespace {

using pbrt::contains;
using pbrt::message_of;
using test::expect_near_in_proportion;
using test::load_text;
using test::warnings_with;

std::string medium_text(const std::string& type, const std::string& parameters) {
    return "MakeNamedMedium \"m\" \"string type\" \"" + type + "\" " + parameters;
}

template <class Kind>
Kind load_one(const std::string& type, const std::string& parameters, const std::string& before = "") {
    return std::get<Kind>(load_text(before + medium_text(type, parameters)).scene.media.at(0));
}

/// Density at a point in the world.
float density_at(const GridMedium& medium, const Vec3& p) {
    const Vec3 q = medium.to_index({p, {0, 0, 1}}).origin;
    return medium.majorants().box().intersects(q) ? medium.density().interpolate(q) : 0.0f;
}

TEST(LoadMedia, Homogeneous) {
    const auto plain = load_one<HomogeneousMedium>("homogeneous", "");
    expect_near_in_proportion(plain.absorption, Rgb(1.0f));
    expect_near_in_proportion(plain.scattering, Rgb(1.0f));
    EXPECT_TRUE(is_black(plain.emission));
    const auto full = load_one<HomogeneousMedium>("homogeneous",
                                                  "\"rgb sigma_a\" [ 1 2 3 ] \"rgb sigma_s\" [ 4 5 6 ] \"float scale\" "
                                                  "2 \"float g\" -0.5 \"rgb Le\" [ 1 1 2 ] \"float Lescale\" 3");
    expect_near_in_proportion(full.absorption, {2, 4, 6});
    expect_near_in_proportion(full.scattering, {8, 10, 12});
    expect_near_in_proportion(full.emission, {6, 12, 36});
    EXPECT_FLOAT_EQ(full.phase.mean_cosine(), -0.5f);
    expect_near_in_proportion(
        load_one<HomogeneousMedium>("homogeneous", "\"string preset\" \"Cream\" \"float scale\" 10").scattering,
        {73.8f, 54.7f, 31.5f});
    const LoadedScene unknown =
        load_text(medium_text("homogeneous", "\"string preset\" \"Gravel\" \"rgb sigma_a\" [ 2 2 2 ]"));
    expect_near_in_proportion(std::get<HomogeneousMedium>(unknown.scene.media.at(0)).absorption, Rgb(2.0f));
    EXPECT_EQ(warnings_with(unknown, "the medium \"Gravel\" is unknown; known are Apple"), 1);
    expect_near_in_proportion(
        load_one<HomogeneousMedium>("homogeneous", "\"spectrum sigma_s\" [ 200 7 900 7 ]").scattering, Rgb(7.0f),
        1e-3f);
    // A spectrum as light has luminance 1.
    EXPECT_NEAR(
        luminance(load_one<HomogeneousMedium>("homogeneous", "\"blackbody Le\" 2000 \"float LeScale\" 5").emission), 5,
        1e-2f);
}

TEST(LoadMedia, PhaseFunctionsByName) {
    const auto phase = [](const std::string& parameters) {
        return load_one<HomogeneousMedium>("homogeneous", parameters).phase;
    };
    const auto same = [](const PhaseFunction& a, const PhaseFunction& b) {
        return a.evaluate(0.9f) == b.evaluate(0.9f) && a.evaluate(-0.2f) == b.evaluate(-0.2f);
    };
    const std::string draine = "\"float g\" 0.4 \"string phase\" \"draine\" ";
    EXPECT_TRUE(same(phase(draine + "\"float alpha\" 30"), PhaseFunction(Draine(0.4f, 30))));
    EXPECT_TRUE(same(phase(draine), PhaseFunction(Draine(0.4f, 1))));
    EXPECT_TRUE(same(phase("\"float g\" 0.4 \"string phase\" \"henyeygreenstein\""), phase("\"float g\" 0.4")));
    EXPECT_TRUE(
        same(load_one<GridMedium>("cloud", draine + "\"float alpha\" 2").phase(), PhaseFunction(Draine(0.4f, 2))));
    EXPECT_EQ(warnings_with(load_text(medium_text("homogeneous", draine + "\"float alpha\" 2")), "alpha"), 0);
    EXPECT_EQ(warnings_with(load_text(medium_text("homogeneous", "\"float alpha\" 2")), "alpha"), 1);
}

TEST(LoadMedia, RefusesWhatIsWrongWithItsPlace) {
    const auto message = [](const std::string& type, const std::string& parameters) {
        return message_of([&] { load_text(medium_text(type, parameters)); });
    };
    EXPECT_PRED2(contains, message("homogeneous", "\"rgb sigma_a\" [ -1 0 0 ]"),
                 "test.pbrt:3:49: error: a colour must be finite and not negative");
    EXPECT_PRED2(contains, message("homogeneous", "\"float g\" 1"),
                 "test.pbrt:3:49: error: \"g\" must lie between -1 and 1");
    EXPECT_PRED2(
        contains, message("homogeneous", "\"string phase\" \"mie\""),
        "test.pbrt:3:49: error: the phase function \"mie\" is unknown; known are cornetteshanks, draine, fog, ");
    EXPECT_PRED2(contains, message("homogeneous", "\"string phase\" \"draine\" \"float alpha\" -1"),
                 "\"alpha\" must lie between 0 and");
    EXPECT_PRED2(contains, message("homogeneous", "\"float scale\" -1"), "\"scale\" must not be below 0");
    EXPECT_PRED2(contains, message("gas", ""), "Medium \"gas\" is unknown; known are cloud");
    EXPECT_PRED2(contains, message("uniformgrid", ""), "\"float density\"");
    EXPECT_PRED2(contains, message("uniformgrid", "\"float density\" [ 1 1 ]"),
                 "\"density\" has 2 values where nx * ny * nz = 1 * 1 * 1");
    EXPECT_PRED2(contains,
                 message("uniformgrid",
                         "\"float density\" [ 1 ] \"integer nx\" 10000 \"integer ny\" 10000 \"integer nz\" 10000"),
                 "10000 * 10000 * 10000");
    EXPECT_PRED2(contains, message("uniformgrid", "\"float density\" [ 1 ] \"integer nx\" -1 \"integer ny\" -1"),
                 "-1 * -1 * 1");
    EXPECT_PRED2(contains, message("uniformgrid", "\"float density\" [ -1 ]"),
                 "voxel (0, 0, 0) holds -1: values must be finite and not negative");
    EXPECT_PRED2(contains, message("uniformgrid", "\"float density\" [ 1 ] \"point3 p1\" [ 1 0 1 ]"), "is empty");
    EXPECT_PRED2(contains,
                 message("uniformgrid", "\"float density\" [ 1 ] \"float temperature\" [ 1 ] \"rgb Le\" [ 1 1 1 ]"),
                 "either");
    EXPECT_PRED2(contains, message("rgbgrid", ""), "needs the parameter");
    EXPECT_PRED2(contains, message("nanovdb", "\"string filename\" \"none-such.nvdb\""), "there is no file");
    EXPECT_PRED2(contains, message("nanovdb", ""), "\"string filename\"");
}

TEST(LoadMedia, PhaseFunctionsByNameAndByTable) {
    const auto phase = [](const std::string& parameters) {
        return load_one<HomogeneousMedium>("homogeneous", "\"string phase\" " + parameters).phase;
    };
    for (const float c : {-0.9f, 0.1f, 0.8f}) {
        EXPECT_FLOAT_EQ(phase("\"rayleigh\"").evaluate(c), Draine(0, 1).evaluate(c));
        EXPECT_FLOAT_EQ(phase("\"cornetteshanks\" \"float g\" 0.6").evaluate(c), Draine(0.6f, 1).evaluate(c));
        HenyeyGreensteinMixture mixture;
        mixture.add(3, 0.8f);
        mixture.add(1, -0.4f);
        EXPECT_FLOAT_EQ(
            phase("\"henyeygreensteinmixture\" \"float g\" [ 0.8 -0.4 ] \"float weights\" [ 3 1 ]").evaluate(c),
            mixture.evaluate(c));
        EXPECT_FLOAT_EQ(phase("\"fog\" \"float diameter\" 9").evaluate(c), fog_droplets(9).evaluate(c));
        EXPECT_FLOAT_EQ(phase("\"fournierforand\" \"float index\" 1.15").evaluate(c),
                        fournier_forand(1.15f, 3.5835f).evaluate(c));
    }
    const std::string table = "\"float angles\" [ 0 60 180 ] \"float values\" [ 4 1 2 ]";
    const PhaseFunction listed = phase("\"tabulated\" " + table);
    EXPECT_FLOAT_EQ(listed.evaluate(1) / listed.evaluate(0.5f), 4);
    EXPECT_FLOAT_EQ(listed.evaluate(-0.25f) / listed.evaluate(0.5f), 1.5f);
    std::ofstream(std::filesystem::temp_directory_path() / "wend_phase.txt") << "# Mie\n0 4\n60 1 # middle\n\n180 2\n";
    EXPECT_FLOAT_EQ(phase("\"tabulated\" \"string file\" \"wend_phase.txt\"").evaluate(0.2f), listed.evaluate(0.2f));
    std::ofstream(std::filesystem::temp_directory_path() / "wend_phase_bad.txt") << "0 4\n60\n";

    const auto refused = [&](const std::string& parameters, const std::string& message) {
        EXPECT_PRED2(contains, message_of([&] { phase(parameters); }), message);
    };
    refused("\"fog\" \"float diameter\" 3", "the diameter of fog droplets must be from 5 to 50");
    refused("\"fournierforand\" \"float slope\" 6", "the slope must be");
    refused("\"tabulated\"", "two at least");
    refused("\"tabulated\" \"float angles\" [ 0 180 ] \"float values\" [ 1 ]", "2 \"angles\", but 1 \"values\"");
    refused("\"tabulated\" \"float angles\" [ 0 90 ] \"float values\" [ 1 1 ]", "must reach from straight on");
    refused("\"tabulated\" \"string file\" \"wend_phase_bad.txt\"", "wend_phase_bad.txt:2:1: error: expected an angle");
    refused("\"tabulated\" \"string file\" \"no_such_phase.txt\"", "no_such_phase.txt");
    refused("\"henyeygreensteinmixture\" \"float g\" [ 1 ] \"float weights\" [ 1 ]", "\"g\" must lie within");
    refused("\"henyeygreensteinmixture\" \"float g\" [ 0 0.1 ] \"float weights\" [ 1 ]", "as many numbers");
}

TEST(LoadMedia, UniformGridSamplesAreInTheMiddleOfTheirCells) {
    const auto medium = load_one<GridMedium>(
        "uniformgrid",
        "\"integer nx\" 2 \"integer ny\" 1 \"integer nz\" 3 \"point3 p0\" [ 2 0 0 ] \"point3 p1\" [ 0 1 6 ] "
        "\"float density\" [ 1 2  3 4  5 6 ] \"rgb sigma_a\" [ 0 0 0 ] \"float scale\" 3");
    expect_near_in_proportion(medium.scattering(), Rgb(3.0f));
    EXPECT_NEAR(density_at(medium, {0.5f, 0.5f, 1}), 1, 1e-5f);
    EXPECT_NEAR(density_at(medium, {1.5f, 0.5f, 1}), 2, 1e-5f);
    EXPECT_NEAR(density_at(medium, {1.5f, 0.5f, 3}), 4, 1e-5f);
    EXPECT_NEAR(density_at(medium, {0.5f, 0.5f, 5}), 5, 1e-5f);
    EXPECT_NEAR(density_at(medium, {1, 0.5f, 1}), 1.5f, 1e-5f);
    // At the faces half of it is left, beyond there is nothing.
    EXPECT_NEAR(density_at(medium, {0, 0.5f, 1}), 0.5f, 1e-5f);
    EXPECT_EQ(density_at(medium, {-0.01f, 0.5f, 1}), 0);
    EXPECT_EQ(density_at(medium, {0.5f, 0.5f, 6.01f}), 0);
}

TEST(LoadMedia, GridsFollowTheirTransform) {
    const auto medium = load_one<GridMedium>("uniformgrid", "\"integer nx\" 2 \"float density\" [ 1 2 ]",
                                             "Translate 10 0 0 Scale 4 1 1 ");
    EXPECT_NEAR(density_at(medium, {11, 0.5f, 0.5f}), 1, 1e-5f);
    EXPECT_NEAR(density_at(medium, {13, 0.5f, 0.5f}), 2, 1e-5f);
    EXPECT_EQ(density_at(medium, {9.9f, 0.5f, 0.5f}), 0);
}

TEST(LoadMedia, GridEmission) {
    const auto scaled = load_one<GridMedium>(
        "uniformgrid", "\"integer nx\" 2 \"float density\" [ 1 1 ] \"rgb Le\" [ 1 2 3 ] \"float Lescale\" [ 0 10 ]");
    ASSERT_TRUE(scaled.emission());
    expect_near_in_proportion(scaled.emission()->at({0.75f, 0.5f, 0.5f}), {10, 20, 30});
    expect_near_in_proportion(scaled.emission()->at({0.25f, 0.5f, 0.5f}), Rgb(0.0f));
    const auto uniform =
        load_one<GridMedium>("uniformgrid", "\"float density\" 1 \"rgb Le\" [ 1 2 3 ] \"float LeScale\" 2");
    expect_near_in_proportion(uniform.emission()->at({0.5f, 0.5f, 0.5f}), {2, 4, 6});
    EXPECT_FALSE(load_one<GridMedium>("uniformgrid", "\"float density\" 1").emission());
    const auto hot =
        load_one<GridMedium>("uniformgrid",
                             "\"integer nx\" 2 \"float density\" [ 1 1 ] \"float temperature\" [ 5 25 ] \"float "
                             "temperatureoffset\" 5 \"float temperaturescale\" 100 \"float Lescale\" 2");
    expect_near_in_proportion(hot.emission()->at({0.75f, 0.5f, 0.5f}), blackbody_emission(2000) * 2.0f, 1e-3f);
    expect_near_in_proportion(hot.emission()->at({0.25f, 0.5f, 0.5f}), Rgb(0.0f));
}

/// Coefficients at a point of the world.
Rgb look_up(const ColourGrid& grid, const GridMedium& medium, const Vec3& p) {
    return grid.interpolate(medium.to_index({p, Vec3(0, 0, 1)}).origin);
}

TEST(LoadMedia, RgbGridHasAColourAtEachVoxel) {
    const auto medium = load_one<GridMedium>(
        "rgbgrid",
        "\"integer nx\" 2 \"rgb sigma_a\" [ 0 0 0  0 1 0 ] \"rgb sigma_s\" [ 1 2 3  3 2 1 ] \"float scale\" 2");
    ASSERT_TRUE(medium.voxels());
    const Vec3 first(0.25f, 0.5f, 0.5f), between(0.5f, 0.5f, 0.5f), face(1, 0.5f, 0.5f);
    expect_near_in_proportion(look_up(medium.voxels()->scattering, medium, first), {2, 4, 6});
    expect_near_in_proportion(look_up(medium.voxels()->scattering, medium, between), Rgb(4.0f));
    expect_near_in_proportion(look_up(medium.voxels()->scattering, medium, face), {3, 2, 1});
    expect_near_in_proportion(look_up(medium.voxels()->absorption, medium, between), {0, 1, 0});
    EXPECT_EQ(density_at(medium, first), 6);
    EXPECT_GE(density_at(medium, between), 5);
    expect_near_in_proportion(medium.scattering(), Rgb(4.0f));
    expect_near_in_proportion(extinction_at(medium, between), {4, 5, 4});
}

TEST(LoadMedia, RgbGridsGlowWithoutAbsorption) {
    const auto medium = load_one<GridMedium>("rgbgrid", "\"rgb sigma_s\" [ 2 1 1 ] \"rgb glow\" [ 1 2 3 ]");
    expect_near_in_proportion(medium.emitted_at({0.5f, 0.5f, 0.5f}), {1, 2, 3});
}

TEST(LoadMedia, RgbGridsEmissionIsNotNormalized) {
    const auto red = load_one<GridMedium>(
        "rgbgrid", "\"rgb sigma_a\" [ 1 0 0 ] \"rgb sigma_s\" [ 2 1 1 ] \"rgb Le\" [ 1 2 3 ] \"float Lescale\" 2");
    const Vec3 middle(0.5f, 0.5f, 0.5f);
    expect_near_in_proportion(red.emission()->at(middle), Rgb(1, 2, 3) * 213.71379f, 1e-2f);
    expect_near_in_proportion(red.emitted_at(middle), {213.71379f, 0, 0}, 1e-2f);
    const auto message = [](const std::string& parameters) {
        return message_of([&] { load_one<GridMedium>("rgbgrid", parameters); });
    };
    EXPECT_PRED2(contains, message("\"rgb sigma_s\" [ 1 1 1 ] \"rgb Le\" [ 1 1 1 ]"), "beside \"rgb Le\"");
    EXPECT_PRED2(contains, message("\"rgb sigma_s\" [ 1 1 1 ] \"float scale\" 1e7"), "mean free paths");
}

TEST(LoadMedia, RgbGridsMissingCoefficientIsOneUpToTheFaces) {
    const auto medium = load_one<GridMedium>("rgbgrid", "\"rgb sigma_s\" [ 2 2 2 ] \"float scale\" 3");
    const Vec3 face(1, 0.5f, 0.5f);
    expect_near_in_proportion(look_up(medium.voxels()->absorption, medium, face), Rgb(3.0f));
    expect_near_in_proportion(look_up(medium.voxels()->scattering, medium, face), Rgb(3.0f));
}

TEST(LoadMedia, TemperaturesWithoutAScaleGlowLessTowardsTheFaces) {
    const auto grid = [](const std::string& scale) {
        return load_one<GridMedium>(
            "uniformgrid",
            "\"integer nx\" 3 \"float density\" [ 1 1 1 ] \"float temperature\" [ 2000 2000 2000 ] "
            "\"point3 p1\" [ 3 1 1 ]" +
                scale,
            "Translate 1 0 0 ");
    };
    const Vec3 middle(2.5f, 0.5f, 0.5f), quarter(1.75f, 0.5f, 0.5f);
    const Rgb full = grid(" \"float Lescale\" 1").emission()->at(middle);
    const auto falling = grid("");
    expect_near_in_proportion(falling.emission()->at(middle), full);
    expect_near_in_proportion(falling.emission()->at(quarter), full * 0.75f);
    const auto scaled = grid(" \"float Lescale\" [ 0 4 0 ]");
    expect_near_in_proportion(scaled.emission()->at(middle), full * 4.0f);
    expect_near_in_proportion(scaled.emission()->at({2, 0.5f, 0.5f}), full * 2.0f);
}

TEST(LoadMedia, CloudFillsItsBoxFromBelow) {
    const auto cloud = load_one<GridMedium>("cloud",
                                            "\"point3 p0\" [ 0 0 0 ] \"point3 p1\" [ 1 1 1 ] \"float density\" 2 "
                                            "\"float g\" 0.8 \"rgb sigma_s\" [ 10 10 10 ]");
    EXPECT_FLOAT_EQ(cloud.phase().mean_cosine(), 0.8f);
    EXPECT_NEAR(density_at(cloud, {0.5f, 0, 0.5f}), 1, 1e-5f);
    EXPECT_NEAR(density_at(cloud, {0.5f, 1, 0.5f}), 0, 1e-5f);
    const CloudShape shape{2, 1, 5};
    for (const Vec3& p : {Vec3(0.25f, 0.5f, 0.75f), Vec3(0.5f, 0.625f, 0.125f)}) {  // points of the grid
        EXPECT_NEAR(density_at(cloud, p), cloud_density(shape, p), 2e-3f);
    }
}

TEST(Cloud, NoiseIsZeroOnTheLatticeSmoothAndWithoutBias) {
    EXPECT_EQ(perlin_noise({3, -7, 12}), 0);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(-100, 100);
    double sum = 0, squares = 0;
    constexpr int count = 100000;
    for (int i = 0; i < count; ++i) {
        const Vec3 p(uniform(random), uniform(random), uniform(random));
        const float n = perlin_noise(p);
        ASSERT_LE(std::abs(n), 1.0f);
        ASSERT_NEAR(n, perlin_noise(p + Vec3(1e-3f, 0, 0)), 4e-3f);
        sum += static_cast<double>(n);
        squares += static_cast<double>(n) * static_cast<double>(n);
    }
    EXPECT_NEAR(sum / count, 0, 0.01);
    EXPECT_GT(squares / count, 0.03);
    // Continuous across the lattice's faces, and finite however far away.
    EXPECT_NEAR(perlin_noise({1 - 1e-4f, 0.3f, 0.6f}), perlin_noise({1 + 1e-4f, 0.3f, 0.6f}), 1e-3f);
    EXPECT_EQ(perlin_noise(Vec3(1e30f)), 0);
}

}  // namespace
}  // namespace wend
