#include "load_support.h"
#include "near.h"
#include "pbrt_support.h"

#include <wend/io/image_file.h>
#include <wend/medium/fresnel.h>
#include <wend/planar/albedo_inversion.h>
#include <wend/scene/bsdf/rough_coat.h>
#include <wend/scene/noise.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <vector>

namespace wend {
namespace {

using pbrt::contains;
using pbrt::message_of;
using test::expect_near;
using test::load_text;
using test::warnings_with;

/// The material of the only shape.
struct Loaded {
    LoadedScene scene;

    explicit Loaded(const std::string& world,
                    const std::filesystem::path& directory = std::filesystem::temp_directory_path(),
                    const std::string& options = "")
        : scene(load_text(world + " Shape \"sphere\"", options, {}, directory)) {}

    template <class Kind>
    const Kind& as() const {
        return std::get<Kind>(scene.scene.materials.at(static_cast<std::size_t>(scene.scene.surfaces.at(0).material)));
    }
    const SurfaceDetail& detail() const {
        return scene.scene.details.at(static_cast<std::size_t>(scene.scene.surfaces.at(0).material));
    }
    Rgb value(TextureId id, const Vec2& uv = {0.5f, 0.5f}, const Vec3& p = {0, 0, 0}) const {
        return scene.scene.textures.evaluate(id, {uv, p});
    }
    Rgb reflectance(const Vec2& uv = {0.5f, 0.5f}, const Vec3& p = {0, 0, 0}) const {
        return value(as<DiffuseMaterial>().reflectance, uv, p);
    }
};

TEST(LoadMaterials, Diffuse) {
    expect_near(Loaded("").reflectance(), Rgb(0.5f));
    expect_near(Loaded("Material \"diffuse\" \"rgb reflectance\" [ 0.1 0.2 0.3 ]").reflectance(), {0.1f, 0.2f, 0.3f});
    expect_near(Loaded("Material \"diffuse\" \"spectrum reflectance\" [ 200 0.2 900 0.2 ]").reflectance(), Rgb(0.2f),
                1e-3f);
    expect_near(
        Loaded("MakeNamedMaterial \"m\" \"string type\" \"diffuse\" \"rgb reflectance\" [ 1 0 0 ] NamedMaterial \"m\"")
            .reflectance(),
        {1, 0, 0});
}

TEST(LoadMaterials, SpectraBelowZeroAreZeroThere) {
    expect_near(Loaded("Material \"diffuse\" \"spectrum reflectance\" [ 200 -.1 300 0 900 0 ]").reflectance(),
                Rgb(0.0f));
    expect_near(Loaded("Material \"diffuse\" \"spectrum reflectance\" [ 200 -.1 201 .4 900 .4 ]").reflectance(),
                Rgb(0.4f), 1e-3f);
}

TEST(LoadMaterials, BlackBodiesReflect) {
    // A peak of 1, in the near infrared: more red than blue, and no more than 1.
    const Rgb colour = Loaded("Material \"diffuse\" \"blackbody reflectance\" 4000").reflectance();
    EXPECT_LE(colour.r, 1);
    EXPECT_GT(colour.r, 0.9f);
    EXPECT_GT(colour.g, 0.7f);
    EXPECT_LT(colour.b, 0.6f);
}

TEST(LoadMaterials, ColourSpaces) {
    // White stays white, and a primary of the wider space is clamped to the narrower one's.
    for (const std::string space : {"rec2020", "dci-p3", "aces2065-1"}) {
        expect_near(Loaded("ColorSpace \"" + space + "\" Material \"diffuse\" \"rgb reflectance\" [ 0.5 0.5 0.5 ]")
                        .reflectance(),
                    Rgb(0.5f));
        const Rgb green =
            Loaded("ColorSpace \"" + space + "\" Material \"diffuse\" \"rgb reflectance\" [ 0 0.5 0 ]").reflectance();
        EXPECT_EQ(green.r, 0) << space;
        EXPECT_GT(green.g, 0.5f) << space;
    }
}

TEST(LoadMaterials, SpectrumFiles) {
    const auto directory = std::filesystem::temp_directory_path();
    std::ofstream(directory / "wend_load.spd") << "# grey\n300 0.25\n900 0.25 # the end\n";
    std::ofstream(directory / "wend_broken.spd") << "300 0.25\n900 x\n";
    expect_near(Loaded("Material \"diffuse\" \"spectrum reflectance\" \"wend_load.spd\"").reflectance(), Rgb(0.25f),
                1e-3f);
    EXPECT_PRED2(contains,
                 message_of([] { Loaded("Material \"diffuse\" \"spectrum reflectance\" \"wend_broken.spd\""); }),
                 "wend_broken.spd:2:1: error: expected a number");
    EXPECT_PRED2(contains, message_of([] { Loaded("Material \"diffuse\" \"spectrum reflectance\" \"metal-Xx\""); }),
                 "test.pbrt:3:20: error: \"metal-Xx\" is neither");
    EXPECT_PRED2(contains, message_of([] { Loaded("Material \"diffuse\" \"rgb reflectance\" [ -1 0 0 ]"); }),
                 "not negative");
}

TEST(LoadMaterials, Conductors) {
    const Loaded copper("Material \"conductor\"");
    EXPECT_LT(copper.as<ConductorMaterial>().reflectance, 0);
    EXPECT_GT(copper.value(copper.as<ConductorMaterial>().k).r, 2);
    EXPECT_TRUE(copper.as<ConductorMaterial>().roughness.remap);
    const Loaded silver(
        "Material \"conductor\" \"spectrum eta\" \"metal-Ag-eta\" \"spectrum k\" \"metal-Ag-k\" \"float roughness\" "
        "0.2 \"float vroughness\" 0.4 \"bool remaproughness\" false");
    EXPECT_LT(silver.value(silver.as<ConductorMaterial>().eta).g, 0.3f);
    EXPECT_FLOAT_EQ(silver.value(silver.as<ConductorMaterial>().roughness.u).r, 0.2f);
    EXPECT_FLOAT_EQ(silver.value(silver.as<ConductorMaterial>().roughness.v).r, 0.4f);
    EXPECT_FALSE(silver.as<ConductorMaterial>().roughness.remap);
    const Loaded grey("Material \"conductor\" \"rgb reflectance\" [ 0.8 0.8 0.8 ]");
    expect_near(grey.value(grey.as<ConductorMaterial>().reflectance), Rgb(0.8f));
    EXPECT_PRED2(contains,
                 message_of([] { Loaded("Material \"conductor\" \"rgb reflectance\" [ 1 1 1 ] \"rgb k\" [ 1 1 1 ]"); }),
                 "either");
    EXPECT_EQ(grey.as<ConductorMaterial>().tint, -1);
    const Loaded tinted("Material \"conductor\" \"rgb tint\" [ 0.9 0.6 0.3 ]");
    expect_near(tinted.value(tinted.as<ConductorMaterial>().tint), Rgb(0.9f, 0.6f, 0.3f));
}

TEST(LoadMaterials, Dielectrics) {
    EXPECT_FLOAT_EQ(Loaded("Material \"dielectric\"").as<DielectricMaterial>().ior, 1.5f);
    EXPECT_FLOAT_EQ(Loaded("Material \"dielectric\" \"float eta\" 1.33").as<DielectricMaterial>().ior, 1.33f);
    EXPECT_NEAR(Loaded("Material \"dielectric\" \"spectrum eta\" \"glass-BK7\"").as<DielectricMaterial>().ior, 1.5168f,
                1e-3f);
    EXPECT_NEAR(Loaded("Material \"dielectric\" \"spectrum eta\" [ 300 1.4 900 1.4 ]").as<DielectricMaterial>().ior,
                1.4f, 1e-3f);
    EXPECT_NEAR(Loaded("Material \"dielectric\" \"rgb eta\" [ 1.5 1.5 1.5 ]").as<DielectricMaterial>().ior, 1.5f,
                1e-5f);
    EXPECT_PRED2(contains, message_of([] { Loaded("Material \"dielectric\" \"float eta\" -1"); }), "refractive index");
    EXPECT_FALSE(Loaded("Material \"dielectric\"").as<DielectricMaterial>().is_antireflective);
    EXPECT_TRUE(
        Loaded("Material \"dielectric\" \"bool antireflective\" true").as<DielectricMaterial>().is_antireflective);
    const Loaded none("Material \"dielectric\" \"float eta\" 0");
    EXPECT_EQ(none.as<DielectricMaterial>().ior, 1);
    EXPECT_EQ(warnings_with(none.scene, "a refractive index of 0 is taken for 1"), 1);
}

TEST(LoadMaterials, Coats) {
    const Loaded loaded(
        "Material \"coateddiffuse\" \"rgb reflectance\" [ 0.1 0.2 0.3 ] \"float roughness\" 0.1 \"float thickness\" "
        "0.1 \"rgb albedo\" [ 0.5 0.5 0.5 ] \"integer nsamples\" 4 \"float g\" 0.2");
    const auto& material = loaded.as<CoatedMaterial>();
    expect_near(loaded.value(std::get<DiffuseMaterial>(material.base).reflectance), {0.1f, 0.2f, 0.3f});
    const float alpha = std::sqrt(0.1f);
    EXPECT_FLOAT_EQ(material.returned, rough_coat_return({1.5f, alpha, alpha}, 0.1f));
    EXPECT_NEAR(coat_return(1.5f, 0), fresnel_diffuse_reflectance(1 / 1.5f), 2e-4f);
    EXPECT_EQ(material.walks, 4);
    EXPECT_EQ(material.max_depth, 10);
    EXPECT_TRUE(loaded.scene.warnings.empty());

    const Loaded metal(
        "Material \"coatedconductor\" \"float interface.roughness\" 0.1 \"float conductor.roughness\" 0.2 \"rgb "
        "conductor.eta\" [ 3 3 3 ] \"rgb conductor.k\" [ 6 6 6 ] \"float interface.eta\" 1.5");
    EXPECT_TRUE(metal.scene.warnings.empty());
    const Bsdf bsdf = make_bsdf(metal.scene.scene.materials.back(), metal.scene.scene.textures, {});
    expect_near(std::get<ConductorBsdf>(std::get<CoatedBsdf>(bsdf).base).k, Rgb(4.0f));
    EXPECT_FLOAT_EQ(std::get<CoatedBsdf>(bsdf).coat.alpha_x, std::sqrt(0.1f));
    EXPECT_PRED2(contains, message_of([] { Loaded("Material \"coateddiffuse\" \"integer maxdepth\" 0"); }),
                 "\"maxdepth\" must be from 1");
}

TEST(LoadMaterials, RoughnessMayExceedOne) {
    const Loaded rough("Material \"conductor\" \"float roughness\" 2.5 \"bool remaproughness\" false");
    const Bsdf bsdf = make_bsdf(rough.scene.scene.materials.back(), rough.scene.scene.textures, {});
    EXPECT_FLOAT_EQ(std::get<ConductorBsdf>(bsdf).alpha_x, 2.5f);
}

TEST(LoadMaterials, Hair) {
    const auto absorption = [](const std::string& parameters) {
        const Loaded loaded("Material \"hair\" " + parameters);
        const auto& hair = loaded.as<HairMaterial>();
        return hair.colour >= 0 ? loaded.value(hair.colour) : Rgb(loaded.value(hair.eumelanin).r);
    };
    expect_near(absorption(""), Rgb(1.3f));
    expect_near(absorption("\"float eumelanin\" 0.4"), Rgb(0.4f));
    expect_near(absorption("\"rgb sigma_a\" [ 1 2 3 ]"), {1, 2, 3});
    expect_near(absorption("\"rgb reflectance\" [ 0.1 0.2 0.3 ]"), {0.1f, 0.2f, 0.3f});
    EXPECT_EQ(warnings_with(Loaded("Material \"hair\" \"rgb sigma_a\" [ 1 2 3 ] \"rgb color\" [ 1 1 1 ]").scene,
                            "\"color\" of a hair is ignored"),
              1);
}

TEST(LoadMaterials, AHairOfNoIndexIsRefused) {
    EXPECT_PRED2(contains, message_of([] { Loaded("Material \"hair\" \"float eta\" 0.5"); }), "index of a hair");
}

TEST(LoadMaterials, Mixtures) {
    const std::string parts =
        "MakeNamedMaterial \"red\" \"string type\" \"diffuse\" \"rgb reflectance\" [ 1 0 0 ] "
        "MakeNamedMaterial \"glass\" \"string type\" \"dielectric\" "
        "MakeNamedMaterial \"none\" \"string type\" \"interface\" ";
    const auto mixed = [&](const std::string& parameters) {
        return Loaded(parts + "Material \"mix\" \"string materials\" " + parameters);
    };
    const Loaded loaded = mixed("[ \"red\" \"glass\" ] \"float amount\" 0.3");
    EXPECT_TRUE(loaded.scene.warnings.empty());
    const SceneDescription& scene = loaded.scene.scene;
    int glass = 0;
    constexpr int points = 20000;
    Pcg32 random(1);
    for (int i = 0; i < points; ++i) {
        const TexturePoint p{{0, 0}, to_sphere(random.uniform2())};
        const MaterialPart at =
            material_at(scene.materials, static_cast<int>(scene.materials.size()) - 1, scene.textures, p);
        EXPECT_EQ(at.count, 1.0f);
        glass +=
            std::holds_alternative<DielectricMaterial>(scene.materials[static_cast<std::size_t>(at.index)]) ? 1 : 0;
    }
    EXPECT_NEAR(glass / static_cast<double>(points), 0.3, 0.015);
    // Two of them are one, also deep inside.
    EXPECT_NO_THROW(mixed("[ \"none\" \"none\" ]").as<InterfaceMaterial>());
    const Loaded nested(
        parts +
        "MakeNamedMaterial \"nothing\" \"string type\" \"mix\" \"string materials\" [ \"none\" \"none\" ] "
        "Material \"mix\" \"string materials\" [ \"nothing\" \"glass\" ]");
    EXPECT_EQ(nested.as<MixMaterial>().first, nested.as<MixMaterial>().second);
    EXPECT_PRED2(contains, message_of([&] { mixed("[ \"red\" ]"); }), "two \"materials\"");
    EXPECT_PRED2(contains, message_of([&] { mixed("[ \"red\" \"blue\" ]"); }), "\"blue\" is not defined");
}

TEST(LoadMaterials, PartsOfSumsCountByTheInverseOfTheirProbability) {
    const std::string parts =
        "MakeNamedMaterial \"red\" \"string type\" \"diffuse\" \"rgb reflectance\" [ 1 0 0 ] "
        "MakeNamedMaterial \"glass\" \"string type\" \"dielectric\" "
        "MakeNamedMaterial \"none\" \"string type\" \"interface\" ";
    const auto added = [&](const std::string& parameters) {
        return Loaded(parts + "Material \"sum\" \"string materials\" " + parameters);
    };
    // Of each the mean count is 1; also where the amount would leave one out.
    for (const auto& [amount, tolerance] : {std::pair(0.3, 0.04), {0.0, 0.5}}) {
        const Loaded loaded = added("[ \"red\" \"glass\" ] \"float amount\" " + std::to_string(amount));
        EXPECT_TRUE(loaded.scene.warnings.empty());
        const SceneDescription& scene = loaded.scene.scene;
        double red = 0, glass = 0;
        constexpr int points = 20000;
        Pcg32 random(1);
        for (int i = 0; i < points; ++i) {
            const TexturePoint p{{0, 0}, to_sphere(random.uniform2())};
            const MaterialPart at =
                material_at(scene.materials, static_cast<int>(scene.materials.size()) - 1, scene.textures, p);
            const auto& material = scene.materials[static_cast<std::size_t>(at.index)];
            (std::holds_alternative<DielectricMaterial>(material) ? glass : red) += double{at.count} / points;
        }
        EXPECT_NEAR(red, 1, tolerance);
        EXPECT_NEAR(glass, 1, tolerance);
    }
    const Loaded left = added("[ \"none\" \"red\" ]");
    EXPECT_EQ(warnings_with(left.scene, "an \"interface\" in a sum is left out"), 1);
    EXPECT_NO_THROW(left.as<DiffuseMaterial>());
    EXPECT_PRED2(contains, message_of([&] { added("[ \"red\" ]"); }), "\"sum\" needs the names of two");
}

TEST(LoadMaterials, MixturesWithAnInterfaceAreThereByChance) {
    const std::string parts =
        "MakeNamedMaterial \"red\" \"string type\" \"diffuse\" \"rgb reflectance\" [ 1 0 0 ] "
        "MakeNamedMaterial \"none\" \"string type\" \"interface\" ";
    const auto presence = [&](const std::string& parameters, const std::string& of_shape = "") {
        const LoadedScene loaded =
            load_text(parts + "Material \"mix\" \"string materials\" " + parameters + " Shape \"sphere\" " + of_shape);
        EXPECT_EQ(warnings_with(loaded, "a mixture lets its share of an \"interface\" pass"), 1);
        const Surface& surface = loaded.scene.surfaces.at(0);
        const auto& mix = std::get<MixMaterial>(loaded.scene.materials[static_cast<std::size_t>(surface.material)]);
        EXPECT_EQ(mix.first, mix.second);
        return loaded.scene.textures.evaluate(surface.alpha, {{0.25f, 0.25f}, {0, 0, 0}}).r;
    };
    EXPECT_FLOAT_EQ(presence("[ \"none\" \"red\" ] \"float amount\" 0.3"), 0.3f);
    EXPECT_FLOAT_EQ(presence("[ \"red\" \"none\" ] \"float amount\" 0.3"), 0.7f);
    EXPECT_FLOAT_EQ(presence("[ \"red\" \"none\" ] \"float amount\" 0.3", "\"float alpha\" 0.5"), 0.35f);
    const std::string outer =
        "MakeNamedMaterial \"holed\" \"string type\" \"mix\" \"string materials\" [ \"red\" \"none\" ] "
        "Material \"mix\" \"string materials\" [ \"holed\" \"red\" ] Shape \"sphere\"";
    EXPECT_EQ(warnings_with(load_text(parts + outer), "within a mixture of mixtures"), 1);
}

TEST(LoadMaterials, BumpsAndNormalMaps) {
    const std::string bumps = "Texture \"bumps\" \"float\" \"checkerboard\" \"float tex1\" 1 \"float tex2\" 0 ";
    EXPECT_GE(Loaded(bumps + "Material \"diffuse\" \"texture displacement\" \"bumps\"").detail().displacement, 0);
    // A shift is no bump.
    EXPECT_TRUE(Loaded("Material \"diffuse\" \"float displacement\" 2").detail().is_none());
    EXPECT_PRED2(contains, message_of([] { Loaded("Material \"diffuse\" \"string normalmap\" \"no.png\""); }),
                 "no.png");
}

TEST(LoadMaterials, AllDiffuse) {
    const Loaded loaded("Material \"conductor\" \"rgb reflectance\" [ 0.3 0.5 0.7 ]",
                        std::filesystem::temp_directory_path(), "Option \"forcediffuse\" true ");
    const Rgb colour = loaded.reflectance();
    EXPECT_GT(colour.r, 0.3f);
    EXPECT_LT(colour.r, 0.4f);
    EXPECT_TRUE(loaded.scene.warnings.empty());
}

TEST(LoadMaterials, InterfacesInAllTheirNames) {
    for (const std::string name : {"interface", "none", ""}) {
        EXPECT_NO_THROW(Loaded("Material \"" + name + "\"").as<InterfaceMaterial>());
    }
}

TEST(LoadMaterials, SubsurfaceIsAMediumBehindADielectric) {
    const auto inside = [](const std::string& parameters) {
        const Loaded loaded("Material \"subsurface\" " + parameters);
        EXPECT_FLOAT_EQ(loaded.as<DielectricMaterial>().ior, 1.33f);
        const Surface& surface = loaded.scene.scene.surfaces.at(0);
        EXPECT_EQ(surface.exterior, vacuum);
        const auto medium =
            std::get<HomogeneousMedium>(loaded.scene.scene.media.at(static_cast<std::size_t>(surface.interior)));
        EXPECT_FALSE(medium.counts_vertices);
        return medium;
    };
    expect_near(inside("").scattering, {2.55f, 3.21f, 3.77f});
    expect_near(inside("\"string name\" \"Skin1\" \"float scale\" 10").absorption, {0.32f, 1.7f, 4.8f});
    const auto given = inside("\"rgb sigma_a\" [ 1 2 3 ] \"rgb sigma_s\" [ 4 5 6 ] \"float scale\" 2 \"float g\" 0.5");
    expect_near(given.absorption, {2, 4, 6});
    expect_near(given.scattering, {8, 10, 12});
    EXPECT_FLOAT_EQ(given.phase.mean_cosine(), 0.5f);
    const auto coloured = inside("\"rgb reflectance\" [ 0 0.5 1 ] \"rgb mfp\" [ 2 2 2 ]");
    expect_near(coloured.extinction(), Rgb(0.5f));
    EXPECT_NEAR(coloured.scattering.r, 0, 1e-4f);
    EXPECT_NEAR(coloured.scattering.g, 0.5f * AlbedoInversion(0, 1.33)(0.5f), 1e-5f);
    EXPECT_NEAR(coloured.scattering.b, 0.5f, 1e-4f);
    EXPECT_PRED2(contains, message_of([&] { inside("\"rgb sigma_a\" [ 1 1 1 ]"); }), "both");
    EXPECT_PRED2(contains, message_of([&] { inside("\"string name\" \"Gravel\""); }), "known are Apple");
    EXPECT_PRED2(contains, message_of([&] { inside("\"float g\" 1"); }), "\"g\" must lie between");
}

TEST(LoadMaterials, SubsurfaceColoursMayVary) {
    const std::string board =
        "Texture \"board\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [ 0.8 0.5 0.1 ] \"rgb tex2\" [ 0.2 0.5 0 ] "
        "Texture \"plain\" \"spectrum\" \"constant\" \"rgb value\" [ 0.8 0.5 0.1 ] ";
    const Loaded loaded(board +
                        "Material \"subsurface\" \"texture reflectance\" \"board\" \"float eta\" 1.4 \"float g\" 0.6 "
                        "\"rgb mfp\" [ 2 4 8 ]");
    EXPECT_EQ(loaded.scene.warnings.size(), 1u);
    EXPECT_EQ(warnings_with(loaded.scene, "the diffusion that pbrt takes for it is up to 10 % off"), 1);
    // The squares of a sphere's parameters are all even ones; the mean is that of the unit square, even as well.
    const AlbedoInversion albedo_of(0.6, 1.4);
    const auto& medium = std::get<HomogeneousMedium>(loaded.scene.scene.media.at(0));
    expect_near(medium.extinction(), {0.5f, 0.25f, 0.125f});
    expect_near(medium.scattering / medium.extinction(), {albedo_of(0.8f), albedo_of(0.5f), albedo_of(0.1f)});
    const TextureId relative = loaded.as<DielectricMaterial>().relative_albedo;
    ASSERT_GE(relative, 0);
    expect_near(loaded.value(relative, {0.5f, 0.5f}), Rgb(1.0f));
    expect_near(loaded.value(relative, {1.5f, 0.5f}), {albedo_of(0.2f) / albedo_of(0.8f), 1, 0});

    // What does not vary has nothing to tell; what cannot is named.
    EXPECT_LT(Loaded(board + "Material \"subsurface\" \"texture reflectance\" \"plain\"")
                  .as<DielectricMaterial>()
                  .relative_albedo,
              0);
    const Loaded radius(board + "Material \"subsurface\" \"texture reflectance\" \"board\" \"texture mfp\" \"board\"");
    EXPECT_EQ(warnings_with(radius.scene, "mean of the texture \"mfp\""), 1);
}

TEST(LoadMaterials, WhatCannotBeIsRefused) {
    EXPECT_PRED2(contains, message_of([] { Loaded("Material \"measured\" \"string filename\" \"none.bsdf\""); }),
                 "test.pbrt:3:21: error: there is no file");
    EXPECT_PRED2(contains, message_of([] { Loaded("Material \"measured\""); }), "needs the parameter");
    EXPECT_PRED2(contains, message_of([] { Loaded("Material \"plaid\""); }), "known are");
    for (const char* huge :
         {"\"rgb eta\" [ 1 1 1e20 ]", "\"spectrum k\" [ 300 1e20 800 1 ]", "\"rgb k\" [ 3e6 1 1 ]"}) {
        EXPECT_PRED2(contains, message_of([&] { Loaded(std::string("Material \"conductor\" ") + huge); }),
                     "of a metal must not be above 1e+06");
    }
    EXPECT_PRED2(contains, message_of([] {
                     Loaded("MakeNamedMaterial \"m\" \"string type\" \"mix\" \"string materials\" [ \"m\" \"m\" ]");
                 }),
                 "made of itself");
    EXPECT_PRED2(contains, message_of([] { Loaded("Material \"mix\" \"string materials\" [ \"a\" \"b\" ]"); }),
                 "not defined");
}

TEST(LoadTextures, ConstantScaleAndMix) {
    const std::string textures =
        "Texture \"half\" \"float\" \"constant\" \"float value\" 0.5 "
        "Texture \"colour\" \"spectrum\" \"constant\" \"rgb value\" [ 0.2 0.4 0.8 ] "
        "Texture \"scaled\" \"spectrum\" \"scale\" \"texture tex\" \"colour\" \"texture scale\" \"half\" "
        "Texture \"mixed\" \"spectrum\" \"mix\" \"texture tex1\" \"colour\" \"rgb tex2\" [ 1 1 1 ] \"float amount\" "
        "0.25 ";
    expect_near(Loaded(textures + "Material \"diffuse\" \"texture reflectance\" \"scaled\"").reflectance(),
                {0.1f, 0.2f, 0.4f});
    expect_near(Loaded(textures + "Material \"diffuse\" \"texture reflectance\" \"mixed\"").reflectance(),
                {0.4f, 0.55f, 0.85f});
    EXPECT_PRED2(contains,
                 message_of([&] { Loaded(textures + "Material \"diffuse\" \"texture reflectance\" \"half\""); }),
                 "the texture \"half\" is not one of kind spectrum");
}

TEST(LoadTextures, Checkerboards) {
    const std::string board = "\"rgb tex1\" [ 1 0 0 ] \"rgb tex2\" [ 0 0 1 ] ";
    const Loaded flat("Texture \"b\" \"spectrum\" \"checkerboard\" \"float uscale\" 2 \"float vscale\" 2 " + board +
                      "Material \"diffuse\" \"texture reflectance\" \"b\"");
    expect_near(flat.reflectance({0.25f, 0.25f}), {1, 0, 0});
    expect_near(flat.reflectance({0.75f, 0.25f}), {0, 0, 1});
    const Loaded solid("Translate 0 0 1 Texture \"b\" \"spectrum\" \"checkerboard\" \"integer dimension\" 3 " + board +
                       "Material \"diffuse\" \"texture reflectance\" \"b\"");
    expect_near(solid.reflectance({0, 0}, {0.5f, 0.5f, 1.5f}), {1, 0, 0});
    expect_near(solid.reflectance({0, 0}, {0.5f, 0.5f, 0.5f}), {0, 0, 1});
    EXPECT_PRED2(contains,
                 message_of([] { Loaded("Texture \"b\" \"spectrum\" \"checkerboard\" \"integer dimension\" 4"); }),
                 "2 or 3");
}

TEST(LoadTextures, Pictures) {
    const auto directory = std::filesystem::temp_directory_path();
    Picture picture;
    picture.image = Image(2, 2);
    picture.full_size = {2, 2};
    picture.image.pixels = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5f, 0.5f, 0.5f}};
    write_picture(directory / "wend_load_texture.png", picture);
    write_picture(directory / "wend_load_texture.exr", picture);
    const auto loaded = [&](const std::string& parameters, const std::string& file = "wend_load_texture.png") {
        return Loaded("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"" + file + "\" " + parameters +
                          " Material \"diffuse\" \"texture reflectance\" \"t\"",
                      directory);
    };
    // (0, 0) is the lower left corner.
    expect_near(loaded("").reflectance({0.25f, 0.25f}), {0, 0, 1}, 1e-3f);
    expect_near(loaded("").reflectance({0.25f, 0.75f}), {1, 0, 0}, 1e-3f);
    expect_near(loaded("").reflectance({0.75f, 0.25f}), Rgb(0.5f), 0.01f);
    const float encoded = 188 / 255.0f;
    expect_near(loaded("\"string encoding\" \"linear\"").reflectance({0.75f, 0.25f}), Rgb(encoded), 0.01f);
    expect_near(loaded("\"string encoding\" \"gamma 2\"").reflectance({0.75f, 0.25f}), Rgb(encoded * encoded), 0.01f);
    expect_near(loaded("\"string encoding\" \"gamma 2\"", "wend_load_texture.exr").reflectance({0.75f, 0.25f}),
                Rgb(0.5f), 1e-3f);
    expect_near(loaded("\"float scale\" 0.5 \"bool invert\" true").reflectance({0.25f, 0.25f}), {1, 1, 0.5f}, 1e-3f);
    expect_near(loaded("\"float udelta\" 0.5 \"string filter\" \"trilinear\"").reflectance({0.25f, 0.25f}), Rgb(0.5f),
                0.01f);
    expect_near(loaded("\"string wrap\" \"black\"").reflectance({1.75f, 0.25f}), Rgb(0.0f));
    const Loaded twice(
        "Texture \"a\" \"spectrum\" \"imagemap\" \"string filename\" \"wend_load_texture.png\" "
        "Texture \"b\" \"spectrum\" \"imagemap\" \"string filename\" \"wend_load_texture.png\"",
        directory);
    EXPECT_TRUE(twice.scene.warnings.empty());
    expect_near(loaded("\"string filter\" \"point\"").reflectance({0.45f, 0.55f}), {1, 0, 0}, 1e-3f);
    // A pixel beyond the right border of a sphere is one at the border, mirrored up and down.
    expect_near(loaded("\"string wrap\" \"octahedralsphere\" \"string filter\" \"point\"").reflectance({1.1f, 0.75f}),
                Rgb(0.5f), 0.01f);
    // Beyond the left border it is one in the second column, as in pbrt.
    expect_near(loaded("\"string wrap\" \"octahedralsphere\" \"string filter\" \"point\"").reflectance({-0.1f, 0.75f}),
                Rgb(0.5f), 0.01f);
    EXPECT_EQ(warnings_with(loaded("\"string encoding\" \"sRGB\"", "wend_load_texture.exr").scene, "not PNG"), 1);
    EXPECT_EQ(warnings_with(loaded("\"string encoding\" \"linear\"", "wend_load_texture.exr").scene, "not PNG"), 0);
    const Loaded unknown = loaded("\"string filter\" \"frob\"");
    EXPECT_EQ(warnings_with(unknown.scene, "the filter \"frob\" is unknown"), 1);
    expect_near(unknown.reflectance({0.5f, 0.25f}), loaded("").reflectance({0.5f, 0.25f}));
    EXPECT_PRED2(contains, message_of([&] { loaded("\"string encoding\" \"frob\""); }),
                 "the encoding \"frob\" is unknown");
    EXPECT_PRED2(contains, message_of([&] { loaded("\"string encoding\" \"gamma -1\""); }), "the encoding");
    EXPECT_PRED2(contains, message_of([&] { loaded("\"string wrap\" \"frob\""); }), "the wrap mode");
    EXPECT_PRED2(contains, message_of([&] { loaded("", "none-such.png"); }), "there is no file");
}

