#include <tests/io/pbrt_support.h>
#include <wend/io/pbrt/parser.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace wend::pbrt {
namespace {

/// The parameters of a film written on line 2, after 11 columns of directive.
ParameterSet parameters(const std::string& text) {
    return parse_string("# a film\nFilm \"rgb\" " + text + "\nWorldBegin", {}, "t.pbrt").film.parameters;
}

std::string parse_message(const std::string& text) {
    return message_of([&] { parameters(text); });
}

TEST(PbrtParameters, SingleValuesBareAndBracketed) {
    const ParameterSet p = parameters(
        "\"float a\" 1.5 \"float b\" [ 2.5 ] \"integer c\" 3 \"integer d\" [-4] \"bool e\" true \"bool f\" [ false ] "
        "\"bool g\" \"true\" \"bool h\" [\"false\"] \"string i\" \"x y\" \"string j\" [ \"z\" ]");
    EXPECT_EQ(p.get_float("a", 0), 1.5f);
    EXPECT_EQ(p.get_float("b", 0), 2.5f);
    EXPECT_EQ(p.get_int("c", 0), 3);
    EXPECT_EQ(p.get_int("d", 0), -4);
    EXPECT_TRUE(p.get_bool("e", false));
    EXPECT_FALSE(p.get_bool("f", true));
    EXPECT_TRUE(p.get_bool("g", false));
    EXPECT_FALSE(p.get_bool("h", true));
    EXPECT_EQ(p.get_string("i", ""), "x y");
    EXPECT_EQ(p.get_string("j", ""), "z");
    EXPECT_TRUE(p.unused().empty());
}

TEST(PbrtParameters, AbsentOnesTakeTheDefault) {
    const ParameterSet p = parameters("");
    EXPECT_EQ(p.get_float("x", 7), 7);
    EXPECT_EQ(p.get_string("x", "d"), "d");
    EXPECT_EQ(p.get_point3("x", Vec3(1, 2, 3)), Vec3(1, 2, 3));
    EXPECT_FALSE(p.get_colour("x"));
    EXPECT_TRUE(p.get_floats("x").empty());
    EXPECT_FALSE(p.has("x"));
    EXPECT_EQ(p.place_of("x").line, 2);
    EXPECT_EQ(p.place_of("x").column, 1);
}

TEST(PbrtParameters, PointsVectorsAndNormals) {
    const ParameterSet p = parameters(
        "\"point2 a\" [1 2] \"vector2 b\" [3 4] \"point3 c\" [1 2 3] \"point d\" [4 5 6] \"vector3 e\" [1 0 0] "
        "\"vector f\" [0 1 0] \"normal3 g\" [0 0 1] \"normal h\" [0 0 1 0 1 0]");
    EXPECT_EQ(p.get_point2("a", {}), Vec2(1, 2));
    EXPECT_EQ(p.get_vector2("b", {}), Vec2(3, 4));
    EXPECT_EQ(p.get_point3("c", {}), Vec3(1, 2, 3));
    EXPECT_EQ(p.get_point3("d", {}), Vec3(4, 5, 6));
    EXPECT_EQ(p.get_vector3("e", {}), Vec3(1, 0, 0));
    EXPECT_EQ(p.get_vector3("f", {}), Vec3(0, 1, 0));
    EXPECT_EQ(p.get_normal3("g", {}), Vec3(0, 0, 1));
    EXPECT_EQ(p.get_normal3s("h"), list<Vec3>(Vec3(0, 0, 1), Vec3(0, 1, 0)));
    EXPECT_EQ(p.get_point2s("a"), list<Vec2>(Vec2(1, 2)));
    EXPECT_EQ(p.get_vector2s("b"), list<Vec2>(Vec2(3, 4)));
    EXPECT_EQ(p.get_point3s("c"), list<Vec3>(Vec3(1, 2, 3)));
    EXPECT_EQ(p.get_vector3s("e"), list<Vec3>(Vec3(1, 0, 0)));
}

TEST(PbrtParameters, Lists) {
    const ParameterSet p = parameters(
        "\"float a\" [1 2 3] \"integer b\" [4 5] \"bool c\" [true false] \"string d\" [\"x\" \"y\"] \"rgb e\" [0 0 1 1 "
        "0 0]");
    EXPECT_EQ(p.get_floats("a"), list<float>(1, 2, 3));
    EXPECT_EQ(p.get_ints("b"), list<int>(4, 5));
    EXPECT_EQ(p.get_bools("c"), list<bool>(true, false));
    EXPECT_EQ(p.get_strings("d"), list<std::string>("x", "y"));
    ASSERT_EQ(p.get_rgbs("e").size(), 2u);
    EXPECT_EQ(p.get_rgbs("e")[1].value, Rgb(1, 0, 0));
}

TEST(PbrtParameters, ColoursOfEveryForm) {
    const ParameterSet p = parameters(
        "\"rgb a\" [.1 .2 .3] \"spectrum b\" [400 1 500 2] \"spectrum c\" \"metal-Ag-eta\" \"spectrum d\" [\"x.spd\"] "
        "\"blackbody e\" 5500 \"texture f\" \"wood\"");
    EXPECT_EQ(std::get<RgbColour>(*p.get_colour("a")).value, Rgb(.1f, .2f, .3f));
    const auto sampled = std::get<SampledSpectrum>(*p.get_colour("b"));
    EXPECT_EQ(sampled.wavelengths, list<float>(400, 500));
    EXPECT_EQ(sampled.values, list<float>(1, 2));
    EXPECT_EQ(std::get<NamedSpectrum>(*p.get_colour("c")).name, "metal-Ag-eta");
    EXPECT_EQ(std::get<NamedSpectrum>(*p.get_colour("d")).name, "x.spd");
    EXPECT_EQ(std::get<Blackbody>(*p.get_colour("e")).temperature, 5500);
    EXPECT_EQ(std::get<TextureName>(*p.get_colour_or_texture("f")).name, "wood");
    EXPECT_TRUE(std::holds_alternative<ColourValue>(*p.get_colour_or_texture("a")));
    EXPECT_EQ(p.get_texture("f")->name, "wood");
    EXPECT_THROW(p.get_colour("f"), InputError);
}

TEST(PbrtParameters, FloatOrTexture) {
    const ParameterSet p = parameters("\"float a\" 2 \"texture b\" \"bumps\"");
    EXPECT_EQ(std::get<float>(p.get_float_or_texture("a", 0)), 2);
    EXPECT_EQ(std::get<TextureName>(p.get_float_or_texture("b", 0)).name, "bumps");
    EXPECT_EQ(std::get<float>(p.get_float_or_texture("c", 3)), 3);
}

TEST(PbrtParameters, RemembersTheColourSpace) {
    const Description d =
        parse_string("ColorSpace \"rec2020\" Film \"rgb\" \"rgb a\" [1 0 0] WorldBegin", {}, "t.pbrt");
    EXPECT_EQ(std::get<RgbColour>(*d.film.parameters.get_colour("a")).space, ColourSpace::rec2020);
}

TEST(PbrtParameters, WrongTypesAreErrorsAtTheParameter) {
    const ParameterSet p = parameters("\"float fov\" 30 \"float L\" 1");
    EXPECT_EQ(message_of([&] { p.get_int("fov", 0); }), "t.pbrt:2:12: error: \"fov\": expected integer, found float");
    EXPECT_EQ(message_of([&] { p.get_colour("L"); }),
              "t.pbrt:2:27: error: \"L\": expected rgb, spectrum or blackbody, found float");
}

TEST(PbrtParameters, WrongCountsAreErrorsAtTheParameter) {
    const ParameterSet p = parameters("\"float fov\" [1 2 3] \"point3 p\" [1 2 3 4 5 6] \"rgb c\" [1 1 1 2 2 2]");
    EXPECT_EQ(message_of([&] { p.get_float("fov", 0); }), "t.pbrt:2:12: error: \"fov\": expected one float, found 3");
    EXPECT_PRED2(contains, message_of([&] { p.get_point3("p", {}); }), "expected one point3, found 2");
    EXPECT_PRED2(contains, message_of([&] { p.get_colour("c"); }), "expected one rgb, found 2");
}

TEST(PbrtParameters, MalformedOnesAreErrors) {
    EXPECT_PRED2(contains, parse_message("\"point3 p\" [1 2]"), "t.pbrt:2:12: error: \"p\": point3 takes groups of 3");
    EXPECT_PRED2(contains, parse_message("\"spectrum s\" [400 1 500]"), "groups of 2");
    EXPECT_PRED2(contains, parse_message("\"float f\" []"), "t.pbrt:2:12: error: \"f\": the list of values is empty");
    EXPECT_PRED2(contains, parse_message("\"spectrum s\" []"), "empty");
    EXPECT_PRED2(contains, parse_message("\"flaot f\" 1"), "unknown parameter type; known: float, integer");
    EXPECT_PRED2(contains, parse_message("\"fov\" 1"), "expected a parameter, \"type name\", found \"fov\"");
    EXPECT_PRED2(contains, parse_message("\"float a b\" 1"), "expected a parameter");
    EXPECT_PRED2(contains, parse_message("\"\" 1"), "expected a parameter");
    EXPECT_PRED2(contains, parse_message("\"float f\" \"one\""), "t.pbrt:2:22: error: expected a number");
    EXPECT_PRED2(contains, parse_message("\"float f\" [1 [2]]"), "t.pbrt:2:25: error: expected a number, found '['");
    EXPECT_PRED2(contains, parse_message("\"integer i\" 1.5"), "expected an integer, found \"1.5\"");
    EXPECT_PRED2(contains, parse_message("\"bool b\" 1"), "expected true or false, found \"1\"");
    EXPECT_PRED2(contains, parse_message("\"string s\" abc"), "expected a quoted string");
    EXPECT_PRED2(contains, parse_message("\"spectrum s\" 5"), "expected '['");
    EXPECT_PRED2(contains, parse_message("\"spectrum s\" [400 \"x\"]"), "expected a number");
    EXPECT_PRED2(contains, parse_message("\"float f\" [1 2"), "expected a number, found \"WorldBegin\"");
    EXPECT_PRED2(contains, parse_message("\"float f\" 1e39"), "not a finite number");
    EXPECT_PRED2(contains, parse_message("\"float f\" nan"), "not a finite number");
}

TEST(PbrtParameters, OfDuplicatesTheLastCountsWithAWarningThatNamesBothPlaces) {
    const Description d = parse_string(
        "WorldBegin\nShape \"a\" \"float f\" 1 \"float g\" 3 \"integer f\" 2\n"
        "Shape \"a\" \"float f\" 1 \"float f\" 4",
        {}, "t.pbrt");
    EXPECT_EQ(d.shapes[0].parameters.get_int("f", 0), 2);
    EXPECT_EQ(d.shapes[0].parameters.get_float("g", 0), 3);
    EXPECT_EQ(d.shapes[1].parameters.get_float("f", 0), 4);
    ASSERT_EQ(d.warnings.size(), 1u);
    EXPECT_EQ(d.warnings[0],
              "t.pbrt:2:35: warning: \"f\" is given twice: the last one counts, not that at t.pbrt:2:11");
}

TEST(PbrtParameters, SpectraAndTemperaturesMustMakeSense) {
    EXPECT_PRED2(contains, message_of([] { parameters("\"spectrum s\" [500 1 400 1]").get_colour("s"); }),
                 "t.pbrt:2:12: error: \"s\": the wavelengths must increase");
    EXPECT_PRED2(contains, message_of([] { parameters("\"blackbody t\" 0").get_colour("t"); }), "above 0 kelvin");
}

TEST(PbrtParameters, TellsWhatNobodyAskedFor) {
    const ParameterSet p = parameters("\"float a\" 1 \"float b\" 2 \"float c\" 3");
    p.get_float("b", 0);
    EXPECT_EQ(p.type_of("c"), ParameterType::real);
    const auto unused = p.unused();
    ASSERT_EQ(unused.size(), 2u);
    EXPECT_EQ(unused[0]->name, "a");
    EXPECT_EQ(unused[1]->name, "c");
    EXPECT_EQ(unused[1]->place.column, 36);
}

TEST(PbrtParameters, LargeArraysMoveOut) {
    Description d = parse_string(
        "WorldBegin Shape \"trianglemesh\" \"point3 P\" [1 2 3 4 5 6] \"integer indices\" [0 1 2]", {}, "t.pbrt");
    ParameterSet& p = d.shapes[0].parameters;
    EXPECT_THROW(p.take_numbers("P", ParameterType::normal3), InputError);
    EXPECT_EQ(p.take_numbers("P", ParameterType::point3), list<float>(1, 2, 3, 4, 5, 6));
    EXPECT_TRUE(p.get_point3s("P").empty());
    EXPECT_EQ(p.take_ints("indices"), list<int>(0, 1, 2));
    EXPECT_TRUE(p.take_ints("absent").empty());
    EXPECT_TRUE(p.unused().empty());
}

TEST(PbrtParameters, SharedArraysAreCopiedOut) {
    Description d =
        parse_string("WorldBegin Attribute \"shape\" \"float a\" [1 2] Shape \"x\" Shape \"y\"", {}, "t.pbrt");
    EXPECT_EQ(d.shapes[0].parameters.take_numbers("a", ParameterType::real), list<float>(1, 2));
    EXPECT_EQ(d.shapes[1].parameters.take_numbers("a", ParameterType::real), list<float>(1, 2));
}

TEST(PbrtParameters, AbsurdlyManyAreAnError) {
    std::string text;
    for (int i = 0; i < 1000; ++i) {
        text += " \"float p" + std::to_string(i) + "\" 1";
    }
    EXPECT_PRED2(contains, parse_message(text), "more than 256 parameters");
}

}  // namespace
}  // namespace wend::pbrt
