// Colour spaces of scene files, of films and of pictures.
#include "load_support.h"
#include "near.h"

#include <tests/support/scratch_folder.h>
#include <wend/io/exr_file.h>
#include <wend/io/image_file.h>
#include <wend/io/spectrum/colour_space.h>
#include <wend/io/spectrum/white_balance.h>

#include <gtest/gtest.h>

#include <string>
#include <variant>

namespace wend {
namespace {

using pbrt::ColourSpace;
using test::expect_near;
using test::load_text;

const Rgb given_colour(0.6f, 0.3f, 0.1f);
constexpr const char* of_given_colour = "Material \"diffuse\" \"rgb reflectance\" [ 0.6 0.3 0.1 ] Shape \"sphere\"";

Rgb reflectance(const LoadedScene& loaded) {
    const auto index = static_cast<std::size_t>(loaded.scene.surfaces[0].material);
    return *loaded.scene.textures.constant(std::get<DiffuseMaterial>(loaded.scene.materials[index]).reflectance);
}

TEST(ColourSpaces, MatricesAreThoseOfTheStandards) {
    // BT.2087: from BT.2020 to BT.709.
    const ColourMatrix& m = rec709_from(ColourSpace::rec2020, false);
    const double expected[3][3] = {{1.6605, -0.5876, -0.0728}, {-0.1246, 1.1329, -0.0083}, {-0.0182, -0.1006, 1.1187}};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            EXPECT_NEAR(m.m[i][j], expected[i][j], 1e-3);
        }
    }
    EXPECT_TRUE(rec709_from(ColourSpace::srgb, false).is_identity());
    for (const auto space : {ColourSpace::dci_p3, ColourSpace::rec2020, ColourSpace::aces2065_1}) {
        expect_near(rec709_from(space, true) * Rgb(1.0f), Rgb(1.0f), 1e-4f);
    }
    // By the chromaticities of D60 and of Rec. 709's primaries.
    expect_near(rec709_from(ColourSpace::aces2065_1, false) * Rgb(1.0f), {1.0470f, 0.9948f, 0.9150f}, 2e-3f);
}

TEST(ColourSpaces, AFilmHoldsColoursOfItsOwn) {
    for (const std::string space : {"dci-p3", "rec2020", "aces2065-1"}) {
        for (const std::string film : {"", "\"float whitebalance\" 6504"}) {
            const LoadedScene loaded = load_text(of_given_colour, "ColorSpace \"" + space + "\" Film \"rgb\" " + film);
            const bool is_aces = space == "aces2065-1";
            // Without a white balance, light that is white in Rec. 709 is bluer than ACES's white.
            if (!is_aces || !film.empty()) {
                expect_near(loaded.balance * reflectance(loaded), given_colour, is_aces ? 4e-3f : 2e-3f);
            } else {
                EXPECT_GT((loaded.balance * Rgb(1.0f)).b, 1.05f);
                const Rgb light = rec709_from(ColourSpace::aces2065_1, false) * given_colour;
                expect_near(loaded.balance * light, given_colour, 1e-4f);
            }
            EXPECT_EQ(to_string(loaded.colour_space), space);
        }
    }
    const LoadedScene plain = load_text(of_given_colour, "Film \"rgb\" ColorSpace \"rec2020\"");
    EXPECT_TRUE(plain.balance.is_identity());
    EXPECT_EQ(plain.colour_space, ColourSpace::srgb);
}

TEST(ColourSpaces, LightIsWhiteAsTheSpaceHasIt) {
    const auto intensity = [](const std::string& light) {
        return std::get<PointLight>(load_text(light).scene.lights.at(0)).intensity;
    };
    const Rgb d60 = rec709_from(ColourSpace::aces2065_1, false) * Rgb(1.0f);
    expect_near(intensity("ColorSpace \"aces2065-1\" LightSource \"point\""), d60, 1e-4f);
    expect_near(intensity("ColorSpace \"aces2065-1\" LightSource \"point\" \"rgb I\" [ 2 2 2 ]"), d60 * 2, 1e-4f);
    expect_near(intensity("ColorSpace \"rec2020\" LightSource \"point\""), Rgb(1.0f), 1e-4f);
    expect_near(intensity("ColorSpace \"rec2020\" LightSource \"point\" \"rgb I\" [ 1 0 0 ]"), {1.6605f, 0, 0}, 1e-4f);
    const LoadedScene area =
        load_text("ColorSpace \"aces2065-1\" AreaLightSource \"diffuse\" Shape \"sphere\" \"float radius\" 2");
    expect_near(std::get<QuadricLight>(area.scene.lights.at(0)).radiance, d60, 1e-4f);
}

TEST(ColourSpaces, PicturesSayWhatTheyHold) {
    const test::ScratchFolder folder;
    const auto file = folder.path() / "p.exr";
    Picture picture;
    picture.image = Image(2, 2, given_colour);
    picture.full_size = {2, 2};
    write_picture(file, picture);
    EXPECT_EQ(exr_colour_space(file), ColourSpace::srgb);
    picture.metadata.emplace(colour_space_text, "rec2020");
    write_picture(file, picture);
    EXPECT_EQ(exr_colour_space(file), ColourSpace::rec2020);
    // Textures are converted, and maps of numbers are not.
    const LoadedScene loaded = load_text(
        "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"p.exr\" "
        "Texture \"n\" \"float\" \"imagemap\" \"string filename\" \"p.exr\" "
        "Material \"diffuse\" \"texture reflectance\" \"t\" \"string normalmap\" \"p.exr\" Shape \"sphere\" "
        "LightSource \"infinite\" \"string filename\" \"p.exr\"",
        "", {}, folder.path());
    const auto index = static_cast<std::size_t>(loaded.scene.surfaces[0].material);
    const auto value = [&](TextureId id) { return loaded.scene.textures.evaluate(id, {{0.5f, 0.5f}, {0, 0, 0}}); };
    const Rgb converted = rec709_from(ColourSpace::rec2020, false) * given_colour;
    expect_near(value(std::get<DiffuseMaterial>(loaded.scene.materials[index]).reflectance), converted, 1e-4f);
    expect_near(value(1), Rgb(mean(given_colour)), 1e-4f);
    expect_near(loaded.scene.details[index].normal_map->pixels[0], given_colour, 1e-4f);
    expect_near(std::get<ImageInfiniteLight>(loaded.scene.lights.at(0)).mean_radiance(), converted, 2e-3f);
}

}  // namespace
}  // namespace wend