TEST(LoadTextures, FloatsAreTheOpacityOrTheMeanOfAPicture) {
    const auto directory = std::filesystem::temp_directory_path();
    Picture picture;
    picture.image = Image(1, 1, {0.3f, 0.6f, 0.9f});
    picture.full_size = {1, 1};
    write_picture(directory / "wend_float_opaque.exr", picture);
    picture.layers = {{"", {"A"}, {0.25f}}};
    write_picture(directory / "wend_float_alpha.exr", picture);
    const auto value = [&](const std::string& file, const std::string& filter) {
        return Loaded("Texture \"t\" \"float\" \"imagemap\" \"string filename\" \"" + file + "\" \"string filter\" \"" +
                          filter +
                          "\" Texture \"u\" \"spectrum\" \"scale\" \"texture scale\" \"t\" "
                          "Material \"diffuse\" \"texture reflectance\" \"u\"",
                      directory)
            .reflectance();
    };
    expect_near(value("wend_float_opaque.exr", "bilinear"), Rgb(0.6f));
    expect_near(value("wend_float_alpha.exr", "trilinear"), Rgb(0.25f));
    expect_near(value("wend_float_alpha.exr", "point"), Rgb(0.3f));
    expect_near(value("wend_float_alpha.exr", "EWA"), Rgb(0.3f));
}

