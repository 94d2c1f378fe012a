// Closed facts of Catmull and Clark's surfaces, creases, boundaries and texture coordinates.
#include "load_support.h"
#include "pbrt_support.h"
#include "subdivision_support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace wend {
namespace {

using pbrt::contains;
using pbrt::message_of;
using test::limit_of;
using test::load_text;
using test::warnings_with;

using Rules = SubdivisionRules;

/// Corners at +-1; bit 0 of a vertex is x, bit 1 is y, bit 2 is z.
ControlMesh cube() {
    ControlMesh control;
    for (int i = 0; i < 8; ++i) {
        const auto at = [i](int axis) { return (i >> axis & 1) != 0 ? 1.0f : -1.0f; };
        control.positions.push_back({at(0), at(1), at(2)});
    }
    control.face_sizes.assign(6, 4);
    control.corners = {4, 5, 7, 6, 0, 2, 3, 1, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
    return control;
}

void crease(ControlMesh& control, std::vector<std::uint32_t> loop, float sharpness) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
        control.creases.push_back({loop[i], loop[(i + 1) % loop.size()], sharpness});
    }
}

/// `n` by `n` unit squares in the plane z = 0.
ControlMesh grid(std::uint32_t n) {
    ControlMesh control;
    for (std::uint32_t y = 0; y <= n; ++y) {
        for (std::uint32_t x = 0; x <= n; ++x) {
            control.positions.push_back({static_cast<float>(x), static_cast<float>(y), 0});
        }
    }
    for (std::uint32_t y = 0; y < n; ++y) {
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t a = y * (n + 1) + x;
            control.corners.insert(control.corners.end(), {a, a + 1, a + n + 2, a + n + 1});
        }
    }
    control.face_sizes.assign(std::size_t{n} * n, 4);
    return control;
}

bool has_point(const TriangleMeshData& mesh, const Vec3& point, float tolerance = 2e-6f) {
    return std::ranges::any_of(mesh.positions, [&](const Vec3& p) { return length(p - point) < tolerance; });
}

std::size_t places_of(const TriangleMeshData& mesh) {
    std::set<std::tuple<float, float, float>> places;
    for (const Vec3& p : mesh.positions) {
        places.emplace(p.x, p.y, p.z);
    }
    return places.size();
}

TEST(SubdivisionRulesTest, CornersAndMiddlesOfACubeAreWhereTheLimitMaskPutsThem) {
    // The limit of a vertex with n edges is (n² v + 4 sum e + sum f) / (n (n + 5)), with the ends of its edges and the
    // opposite corners of its squares (halstead1993). The corner: (9 + 4 - 1) / 24. The middle of a face after one
    // step: its own point is 1, those of its edges are at 3/4, its corners have moved to 5/9.
    const auto middle = static_cast<float>((16 + 4 * 4 * 0.75 + 4 * 5.0 / 9) / 36);
    for (const int levels : {0, 1, 2, 4}) {
        const TriangleMeshData mesh = limit_of(cube(), levels);
        EXPECT_EQ(mesh.indices.size(), 3u * 12u << 2 * levels);
        // Smooth and closed: as many places as vertices, and Euler's number.
        EXPECT_EQ(places_of(mesh), mesh.positions.size());
        EXPECT_EQ(mesh.positions.size(), mesh.indices.size() / 6 + 2);
        for (int i = 0; i < 8; ++i) {
            EXPECT_TRUE(has_point(mesh, cube().positions[static_cast<std::size_t>(i)] * 0.5f));
        }
        if (levels > 0) {
            EXPECT_TRUE(has_point(mesh, {0, 0, middle}));
            EXPECT_TRUE(has_point(mesh, {-middle, 0, 0}));
        }
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            EXPECT_GT(dot(mesh.normals[i], normalize(mesh.positions[i])), 0.9f);
        }
    }
}

TEST(SubdivisionRulesTest, WhatIsInfinitelySharpStaysInPlace) {
    ControlMesh control = cube();
    for (const auto& loop : {std::vector<std::uint32_t>{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}}) {
        crease(control, loop, ControlMesh::infinitely_sharp);
    }
    for (const int levels : {0, 2}) {
        const TriangleMeshData mesh = limit_of(control, levels);
        const std::size_t side = (std::size_t{1} << levels) + 1;
        // Six flat faces, each with normals of its own, which meet in the same places.
        EXPECT_EQ(mesh.positions.size(), 6 * side * side);
        EXPECT_EQ(places_of(mesh), mesh.indices.size() / 6 + 2);
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            EXPECT_NEAR(dot(mesh.positions[i], mesh.normals[i]), 1, 1e-6f);
            const Vec3& n = mesh.normals[i];
            EXPECT_NEAR(std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)}), 1, 1e-6f);
        }
    }
}

