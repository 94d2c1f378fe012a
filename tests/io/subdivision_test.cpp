#include "load_support.h"
#include "pbrt_support.h"
#include "subdivision_support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace wend {
namespace {

using pbrt::contains;
using pbrt::message_of;
using test::limit_of;
using test::load_text;
using test::warnings_with;

ControlMesh triangles(std::vector<Vec3> positions, std::vector<std::uint32_t> corners) {
    ControlMesh control;
    control.positions = std::move(positions);
    control.face_sizes.assign(corners.size() / 3, 3);
    control.corners = std::move(corners);
    return control;
}

const ControlMesh tetrahedron =
    triangles({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2});
const ControlMesh octahedron = triangles({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                                         {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5});

/// What pbrt's "loopsubdiv" follows.
const SubdivisionRules loop{SubdivisionRules::Scheme::loop, SubdivisionRules::Boundary::edge_only};

float distance_to_nearest(const TriangleMeshData& mesh, const Vec3& point) {
    float nearest = std::numeric_limits<float>::max();
    for (const Vec3& p : mesh.positions) {
        nearest = std::min(nearest, length(p - point));
    }
    return nearest;
}

TEST(Subdivision, VerticesLieOnTheLimitSurfaceAtEveryLevel) {
    // Loop's weights of the limit: 1 / (n + 3 / (8 beta)) for each of n neighbours, beta = (5/8 - (3/8 + cos(2 pi / n)
    // / 4)^2) / n. Neighbours add up to -v in the tetrahedron, where beta is 3/16, and to zero in the octahedron.
    const double beta = (0.625 - 0.375 * 0.375) / 4;
    const auto on_octahedron = static_cast<float>(1 - 4 / (4 + 3 / (8 * beta)));
    for (const int levels : {0, 1, 3}) {
        const TriangleMeshData round = limit_of(tetrahedron, levels, loop);
        EXPECT_EQ(round.indices.size(), 3u * 4u << 2 * levels);
        for (const Vec3& v : tetrahedron.positions) {
            EXPECT_LT(distance_to_nearest(round, v * 0.2f), 1e-6f);
        }
        const TriangleMeshData rounder = limit_of(octahedron, levels, loop);
        for (const Vec3& v : octahedron.positions) {
            EXPECT_LT(distance_to_nearest(rounder, v * on_octahedron), 1e-6f);
        }
    }
}

TEST(Subdivision, KeepsOrientationAndStaysClosed) {
    const TriangleMeshData mesh = limit_of(octahedron, 3, loop);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::uint32_t* corner = &mesh.indices[i];
        const Vec3 a = mesh.positions[corner[0]], b = mesh.positions[corner[1]], c = mesh.positions[corner[2]];
        EXPECT_GT(dot(cross(b - a, c - a), a + b + c), 0);
        for (int k = 0; k < 3; ++k) {
            ++edges[{corner[k], corner[(k + 1) % 3]}];
        }
    }
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_TRUE(edges.contains({edge.second, edge.first}));
    }
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        EXPECT_GT(dot(normalize(mesh.normals[i]), normalize(mesh.positions[i])), 0.9f);
    }
    // By symmetry.
    const auto top = std::ranges::max_element(mesh.positions, {}, [](const Vec3& p) { return p.z; });
    EXPECT_NEAR(normalize(mesh.normals[static_cast<std::size_t>(top - mesh.positions.begin())]).z, 1, 1e-6f);
}

TEST(Subdivision, BoundariesTendToSplines) {
    const ControlMesh triangle = triangles({{0, 0, 0}, {6, 0, 0}, {0, 6, 0}}, {0, 1, 2});
    for (const int levels : {0, 2}) {
        const TriangleMeshData mesh = limit_of(triangle, levels, loop);
        EXPECT_EQ(mesh.indices.size(), 3u << 2 * levels);
        // 2/3 of the vertex, 1/6 of each neighbour on the boundary.
        EXPECT_LT(distance_to_nearest(mesh, {1, 1, 0}), 1e-5f);
        EXPECT_LT(distance_to_nearest(mesh, {4, 1, 0}), 1e-5f);
        for (const Vec3& n : mesh.normals) {
            EXPECT_GT(n.z, 0);
        }
    }
}

TEST(Subdivision, TakesMeshesThatAreNoSurface) {
    std::vector<Vec3> positions = tetrahedron.positions;
    std::vector<std::uint32_t> corners = tetrahedron.corners;
    positions.push_back({5, 5, 5});                   // belongs to no triangle
    positions.push_back({2, -2, 2});                  // of a third triangle at an edge
    for (const std::uint32_t index : {0u, 1u, 5u,     // that
                                      0u, 1u, 5u,     // twice
                                      3u, 3u, 2u}) {  // no triangle
        corners.push_back(index);
    }
    const ControlMesh fan = triangles(positions, corners);
    for (const int levels : {0, 2}) {
        const TriangleMeshData mesh = limit_of(fan, levels, loop);
        EXPECT_EQ(mesh.indices.size(), 3u * 6u << 2 * levels);
        for (const Vec3& p : mesh.positions) {
            EXPECT_TRUE(is_finite(p));
        }
    }
    EXPECT_FALSE(limit_surface(triangles(positions, {1, 1, 2}), loop, 2));
    EXPECT_FALSE(limit_surface({}, loop, 2));
}

std::string loop_shape(const std::string& levels, const std::string& indices = "0 1 2") {
    return "Shape \"loopsubdiv\" " + (levels.empty() ? "" : "\"integer levels\" " + levels) +
           " \"point3 P\" [ 0 0 0  6 0 0  0 6 0 ] \"integer indices\" [ " + indices + " ]";
}

TEST(Subdivision, IsAShapeOfScenes) {
    const LoadedScene loaded = load_text("Translate 0 0 7 " + loop_shape("") + loop_shape("1"));
    const auto& standard = std::get<TriangleMesh>(*loaded.scene.surfaces[0].shape);
    EXPECT_EQ(standard.triangle_count(), 64u);
    EXPECT_FLOAT_EQ(standard.positions[0].z, 7);
    EXPECT_FLOAT_EQ(standard.normals[0].z, 1);
    EXPECT_EQ(std::get<TriangleMesh>(*loaded.scene.surfaces[1].shape).triangle_count(), 4u);
    EXPECT_EQ(warnings_with(loaded, "loopsubdiv"), 0);
}

TEST(Subdivision, RefusesWhatLeadsToNoMesh) {
    const auto message = [](const std::string& shape) { return message_of([&] { load_text(shape); }); };
    EXPECT_PRED2(contains, message(loop_shape("-1")), "\"levels\" is -1");
    EXPECT_PRED2(contains, message(loop_shape("2000000000")), "\"levels\" is 2000000000");
    EXPECT_PRED2(contains, message(loop_shape("1", "0 0 2")), "as many different vertices as corners");
    EXPECT_PRED2(contains, message(loop_shape("1", "0 1 3")), "index 3 is out of range");
}

}  // namespace
}  // namespace wend