TEST(LoadTextures, MappingsAreInTheSpaceOfTheTexture) {
    const auto value = [](const std::string& mapping, const Vec3& p) {
        return Loaded(
                   "Translate 1 2 3 Texture \"t\" \"spectrum\" \"bilerp\" \"rgb v00\" [0 0 0] \"rgb v01\" [0 1 0] "
                   "\"rgb v10\" [1 0 0] \"rgb v11\" [1 1 0] \"string mapping\" \"" +
                   mapping + " Material \"diffuse\" \"texture reflectance\" \"t\"")
            .reflectance({0.1f, 0.2f}, p);
    };
    expect_near(value("uv\" \"float uscale\" 2 \"float vdelta\" .5", {0, 0, 0}), {0.2f, 0.7f, 0});
    expect_near(value("spherical\"", {1, 3, 3}), {0.5f, 0.25f, 0});
    expect_near(value("spherical\"", {1, 1, 4}), {0.25f, 0.75f, 0});
    expect_near(value("spherical\"", {1, 2, 3}), {0, 0, 0});  // its very centre
    expect_near(value("cylindrical\"", {1, 4, 3.7f}), {0.75f, 0.7f, 0});
    expect_near(value("planar\" \"vector3 v1\" [0 .5 0] \"vector3 v2\" [0 0 2] \"float udelta\" .1", {9, 3, 3.2f}),
                {0.6f, 0.4f, 0});
}