TEST(SubdivisionRulesTest, CreasesAreSplinesAndSharpForAsLongAsTheySay) {
    ControlMesh control = cube();
    crease(control, {4, 5, 7, 6}, ControlMesh::infinitely_sharp);
    const TriangleMeshData sharp = limit_of(control, 2);
    // The loop at z = 1 tends to a cubic spline: (1 + 4 - 1) / 6. What is within it stays flat.
    EXPECT_TRUE(has_point(sharp, {2 / 3.0f, 2 / 3.0f, 1}));
    EXPECT_TRUE(has_point(sharp, {0, 0, 1}));
    // Sharp for one step: that goes by the spline's rule, and puts the corner to (3/4, 3/4, 1); then the smooth mask.
    control = cube();
    crease(control, {4, 5, 7, 6}, 1);
    const TriangleMeshData once = limit_of(control, 2);
    EXPECT_TRUE(has_point(once, {14.75f / 24, 14.75f / 24, 0.75f}));
    // A twin that must differ.
    EXPECT_FALSE(has_point(limit_of(cube(), 2), {14.75f / 24, 14.75f / 24, 0.75f}, 0.01f));
    // Along what is no edge there is no crease.
    control = cube();
    control.creases.push_back({0, 7, 5});
    EXPECT_TRUE(has_point(limit_of(control, 1), {0.5f, 0.5f, 0.5f}));
}

TEST(SubdivisionRulesTest, SharpCornersStay) {
    ControlMesh control = cube();
    control.sharp_corners.push_back({7, ControlMesh::infinitely_sharp});
    const TriangleMeshData mesh = limit_of(control, 2);
    EXPECT_TRUE(has_point(mesh, {1, 1, 1}));
    EXPECT_FALSE(has_point(mesh, {1, 1, -1}, 0.1f));
}

TEST(SubdivisionRulesTest, BoundariesAreAsTheyAreAskedFor) {
    Rules rules;
    rules.boundary = Rules::Boundary::edge_and_corner;
    const TriangleMeshData square = limit_of(grid(1), 2, rules);
    EXPECT_TRUE(has_point(square, {0, 0, 0}) && has_point(square, {1, 1, 0}));
    rules.boundary = Rules::Boundary::edge_only;
    // The spline of the boundary: (1 + 4 + 1) / 6 of its corners.
    EXPECT_TRUE(has_point(limit_of(grid(1), 2, rules), {1 / 6.0f, 1 / 6.0f, 0}));
    EXPECT_FALSE(has_point(limit_of(grid(1), 2, rules), {0, 0, 0}, 0.1f));
    rules.boundary = Rules::Boundary::none;
    EXPECT_FALSE(limit_surface(grid(1), rules, 2));
    // Only what has neighbours all around is there; evenly spaced points keep their places.
    const TriangleMeshData inner = limit_of(grid(3), 1, rules);
    EXPECT_EQ(inner.indices.size(), 3u * 8u);
    EXPECT_TRUE(has_point(inner, {1, 1, 0}) && has_point(inner, {1.5f, 2, 0}));
}

TEST(SubdivisionRulesTest, BilinearFacesAreCutOnly) {
    ControlMesh control = grid(1);
    control.positions[3].z = 2;
    Rules rules;
    rules.scheme = Rules::Scheme::bilinear;
    const TriangleMeshData mesh = limit_of(control, 3, rules);
    EXPECT_EQ(mesh.positions.size(), 81u);
    for (const Vec3& p : mesh.positions) {
        EXPECT_NEAR(p.z, 2 * p.x * p.y, 1e-6f);
    }
}

