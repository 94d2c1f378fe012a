// Scenes that a program gives directive by directive: what a file may say, and what it may not.
#include <wend/core/error.h>
#include <wend/io/pbrt/directive_sequence.h>
#include <wend/io/pbrt/directives.h>
#include <wend/io/pbrt/parser.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace wend::pbrt {
namespace {

Parameter parameter(ParameterType type, std::string name, ParameterValues values) {
    Parameter p;
    p.type = type;
    p.name = std::move(name);
    p.values = std::move(values);
    return p;
}

TEST(DirectiveSequence, IsTheDescriptionOfTheText) {
    DirectiveSequence sequence("scene", "/tmp");
    const std::vector<double> eye = {0, 0, -4, 0, 0, 0, 0, 1, 0}, offset = {1, 2, 3};
    sequence.add("LookAt", {}, eye, {});
    sequence.add("Camera", {"perspective"}, {}, {parameter(ParameterType::real, "fov", std::vector<float>{40})});
    sequence.add("WorldBegin", {}, {}, {});
    sequence.add("AttributeBegin", {}, {}, {});
    sequence.add("Translate", {}, offset, {});
    sequence.add("Material", {"diffuse"}, {}, {});
    sequence.add("Shape", {"sphere"}, {}, {parameter(ParameterType::real, "radius", std::vector<float>{2})});
    sequence.add("AttributeEnd", {}, {}, {});
    const Description a = sequence.finish();
    const Description b = parse_string(
        "LookAt 0 0 -4 0 0 0 0 1 0 Camera \"perspective\" \"float fov\" 40 WorldBegin AttributeBegin Translate 1 2 3 "
        "Material \"diffuse\" Shape \"sphere\" \"float radius\" 2 AttributeEnd",
        "/tmp", "text");
    EXPECT_EQ(a.camera.type, b.camera.type);
    EXPECT_EQ(a.camera.parameters.get_float("fov", 0), 40);
    ASSERT_EQ(a.shapes.size(), 1u);
    EXPECT_EQ(a.shapes[0].parameters.get_float("radius", 0), b.shapes[0].parameters.get_float("radius", 1));
    EXPECT_EQ(a.shapes[0].world_from_object.point({0, 0, 0}), b.shapes[0].world_from_object.point({0, 0, 0}));
    EXPECT_EQ(a.shapes[0].material, b.shapes[0].material);
    EXPECT_EQ(to_string(Place(a.shapes[0].place)), "scene:7");
    EXPECT_TRUE(a.files.empty());
}

TEST(DirectiveSequence, RefusesWhatAFileMayNotSay) {
    const auto message = [](std::string_view directive, std::vector<std::string> texts, std::vector<double> numbers,
                            std::vector<Parameter> parameters) -> std::string {
        try {
            DirectiveSequence sequence("scene", ".");
            sequence.add("WorldBegin", {}, {}, {});
            sequence.add(directive, std::move(texts), numbers, std::move(parameters));
            sequence.finish();
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_NE(message("Nothing", {}, {}, {}).find("scene:2"), std::string::npos);
    EXPECT_NE(message("Film", {"rgb"}, {}, {}).find("not allowed after WorldBegin"), std::string::npos);
    EXPECT_NE(message("Shape", {}, {}, {}), "accepted");
    EXPECT_NE(message("Shape", {"sphere", "sphere"}, {}, {}), "accepted");
    EXPECT_NE(message("Shape", {"sphere"}, {1}, {}), "accepted");
    EXPECT_NE(message("Translate", {}, {1, 2}, {}), "accepted");
    EXPECT_NE(message("Transform", {}, std::vector<double>(15), {}), "accepted");
    EXPECT_NE(message("AttributeBegin", {"x"}, {}, {}), "accepted");
    EXPECT_NE(message("AttributeBegin", {}, {}, {}), "accepted");  // not closed
    EXPECT_NE(message("Import", {"x"}, {}, {}), "accepted");
    EXPECT_NE(message("ActiveTransform", {"x"}, {}, {}), "accepted");
    EXPECT_NE(message("Texture", {"a", "b"}, {}, {}), "accepted");
    EXPECT_NE(message("Shape", {"sphere"}, {}, {parameter(ParameterType::point3, "P", std::vector<float>{1, 2})}),
              "accepted");
    EXPECT_NE(message("Shape", {"sphere"}, {}, {parameter(ParameterType::real, "radius", std::vector<float>{})}),
              "accepted");
    EXPECT_EQ(message("Shape", {"sphere"}, {}, {}), "accepted");
}

TEST(Directives, AreFoundByTheirNames) {
    for (const char* name : {"Accelerator", "CoordSysTransform", "CoordinateSystem", "Film", "Shape", "WorldBegin"}) {
        ASSERT_TRUE(find_directive(name)) << name;
        EXPECT_EQ(find_directive(name)->name, name);
    }
    for (const char* name : {"", "A", "Shap", "Shapes", "shape", "Zzz"}) {
        EXPECT_FALSE(find_directive(name)) << name;
    }
}

}  // namespace
}  // namespace wend::pbrt