TEST(LoadTextures, UnknownMappingsAreTheCoordinatesAsTheyAre) {
    const Loaded loaded(
        "Texture \"t\" \"spectrum\" \"bilerp\" \"rgb v00\" [0 0 0] \"rgb v01\" [0 1 0] \"rgb v10\" [1 0 0] "
        "\"rgb v11\" [1 1 0] \"string mapping\" \"cubic\" \"float uscale\" 2 "
        "Material \"diffuse\" \"texture reflectance\" \"t\"");
    expect_near(loaded.reflectance({0.1f, 0.2f}), {0.1f, 0.2f, 0});
    EXPECT_EQ(warnings_with(loaded.scene, "the texture mapping \"cubic\" is unknown"), 1);
}

TEST(LoadTextures, PatternsOfNoise) {
    const auto texture = [](const std::string& kind, const std::string& parameters) {
        return Loaded("Scale 2 2 2 Texture \"t\" \"" + kind + "\" " + parameters +
                      (kind == "float" ? " Texture \"u\" \"spectrum\" \"scale\" \"texture scale\" \"t\" " : " ") +
                      "Material \"diffuse\" \"texture reflectance\" \"" + (kind == "float" ? "u" : "t") + "\"");
    };
    const Vec3 p(0.6f, 1.1f, -0.3f), q = p * 0.5f;
    const Rgb fractal =
        texture("float", "\"fbm\" \"integer octaves\" 2 \"float roughness\" .25").reflectance({0, 0}, p);
    expect_near(fractal, Rgb(perlin_noise(q) + 0.25f * perlin_noise(q * 1.99f)));
    const Rgb wrinkled =
        texture("float", "\"wrinkled\" \"integer octaves\" 1 \"float roughness\" .5").reflectance({0, 0}, p);
    expect_near(wrinkled, Rgb(std::abs(perlin_noise(q)) + 0.1f));
    EXPECT_TRUE(is_finite(texture("float", "\"windy\"").reflectance({0, 0}, p)));
    // Without displacement: half way along the wave.
    const Rgb marble =
        texture("spectrum", "\"marble\" \"float variation\" 0 \"float scale\" 3").reflectance({0, 0}, {0, 0, 0});
    expect_near(marble, Rgb(0.75f), 0.2f);
    EXPECT_PRED2(contains, message_of([&] { texture("float", "\"fbm\" \"integer octaves\" 100"); }), "from 0 to 64");
}

