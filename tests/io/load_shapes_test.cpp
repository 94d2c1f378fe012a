#include "load_support.h"
#include "pbrt_support.h"

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

const std::string triangle = "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0 ] ";

/// The normal where a ray from `origin` along `direction` first meets the scene.
Vec3 normal_seen(const std::string& world, const Vec3& origin, const Vec3& direction) {
    const Scene scene(load_text(world).scene);
    const auto hit = scene.intersect({origin, direction});
    EXPECT_TRUE(hit) << world;
    return hit ? hit->normal : Vec3(0, 0, 0);
}

TEST(LoadShapes, MeshNormalsFollowTheOrderOfVertices) {
    const auto z = [](const std::string& before) {
        return normal_seen(before + triangle + "\"integer indices\" [ 0 1 2 ]", {0.2f, 0.2f, 5}, {0, 0, -1}).z;
    };
    EXPECT_NEAR(z(""), 1, 1e-6f);
    EXPECT_NEAR(z("ReverseOrientation "), -1, 1e-6f);
    // Mirrored in z, the normal is mirrored with the triangle, as a normal of the object's.
    EXPECT_NEAR(z("Scale 1 1 -1 "), -1, 1e-6f);
    EXPECT_NEAR(z("ReverseOrientation Scale 1 1 -1 "), 1, 1e-6f);
    EXPECT_NEAR(normal_seen("Scale -1 1 1 " + triangle, {-0.2f, 0.2f, 5}, {0, 0, -1}).z, 1, 1e-6f);
}

TEST(LoadShapes, GivenNormalsDecideTheSide) {
    const auto z = [](const std::string& before) {
        return normal_seen(before + triangle + "\"normal N\" [ 0 0 -1  0 0 -1  0 0 -1 ]", {0.2f, 0.2f, 5}, {0, 0, -1})
            .z;
    };
    EXPECT_NEAR(z(""), -1, 1e-6f);
    EXPECT_NEAR(z("ReverseOrientation "), 1, 1e-6f);
    EXPECT_NEAR(z("Scale 1 1 -1 "), 1, 1e-6f);
}

TEST(LoadShapes, NormalsMapByTheInverseTranspose) {
    const LoadedScene loaded = load_text("Scale 2 1 1 " + triangle + "\"normal N\" [ 1 0 1  1 0 1  1 0 1 ]");
    const auto& mesh = std::get<TriangleMesh>(loaded.scene.surfaces[0].shape);
    EXPECT_NEAR(length(mesh.normals[0] - normalize(Vec3(0.5f, 0, 1))), 0, 1e-6f);
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
    const auto& sphere = std::get<Sphere>(std::get<Quadric>(loaded.scene.surfaces[0].shape).shape);
    EXPECT_EQ(sphere.radius, 2);
    EXPECT_EQ(sphere.z_min, -1);
    EXPECT_EQ(sphere.z_max, 2);
    EXPECT_NEAR(sphere.phi_max, 0.5f * pi, 1e-6f);
    const auto& disk = std::get<Disk>(std::get<Quadric>(loaded.scene.surfaces[1].shape).shape);
    EXPECT_EQ(disk.height, 3);
    EXPECT_EQ(disk.inner_radius, 1);
    EXPECT_PRED2(contains, message_of([] { load_text("Shape \"sphere\" \"float radius\" -1"); }), "above 0");
    EXPECT_PRED2(contains, message_of([] { load_text("Shape \"disk\" \"float innerradius\" 2"); }),
                 "nothing of the disk");
}

TEST(LoadShapes, RefusesBrokenMeshesWithTheirPlace) {
    const auto message = [](const std::string& shape) { return message_of([&] { load_text(shape); }); };
    EXPECT_PRED2(contains, message("Shape \"trianglemesh\""),
                 "test.pbrt:3:1: error: Shape \"trianglemesh\" needs the parameter \"point3 P\"");
    EXPECT_PRED2(contains, message(triangle + "\"integer indices\" [ 0 1 3 ]"),
                 "the index 3 is out of range: there are 3 vertices");
    EXPECT_PRED2(contains, message(triangle + "\"integer indices\" [ 0 1 -1 ]"), "the index -1 is out of range");
    EXPECT_PRED2(contains, message(triangle + "\"integer indices\" [ 0 1 ]"), "no multiple of 3");
    EXPECT_PRED2(contains, message("Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0  1 1 0 ]"), "indices");
    EXPECT_PRED2(contains, message("Scale 1e30 1 1 Shape \"trianglemesh\" \"point3 P\" [ 1e30 0 0  1 0 0  0 1 0 ]"),
                 "not finite");
    EXPECT_PRED2(contains, message("Shape \"plymesh\""), "\"string filename\"");
    EXPECT_PRED2(contains, message("Shape \"plymesh\" \"string filename\" \"none-such.ply\""), "there is no file");
    EXPECT_PRED2(contains, message("Shape \"frob\""), "Shape \"frob\" is unknown");
}

TEST(LoadShapes, PlyMesh) {
    const auto directory = std::filesystem::temp_directory_path();
    std::ofstream(directory / "wend_load_test.ply")
        << "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 "
           "3\n";
    const LoadedScene loaded =
        load_text("Translate 0 0 7 Shape \"plymesh\" \"string filename\" \"wend_load_test.ply\"", "", {}, directory);
    const auto& mesh = std::get<TriangleMesh>(loaded.scene.surfaces[0].shape);
    EXPECT_EQ(mesh.triangle_count(), 2u);
    EXPECT_EQ(mesh.vertex(0, 0), Vec3(0, 0, 7));
}

TEST(LoadShapes, SubstitutesAreNamedOnce) {
    const std::string patch = "Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0  1 1 0 ] ";
    const LoadedScene loaded =
        load_text(patch + patch + "Shape \"curve\" \"point3 P\" [ 0 0 0  1 0 0  1 1 0  0 1 0 ] Shape \"curve\" ");
    EXPECT_EQ(loaded.scene.surfaces.size(), 2u);
    EXPECT_EQ(warnings_with(loaded, "bilinearmesh"), 1);
    EXPECT_EQ(warnings_with(loaded, "Shape \"curve\" is not implemented"), 1);
    const auto& mesh = std::get<TriangleMesh>(loaded.scene.surfaces[0].shape);
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
