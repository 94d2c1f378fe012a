// Textures of pbrt files where pbrt is not what one would guess.
#include "load_support.h"
#include "near.h"
#include "pbrt_support.h"

#include <tests/support/scratch_folder.h>
#include <wend/io/image_file.h>

#include <gtest/gtest.h>

#include <string>

namespace wend {
namespace {

using pbrt::contains;
using pbrt::message_of;
using test::expect_near;
using test::load_text;

/// A picture of one colour, .25, and an opacity of .75; and one without.
class LoadedTextures : public testing::Test {
protected:
    LoadedTextures() {
        Picture picture;
        picture.image = Image(1, 1, Rgb(0.25f));
        picture.full_size = {1, 1};
        write_picture(folder.path() / "grey.exr", picture);
        picture.layers = {{"", {"A"}, {0.75f}}};
        write_picture(folder.path() / "leaf.exr", picture);
    }

    LoadedScene load(const std::string& world) const { return load_text(world, "", {}, folder.path()); }
    /// The value of the texture "t" as a reflectance.
    Rgb reflectance(const std::string& textures) const {
        const LoadedScene loaded =
            load(textures + " Material \"diffuse\" \"texture reflectance\" \"t\" Shape \"sphere\"");
        const auto& material = std::get<DiffuseMaterial>(loaded.scene.materials.back());
        return loaded.scene.textures.evaluate(material.reflectance, {{0.5f, 0.5f}, {0, 0, 0}});
    }

