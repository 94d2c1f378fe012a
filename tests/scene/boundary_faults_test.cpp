// Which boundaries hold their medium, and which do not.
#include "small_scene.h"

#include <wend/scene/boundary_faults.h>

#include <gtest/gtest.h>

namespace wend {
namespace {

using Kind = BoundaryFault::Kind;

using test::interface;
using test::opaque;

/// An empty scene with one medium.
SceneDescription one_medium() {
    SceneDescription scene = test::two_materials();
    scene.media.emplace_back(HomogeneousMedium{Rgb(1.0f), Rgb(9.0f), Rgb(0.0f), PhaseFunction()});
    return scene;
}

Surface& add_boundary(SceneDescription& scene, Shape shape) {
    Surface& surface = test::add(scene, std::move(shape), interface);
    surface.interior = 0;
    return surface;
}

/// The cube [-1, 1]³, two triangles a face, with shared corners.
TriangleMesh cube() {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.positions.emplace_back((i & 1) ? 1.0f : -1.0f, (i & 2) ? 1.0f : -1.0f, (i & 4) ? 1.0f : -1.0f);
    }
    mesh.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                    2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    return mesh;
}

/// The same with corners that each triangle has for itself.
TriangleMesh separated(const TriangleMesh& mesh) {
    TriangleMesh result;
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        result.positions.push_back(mesh.positions[mesh.indices[i]]);
        result.indices.push_back(static_cast<std::uint32_t>(i));
    }
    return result;
}

/// The triangles first .. last - 1 alone.
TriangleMesh part(TriangleMesh mesh, std::size_t first, std::size_t last) {
    mesh.indices = {mesh.indices.begin() + static_cast<std::ptrdiff_t>(3 * first),
                    mesh.indices.begin() + static_cast<std::ptrdiff_t>(3 * last)};
    return mesh;
}

void turn(TriangleMesh& mesh, std::size_t triangle) {
    std::swap(mesh.indices[3 * triangle + 1], mesh.indices[3 * triangle + 2]);
}

std::vector<BoundaryFault> faults_of(TriangleMesh mesh) {
    SceneDescription scene = one_medium();
    add_boundary(scene, std::move(mesh));
    return boundary_faults(scene);
}

TEST(BoundaryFaults, AClosedMeshHasNone) {
    EXPECT_TRUE(faults_of(cube()).empty());
    EXPECT_TRUE(faults_of(separated(cube())).empty()) << "corners in the same place are the same";
}

TEST(BoundaryFaults, AMissingFaceIsAHole) {
    for (const bool separate : {false, true}) {
        const TriangleMesh mesh = part(cube(), 2, 12);
        const auto faults = faults_of(separate ? separated(mesh) : mesh);
        ASSERT_EQ(faults.size(), 1u);
        EXPECT_EQ(faults[0].kind, Kind::open);
        EXPECT_EQ(faults[0].medium, 0);
        EXPECT_EQ(faults[0].surface, 0);
        EXPECT_EQ(faults[0].edges, 4u);
        EXPECT_EQ(faults[0].position.z, -1);
    }
}

TEST(BoundaryFaults, ASheetIsOpen) {
    const auto faults = faults_of(test::square());
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0].kind, Kind::open);
}

TEST(BoundaryFaults, ATurnedTriangleIsContraryToItsNeighbours) {
    TriangleMesh mesh = cube();
    turn(mesh, 5);
    const auto faults = faults_of(mesh);
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0].kind, Kind::contrary);
    EXPECT_EQ(faults[0].edges, 3u);
}

TEST(BoundaryFaults, NormalsDecideWhatIsTurned) {
    TriangleMesh mesh = cube();
    mesh.normals = mesh.positions;  // outwards
    turn(mesh, 5);
    EXPECT_TRUE(faults_of(mesh).empty());
    for (Vec3& n : mesh.normals) {
        n = -n;
    }
    const auto faults = faults_of(mesh);
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0].kind, Kind::inside_out);
}

TEST(BoundaryFaults, SeveralMeshesAreJudgedTogether) {
    // Each face a mesh of its own, with corners that differ by rounding.
    const auto faces = [](int count) {
        SceneDescription scene = one_medium();
        for (std::size_t face = 0; face < static_cast<std::size_t>(count); ++face) {
            TriangleMesh mesh = part(cube(), 2 * face, 2 * face + 2);
            for (Vec3& p : mesh.positions) {
                p = Vec3(10) + p * (1 + 1e-6f * static_cast<float>(face));
            }
            add_boundary(scene, std::move(mesh));
        }
        return scene;
    };
    EXPECT_TRUE(boundary_faults(faces(6)).empty());
    const auto open = boundary_faults(faces(5));
    ASSERT_EQ(open.size(), 4u) << "each shape around the hole is told once";
    EXPECT_EQ(open[0].edges, 1u);
    // The face that is turned is one of those told.
    SceneDescription scene = faces(6);
    scene.surfaces[3].flip_normal = true;
    const auto contrary = boundary_faults(scene);
    ASSERT_FALSE(contrary.empty());
    for (const BoundaryFault& fault : contrary) {
        EXPECT_EQ(fault.kind, Kind::contrary);
    }
    // A face that has the medium on its outer side and is turned is as good as any.
    scene.surfaces[3].interior = vacuum;
    scene.surfaces[3].exterior = 0;
    EXPECT_TRUE(boundary_faults(scene).empty());
}

