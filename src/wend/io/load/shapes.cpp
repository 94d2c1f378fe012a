#include <wend/io/load/shapes.h>

#include <wend/io/load/curves.h>
#include <wend/io/load/mesh_parameters.h>
#include <wend/io/load/subdivision_shapes.h>
#include <wend/io/ply.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace wend {
namespace {

Shape load_triangle_mesh(LoadContext& context, pbrt::ShapeEntity& shape) {
    // Faces are numbered for Ptex textures only.
    static_cast<void>(shape.parameters.take_ints("faceIndices"));
    TriangleMeshData mesh = take_mesh(context, shape, 3);
    take_motion(shape, mesh);
    return place(shape, std::move(mesh));
}

/// Puts quadrilaterals, which are one shape each to pbrt, behind all triangles.
void part_quadrilaterals(TriangleMeshData& mesh) {
    if (mesh.quadrilaterals.empty()) {
        return;
    }
    std::vector<std::uint32_t> last;
    last.reserve(6 * mesh.quadrilaterals.size());
    std::size_t kept = 0, next = 0;
    for (std::size_t i = 0; i < mesh.indices.size();) {
        const bool is_quadrilateral =
            next < mesh.quadrilaterals.size() && i == 3 * std::size_t{mesh.quadrilaterals[next]};
        const auto from = mesh.indices.begin() + static_cast<std::ptrdiff_t>(i);
        if (is_quadrilateral) {
            last.insert(last.end(), from, from + 6);
            ++next;
        } else {
            std::copy(from, from + 3, mesh.indices.begin() + static_cast<std::ptrdiff_t>(kept));
            kept += 3;
        }
        i += is_quadrilateral ? 6 : 3;
    }
    mesh.indices.resize(kept);
    mesh.first_quadrilateral = kept / 3;
    mesh.indices.insert(mesh.indices.end(), last.begin(), last.end());
    mesh.quadrilaterals = {};
}

Shape load_ply_mesh(LoadContext& context, pbrt::ShapeEntity& shape) {
    TriangleMeshData mesh = read_ply(required_file(context, shape, "filename"));
    part_quadrilaterals(mesh);
    if (shape.parameters.get_texture("displacement")) {
        context.warnings.add(shape.parameters.place_of("displacement"), "the displacement of a \"plymesh\" is ignored");
    }
    return place(shape, std::move(mesh));
}

/// A patch of a bilinear mesh: what its four corners have, (0,0), (1,0), (0,1), (1,1).
template <class T>
struct Patch {
    std::array<T, 4> corners;

    Patch(const std::vector<T>& of_vertices, const std::uint32_t* vertices) {
        for (std::size_t i = 0; i < 4; ++i) {
            corners[i] = of_vertices[vertices[i]];
        }
    }

