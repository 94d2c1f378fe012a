#include <wend/io/load/shapes.h>
#include <wend/io/load/subdivision.h>
#include <wend/io/ply.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wend {
namespace {

template <class Vector>
std::vector<Vector> take_vectors(pbrt::ParameterSet& p, std::string_view name, pbrt::ParameterType type) {
    const std::vector<float> numbers = p.take_numbers(name, type);
    constexpr std::size_t n = Vector::dimensions();
    std::vector<Vector> vectors(numbers.size() / n);
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        for (std::size_t axis = 0; axis < n; ++axis) {
            vectors[i][static_cast<int>(axis)] = numbers[n * i + axis];
        }
    }
    return vectors;
}

/// Drops values that are not one a vertex, as pbrt does.
template <class Vector>
void require_one_a_vertex(LoadContext& context, const pbrt::ShapeEntity& shape, std::vector<Vector>& values,
                          std::size_t vertices, std::string_view name) {
    if (!values.empty() && values.size() != vertices) {
        context.warnings.add(shape.parameters.place_of(name),
                             fmt::format("\"{}\" has not one value a vertex and is ignored", name));
        values.clear();
    }
}

/// The parameters P and indices, `corners` of these a face. Without indices the vertices are a single face.
TriangleMeshData take_faces(pbrt::ShapeEntity& shape, std::size_t corners) {
    pbrt::ParameterSet& p = shape.parameters;
    const pbrt::Location positions_place = p.place_of("P");
    const pbrt::Location indices_place = p.place_of("indices");
    TriangleMeshData mesh;
    mesh.positions = take_vectors<Vec3>(p, "P", pbrt::ParameterType::point3);
    if (mesh.positions.empty()) {
        throw InputError(positions_place, fmt::format("Shape \"{}\" needs the parameter \"point3 P\"", shape.type));
    }
    const std::vector<int> indices = p.take_ints("indices");
    if (indices.empty()) {
        if (mesh.positions.size() != corners) {
            throw InputError(indices_place,
                             fmt::format("Shape \"{}\" needs the parameter \"integer indices\"", shape.type));
        }
        mesh.indices.resize(corners);
        std::iota(mesh.indices.begin(), mesh.indices.end(), 0u);
        return mesh;
    }
    if (indices.size() % corners != 0) {
        throw InputError(indices_place,
                         fmt::format("\"indices\" has {} values, which is no multiple of {}", indices.size(), corners));
    }
    mesh.indices.reserve(indices.size());
    for (const int index : indices) {
        if (index < 0 || static_cast<std::size_t>(index) >= mesh.positions.size()) {
            throw InputError(indices_place, fmt::format("the index {} is out of range: there are {} vertices", index,
                                                        mesh.positions.size()));
        }
        mesh.indices.push_back(static_cast<std::uint32_t>(index));
    }
    return mesh;
}

/// take_faces(), and the parameters N and uv.
TriangleMeshData take_mesh(LoadContext& context, pbrt::ShapeEntity& shape, std::size_t corners) {
    TriangleMeshData mesh = take_faces(shape, corners);
    mesh.normals = take_vectors<Vec3>(shape.parameters, "N", pbrt::ParameterType::normal3);
    mesh.uvs = take_vectors<Vec2>(shape.parameters, "uv", pbrt::ParameterType::point2);
    require_one_a_vertex(context, shape, mesh.normals, mesh.positions.size(), "N");
    require_one_a_vertex(context, shape, mesh.uvs, mesh.positions.size(), "uv");
    return mesh;
}

/// To the world; normals that are given turn with ReverseOrientation.
TriangleMesh place(const pbrt::ShapeEntity& shape, TriangleMeshData raw) {
    TriangleMesh mesh;
    mesh.positions = std::move(raw.positions);
    mesh.normals = std::move(raw.normals);
    mesh.uvs = std::move(raw.uvs);
    mesh.indices = std::move(raw.indices);
    for (Vec3& v : mesh.positions) {
        v = shape.world_from_object.point(v);
        if (!is_finite(v)) {
            throw InputError(shape.place, fmt::format("Shape \"{}\" has a vertex that is not finite", shape.type));
        }
    }
    for (Vec3& n : mesh.normals) {
        const Vec3 mapped = shape.world_from_object.normal(n) * (shape.reverse_orientation ? -1.0f : 1.0f);
        // A normal that is no direction leaves its part of the surface flat.
        n = is_finite(mapped) && length_squared(mapped) > 0 ? normalize(mapped) : Vec3(0, 0, 0);
    }
    return mesh;
}