TEST(BoundaryFaults, ACornerAmidAnEdgeIsNoHole) {
    // One side in two halves, their common edge ending amid the edges of the neighbours.
    SceneDescription scene = one_medium();
    add_boundary(scene, part(cube(), 2, 12));
    for (const float x : {-1.0f, 0.0f}) {
        TriangleMesh half;
        half.positions = {{x, -1, -1}, {x, 1, -1}, {x + 1, 1, -1}, {x + 1, -1, -1}};
        half.indices = {0, 1, 2, 0, 2, 3};
        add_boundary(scene, std::move(half));
    }
    EXPECT_TRUE(boundary_faults(scene).empty());
    scene.world_surfaces.pop_back();
    EXPECT_FALSE(boundary_faults(scene).empty());
}

TEST(BoundaryFaults, APinholeIsNoneWorthTelling) {
    const auto pierced = [](float width) {
        TriangleMesh mesh = part(cube(), 2, 12);
        mesh.positions.insert(mesh.positions.end(), {Vec3(-width, -width, -1), Vec3(width, -width, -1),
                                                     Vec3(-width, width, -1), Vec3(width, width, -1)});
        for (const std::uint32_t corner :
             {0, 2, 10, 0, 10, 8, 2, 3, 11, 2, 11, 10, 3, 1, 9, 3, 9, 11, 1, 0, 8, 1, 8, 9}) {
            mesh.indices.push_back(corner);
        }
        return mesh;
    };
    EXPECT_TRUE(faults_of(pierced(1e-4f)).empty());
    const auto faults = faults_of(pierced(1e-2f));
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0].kind, Kind::open);
}

TEST(BoundaryFaults, SpheresAreClosed) {
    SceneDescription scene = one_medium();
    Surface& sphere = add_boundary(scene, Quadric(Sphere{}, Transform::scale(2, 1, 1)));
    EXPECT_TRUE(boundary_faults(scene).empty());
    sphere.flip_normal = true;
    const auto faults = boundary_faults(scene);
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_EQ(faults[0].kind, Kind::inside_out);
    scene.camera_medium = 0;
    EXPECT_TRUE(boundary_faults(scene).empty()) << "a bubble, seen from within the medium";
}

TEST(BoundaryFaults, NothingIsSaidOfWhatCannotBeDecided) {
    // A hemisphere may be closed by a disk.
    SceneDescription scene = one_medium();
    add_boundary(scene, Quadric(Sphere{1, 0, 1}, Transform()));
    add_boundary(scene, part(cube(), 2, 12));
    EXPECT_TRUE(boundary_faults(scene).empty());
}

TEST(BoundaryFaults, AnOpaqueFloorMayCloseAHole) {
    SceneDescription scene = one_medium();
    add_boundary(scene, part(cube(), 2, 12));
    TriangleMesh floor = test::square(-1.001f);
    for (Vec3& p : floor.positions) {
        p = Vec3(5 * p.x, 5 * p.y, p.z);
    }
    test::add(scene, floor, opaque);
    EXPECT_TRUE(boundary_faults(scene).empty());
    // Another hole is still one.
    auto open = std::get<TriangleMesh>(*scene.surfaces[0].shape);
    open.indices.resize(3 * 8);
    scene.surfaces[0].shape = open;
    EXPECT_FALSE(boundary_faults(scene).empty());
}

TEST(BoundaryFaults, OfAnObjectTheFloorIsThatOfItsInstance) {
    SceneDescription scene = one_medium();
    add_boundary(scene, part(cube(), 2, 12));
    scene.world_surfaces.clear();
    scene.objects.push_back({{0}});
    scene.instances.push_back({0, Transform::translate(0, 0, 4)});
    EXPECT_EQ(boundary_faults(scene).size(), 1u);
    TriangleMesh floor = test::square(3);
    for (Vec3& p : floor.positions) {
        p = Vec3(5 * p.x, 5 * p.y, p.z);
    }
    test::add(scene, floor, opaque);
    EXPECT_TRUE(boundary_faults(scene).empty());
}

TEST(BoundaryFaults, WhatLetsNoLightInIsLeftAlone) {
    SceneDescription scene = one_medium();
    add_boundary(scene, test::square()).material = opaque;
    EXPECT_TRUE(boundary_faults(scene).empty());
    // Nor where the medium is only what surrounds an object.
    scene = one_medium();
    Surface& sheet = add_boundary(scene, test::square());
    std::swap(sheet.interior, sheet.exterior);
    EXPECT_TRUE(boundary_faults(scene).empty());
}

TEST(BoundaryFaults, ABubbleIsPartOfTheBoundary) {
    SceneDescription scene = one_medium();
    add_boundary(scene, cube());
    TriangleMesh bubble = cube();
    for (Vec3& p : bubble.positions) {
        p *= 0.5f;
    }
    Surface& inner = add_boundary(scene, std::move(bubble));
    std::swap(inner.interior, inner.exterior);
    EXPECT_TRUE(boundary_faults(scene).empty());
}

}  // namespace
}  // namespace wend