    T at(float u, float v) const {
        return (corners[0] * (1 - u) + corners[1] * u) * (1 - v) + (corners[2] * (1 - u) + corners[3] * u) * v;
    }
    T along_u(float v) const { return (corners[1] - corners[0]) * (1 - v) + (corners[3] - corners[2]) * v; }
    T along_v(float u) const { return (corners[2] - corners[0]) * (1 - u) + (corners[3] - corners[1]) * u; }
    /// How far its corners are from those of a parallelogram.
    T twist() const { return corners[0] - corners[1] - corners[2] + corners[3]; }
};

/// Into how many strips each way a patch must be divided so that triangles stand for it: two of them are exact where
/// nothing is twisted.
int strips_of(const TriangleMeshData& patches, const std::uint32_t* vertices) {
    constexpr int most = 32;
    // Of the distance to the triangles, over the diameter; and of texture coordinates and normals.
    constexpr float tolerance = 1e-4f, tolerance_of_values = 1e-2f;
    const Patch<Vec3> p(patches.positions, vertices);
    const float size = length(p.corners[3] - p.corners[0]) + length(p.corners[2] - p.corners[1]);
    float twist = size > 0 ? length(p.twist()) / size : 0.0f;
    twist /= tolerance;
    if (!patches.uvs.empty()) {
        twist = std::max(twist, Patch<Vec2>(patches.uvs, vertices).twist().length() / tolerance_of_values);
    }
    if (!patches.normals.empty()) {
        twist = std::max(twist, length(Patch<Vec3>(patches.normals, vertices).twist()) / tolerance_of_values);
    }
    // The error is an eighth of the twist, and falls with the square of the number of strips.
    return twist > 0.1f ? std::clamp(static_cast<int>(std::ceil(std::sqrt(twist / 8))), 2, most) : 1;
}

/// Appends a patch as a lattice of triangles, with vertices of its own, so that it has texture coordinates of its own.
void add_patch(const TriangleMeshData& patches, const std::uint32_t* vertices, int strips, bool has_normals,
               TriangleMeshData& mesh) {
    const Patch<Vec3> positions(patches.positions, vertices);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int j = 0; j <= strips; ++j) {
        for (int i = 0; i <= strips; ++i) {
            const float u = static_cast<float>(i) / static_cast<float>(strips);
            const float v = static_cast<float>(j) / static_cast<float>(strips);
            mesh.positions.push_back(positions.at(u, v));
            mesh.uvs.push_back(patches.uvs.empty() ? Vec2(u, v) : Patch<Vec2>(patches.uvs, vertices).at(u, v));
            if (!patches.normals.empty()) {
                mesh.normals.push_back(Patch<Vec3>(patches.normals, vertices).at(u, v));
            } else if (has_normals) {
                mesh.normals.push_back(cross(positions.along_u(v), positions.along_v(u)));
            }
        }
    }
    const auto row = static_cast<std::uint32_t>(strips + 1);
    for (std::uint32_t j = 0; j + 1 < row; ++j) {
        for (std::uint32_t i = 0; i + 1 < row; ++i) {
            const std::uint32_t corner = first + j * row + i;
            for (const std::uint32_t offset : {0u, 1u, row + 1, 0u, row + 1, row}) {
                mesh.indices.push_back(corner + offset);
            }
        }
    }
}

/// Flat patches become two triangles each, curved ones a lattice of them with the normals of the patch. All patches of
/// a mesh are divided alike.
Shape load_bilinear_mesh(LoadContext& context, pbrt::ShapeEntity& shape) {
    // Faces are numbered for Ptex textures only.
    static_cast<void>(shape.parameters.take_ints("faceIndices"));
    const TriangleMeshData patches = take_mesh(context, shape, 4);
    int strips = 1;
    for (std::size_t i = 0; i < patches.indices.size(); i += 4) {
        strips = std::max(strips, strips_of(patches, &patches.indices[i]));
    }
    constexpr std::size_t most_triangles = std::size_t{1} << 23;
    const std::size_t count = patches.indices.size() / 4;
    while (strips > 1 && count * 2 * static_cast<std::size_t>(strips * strips) > most_triangles) {
        strips /= 2;
    }
    TriangleMeshData mesh;
    for (std::size_t i = 0; i < patches.indices.size(); i += 4) {
        add_patch(patches, &patches.indices[i], strips, strips > 1, mesh);
    }
    return place(shape, std::move(mesh));
}

