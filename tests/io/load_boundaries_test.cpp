// Warnings about shapes that do not hold their medium.
#include "load_support.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

namespace wend {
namespace {

using test::load_text;
using test::warnings_with;

const std::string wax = R"(MakeNamedMedium "wax" "string type" "homogeneous"
MediumInterface "wax" ""
Material "interface"
)";

/// A cube of side 2 by the rows of its indices, a face each, but for some left out.
std::string cube(int faces) {
    static const char* const rows[] = {"0 2 3 0 3 1 ", "4 5 7 4 7 6 ", "0 1 5 0 5 4 ",
                                       "2 6 7 2 7 3 ", "0 4 6 0 6 2 ", "1 3 7 1 7 5 "};
    std::string text =
        "Shape \"trianglemesh\" \"point3 P\" [ -1 -1 -1  1 -1 -1  -1 1 -1  1 1 -1  -1 -1 1  1 -1 1  -1 1 1  1 1 1 ] "
        "\"integer indices\" [ ";
    for (int i = 0; i < faces; ++i) {
        text += rows[i];
    }
    return text + "]\n";
}

TEST(LoadBoundaries, AnOpenMeshIsNamedWithItsPlaceAndMedium) {
    const LoadedScene open = load_text(wax + cube(5));
    ASSERT_EQ(open.warnings.size(), 1u);
    EXPECT_NE(open.warnings[0].find("test.pbrt:6:1: warning: "), std::string::npos) << open.warnings[0];
    EXPECT_NE(open.warnings[0].find("medium \"wax\" is open: it ends at 4 edges, the first near (1, "),
              std::string::npos)
        << open.warnings[0];
    EXPECT_TRUE(load_text(wax + cube(6)).warnings.empty());
}

TEST(LoadBoundaries, TheMediumOfAMaterialHasNoName) {
    EXPECT_EQ(warnings_with(load_text("Material \"subsurface\"\n" + cube(5)), "the medium inside is open"), 1);
    const LoadedScene whole = load_text("Material \"subsurface\"\n" + cube(6));
    EXPECT_EQ(whole.warnings.size(), 1u);
    EXPECT_EQ(warnings_with(whole, "the diffusion that pbrt takes"), 1);
}

TEST(LoadBoundaries, OrientationIsThatOfTheFile) {
    EXPECT_EQ(warnings_with(load_text(wax + "ReverseOrientation\n" + cube(6)), "inside out"), 1);
    EXPECT_EQ(warnings_with(load_text(wax + "ReverseOrientation\nShape \"sphere\""), "inside out"), 1);
    EXPECT_TRUE(load_text(wax + "Scale -1 1 1\n" + cube(6)).warnings.empty());
    // As in pbrt, mirroring turns quadrics inside out.
    EXPECT_EQ(warnings_with(load_text(wax + "Scale 1 -1 1\nShape \"sphere\""), "inside out"), 1);
    EXPECT_EQ(warnings_with(load_text(wax + "Scale -1 -1 1\nShape \"sphere\""), "inside out"), 0);
    // Two halves, one of them turned.
    const std::string half = "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0  0 0 1 ] \"integer indices\" ";
    const std::string whole = wax + half + "[ 0 2 1  0 1 3 ]\n" + half + "[ 0 3 2  1 2 3 ]\n";
    EXPECT_TRUE(load_text(whole).warnings.empty());
    const std::string turned = wax + half + "[ 0 2 1  0 1 3 ]\nReverseOrientation " + half + "[ 0 3 2  1 2 3 ]\n";
    EXPECT_EQ(warnings_with(load_text(turned), "face opposite ways at 4 edges"), 1);
}

TEST(LoadBoundaries, SixPlacedSquaresAreOneCube) {
    const std::string square =
        "Shape \"trianglemesh\" \"point3 P\" [ -1 -1 1  1 -1 1  1 1 1  -1 1 1 ] "
        "\"integer indices\" [ 0 1 2 0 2 3 ]\nAttributeEnd\n";
    std::string faces = wax + "Translate 7 0.3 1 Rotate 20 1 2 3\n";
    for (const char* turn : {"0 1 0 0", "90 1 0 0", "180 1 0 0", "270 1 0 0", "90 0 1 0"}) {
        faces += std::string("AttributeBegin Rotate ") + turn + "\n" + square;
    }
    EXPECT_EQ(load_text(faces).warnings.size(), 4u);
    EXPECT_TRUE(load_text(faces + "AttributeBegin Rotate -90 0 1 0\n" + square).warnings.empty());
}

TEST(LoadBoundaries, ManyFaultsAreCounted) {
    std::string world = wax;
    for (int i = 0; i < 12; ++i) {
        world += "Translate 3 0 0\n" + cube(5);
    }
    const LoadedScene loaded = load_text(world);
    EXPECT_EQ(loaded.warnings.size(), 8u);
    EXPECT_EQ(warnings_with(loaded, "4 more like this"), 1);
}

TEST(LoadBoundaries, ThoseOfTheProjectsScenesHold) {
    int scenes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(test::source_dir() / "scenes")) {
        if (entry.path().extension() == ".pbrt") {
            const LoadedScene loaded = load_scene(entry.path());
            EXPECT_EQ(warnings_with(loaded, "the boundary of"), 0) << entry.path() << "\n" << loaded.warnings.front();
            ++scenes;
        }
    }
    EXPECT_GT(scenes, 5);
}

}  // namespace
}  // namespace wend