TEST(LoadTextures, DotsAndMixturesByDirection) {
    // As in pbrt, "inside" is what lies around the dots.
    const Loaded dots(
        "Texture \"d\" \"spectrum\" \"dots\" \"rgb outside\" [ 1 0 0 ] \"rgb inside\" [ 0 0 1 ] "
        "Material \"diffuse\" \"texture reflectance\" \"d\"");
    int in_dots = 0;
    constexpr int side = 100;
    for (int i = 0; i < side * side; ++i) {
        const Rgb colour = dots.reflectance(Vec2(static_cast<float>(i % side), static_cast<float>(i / side)) * 0.37f);
        EXPECT_EQ(colour.r + colour.b, 1);
        in_dots += colour.r == 1;
    }
    // At most half of the squares have a dot: where the noise is above 0.
    EXPECT_GT(in_dots, side * side / 10);
    EXPECT_LT(in_dots, side * side / 5);
    const Loaded mix(
        "Rotate 90 1 0 0 Texture \"m\" \"spectrum\" \"directionmix\" \"rgb tex1\" [1 0 0] \"rgb tex2\" "
        "[0 0 1] Material \"diffuse\" \"texture reflectance\" \"m\"");
    const TextureId id = mix.as<DiffuseMaterial>().reflectance;
    expect_near(mix.scene.scene.textures.evaluate(id, {{0, 0}, {0, 0, 0}, {0, 0, -1}}), {1, 0, 0});
    expect_near(mix.scene.scene.textures.evaluate(id, {{0, 0}, {0, 0, 0}, {0, 0.8f, 0.6f}}), {0.6f, 0, 0.4f});
}