/// Whether a sphere, disk or cylinder has no area: pbrt meets nothing there.
bool is_nothing(const pbrt::ShapeEntity& shape) {
    const pbrt::ParameterSet& p = shape.parameters;
    const bool is_sphere = shape.type == "sphere", is_disk = shape.type == "disk";
    if (!is_sphere && !is_disk && shape.type != "cylinder") {
        return false;
    }
    const float radius = p.get_float("radius", 1);
    if (radius < 0) {
        return false;  // refused later
    }
    if (radius == 0 || p.get_float("phimax", 360) <= 0) {
        return true;
    }
    if (is_disk) {
        return p.get_float("innerradius", 0) >= radius;
    }
    const float end = is_sphere ? radius : 1;
    const float z_min = p.get_float("zmin", -end), z_max = p.get_float("zmax", end);
    return z_min == z_max || (is_sphere && (std::min(z_min, z_max) >= radius || std::max(z_min, z_max) <= -radius));
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

Cylinder load_cylinder_data(const pbrt::ParameterSet& p) {
    Cylinder cylinder;
    cylinder.radius = positive_float(p, "radius", 1);
    std::tie(cylinder.z_min, cylinder.z_max) = std::minmax({load_finite(p, "zmin", -1), load_finite(p, "zmax", 1)});
    cylinder.phi_max = load_sweep(p);
    return cylinder;
}

Shape load_cylinder(LoadContext&, pbrt::ShapeEntity& shape) {
    return CylinderShell(load_cylinder_data(shape.parameters), shape.world_from_object);
}

/// Cylinders that shine or bound a medium are meshes.
Shape load_prism(LoadContext& context, pbrt::ShapeEntity& shape) {
    constexpr int segments = 256;
    context.warnings.add(shape.place, fmt::format("for a \"cylinder\" that shines or bounds a medium, a prism of {} "
                                                  "sides takes its place",
                                                  segments));
    const Cylinder cylinder = load_cylinder_data(shape.parameters);
    // Normals that are given turn with ReverseOrientation alone; those of quadrics with mirroring as well.
    const float side = shape.world_from_object.swaps_handedness() ? -1.0f : 1.0f;
    TriangleMeshData mesh;
    for (int i = 0; i <= segments; ++i) {
        const float u = static_cast<float>(i) / segments;
        const Vec3 outwards(std::cos(u * cylinder.phi_max), std::sin(u * cylinder.phi_max), 0);
        for (int v = 0; v < 2; ++v) {
            mesh.positions.push_back(outwards * cylinder.radius + Vec3(0, 0, v == 0 ? cylinder.z_min : cylinder.z_max));
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
    return Quadric(sphere, shape.world_from_object);
}

Shape load_disk(LoadContext&, pbrt::ShapeEntity& shape) {
    const pbrt::ParameterSet& p = shape.parameters;
    Disk disk;
    disk.height = load_finite(p, "height", 0);
    disk.radius = positive_float(p, "radius", 1);
    disk.inner_radius = non_negative_float(p, "innerradius", 0);
    disk.phi_max = load_sweep(p);
    return Quadric(disk, shape.world_from_object);
}

}  // namespace

std::optional<Shape> load_shape(LoadContext& context, pbrt::ShapeEntity& shape, bool as_mesh) {
    struct Loader {
        std::string_view type;
        Shape (*load)(LoadContext&, pbrt::ShapeEntity&);
    };
    static constexpr Loader loaders[] = {
        {"bilinearmesh", load_bilinear_mesh}, {"curve", load_curve},
        {"cylinder", load_cylinder},          {"disk", load_disk},
        {"plymesh", load_ply_mesh},           {"sphere", load_sphere},
        {"loopsubdiv", load_loop_surface},    {"subdivision", load_subdivision_surface},
        {"trianglemesh", load_triangle_mesh}};
    if (is_nothing(shape)) {
        context.warnings.add(shape.place, fmt::format("nothing of the \"{}\" is there: it is left out", shape.type));
        return std::nullopt;
    }
    for (const Loader& loader : loaders) {
        if (loader.type == shape.type) {
            Shape loaded =
                as_mesh && shape.type == "cylinder" ? load_prism(context, shape) : loader.load(context, shape);
            if (const auto* mesh = std::get_if<TriangleMesh>(&loaded); mesh && mesh->indices.empty()) {
                context.warnings.add(shape.place,
                                     fmt::format("Shape \"{}\" has no triangles: it is left out", shape.type));
                return std::nullopt;
            }
            return loaded;
        }
    }
    refuse_type("Shape", shape,
                {"bilinearmesh", "curve", "cylinder", "disk", "loopsubdiv", "plymesh", "sphere", "subdivision",
                 "trianglemesh"});
}

bool flips_normal(const pbrt::ShapeEntity& shape) {
    return shape.reverse_orientation != shape.world_from_object.swaps_handedness();
}

}  // namespace wend