Shape load_triangle_mesh(LoadContext& context, pbrt::ShapeEntity& shape) {
    // Faces are numbered for Ptex textures only.
    static_cast<void>(shape.parameters.take_ints("faceIndices"));
    return place(shape, take_mesh(context, shape, 3));
}

Shape load_ply_mesh(LoadContext& context, pbrt::ShapeEntity& shape) {
    TriangleMeshData mesh = read_ply(required_file(context, shape, "filename"));
    if (shape.parameters.get_texture("displacement")) {
        context.warnings.add(shape.parameters.place_of("displacement"), "the displacement of a \"plymesh\" is ignored");
    }
    return place(shape, std::move(mesh));
}

/// Each patch becomes two triangles with vertices of their own, so that it has texture coordinates of its own.
Shape load_bilinear_mesh(LoadContext& context, pbrt::ShapeEntity& shape) {
    context.warnings.add(shape.place,
                         "Shape \"bilinearmesh\" is not implemented: two triangles a patch take its place");
    const TriangleMeshData patches = take_mesh(context, shape, 4);
    TriangleMeshData mesh;
    for (std::size_t i = 0; i < patches.indices.size(); i += 4) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (std::size_t corner = 0; corner < 4; ++corner) {
            const std::uint32_t vertex = patches.indices[i + corner];
            mesh.positions.push_back(patches.positions[vertex]);
            mesh.uvs.push_back(patches.uvs.empty()
                                   ? Vec2(static_cast<float>(corner & 1), static_cast<float>(corner >> 1))
                                   : patches.uvs[vertex]);
            if (!patches.normals.empty()) {
                mesh.normals.push_back(patches.normals[vertex]);
            }
        }
        // The corners are (0,0), (1,0), (0,1), (1,1).
        for (const std::uint32_t corner : {0u, 1u, 3u, 0u, 3u, 2u}) {
            mesh.indices.push_back(first + corner);
        }
    }
    return place(shape, std::move(mesh));
}

Shape load_subdivision_surface(LoadContext& context, pbrt::ShapeEntity& shape) {
    const int levels = shape.parameters.get_int("levels", 3);
    const pbrt::Location levels_place = shape.parameters.place_of("levels");
    const TriangleMeshData control = take_faces(shape, 3);
    // Refining takes a quarter of a kilobyte for each.
    constexpr double most_triangles = 1 << 21;
    const double triangles = static_cast<double>(control.indices.size() / 3) * std::pow(4.0, levels);
    context.subdivided += triangles;
    if (levels < 0 || !(context.subdivided <= most_triangles)) {
        throw InputError(levels_place, fmt::format("\"levels\" is {}: it must not be negative, and all \"loopsubdiv\" "
                                                   "together lead to {:.0f} triangles at most",
                                                   levels, most_triangles));
    }
    std::optional<TriangleMeshData> limit = subdivide(control.positions, control.indices, levels);
    if (!limit) {
        throw InputError(shape.place, "no triangle of the \"loopsubdiv\" has three different vertices");
    }
    return place(shape, *std::move(limit));
}

float load_sweep(const pbrt::ParameterSet& p) {
    return std::min(positive_float(p, "phimax", 360), 360.0f) * pi / 180;
}

float load_finite(const pbrt::ParameterSet& p, std::string_view name, float fallback) {
    const float value = p.get_float(name, fallback);
    if (!std::isfinite(value)) {
        throw InputError(p.place_of(name), fmt::format("\"{}\" must be finite", name));
    }
    return value;
}

