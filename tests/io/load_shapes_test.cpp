#include "load_support.h"
#include "pbrt_support.h"

#include <tests/support/scratch_folder.h>
#include <wend/scene/scene.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace wend {
namespace {

using pbrt::contains;
using pbrt::message_of;
using test::load_text;
using test::warnings_with;

const std::string one_triangle = "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0 ] ";

/// The normal where a ray from `origin` along `direction` first meets the scene.
Vec3 normal_seen(const std::string& world, const Vec3& origin, const Vec3& direction) {
    const Scene scene(load_text(world).scene);
    const auto hit = scene.intersect({origin, direction});
    EXPECT_TRUE(hit) << world;
    return hit ? hit->normal : Vec3(0, 0, 0);
}

TEST(LoadShapes, MeshNormalsFollowTheOrderOfVertices) {
    const auto z = [](const std::string& before) {
        return normal_seen(before + one_triangle + "\"integer indices\" [ 0 1 2 ]", {0.2f, 0.2f, 5}, {0, 0, -1}).z;
    };
    EXPECT_NEAR(z(""), 1, 1e-6f);
    EXPECT_NEAR(z("ReverseOrientation "), -1, 1e-6f);
    // Mirrored in z, the normal is mirrored with the triangle, as a normal of the object's.
    EXPECT_NEAR(z("Scale 1 1 -1 "), -1, 1e-6f);
    EXPECT_NEAR(z("ReverseOrientation Scale 1 1 -1 "), 1, 1e-6f);
    EXPECT_NEAR(normal_seen("Scale -1 1 1 " + one_triangle, {-0.2f, 0.2f, 5}, {0, 0, -1}).z, 1, 1e-6f);
}

TEST(LoadShapes, GivenNormalsDecideTheSide) {
    const auto z = [](const std::string& before) {
        return normal_seen(before + one_triangle + "\"normal N\" [ 0 0 -1  0 0 -1  0 0 -1 ]", {0.2f, 0.2f, 5},
                           {0, 0, -1})
            .z;
    };
    EXPECT_NEAR(z(""), -1, 1e-6f);
    EXPECT_NEAR(z("ReverseOrientation "), 1, 1e-6f);
    EXPECT_NEAR(z("Scale 1 1 -1 "), 1, 1e-6f);
}

TEST(LoadShapes, NormalsMapByTheInverseTranspose) {
    const LoadedScene loaded = load_text("Scale 2 1 1 " + one_triangle + "\"normal N\" [ 1 0 1  1 0 1  1 0 1 ]");
    const auto& mesh = std::get<TriangleMesh>(*loaded.scene.surfaces[0].shape);
    EXPECT_NEAR(length(mesh.normals[0] - normalize(Vec3(0.5f, 0, 1))), 0, 1e-6f);
}

TEST(LoadShapes, GivenTangentsDecideHowASurfaceIsBrushed) {
    const std::string along_y = one_triangle + "\"vector S\" [ 0 1 0  0 1 0  0 1 0 ] ";
    const auto tangent = [](const std::string& world) {
        const Scene scene(load_text(world).scene);
        return scene.intersect({Vec3(0.2f, 0.2f, 5), Vec3(0, 0, -1)})->shading.s;
    };
    EXPECT_NEAR(tangent(one_triangle + "\"point2 uv\" [ 0 0  1 0  0 1 ]").x, 1, 1e-6f);
    EXPECT_NEAR(tangent(along_y + "\"point2 uv\" [ 0 0  1 0  0 1 ]").y, 1, 1e-6f);
    EXPECT_NEAR(tangent("Rotate 90 0 0 1 Translate 0 -0.4 0 " + along_y).x, -1, 1e-6f);
    EXPECT_EQ(warnings_with(load_text(one_triangle + "\"vector S\" [ 0 1 0 ]"), "\"S\" has not one value a vertex"), 1);
}

TEST(LoadShapes, TheCameraSeesThemAsTheySay) {
    const auto view = [](const std::string& parameters) {
        return load_text(one_triangle + parameters).scene.surfaces[0].view;
    };
    EXPECT_EQ(view(""), CameraView::shown);
    EXPECT_EQ(view("\"string cameraview\" \"hidden\""), CameraView::hidden);
    EXPECT_EQ(view("\"string cameraview\" \"holdout\""), CameraView::held_out);
    EXPECT_PRED2(contains, message_of([&] { view("\"string cameraview\" \"seen\""); }),
                 "known are shown, hidden, holdout");
    const std::string fog = "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" MediumInterface \"fog\" \"\" ";
    EXPECT_EQ(warnings_with(load_text(fog + one_triangle + "\"string cameraview\" \"hidden\""),
                            "what bounds a medium is not hidden"),
              1);
}

TEST(LoadShapes, QuadricNormals) {
    const auto z = [](const std::string& world) { return normal_seen(world, {0.1f, 0.1f, 5}, {0, 0, -1}).z; };
    EXPECT_GT(z("Shape \"sphere\""), 0);
    EXPECT_LT(z("ReverseOrientation Shape \"sphere\""), 0);
    // As in pbrt, mirroring turns quadrics inside out.
    EXPECT_LT(z("Scale -1 1 1 Shape \"sphere\""), 0);
    EXPECT_NEAR(z("Shape \"disk\" \"float height\" 1"), 1, 1e-6f);
    EXPECT_NEAR(z("Rotate 180 1 0 0 Shape \"disk\""), -1, 1e-6f);
    EXPECT_NEAR(z("ReverseOrientation Shape \"disk\""), -1, 1e-6f);
    EXPECT_GT(normal_seen("Shape \"cylinder\"", {5, 0.01f, 0}, {-1, 0, 0}).x, 0.9f);
    EXPECT_LT(normal_seen("Scale 1 1 -1 Shape \"cylinder\"", {5, 0.01f, 0}, {-1, 0, 0}).x, -0.9f);
}

TEST(LoadShapes, QuadricParameters) {
    const LoadedScene loaded = load_text(
        "Shape \"sphere\" \"float radius\" 2 \"float zmin\" -1 \"float zmax\" 5 \"float phimax\" 90 "
        "Shape \"disk\" \"float height\" 3 \"float radius\" 2 \"float innerradius\" 1");
    const auto& sphere = std::get<Sphere>(std::get<Quadric>(*loaded.scene.surfaces[0].shape).shape);
    EXPECT_EQ(sphere.radius, 2);
    EXPECT_EQ(sphere.z_min, -1);
    EXPECT_EQ(sphere.z_max, 2);
    EXPECT_NEAR(sphere.phi_max, 0.5f * pi, 1e-6f);
    const auto& disk = std::get<Disk>(std::get<Quadric>(*loaded.scene.surfaces[1].shape).shape);
    EXPECT_EQ(disk.height, 3);
    EXPECT_EQ(disk.inner_radius, 1);
    EXPECT_PRED2(contains, message_of([] { load_text("Shape \"sphere\" \"float radius\" -1"); }), "above 0");
}

TEST(LoadShapes, QuadricsOfNoAreaAreLeftOut) {
    for (const std::string shape :
         {"\"sphere\" \"float radius\" 0", "\"sphere\" \"float zmin\" 2 \"float zmax\" 3",
          "\"sphere\" \"float phimax\" 0", "\"disk\" \"float innerradius\" 2", "\"disk\" \"float radius\" 0",
          "\"cylinder\" \"float zmin\" 1 \"float zmax\" 1", "\"cylinder\" \"float radius\" 0"}) {
        const LoadedScene loaded = load_text("AreaLightSource \"diffuse\" Shape \"sphere\" Shape " + shape);
        EXPECT_EQ(loaded.scene.surfaces.size(), 1u) << shape;
        EXPECT_EQ(loaded.scene.lights.size(), 1u) << shape;
        EXPECT_EQ(warnings_with(loaded, "it is left out"), 1) << shape;
        EXPECT_EQ(loaded.warnings.size(), 1u) << shape;
    }
}

TEST(LoadShapes, RefusesBrokenMeshesWithTheirPlace) {
    const auto message = [](const std::string& shape) { return message_of([&] { load_text(shape); }); };
    EXPECT_PRED2(contains, message("Shape \"trianglemesh\""),
                 "test.pbrt:3:1: error: Shape \"trianglemesh\" needs the parameter \"point3 P\"");
    EXPECT_PRED2(contains, message(one_triangle + "\"integer indices\" [ 0 1 3 ]"),
                 "the index 3 is out of range: there are 3 vertices");
    EXPECT_PRED2(contains, message(one_triangle + "\"integer indices\" [ 0 1 -1 ]"), "the index -1 is out of range");
    EXPECT_PRED2(contains, message("Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0  1 1 0 ]"), "indices");
    EXPECT_PRED2(contains, message("Scale 1e30 1 1 Shape \"trianglemesh\" \"point3 P\" [ 1e30 0 0  1 0 0  0 1 0 ]"),
                 "not finite");
    EXPECT_PRED2(contains, message("Shape \"plymesh\""), "\"string filename\"");
    EXPECT_PRED2(contains, message("Shape \"plymesh\" \"string filename\" \"none-such.ply\""), "there is no file");
    EXPECT_PRED2(contains, message("Shape \"frob\""), "Shape \"frob\" is unknown");
}

TEST(LoadShapes, IndicesBeyondTheLastFaceAreLeftOut) {
    const LoadedScene loaded = load_text(one_triangle + "\"integer indices\" [ 0 1 2 0 1 ]");
    EXPECT_EQ(std::get<TriangleMesh>(*loaded.scene.surfaces[0].shape).triangle_count(), 1u);
    EXPECT_EQ(warnings_with(loaded, "no multiple of 3"), 1);
    const LoadedScene patches = load_text(
        "Shape \"bilinearmesh\" \"integer indices\" [ 0 1 2 3 0 ] \"point3 P\" [ 0 0 0  1 0 0  0 1 0  1 1 0 ]");
    EXPECT_EQ(std::get<TriangleMesh>(*patches.scene.surfaces[0].shape).triangle_count(), 2u);
    EXPECT_EQ(warnings_with(patches, "no multiple of 4"), 1);
}

TEST(LoadShapes, LongerNormalsCountMore) {
    const auto middle = [](const std::string& normals) {
        const Scene scene(load_text(one_triangle + "\"normal N\" " + normals).scene);
        return scene.intersect({{0.5f, 0, 1}, {0, 0, -1}})->shading.n;
    };
    EXPECT_LT(length(middle("[ 0 1 1  0 0 3  0 0 1 ]") - normalize(Vec3(0, 1, 4))), 1e-5f);
    EXPECT_LT(length(middle("[ 0 2 2  0 0 6  0 0 0 ]") - normalize(Vec3(0, 1, 4))), 1e-5f);
    // Those of one length have it no longer.
    const LoadedScene even = load_text(one_triangle + "\"normal N\" [ 0 0 5  0 5 0  5 0 0 ]");
    EXPECT_EQ(std::get<TriangleMesh>(*even.scene.surfaces[0].shape).normals[1], Vec3(0, 1, 0));
}

TEST(LoadShapes, MeshesMayChangeTheirShape) {
    const std::string moving = one_triangle + "\"point3 P1\" [ 0 0 1  1 0 1  0 1 1 ] ";
    const LoadedScene loaded =
        load_text("Translate 0 0 7 " + moving + one_triangle + "ReverseOrientation Scale 2 2 1 " + moving +
                  "\"normal N\" [ 0 0 1  0 0 1  0 0 1 ] " + "\"normal N1\" [ 0 2 2  0 2 2  0 2 2 ]");
    const auto mesh = [&](std::size_t i) { return std::get<TriangleMesh>(*loaded.scene.surfaces[i].shape); };
    ASSERT_TRUE(mesh(0).is_moving());
    EXPECT_FALSE(mesh(1).is_moving());
    EXPECT_EQ(mesh(0).triangle(0, 0)[1], Vec3(1, 0, 7));
    EXPECT_EQ(mesh(0).triangle(0, 1)[1], Vec3(1, 0, 8));
    EXPECT_EQ(mesh(0).triangle(0, 0.5f)[1], Vec3(1, 0, 7.5f));
    EXPECT_EQ(bounds(*loaded.scene.surfaces[0].shape).max.z, 8);
    EXPECT_EQ(mesh(2).corner_normals(0, 0)[0], Vec3(0, 0, -1));
    EXPECT_LT(length(mesh(2).corner_normals(0, 1)[0] + normalize(Vec3(0, 0.5f, 1))), 1e-6f);
    const auto message = [](const std::string& shape) { return message_of([&] { load_text(shape); }); };
    EXPECT_PRED2(contains, message(one_triangle + "\"point3 P1\" [ 0 0 1 ]"), "\"P1\" has 1 values for 3 vertices");
    EXPECT_PRED2(contains, message(moving + "\"normal N\" [ 0 0 1  0 0 1  0 0 1 ]"), "\"N1\" has 0 values");
    EXPECT_PRED2(contains, message(one_triangle + "\"normal N1\" [ 0 0 1 ]"), "\"N1\" has 1 values");
    EXPECT_PRED2(contains, message(one_triangle + "\"point3 P1\" [ 0 0 1e20  1 0 1  0 1 1 ]"), "must stay within");
}

TEST(LoadShapes, PlyMesh) {
    const auto directory = std::filesystem::temp_directory_path();
    std::ofstream(directory / "wend_load_test.ply")
        << "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 "
           "3\n";
    const LoadedScene loaded =
        load_text("Translate 0 0 7 Shape \"plymesh\" \"string filename\" \"wend_load_test.ply\"", "", {}, directory);
    const auto& mesh = std::get<TriangleMesh>(*loaded.scene.surfaces[0].shape);
    EXPECT_EQ(mesh.triangle_count(), 2u);
    EXPECT_EQ(mesh.vertex(0, 0), Vec3(0, 0, 7));
}

/// A PLY file of a quadrilateral between two triangles, far apart.
std::string mixed_ply() {
    return "ply\nformat ascii 1.0\nelement vertex 10\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 3\nproperty list uchar int vertex_indices\nend_header\n10 0 0\n11 0 0\n11 1 0\n"
           "0 0 0\n2 0 0\n2 2 0\n0 2 0\n20 0 0\n21 0 0\n21 1 0\n3 0 1 2\n4 3 4 5 6\n3 7 8 9\n";
}

TEST(LoadShapes, QuadrilateralsOfPlyFilesAreOneShapeEach) {
    const test::ScratchFolder folder;
    folder.write("m.ply", mixed_ply());
    const std::string shape = "Shape \"plymesh\" \"string filename\" \"m.ply\"";
    const LoadedScene loaded = load_text(shape, "", {}, folder.path());
    const auto& mesh = std::get<TriangleMesh>(*loaded.scene.surfaces[0].shape);
    EXPECT_EQ(mesh.indices, (std::vector<std::uint32_t>{0, 1, 2, 7, 8, 9, 3, 4, 5, 3, 5, 6}));
    // The parameters of a patch where there are no others.
    const Scene scene(loaded.scene);
    for (const Vec2& at : {Vec2(0.25f, 0.75f), Vec2(0.75f, 0.25f)}) {
        const auto hit = scene.intersect({{2 * at.x, 2 * at.y, 1}, {0, 0, -1}});
        ASSERT_TRUE(hit);
        EXPECT_LT((hit->uv - at).length(), 1e-5f);
    }
    const auto triangle_hit = scene.intersect({{20.75f, 0.25f, 1}, {0, 0, -1}});
    ASSERT_TRUE(triangle_hit);
    EXPECT_LT((triangle_hit->uv - Vec2(0.75f, 0.25f)).length(), 1e-5f);
    // One power each.
    const LoadedScene lamp = load_text("AreaLightSource \"diffuse\" \"float power\" 3 " + shape, "", {}, folder.path());
    float power = 0;
    for (const Light& light : lamp.scene.lights) {
        power += light_power(light, 0);
    }
    EXPECT_NEAR(power, 9, 1e-4f);
    const auto& half = std::get<TriangleLight>(lamp.scene.lights.back());
    EXPECT_EQ(half.uv1, Vec2(1, 1));
    EXPECT_EQ(half.uv2, Vec2(0, 1));
}

TEST(LoadShapes, MeshesWithoutTextureCoordinatesAreBrushedAlongTheirFirstSide) {
    const auto along = [](const std::string& material) {
        const Scene scene(load_text(material + " Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 3 0  -1 3 0 ]").scene);
        return scene.intersect({{0, 1, 1}, {0, 0, -1}})->shading.s;
    };
    const Vec3 side = normalize(Vec3(1, 3, 0));
    EXPECT_LT(length(along("Material \"conductor\" \"float uroughness\" .1 \"float vroughness\" .5") - side), 1e-5f);
    EXPECT_LT(length(along("Material \"coatedconductor\" \"float conductor.uroughness\" .1") - side), 1e-5f);
    EXPECT_LT(length(along("Material \"hair\"") - side), 1e-5f);
}

TEST(LoadShapes, NormalsOfPlyFilesThatAreNoneLeaveTheFaceFlat) {
    const auto directory = std::filesystem::temp_directory_path();
    std::ofstream(directory / "wend_load_normals.ply")
        << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
           "property float nx\nproperty float ny\nproperty float nz\n"
           "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 nan nan nan\n1 0 0 nan 0 1\n"
           "0 1 0 0 inf 0\n3 0 1 2\n";
    const LoadedScene loaded =
        load_text("Shape \"plymesh\" \"string filename\" \"wend_load_normals.ply\"", "", {}, directory);
    const Scene scene(loaded.scene);
    const auto hit = scene.intersect({{0.25f, 0.25f, 1}, {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->normal, Vec3(0, 0, 1));
    EXPECT_EQ(hit->shading.n, Vec3(0, 0, 1));
}

TEST(LoadShapes, CylindersAreExact) {
    const LoadedScene loaded = load_text(
        "Rotate 90 1 0 0 Shape \"cylinder\" \"float radius\" 2 \"float zmin\" 3 \"float zmax\" -1 \"float phimax\" "
        "270");
    EXPECT_TRUE(loaded.warnings.empty());
    const Scene scene(loaded.scene);
    // The axis is -y now; along it, from -3 to 1. What is missing has x > 0 and z < 0.
    const auto hit = scene.intersect({{-5, 0, 0.1f}, {1, 0, 0}});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->position.x, -std::sqrt(4 - 0.01f), 1e-5f);
    EXPECT_NEAR(dot(hit->normal, Vec3(hit->position.x, 0, hit->position.z)) / 2, 1, 1e-5f);
    EXPECT_NEAR(hit->uv.y, 0.25f, 1e-5f);
    const auto through_the_gap = scene.intersect({{5, 0, -0.1f}, {-1, 0, 0}});
    ASSERT_TRUE(through_the_gap);
    EXPECT_LT(through_the_gap->position.x, 0);
    EXPECT_FALSE(scene.intersect({{-5, 1.1f, 0}, {1, 0, 0}}));
    // What shines is a mesh, as lights are made of triangles.
    const LoadedScene light = load_text("AreaLightSource \"diffuse\" Shape \"cylinder\"");
    EXPECT_EQ(std::get<TriangleMesh>(*light.scene.surfaces[0].shape).triangle_count(), 512u);
    EXPECT_EQ(light.scene.lights.size(), 512u);
    EXPECT_EQ(warnings_with(light, "a prism of 256 sides"), 1);
}

TEST(LoadShapes, CurvedPatches) {
    const LoadedScene loaded = load_text(
        "Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0  1 1 1 ] "
        "Shape \"bilinearmesh\" \"point3 P\" [ 5 0 0  6 0 0  5 1 0  6 1 0 ]");
    EXPECT_TRUE(loaded.warnings.empty());
    EXPECT_EQ(std::get<TriangleMesh>(*loaded.scene.surfaces[1].shape).triangle_count(), 2u);
    const auto& mesh = std::get<TriangleMesh>(*loaded.scene.surfaces[0].shape);
    EXPECT_GT(mesh.triangle_count(), 100u);
    const Scene scene(loaded.scene);
    for (const float x : {0.13f, 0.5f, 0.77f}) {
        for (const float y : {0.21f, 0.64f, 0.98f}) {
            const auto hit = scene.intersect({{x, y, 5}, {0, 0, -1}});
            ASSERT_TRUE(hit);
            EXPECT_NEAR(hit->position.z, x * y, 1e-3f);
            EXPECT_NEAR(hit->uv.x, x, 1e-4f);
            EXPECT_NEAR(hit->uv.y, y, 1e-4f);
            EXPECT_LT(length(hit->shading.n - normalize(Vec3(-y, -x, 1))), 2e-3f);
        }
    }
}

TEST(LoadShapes, CurvesOfBothBasesAndDegrees) {
    const auto curves = [](const std::string& text) {
        return std::get<CurveSet>(*load_text("Shape \"curve\" " + text).scene.surfaces.at(0).shape);
    };
    const auto near = [](const Vec3& a, const Vec3& b) { EXPECT_LT(length(a - b), 1e-5f) << a << " " << b; };
    const std::string points = "\"point3 P\" [0 0 0 1 0 0 2 3 0 3 0 1 4 1 0 5 0 0 6 0 3] ";
    const CurveSet cubic = curves(points + "\"float width0\" 2 \"float width1\" 4 \"string type\" \"cylinder\"");
    ASSERT_EQ(cubic.segments.size(), 2u);
    EXPECT_EQ(cubic.kind, CurveSet::Kind::cylinder);
    EXPECT_EQ(cubic.segments[0].width[1], 3);
    near(cubic.segments[1].at(0), {3, 0, 1});
    near(cubic.segments[1].at(1), {6, 0, 3});
    const CurveSet quadratic = curves(points + "\"integer degree\" 2");
    ASSERT_EQ(quadratic.segments.size(), 3u);
    near(quadratic.segments[0].at(0.5f), Vec3(0, 0, 0) * 0.25f + Vec3(1, 0, 0) * 0.5f + Vec3(2, 3, 0) * 0.25f);
    const CurveSet spline = curves(points + "\"string basis\" \"bspline\"");
    ASSERT_EQ(spline.segments.size(), 4u);
    near(spline.segments[1].at(0), (Vec3(1, 0, 0) + Vec3(2, 3, 0) * 4.0f + Vec3(3, 0, 1)) / 6.0f);
    near(spline.segments[1].at(1), spline.segments[2].at(0));
    near(spline.segments[1].along(1), spline.segments[2].along(0));
    const CurveSet low = curves(points + "\"string basis\" \"bspline\" \"integer degree\" 2");
    ASSERT_EQ(low.segments.size(), 5u);
    near(low.segments[0].at(0.5f), Vec3(0, 0, 0) * 0.125f + Vec3(1, 0, 0) * 0.75f + Vec3(2, 3, 0) * 0.125f);
    EXPECT_EQ(curves(points + "\"string type\" \"frob\"").kind, CurveSet::Kind::cylinder);
    EXPECT_EQ(warnings_with(load_text("Shape \"curve\" " + points + "\"string type\" \"frob\""), "known are flat"), 1);
    const auto error = [&](const std::string& text) { return message_of([&] { curves(text); }); };
    EXPECT_PRED2(contains, error("\"point3 P\" [0 0 0 1 0 0 1 1 0 0 1 0 2 2 2]"), "make no curve of degree 3");
    EXPECT_PRED2(contains, error(points + "\"integer degree\" 4"), "2 or 3");
    EXPECT_PRED2(contains, error(points + "\"string type\" \"ribbon\""), "needs 3 normals");
    EXPECT_PRED2(contains, error(points + "\"string basis\" \"frob\""), "known are bezier");
    EXPECT_PRED2(contains, error(points + "\"float width\" -1"), "not be below 0");
}

TEST(LoadShapes, CurvesAlikeAreOneSurface) {
    const std::string curve = "Shape \"curve\" \"point3 P\" [0 0 0 1 0 0 1 1 0 0 1 0] ";
    const LoadedScene loaded =
        load_text(curve + curve + "Material \"conductor\" " + curve + "AreaLightSource \"diffuse\" " + curve);
    ASSERT_EQ(loaded.scene.surfaces.size(), 2u);
    EXPECT_EQ(std::get<CurveSet>(*loaded.scene.surfaces[0].shape).segments.size(), 2u);
    EXPECT_EQ(std::get<CurveSet>(*loaded.scene.surfaces[1].shape).segments.size(), 2u);
    EXPECT_TRUE(loaded.scene.lights.empty());
    EXPECT_EQ(warnings_with(loaded, "curves neither shine nor bound a medium"), 1);
}

TEST(LoadShapes, FlatPatchesAreTwoTriangles) {
    const std::string patch = "Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0  1 1 0 ] ";
    const LoadedScene loaded = load_text(patch + patch);
    EXPECT_EQ(loaded.scene.surfaces.size(), 2u);
    EXPECT_TRUE(loaded.warnings.empty());
    const auto& mesh = std::get<TriangleMesh>(*loaded.scene.surfaces[0].shape);
    EXPECT_EQ(mesh.triangle_count(), 2u);
    const Scene scene(load_text(patch).scene);
    const auto hit = scene.intersect({{0.25f, 0.75f, 1}, {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->uv.x, 0.25f, 1e-6f);
    EXPECT_NEAR(hit->uv.y, 0.75f, 1e-6f);
    EXPECT_GT(hit->normal.z, 0);
}

TEST(LoadShapes, UnknownParametersAreNamedOncePerTypeAndName) {
    const LoadedScene loaded = load_text(
        "Shape \"sphere\" \"float frob\" 1 Shape \"sphere\" \"float frob\" 2 Shape \"disk\" \"float frob\" 1");
    EXPECT_EQ(loaded.warnings.size(), 2u);
    EXPECT_EQ(loaded.warnings[0], "test.pbrt:3:16: warning: the parameter \"frob\" of Shape \"sphere\" is not used");
}

TEST(LoadShapes, AlphaIsKeptWhereItIsNotCertain) {
    const LoadedScene loaded = load_text(
        "Texture \"holes\" \"float\" \"checkerboard\" Shape \"sphere\" Shape \"sphere\" \"float alpha\" 1 "
        "Shape \"sphere\" \"float alpha\" 0.25 Shape \"sphere\" \"texture alpha\" \"holes\"");
    EXPECT_LT(loaded.scene.surfaces[0].alpha, 0);
    EXPECT_LT(loaded.scene.surfaces[1].alpha, 0);
    ASSERT_GE(loaded.scene.surfaces[2].alpha, 0);
    EXPECT_EQ(*loaded.scene.textures.constant(loaded.scene.surfaces[2].alpha), Rgb(0.25f));
    EXPECT_GE(loaded.scene.surfaces[3].alpha, 0);
}

TEST(LoadShapes, MediaLieOnTheSidesThatTheInterfaceNames) {
    const std::string media =
        "MakeNamedMedium \"in\" \"string type\" \"homogeneous\" MakeNamedMedium \"out\" \"string type\" "
        "\"homogeneous\" ";
    const LoadedScene loaded = load_text(media +
                                         "Shape \"sphere\" MediumInterface \"in\" \"out\" Shape \"sphere\" "
                                         "MediumInterface \"\" \"in\" Shape \"sphere\"");
    EXPECT_EQ(loaded.scene.surfaces[0].interior, vacuum);
    EXPECT_FALSE(loaded.scene.surfaces[0].bounds_medium());
    EXPECT_EQ(loaded.scene.surfaces[1].interior, 0);
    EXPECT_EQ(loaded.scene.surfaces[1].exterior, 1);
    EXPECT_EQ(loaded.scene.surfaces[2].interior, vacuum);
    EXPECT_EQ(loaded.scene.surfaces[2].exterior, 0);
    const Scene scene(load_text(media + "MediumInterface \"in\" \"out\" Shape \"sphere\"").scene);
    const auto hit = scene.intersect({{0, 0, 5}, {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_EQ(scene.medium_beyond(*hit, {0, 0, -1}, {}).id, 0);
    EXPECT_EQ(scene.medium_beyond(*hit, {0, 0, 1}, {}).id, 1);
}

TEST(LoadShapes, InstancesPlaceTheirObject) {
    const std::string world =
        "ObjectBegin \"ball\" Translate 1 0 0 Shape \"sphere\" ObjectEnd Translate 0 10 0 ObjectInstance \"ball\" "
        "Scale 2 2 2 ObjectInstance \"ball\" Shape \"disk\"";
    const LoadedScene loaded = load_text(world);
    EXPECT_EQ(loaded.scene.objects.size(), 1u);
    EXPECT_EQ(loaded.scene.objects[0].surfaces, std::vector<int>{0});
    EXPECT_EQ(loaded.scene.world_surfaces, std::vector<int>{1});
    ASSERT_EQ(loaded.scene.instances.size(), 2u);
    const Scene scene(load_text(world).scene);
    const auto hit = scene.intersect({{1, 10, 5}, {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->position.z, 2, 0.3f);  // the larger ball is around (2, 10, 0)
    EXPECT_FALSE(scene.intersect({{1, 0, 5}, {0, 0, -1}}));
}

}  // namespace
}  // namespace wend