    const test::ScratchFolder folder;
    const std::string grey = "\"imagemap\" \"string filename\" \"grey.exr\" ";
};

TEST_F(LoadedTextures, AConstantFactorScalesAPictureBeforeItIsInverted) {
    for (const std::string kind : {"spectrum", "float"}) {
        const std::string picture = "Texture \"p\" \"" + kind + "\" " + grey + "\"bool invert\" true ";
        const std::string of_number =
            kind == "float" ? "Texture \"t\" \"spectrum\" \"mix\" \"texture amount\" \"n\" " : "";
        const std::string name = kind == "float" ? "n" : "t";
        const std::string scaled =
            picture + "Texture \"" + name + "\" \"" + kind + "\" \"scale\" \"texture tex\" \"p\" ";
        // 1 - .25 * .5
        expect_near(reflectance(scaled + "\"float scale\" .5 " + of_number), Rgb(0.875f));
        expect_near(reflectance("Texture \"c\" \"float\" \"constant\" \"float value\" .5 " + scaled +
                                "\"texture scale\" \"c\" " + of_number),
                    Rgb(0.875f));
        expect_near(reflectance(scaled + "\"float scale\" 1 " + of_number), Rgb(0.75f));
        // What is no picture is a product.
        expect_near(reflectance("Texture \"" + name + "\" \"" + kind + "\" \"scale\" " +
                                (kind == "float" ? "\"float tex\" .5 " : "\"rgb tex\" [.5 .5 .5] ") +
                                "\"float scale\" .5 " + of_number),
                    Rgb(0.25f));
    }
    // The factor of a float texture may be the picture as well.
    expect_near(reflectance("Texture \"p\" \"float\" " + grey +
                            "\"bool invert\" true Texture \"n\" \"float\" \"scale\" \"float tex\" .5 "
                            "\"texture scale\" \"p\" Texture \"t\" \"spectrum\" \"mix\" \"texture amount\" \"n\""),
                Rgb(0.875f));
}

TEST_F(LoadedTextures, ColoursOfSurfacesEndAtOneBeforeTheyAreMixed) {
    const std::string bright = "Texture \"p\" \"spectrum\" " + grey + "\"float scale\" 8 ";
    expect_near(reflectance(bright + "Texture \"t\" \"spectrum\" \"mix\" \"texture tex2\" \"p\""), Rgb(0.5f));
    expect_near(reflectance("Texture \"p\" \"spectrum\" " + grey +
                            "\"float scale\" -8 Texture \"t\" \"spectrum\" \"mix\" \"texture tex1\" \"p\""),
                Rgb(0.5f));
    // What is no reflectance does not.
    const LoadedScene metal =
        load(bright + "Material \"conductor\" \"texture eta\" \"p\" \"texture k\" \"p\" Shape \"sphere\"");
    const auto& conductor = std::get<ConductorMaterial>(metal.scene.materials.back());
    expect_near(metal.scene.textures.evaluate(conductor.eta, {{0.5f, 0.5f}, {0, 0, 0}}), Rgb(2.0f));
    const LoadedScene listed = load(
        "Texture \"p\" \"spectrum\" \"constant\" \"spectrum value\" [ 200 3 900 3 ] "
        "Material \"conductor\" \"texture eta\" \"p\" \"texture k\" \"p\" Shape \"sphere\"");
    const auto& second = std::get<ConductorMaterial>(listed.scene.materials.back());
    expect_near(listed.scene.textures.evaluate(second.eta, {{0.5f, 0.5f}, {0, 0, 0}}), Rgb(3.0f), 1e-2f);
}

TEST_F(LoadedTextures, ByTheAngleOfViewTheyHaveOneNumberOrThreeForEachCosine) {
    // Points are seen straight from above here: the last value.
    expect_near(reflectance("Texture \"t\" \"spectrum\" \"facing\" \"float values\" [ 1 1 1 .1 .2 .3 ]"),
                Rgb(0.1f, 0.2f, 0.3f));
    expect_near(reflectance("Texture \"n\" \"float\" \"facing\" \"float values\" [ 0 .25 ] "
                            "Texture \"t\" \"spectrum\" \"mix\" \"texture amount\" \"n\""),
                Rgb(0.25f));
    EXPECT_THROW(reflectance("Texture \"t\" \"spectrum\" \"facing\" \"float values\" [ 1 1 ]"), InputError);
    EXPECT_THROW(reflectance("Texture \"t\" \"spectrum\" \"facing\""), InputError);
}

TEST_F(LoadedTextures, ByFineFiltersPresencesAreTheOpacityAndOtherNumbersAreNot) {
    const LoadedScene loaded = load(
        "Texture \"p\" \"float\" \"imagemap\" \"string filename\" \"leaf.exr\" \"string filter\" \"EWA\" "
        "Texture \"n\" \"float\" \"mix\" \"texture tex1\" \"p\" \"texture tex2\" \"p\" "
        "Material \"conductor\" \"texture roughness\" \"n\" Shape \"sphere\" \"texture alpha\" \"n\"");
    const auto value = [&](TextureId id) { return loaded.scene.textures.evaluate(id, {{0.5f, 0.5f}, {0, 0, 0}}).r; };
    EXPECT_FLOAT_EQ(value(loaded.scene.surfaces[0].alpha), 0.75f);
    EXPECT_FLOAT_EQ(value(std::get<ConductorMaterial>(loaded.scene.materials.back()).roughness.u), 0.25f);
}

TEST_F(LoadedTextures, MayReferToLaterOnesButNotToThemselves) {
    expect_near(reflectance("Texture \"t\" \"spectrum\" \"scale\" \"texture tex\" \"p\" \"texture scale\" \"n\" "
                            "Texture \"n\" \"float\" \"constant\" \"float value\" .5 Texture \"p\" \"spectrum\" " +
                            grey),
                Rgb(0.125f));
    EXPECT_PRED2(contains, message_of([&] {
                     load(
                         "Texture \"a\" \"float\" \"scale\" \"texture tex\" \"b\" "
                         "Texture \"b\" \"float\" \"scale\" \"texture tex\" \"a\"");
                 }),
                 "the texture \"a\" is made of itself");
}

TEST_F(LoadedTextures, DeepOnesAreRefused) {
    std::string chain;
    for (int i = 0; i < 3000; ++i) {
        chain += "Texture \"" + std::to_string(i) + "\" \"float\" \"scale\" \"texture tex\" \"" +
                 std::to_string(i + 1) + "\"\n";
    }
    EXPECT_PRED2(contains, message_of([&] { load(chain + "Texture \"3000\" \"float\" \"constant\""); }),
                 "more than 1000 deep");
}

}  // namespace
}  // namespace wend