TEST(LoadTextures, SubstitutesAreNamedOnce) {
    const Loaded loaded("Texture \"f\" \"spectrum\" \"ptex\" Material \"diffuse\" \"texture reflectance\" \"f\"");
    expect_near(loaded.reflectance(), Rgb(0.5f));
    EXPECT_EQ(warnings_with(loaded.scene, "is not implemented"), 1);
    EXPECT_PRED2(contains, message_of([] { Loaded("Texture \"x\" \"float\" \"frob\""); }), "known are bilerp");
}

TEST(LoadTextures, PixelsThatAreNoNumbersAreBlack) {
    const auto directory = std::filesystem::temp_directory_path();
    std::ofstream file(directory / "wend_nan.pfm", std::ios::binary);
    file << "PF\n1 1\n-1.0\n";
    const float pixel[] = {std::numeric_limits<float>::quiet_NaN(), 1, 1};
    file.write(reinterpret_cast<const char*>(pixel), sizeof(pixel));
    file.close();
    const Loaded loaded(
        "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"wend_nan.pfm\" "
        "Material \"diffuse\" \"texture reflectance\" \"t\"",
        directory);
    EXPECT_EQ(warnings_with(loaded.scene, "not finite numbers"), 1);
    expect_near(loaded.reflectance(), Rgb(0.0f));
}