TEST(SubdivisionRulesTest, FacesOfOtherSizesAreCutToo) {
    // A prism over a pentagon.
    ControlMesh control;
    for (int k = 0; k < 10; ++k) {
        const float angle = 2 * pi * static_cast<float>(k % 5) / 5;
        control.positions.push_back({std::cos(angle), std::sin(angle), k < 5 ? -1.0f : 1.0f});
    }
    control.face_sizes = {5, 5, 4, 4, 4, 4, 4};
    control.corners = {5, 6, 7, 8, 9, 4, 3, 2, 1, 0};
    for (std::uint32_t k = 0; k < 5; ++k) {
        control.corners.insert(control.corners.end(), {k, (k + 1) % 5, (k + 1) % 5 + 5, k + 5});
    }
    for (const int levels : {0, 1, 3}) {
        const TriangleMeshData mesh = limit_of(control, levels);
        EXPECT_EQ(mesh.positions.size(), mesh.indices.size() / 6 + 2);
        EXPECT_LE(static_cast<double>(mesh.indices.size()) / 3, limit_triangles(control, levels));
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const Vec3 a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[i + 1]],
                       c = mesh.positions[mesh.indices[i + 2]];
            EXPECT_GT(dot(cross(b - a, c - a), a + b + c), 0);
        }
    }
}

TEST(SubdivisionRulesTest, HolesShapeTheirNeighbours) {
    ControlMesh control = cube();
    control.holes = {0};
    const TriangleMeshData mesh = limit_of(control, 2);
    EXPECT_EQ(mesh.indices.size(), 3u * 10u << 4);
    EXPECT_TRUE(has_point(mesh, {0.5f, 0.5f, 0.5f}));
    control.holes = {0, 0};
    EXPECT_EQ(limit_triangles(control, 2), 5 * 4 * 8);
}

TEST(SubdivisionRulesTest, TextureCoordinatesOfVerticesGoWithThem) {
    ControlMesh control = cube();
    for (const Vec3& p : control.positions) {
        control.uvs.push_back({p.x, p.y});
    }
    control.uv_corners = control.corners;
    Rules rules;
    rules.face_varying = Rules::FaceVarying::none;
    const TriangleMeshData mesh = limit_of(control, 2, rules);
    ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
    EXPECT_EQ(places_of(mesh), mesh.positions.size());
    for (std::size_t i = 0; i < mesh.uvs.size(); ++i) {
        EXPECT_NEAR(mesh.uvs[i].x, mesh.positions[i].x, 1e-6f);
        EXPECT_NEAR(mesh.uvs[i].y, mesh.positions[i].y, 1e-6f);
    }
}

TEST(SubdivisionRulesTest, TextureCoordinatesOfCornersHaveSeams) {
    ControlMesh control = grid(2);
    // Each face has all of the map.
    control.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (int face = 0; face < 4; ++face) {
        control.uv_corners.insert(control.uv_corners.end(), {0, 1, 2, 3});
    }
    Rules rules;
    rules.scheme = Rules::Scheme::bilinear;
    const TriangleMeshData mesh = limit_of(control, 1, rules);
    // Points of seams are several vertices: 4 faces of 9.
    EXPECT_EQ(mesh.uvs.size(), 36u);
    for (std::size_t i = 0; i < mesh.uvs.size(); ++i) {
        const auto off = [](float place, float u) { return std::abs(place - u - std::round(place - u)); };
        EXPECT_LT(off(mesh.positions[i].x, mesh.uvs[i].x), 1e-6f);
        EXPECT_LT(off(mesh.positions[i].y, mesh.uvs[i].y), 1e-6f);
    }
}

TEST(SubdivisionRulesTest, WhatMovesIsOnTheLimitAtBothEnds) {
    ControlMesh moving = cube(), end = cube();
    for (std::size_t i = 0; i < end.positions.size(); ++i) {
        end.positions[i] = end.positions[i] * Vec3(1, 2, 0.5f) + Vec3(static_cast<float>(i), 0, 0);
    }
    moving.end_positions = end.positions;
    const TriangleMeshData both = limit_of(moving, 2), first = limit_of(cube(), 2), last = limit_of(end, 2);
    EXPECT_EQ(both.positions, first.positions);
    EXPECT_EQ(both.indices, last.indices);
    EXPECT_EQ(both.end_positions, last.positions);
    EXPECT_EQ(both.end_normals, last.normals);
}

std::string shape(const std::string& parameters) {
    return "Shape \"subdivision\" \"point3 P\" [ 0 0 0  1 0 0  1 1 0  0 1 0 ] \"integer indices\" [ 0 1 2 3 ] " +
           parameters;
}