Shape load_cylinder(LoadContext& context, pbrt::ShapeEntity& shape) {
    constexpr int segments = 128;
    context.warnings.add(
        shape.place,
        fmt::format("Shape \"cylinder\" is not implemented: a prism of {} sides takes its place", segments));
    const pbrt::ParameterSet& p = shape.parameters;
    const float radius = positive_float(p, "radius", 1);
    const float z[2] = {load_finite(p, "zmin", -1), load_finite(p, "zmax", 1)};
    const float sweep = load_sweep(p);
    // Normals that are given turn with ReverseOrientation alone; those of quadrics with mirroring as well.
    const float side = shape.world_from_object.swaps_handedness() ? -1.0f : 1.0f;
    TriangleMeshData mesh;
    for (int i = 0; i <= segments; ++i) {
        const float u = static_cast<float>(i) / segments;
        const Vec3 outwards(std::cos(u * sweep), std::sin(u * sweep), 0);
        for (int v = 0; v < 2; ++v) {
            mesh.positions.push_back(outwards * radius + Vec3(0, 0, z[v]));
            mesh.normals.push_back(outwards * side);
            mesh.uvs.push_back({u, static_cast<float>(v)});
        }
    }
    for (std::uint32_t i = 0; i < segments; ++i) {
        for (const std::uint32_t corner : {0u, 2u, 3u, 0u, 3u, 1u}) {
            mesh.indices.push_back(2 * i + corner);
        }
    }
    return place(shape, std::move(mesh));
}

Shape load_sphere(LoadContext&, pbrt::ShapeEntity& shape) {
    const pbrt::ParameterSet& p = shape.parameters;
    Sphere sphere;
    sphere.radius = positive_float(p, "radius", 1);
    const auto [low, high] =
        std::minmax({load_finite(p, "zmin", -sphere.radius), load_finite(p, "zmax", sphere.radius)});
    sphere.z_min = std::clamp(low, -sphere.radius, sphere.radius);
    sphere.z_max = std::clamp(high, -sphere.radius, sphere.radius);
    sphere.phi_max = load_sweep(p);
    if (!(sphere.z_min < sphere.z_max)) {
        throw InputError(p.place_of("zmin"), "nothing of the sphere lies between \"zmin\" and \"zmax\"");
    }
    return Quadric(sphere, shape.world_from_object);
}

Shape load_disk(LoadContext&, pbrt::ShapeEntity& shape) {
    const pbrt::ParameterSet& p = shape.parameters;
    Disk disk;
    disk.height = load_finite(p, "height", 0);
    disk.radius = positive_float(p, "radius", 1);
    disk.inner_radius = non_negative_float(p, "innerradius", 0);
    disk.phi_max = load_sweep(p);
    if (!(disk.inner_radius < disk.radius)) {
        throw InputError(p.place_of("innerradius"), "nothing of the disk lies between \"innerradius\" and \"radius\"");
    }
    return Quadric(disk, shape.world_from_object);
}

}  // namespace

std::optional<Shape> load_shape(LoadContext& context, pbrt::ShapeEntity& shape) {
    struct Loader {
        std::string_view type;
        Shape (*load)(LoadContext&, pbrt::ShapeEntity&);
    };
    static constexpr Loader loaders[] = {
        {"bilinearmesh", load_bilinear_mesh},     {"cylinder", load_cylinder}, {"disk", load_disk},
        {"loopsubdiv", load_subdivision_surface}, {"plymesh", load_ply_mesh},  {"sphere", load_sphere},
        {"trianglemesh", load_triangle_mesh}};
    for (const Loader& loader : loaders) {
        if (loader.type == shape.type) {
            Shape loaded = loader.load(context, shape);
            if (const auto* mesh = std::get_if<TriangleMesh>(&loaded); mesh && mesh->indices.empty()) {
                context.warnings.add(shape.place,
                                     fmt::format("Shape \"{}\" has no triangles: it is left out", shape.type));
                return std::nullopt;
            }
            return loaded;
        }
    }
    if (shape.type == "curve") {
        context.warnings.add(shape.place, "Shape \"curve\" is not implemented: it is left out");
        return std::nullopt;
    }
    refuse_type("Shape", shape,
                {"bilinearmesh", "curve", "cylinder", "disk", "loopsubdiv", "plymesh", "sphere", "trianglemesh"});
}

bool flips_normal(const pbrt::ShapeEntity& shape) {
    return shape.reverse_orientation != shape.world_from_object.swaps_handedness();
}

}  // namespace wend