TEST(LoadTextures, RefusesTexturesThatGrowExponentially) {
    std::string world = "Texture \"t0\" \"float\" \"checkerboard\" ";
    for (int i = 1; i < 40; ++i) {
        const std::string before = " \"t" + std::to_string(i - 1) + "\" ";
        world += "Texture \"t" + std::to_string(i) + "\" \"float\" \"scale\" \"texture tex\"" + before +
                 "\"texture scale\"" + before + "\n";
    }
    EXPECT_PRED2(contains, message_of([&] { load_text(world); }), "more than 10000 parts");
}

TEST(LoadTextures, MeshesHaveValuesAtTheirCorners) {
    const Loaded loaded(
        "Texture \"m\" \"spectrum\" \"mesh\" \"float values\" [ 1 0 0  0 1 0  0 0 1  .5 .5 .5 ] "
        "\"integer indices\" [ 0 1 2  3 3 3 ] Material \"diffuse\" \"texture reflectance\" \"m\"");
    const auto at = [&](std::uint32_t triangle, const Vec2& of_corners) {
        return loaded.scene.scene.textures.evaluate(loaded.as<DiffuseMaterial>().reflectance,
                                                    {{0, 0}, {0, 0, 0}, {0, 0, 1}, false, triangle, of_corners});
    };
    EXPECT_EQ(at(0, {0, 0}), Rgb(1, 0, 0));
    EXPECT_EQ(at(0, {0.25f, 0.5f}), Rgb(0.25f, 0.25f, 0.5f));
    EXPECT_EQ(at(1, {0.25f, 0.5f}), Rgb(0.5f));
    EXPECT_EQ(at(2, {0, 1}), Rgb(0, 0, 1)) << "of a larger mesh";
    const auto refused = [](const std::string& parameters) {
        return message_of([&] { Loaded("Texture \"m\" \"float\" \"mesh\" " + parameters); });
    };
    EXPECT_PRED2(contains, refused("\"integer indices\" [ 0 0 0 ]"), "\"values\" are finite numbers, 1 each");
    EXPECT_PRED2(contains, refused("\"float values\" [ 1 2 ] \"integer indices\" [ 0 1 ]"), "three for each triangle");
    EXPECT_PRED2(contains, refused("\"float values\" [ 1 2 ] \"integer indices\" [ 0 1 2 ]"),
                 "index 2 is out of range");
}

}  // namespace
}  // namespace wend