TEST(SubdivisionRulesTest, IsAShapeOfScenes) {
    const LoadedScene loaded = load_text(
        "Translate 0 0 7 " +
        shape(
            "\"integer faceVertexCounts\" 4 \"string scheme\" \"catmullClark\" \"string interpolateBoundary\" "
            "\"edgeOnly\" \"integer creaseIndices\" [ 0 1 2 ] \"integer creaseLengths\" 3 \"float creaseSharpnesses\" "
            "[ 10 10 ] \"integer cornerIndices\" 0 \"float cornerSharpnesses\" 10 \"point2 uv\" [ 0 0 1 0 1 1 0 1 ] "
            "\"string faceVaryingLinearInterpolation\" \"all\" \"integer levels\" 2 \"string triangleSubdivisionRule\" "
            "\"smooth\""));
    const auto& mesh = std::get<TriangleMesh>(*loaded.scene.surfaces[0].shape);
    EXPECT_EQ(mesh.triangle_count(), 32u);
    EXPECT_EQ(mesh.uvs.size(), mesh.positions.size());
    EXPECT_TRUE(std::ranges::any_of(mesh.positions, [](const Vec3& p) { return length(p - Vec3(0, 0, 7)) < 1e-6f; }));
    EXPECT_TRUE(std::ranges::all_of(mesh.normals, [](const Vec3& n) { return n.z > 0.999f; }));
    EXPECT_EQ(warnings_with(loaded, "subdivision"), 0);
}

TEST(SubdivisionRulesTest, RefusesWhatDoesNotGoTogether) {
    const auto message = [](const std::string& parameters) {
        return message_of([&] { load_text(shape(parameters)); });
    };
    EXPECT_PRED2(contains, message("\"integer faceVertexCounts\" [ 4 3 ]"), "the faces have 7 corners");
    EXPECT_PRED2(contains, message("\"integer faceVertexCounts\" [ 2 2 ]"), "a face has 2 corners");
    EXPECT_PRED2(contains, message("\"string scheme\" \"doosabin\""), "known are catmullClark, loop, bilinear");
    EXPECT_PRED2(contains, message("\"string scheme\" \"loop\" \"integer faceVertexCounts\" 4"), "triangles alone");
    EXPECT_PRED2(contains, message("\"integer creaseIndices\" [ 0 4 ]"), "index 4 is out of range");
    EXPECT_PRED2(contains, message("\"integer creaseIndices\" [ 0 1 ]"), "\"creaseLengths\" add up to 0");
    EXPECT_PRED2(contains, message("\"integer creaseIndices\" [ 0 1 ] \"integer creaseLengths\" 2"),
                 "0 values for 1 creases");
    EXPECT_PRED2(contains, message("\"integer cornerIndices\" 0 \"float cornerSharpnesses\" -1"), "below 0");
    EXPECT_PRED2(contains, message("\"integer cornerIndices\" 0"), "0 values for 1 corners");
    EXPECT_PRED2(contains, message("\"integer holeIndices\" 1"), "there are 1 faces");
    EXPECT_PRED2(contains, message("\"integer holeIndices\" 0"), "neither a hole");
    EXPECT_PRED2(contains, message("\"point2 uv\" [ 0 0 ]"), "\"uvindices\" has 0 values for 4 corners");
    EXPECT_PRED2(contains, message("\"integer levels\" 12"), "\"levels\" is 12");
    EXPECT_PRED2(contains, message("\"string interpolateBoundary\" \"none\""), "left out at the boundary");
}

TEST(SubdivisionRulesTest, RefusesWhatTheLibraryDoesNotTake) {
    ControlMesh fan;
    const std::uint32_t spokes = 300;
    fan.positions.push_back({0, 0, 1});
    for (std::uint32_t k = 0; k < spokes; ++k) {
        const float angle = 2 * pi * static_cast<float>(k) / static_cast<float>(spokes);
        fan.positions.push_back({std::cos(angle), std::sin(angle), 0});
        fan.corners.insert(fan.corners.end(), {0, k + 1, (k + 1) % spokes + 1});
    }
    fan.face_sizes.assign(spokes, 3);
    EXPECT_THROW(limit_surface(fan, {}, 1), std::invalid_argument);
    ControlMesh disc = fan;
    disc.corners.clear();
    for (std::uint32_t k = 0; k < spokes; ++k) {
        disc.corners.push_back(k + 1);
    }
    disc.face_sizes = {spokes};
    EXPECT_THROW(limit_surface(disc, {}, 1), std::invalid_argument);
    // A pole of as many edges as are allowed is taken.
    fan.positions.resize(129);
    fan.face_sizes.assign(128, 3);
    fan.corners.resize(3 * 128);
    fan.corners.back() = 1;
    EXPECT_EQ(limit_of(fan, 0).indices.size() % 3, 0u);
}

}  // namespace
}  // namespace wend
