#include <wend/io/mitsuba/meshes.h>

#include <wend/core/error.h>
#include <wend/io/mitsuba/obj_file.h>
#include <wend/io/mitsuba/serialized_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace wend::mitsuba {
namespace {

/// A square with the normal z.
TriangleMeshData rectangle() {
    TriangleMeshData mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.indices = {0, 1, 2, 2, 3, 0};
    return mesh;
}

/// Six squares, each with all of a texture.
TriangleMeshData cube() {
    // By side: its corners with (u, v) = (0, 1), (1, 1), (1, 0), (0, 0).
    constexpr float corners[6][4][3] = {
        {{1, -1, -1}, {1, -1, 1}, {-1, -1, 1}, {-1, -1, -1}}, {{1, 1, -1}, {-1, 1, -1}, {-1, 1, 1}, {1, 1, 1}},
        {{1, -1, -1}, {1, 1, -1}, {1, 1, 1}, {1, -1, 1}},     {{1, -1, 1}, {1, 1, 1}, {-1, 1, 1}, {-1, -1, 1}},
        {{-1, -1, 1}, {-1, 1, 1}, {-1, 1, -1}, {-1, -1, -1}}, {{1, 1, -1}, {1, -1, -1}, {-1, -1, -1}, {-1, 1, -1}}};
    constexpr Vec3 normals[6] = {{0, -1, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 0, -1}};
    const Vec2 uvs[4] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    TriangleMeshData mesh;
    for (std::uint32_t side = 0; side < 6; ++side) {
        for (std::uint32_t i = 0; i < 4; ++i) {
            const float* p = corners[side][i];
            mesh.positions.push_back({p[0], p[1], p[2]});
            mesh.normals.push_back(normals[side]);
            mesh.uvs.push_back(uvs[i]);
        }
        for (const std::uint32_t corner : {0u, 1u, 2u, 3u, 0u, 2u}) {
            mesh.indices.push_back(4 * side + corner);
        }
    }
    return mesh;
}

/// The unit disk, with the radius and the angle as texture coordinates.
TriangleMeshData disk() {
    constexpr std::uint32_t rings = 16, segments = 256;
    TriangleMeshData mesh;
    for (std::uint32_t ring = 0; ring <= rings; ++ring) {
        for (std::uint32_t segment = 0; segment <= segments; ++segment) {
            const Vec2 uv(static_cast<float>(ring) / rings, static_cast<float>(segment) / segments);
            const float angle = 2 * pi * uv.y;
            mesh.positions.push_back({uv.x * std::cos(angle), uv.x * std::sin(angle), 0});
            mesh.normals.push_back({0, 0, 1});
            mesh.uvs.push_back(uv);
            if (ring < rings && segment < segments) {
                const std::uint32_t corner = ring * (segments + 1) + segment, next = corner + segments + 1;
                mesh.indices.insert(mesh.indices.end(), {corner, next, next + 1, corner, next + 1, corner + 1});
            }
        }
    }
    return mesh;
}

float angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(length(cross(a, b)), dot(a, b));
}

/// At each vertex the mean of its triangles' normals, by their angles there.
void add_smooth_normals(TriangleMeshData& mesh) {
    mesh.normals.assign(mesh.positions.size(), Vec3(0, 0, 0));
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t* corner = &mesh.indices[i];
        const Vec3 p[3] = {mesh.positions[corner[0]], mesh.positions[corner[1]], mesh.positions[corner[2]]};
        const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
        if (!(length_squared(normal) > 0) || !is_finite(normal)) {
            continue;
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const float angle = angle_between(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
            mesh.normals[corner[k]] += normalize(normal) * angle;
        }
    }
}

TriangleMeshData read_mesh(const Object& shape, bool& has_face_normals) {
    if (shape.type() == "rectangle") {
        return rectangle();
    }
    if (shape.type() == "cube") {
        return cube();
    }
    if (shape.type() == "disk") {
        return disk();
    }
    const std::filesystem::path file = shape.file("filename");
    if (shape.type() == "serialized") {
        SerializedMesh read = read_serialized(file, shape.integer("shape_index", 0));
        has_face_normals = has_face_normals || read.has_face_normals;
        return std::move(read.mesh);
    }
    const bool is_obj = shape.type() == "obj";
    TriangleMeshData mesh = is_obj ? read_obj(file) : read_ply(file, true);
    if (shape.flag("flip_tex_coords", is_obj)) {
        for (Vec2& uv : mesh.uvs) {
            uv.y = 1 - uv.y;
        }
    }
    return mesh;
}

template <class Vector>
std::vector<float> flat(const std::vector<Vector>& vectors) {
    std::vector<float> numbers;
    numbers.reserve(vectors.size() * Vector::dimensions());
    for (const Vector& vector : vectors) {
        for (unsigned i = 0; i < Vector::dimensions(); ++i) {
            numbers.push_back(vector[static_cast<int>(i)]);
        }
    }
    return numbers;
}

}  // namespace

TriangleMeshData mesh_of(const Object& shape) {
    bool has_face_normals = shape.flag("face_normals", false);
    TriangleMeshData mesh = read_mesh(shape, has_face_normals);
    const Transform to_world = shape.transform("to_world");
    for (Vec3& position : mesh.positions) {
        position = to_world.point(position);
        if (!is_finite(position)) {
            throw InputError(shape.place(), fmt::format("{} has a vertex that is not finite", shape.title()));
        }
    }
    for (Vec3& normal : mesh.normals) {
        normal = to_world.normal(normal);
    }
    if (has_face_normals) {
        mesh.normals.clear();
    } else if (mesh.normals.empty()) {
        add_smooth_normals(mesh);
    }
    // Unlike pbrt, Mitsuba has all of one length.
    for (Vec3& normal : mesh.normals) {
        const float size = length(normal);
        normal = size > 0 && std::isfinite(size) ? normal / size : Vec3(0, 0, 0);
    }
    return mesh;
}

void set_mesh(const TriangleMeshData& mesh, Parameters& p) {
    using enum pbrt::ParameterType;
    p.add(point3, "P", flat(mesh.positions));
    if (!mesh.normals.empty()) {
        p.add(normal3, "N", flat(mesh.normals));
    }
    if (!mesh.uvs.empty()) {
        p.add(point2, "uv", flat(mesh.uvs));
    }
    p.add(integer, "indices", std::vector<int>(mesh.indices.begin(), mesh.indices.end()));
}

}  // namespace wend::mitsuba
