// The XML of Mitsuba scenes: parameters, includes, references, and what is none of them.
#include "mitsuba_support.h"

#include <wend/io/mitsuba/document.h>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <string>

namespace wend::mitsuba {
namespace {

TEST(MitsubaDocument, TheFirstDefaultOfAParameterHoldsAndTheLongestNameIsMeant) {
    const MitsubaFiles files;
    const auto scene = files.read(
        "<default name=\"r\" value=\"9\"/><default name=\"radius\" value=\"2\"/><default name=\"radius\" value=\"3\"/>"
        "<shape type=\"sphere\"><float name=\"radius\" value=\"$radius\"/></shape>"
        "<shape type=\"sphere\"><float name=\"radius\" value=\"1$r\"/></shape>");
    ASSERT_EQ(scene.shapes.size(), 2u);
    EXPECT_EQ(scene.shapes[0].parameters.get_float("radius", 0), 2);
    EXPECT_EQ(scene.shapes[1].parameters.get_float("radius", 0), 19);
}

TEST(MitsubaDocument, PlacesAreThoseOfTheFileThatIsIncluded) {
    const MitsubaFiles files;
    files.write("part.xml", "<scene version=\"3.0.0\">\n\n  <shape type=\"sphere\"/>\n</scene>");
    const auto scene = files.read("<include filename=\"part.xml\"/>");
    ASSERT_EQ(scene.shapes.size(), 1u);
    const Place place = scene.shapes[0].place;
    EXPECT_EQ(place.file, files.path("part.xml").string());
    EXPECT_EQ(place.line, 3);
    EXPECT_EQ(place.column, 3);
    EXPECT_EQ(scene.files.size(), 2u);
}

TEST(MitsubaDocument, AnIncludedObjectTakesThePlaceOfTheInclude) {
    const MitsubaFiles files;
    files.write("red.xml", "<bsdf version=\"3.0.0\" type=\"diffuse\" id=\"red\"/>");
    const auto scene = files.read(
        "<shape type=\"sphere\"><include filename=\"red.xml\"/></shape>"
        "<shape type=\"sphere\"><ref id=\"red\"/></shape>");
    ASSERT_EQ(scene.shapes.size(), 2u);
    EXPECT_EQ(scene.shapes[0].material, scene.shapes[1].material);
}

TEST(MitsubaDocument, AliasesAndReferencesMeanOneObject) {
    const MitsubaFiles files;
    const auto scene = files.read(
        "<bsdf type=\"diffuse\" id=\"a\"/><alias id=\"a\" as=\"b\"/>"
        "<shape type=\"sphere\"><ref id=\"a\"/></shape><shape type=\"sphere\"><ref id=\"b\"/></shape>"
        "<shape type=\"sphere\"><ref id=\"later\"/></shape><bsdf type=\"diffuse\" id=\"later\"/>");
    ASSERT_EQ(scene.shapes.size(), 3u);
    EXPECT_EQ(scene.shapes[0].material, scene.shapes[1].material);
    EXPECT_NE(scene.shapes[0].material, scene.shapes[2].material);
}

TEST(MitsubaDocument, FilesAreFoundInTheFoldersOfPath) {
    const MitsubaFiles files;
    std::filesystem::create_directory(files.path("meshes"));
    files.write("meshes/m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const auto scene = files.read(
        "<path value=\"meshes\"/>"
        "<shape type=\"obj\"><string name=\"filename\" value=\"m.obj\"/></shape>");
    EXPECT_EQ(scene.shapes.size(), 1u);
}

TEST(MitsubaDocument, NamesOfVersion0AreThoseOfVersion3) {
    const MitsubaFiles files;
    const std::string text =
        "<scene version=\"0.6.0\"><sensor type=\"perspective\"><float name=\"fov\" value=\"30\"/><string "
        "name=\"fovAxis\" "
        "value=\"y\"/><transform name=\"toWorld\"><lookAt origin=\"0 0 0\" target=\"0 0 1\" up=\"0 1 "
        "0\"/></transform></sensor>"
        "<shape type=\"sphere\"><bsdf type=\"dielectric\"><float name=\"intIOR\" value=\"1.7\"/><float name=\"extIOR\" "
        "value=\"1\"/></bsdf></shape></scene>";
    const auto scene = read_scene(text, "/tmp", "old.xml");
    EXPECT_EQ(warnings_of(scene), "");
    EXPECT_FLOAT_EQ(scene.camera.parameters.get_float("fov", 0), 30);
    EXPECT_FLOAT_EQ(scene.materials[scene.shapes[0].material].parameters.get_float("eta", 0), 1.7f);
}

TEST(MitsubaDocument, WhatIsWrongIsNamedWithItsPlace) {
    const MitsubaFiles files;
    const Wrong cases[] = {
        {"<shape type=\"sphere\">", "this is no XML"},
        {"<shap type=\"sphere\"/>", "<shap> is unknown; known are scene, bsdf"},
        {"<shape/>", "<shape> needs the attribute \"type\""},
        {"<shape type=\"sphere\" typ=\"a\"/>", "<shape> has no attribute \"typ\""},
        {"<shape type=\"sphere\" type=\"cube\"/>", "the attribute \"type\" is given twice"},
        {"<shape type=\"$kind\"/>", "\"$kind\" is not defined"},
        {"<shape type=\"sphere\"><ref id=\"no\"/></shape>", "nothing has the id \"no\""},
        {"<alias id=\"no\" as=\"a\"/>", "nothing before has the id \"no\""},
        {"<bsdf type=\"diffuse\" id=\"a\"/><bsdf type=\"diffuse\" id=\"a\"/>", "the id \"a\" is that of <bsdf> at"},
        {"<shape type=\"sphere\"><float name=\"radius\" value=\"x\"/></shape>", "\"x\" is no number"},
        {"<shape type=\"sphere\"><float name=\"radius\" value=\"inf\"/></shape>", "\"inf\" is no number"},
        {"<shape type=\"sphere\"><float name=\"radius\" value=\"1e300\"/></shape>", "\"1e300\" is no number"},
        {"<shape type=\"sphere\"><string name=\"radius\" value=\"1\"/></shape>", "is a number here, not a <string>"},
        {"<shape type=\"sphere\"><float name=\"radius\" value=\"1\"/><float name=\"radius\" value=\"2\"/></shape>",
         "\"radius\" of <shape type=\"sphere\"> is given twice"},
        {"<shape type=\"sphere\"><translate x=\"1\"/></shape>", "<translate> cannot be in <shape>"},
        {"<shape type=\"sphere\"><float name=\"radius\" value=\"1\"><float name=\"a\" value=\"1\"/></float></shape>",
         "<float> cannot be in <float>"},
        {"<shape type=\"sphere\"><transform name=\"to_world\"><scale value=\"0\"/></transform></shape>",
         "a scale must be finite and not zero"},
        {"<shape type=\"sphere\"><transform name=\"to_world\"><rotate angle=\"9\"/></transform></shape>",
         "needs an axis that is not 0"},
        {"<shape type=\"sphere\"><transform name=\"to_world\"><matrix value=\"1 2 3\"/></transform></shape>",
         "<matrix> is 16 or 9 numbers, not 3"},
        {"<shape type=\"sphere\"><transform name=\"to_world\"><lookat origin=\"0 0 0\" target=\"0 0 "
         "0\"/></transform></shape>",
         "the transformation matrix is singular"},
        {"<include filename=\"missing.xml\"/>", "missing.xml"},
        {"<path value=\"missing\"/>", "there is no folder"},
        {"<shape type=\"obj\"><string name=\"filename\" value=\"missing.obj\"/></shape>", "there is no file"},
    };
    for (const Wrong& wrong : cases) {
        SCOPED_TRACE(wrong.content);
        const std::string message = files.error_of(wrong.content);
        EXPECT_PRED2(contains, message, wrong.message);
        EXPECT_PRED2(contains, message, "scene.xml:");
    }
}

TEST(MitsubaDocument, AFileNeedsAVersionAndToBeAScene) {
    const MitsubaFiles files;
    EXPECT_PRED2(contains, files.error_of_text("<scene/>"), "needs the attribute \"version\"");
    EXPECT_PRED2(contains, files.error_of_text("<bsdf version=\"3.0.0\" type=\"diffuse\"/>"), "expected <scene>");
    EXPECT_PRED2(contains, files.error_of_text(""), "this is no XML");
    EXPECT_PRED2(contains, files.error_of_text("<scene version=\"3.0.0\"/>"), "the scene has no <sensor>");
}

TEST(MitsubaDocument, PipesAreRefused) {
    const MitsubaFiles files;
    ASSERT_EQ(mkfifo(files.path("pipe.xml").c_str(), 0600), 0);
    EXPECT_PRED2(contains, files.error_of("<include filename=\"pipe.xml\"/>"), "is a pipe, which may never end");
}

TEST(MitsubaDocument, CirclesEnd) {
    const MitsubaFiles files;
    files.write("a.xml", "<scene version=\"3.0.0\"><include filename=\"b.xml\"/></scene>");
    files.write("b.xml", "<scene version=\"3.0.0\"><include filename=\"a.xml\"/></scene>");
    EXPECT_PRED2(contains, files.error_of("<include filename=\"a.xml\"/>"), "includes itself");
    EXPECT_PRED2(contains, files.error_of("<include filename=\"scene.xml\"/>"), "includes itself");
    const std::string circle =
        "<bsdf type=\"blendbsdf\" id=\"a\"><ref id=\"b\"/><ref id=\"b\"/></bsdf>"
        "<bsdf type=\"blendbsdf\" id=\"b\"><ref id=\"a\"/><ref id=\"a\"/></bsdf>"
        "<shape type=\"sphere\"><ref id=\"a\"/></shape>";
    EXPECT_PRED2(contains, files.error_of(circle), "too deeply or in a circle");
    EXPECT_PRED2(contains,
                 files.error_of("<texture type=\"checkerboard\" id=\"t\"><ref name=\"color0\" id=\"t\"/></texture>"
                                "<shape type=\"sphere\"><bsdf type=\"diffuse\"><ref name=\"reflectance\" id=\"t\"/>"
                                "</bsdf></shape>"),
                 "too deeply or in a circle");
    EXPECT_PRED2(contains, files.error_of("<shape type=\"shapegroup\" id=\"g\"><ref id=\"g\"/></shape>"),
                 "cannot be in");
    EXPECT_PRED2(contains, files.error_of("<shape type=\"merge\" id=\"m\"><ref id=\"m\"/></shape>"), "in a circle");
    EXPECT_PRED2(contains,
                 files.error_of("<phase type=\"blendphase\" id=\"p\"><ref id=\"p\"/><ref id=\"p\"/></phase>"
                                "<shape type=\"sphere\"><medium name=\"interior\" type=\"homogeneous\"><ref id=\"p\"/>"
                                "</medium></shape>"),
                 "blended more than");
}

TEST(MitsubaDocument, WhatGrowsIsBounded) {
    const MitsubaFiles files;
    // Each includes the next one ten times.
    for (int i = 0; i < 8; ++i) {
        std::string text = "<scene version=\"3.0.0\">";
        for (int k = 0; k < 10; ++k) {
            text += fmt::format("<include filename=\"{}.xml\"/>", i + 1);
        }
        files.write(fmt::format("{}.xml", i), text + "</scene>");
    }
    files.write("8.xml", "<scene version=\"3.0.0\"/>");
    EXPECT_PRED2(contains, files.error_of("<include filename=\"0.xml\"/>"), "include each other");

    std::string doubling = "<default name=\"a0\" value=\"xxxxxxxxxxxxxxxx\"/>";
    for (int i = 0; i < 40; ++i) {
        doubling += fmt::format("<default name=\"a{0}\" value=\"$a{1}$a{1}\"/>", i + 1, i);
    }
    EXPECT_PRED2(contains, files.error_of(doubling), "far too long a text");

    std::string deep, closing;
    for (int i = 0; i < 100'000; ++i) {
        deep += "<bsdf type=\"twosided\">";
        closing += "</bsdf>";
    }
    EXPECT_PRED2(contains, files.error_of(deep + closing), "nested more than 64 deep");

    std::string wide = "<shape";
    for (int i = 0; i < 200'000; ++i) {
        wide += fmt::format(" a{}=\"\"", i);
    }
    EXPECT_PRED2(contains, files.error_of(wide + "/>"), "at most 64 attributes");

    const std::string many(11'000'000, '<');
    EXPECT_PRED2(contains, files.error_of(many), "elements and attributes");
}

TEST(MitsubaDocument, EntitiesAreNotExpanded) {
    const MitsubaFiles files;
    const std::string text =
        "<!DOCTYPE scene [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\">"
        "<!ENTITY file SYSTEM \"file:///etc/passwd\">]>" +
        scene_with("<shape type=\"sphere\" id=\"&b;\"/><shape type=\"&file;\"/>");
    EXPECT_PRED2(contains, files.error_of_text(text), "<shape type=\"&file;\"> is unknown");
}

TEST(MitsubaDocument, ATextOfItsOwnIncludesNothingIfItMayNot) {
    EXPECT_PRED2(contains,
                 message_of([] { read_scene(scene_with("<include filename=\"a.xml\"/>"), "/tmp", "text", false); }),
                 "may not include files");
}

}  // namespace
}  // namespace wend::mitsuba
