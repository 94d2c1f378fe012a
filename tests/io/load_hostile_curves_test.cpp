// Curves that are broken or that lie: a clear error with its place, or what is left of them, and no crash, hang or
// heap of memory.
#include "load_support.h"
#include "pbrt_support.h"

#include <wend/scene/curve.h>
#include <wend/scene/scene.h>

#include <gtest/gtest.h>

#include <string>
#include <variant>

namespace wend {
namespace {

using pbrt::contains;
using pbrt::message_of;

const std::string four_points = "\"point3 P\" [0 0 0 1 0 0 1 1 0 0 1 0] ";
const std::string one_place = "\"point3 P\" [1 1 1 1 1 1 1 1 1 1 1 1] ";

std::string curve_error_of(const std::string& parameters, const std::string& before = "") {
    return message_of([&] { test::load_text(before + "Shape \"curve\" " + parameters); });
}

/// What is wrong with a curve, and what is to be said of it.
struct Hostile {
    std::string parameters;
    const char* message;
};

void expect_errors(std::initializer_list<Hostile> cases) {
    for (const Hostile& hostile : cases) {
        SCOPED_TRACE(hostile.parameters);
        const std::string error = curve_error_of(hostile.parameters);
        EXPECT_PRED2(contains, error, hostile.message);
        EXPECT_PRED2(contains, error, "test.pbrt:3:");
    }
}

TEST(HostileCurves, CountsThatDoNotFit) {
    expect_errors({{"", "0 points \"P\" make no curve of degree 3"},
                   {"\"point3 P\" [0 0 0 1 0]", "point3 takes groups of 3 numbers, but there are 5"},
                   {"\"point3 P\" [0 0 0 1 0 0 1 1 0]", "3 points \"P\" make no curve of degree 3"},
                   {"\"point3 P\" [0 0 0 1 0 0 1 1 0] \"string basis\" \"bspline\"", "in the basis \"bspline\""},
                   {"\"point3 P\" [0 0 0 1 0 0] \"integer degree\" 2", "2 points \"P\" make no curve of degree 2"},
                   {four_points + "\"float width\" [1 2]", "expected one float, found 2"},
                   {four_points + "\"string type\" \"ribbon\" \"normal3 N\" [0 0 1]", "needs 2 normals \"N\", not 1"},
                   {four_points + "\"string type\" \"ribbon\" \"normal3 N\" [0 0 1 0 0 1 0 0 1]", "needs 2 normals"}});
}

TEST(HostileCurves, NumbersThatAreNone) {
    expect_errors({{four_points + "\"float width\" nan", "\"nan\" is not a finite number"},
                   {four_points + "\"float width0\" -nan", "\"-nan\" is not a finite number"},
                   {four_points + "\"float width\" 1e39", "\"1e39\" is not a finite number that a float can hold"},
                   {four_points + "\"float width1\" -1", "\"width1\" must not be below 0"},
                   {"\"point3 P\" [0 0 0 nan 0 0 1 1 0 0 1 0]", "\"nan\" is not a finite number"},
                   {"\"point3 P\" [0 0 0 1e39 0 0 1 1 0 0 1 0]", "\"1e39\" is not a finite number"},
                   {four_points + "\"string type\" \"ribbon\" \"normal3 N\" [0 0 1 0 0 0]", "has no direction"},
                   {four_points + "\"string type\" \"round\" \"float width\" 3e38", "coordinates must stay within"}});
    // What is finite in the file need not be in the world.
    EXPECT_PRED2(contains, curve_error_of(four_points, "Scale 1e30 1e30 1e30 "), "coordinates must stay within");
    EXPECT_PRED2(contains, curve_error_of(four_points, "Scale 1e20 1e20 1e20 Scale 1e20 1e20 1e20 "), "not finite");
    EXPECT_PRED2(contains, curve_error_of("\"float width\" 3e38 " + four_points, "Scale 1e3 1e3 1e3 "),
                 "must stay within");
}

TEST(HostileCurves, WordsThatThereAreNot) {
    expect_errors({{four_points + "\"string basis\" \"frob\"", "known are bezier, bspline"},
                   {four_points + "\"integer degree\" 2000000000", "is 2 or 3, not 2000000000"},
                   {four_points + "\"integer degree\" -1", "is 2 or 3, not -1"},
                   {four_points + "\"float degree\" 2.5", "expected integer, found float"},
                   {four_points + "\"string width\" \"thick\"", "expected float, found string"}});
}

TEST(HostileCurves, AbsurdSplitsAreNoMemory) {
    for (const char* depth : {"1000000000", "-5", "2147483647"}) {
        const LoadedScene loaded =
            test::load_text("Shape \"curve\" " + four_points + "\"integer splitdepth\" " + depth);
        ASSERT_EQ(loaded.scene.surfaces.size(), 1u);
        EXPECT_LE(std::get<CurveSet>(*loaded.scene.surfaces[0].shape).primitive_count(), 16u) << depth;
    }
}

TEST(HostileCurves, ThoseWithoutLengthOrWidthGiveNoNonsense) {
    for (const char* type : {"flat", "cylinder", "round"}) {
        for (const std::string& text :
             {one_place, four_points + "\"float width\" 0 ", one_place + "\"float width\" 0 "}) {
            SCOPED_TRACE(text + type);
            const LoadedScene loaded = test::load_text("Shape \"curve\" " + text + "\"string type\" \"" + type + "\"");
            ASSERT_EQ(loaded.scene.surfaces.size(), 1u);
            const Scene scene(loaded.scene);
            for (const Vec3& origin : {Vec3(1, 1, 9), Vec3(1, 0, 9), Vec3(0.5f, 0, 9)}) {
                const auto hit = scene.intersect({origin, {0, 0, -1}});
                EXPECT_TRUE(!hit || (is_finite(hit->position) && is_finite(hit->normal)));
            }
        }
    }
}

}  // namespace
}  // namespace wend
