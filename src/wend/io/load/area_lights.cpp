#include <wend/io/load/area_lights.h>

#include <wend/scene/moving_light.h>

#include <cmath>
#include <cstdint>
#include <utility>

namespace wend {
namespace {

bool is_whole(const Sphere& sphere) {
    return sphere.is_full();
}

bool is_whole(const Disk& disk) {
    constexpr float full_turn = 6.283185f;
    return !(disk.inner_radius > 0) && disk.phi_max >= full_turn;
}

/// Whether a triangle's normal must be reversed to lie on the side of its vertices' normals, or else as the surface
/// says.
bool flips(const Surface& surface, const TriangleMesh& mesh, std::size_t triangle) {
    if (mesh.normals.empty()) {
        return surface.flip_normal;
    }
    const std::uint32_t* i = &mesh.indices[3 * triangle];
    const Vec3 face = cross(mesh.positions[i[1]] - mesh.positions[i[0]], mesh.positions[i[2]] - mesh.positions[i[0]]);
    return dot(face, mesh.normals[i[0]] + mesh.normals[i[1]] + mesh.normals[i[2]]) < 0;
}

/// Its axis in the world.
std::shared_ptr<const EmissionProfile> placed_profile(const AreaLight& light, const LampPlace& at) {
    if (!light.profile) {
        return nullptr;
    }
    EmissionProfile profile = *light.profile;
    const Vec3 placed = at.world_from_object.vector(profile.axis);
    const Vec3 axis = at.motion ? at.motion->start().vector(placed) : placed;
    profile.axis = length_squared(axis) > 0 ? normalize(axis) : profile.axis;
    return std::make_shared<const EmissionProfile>(profile);
}

void attach_to_quadric(const AreaLight& light, const LampPlace& at, const Surface& surface,
                       std::vector<Light>& lights) {
    QuadricLight source =
        make_quadric_light(std::make_shared<const Quadric>(std::get<Quadric>(*surface.shape)), at.world_from_object,
                           surface.flip_normal, light.radiance, light.two_sided);
    source.motion = at.motion;
    // Exact where the transform keeps shapes similar.
    source.radiance = light.radiance_of(source.object_area * std::cbrt(sqr(PlacedQuadric(source, 0).area_factor())));
    source.presence = at.presence;
    source.picture = light.picture;
    source.profile = placed_profile(light, at);
    lights.push_back(std::move(source));
}

/// Parameters of a triangle's corners, by default those of pbrt.
void copy_uvs(const TriangleMesh& mesh, std::size_t triangle, TriangleLight& source) {
    if (mesh.uvs.empty()) {
        const auto uvs = mesh.default_uvs(triangle);
        source.uv1 = uvs[0];
        source.uv2 = uvs[1];
        return;
    }
    const std::uint32_t* i = &mesh.indices[3 * triangle];
    source.uv0 = mesh.uvs[i[0]];
    source.uv1 = mesh.uvs[i[1]];
    source.uv2 = mesh.uvs[i[2]];
}

/// A triangle of a mesh, which moves as the mesh does.
TriangleLight lamp_of(const AreaLight& light, const LampPlace& at, const Surface& surface, std::size_t triangle) {
    const auto& mesh = std::get<TriangleMesh>(*surface.shape);
    const bool flip = flips(surface, mesh, triangle);
    TriangleLight source = make_triangle_light(mesh.vertex(triangle, 0), mesh.vertex(triangle, 1),
                                               mesh.vertex(triangle, 2), flip, light.radiance, light.two_sided);
    if (at.motion || mesh.is_moving()) {
        source.motion =
            std::make_shared<const TriangleMotion>(TriangleMotion{mesh.triangle(triangle, 1), at.motion, flip});
        const PlacedTriangle placed = placed_at(source, 0);
        source.normal = placed.normal;
        source.area = placed.area;
    }
    source.presence = at.presence;
    source.picture = light.picture;
    copy_uvs(mesh, triangle, source);
    return source;
}

void attach_to_mesh(const AreaLight& light, const LampPlace& at, const Surface& surface, std::vector<Light>& lights) {
    const auto& mesh = std::get<TriangleMesh>(*surface.shape);
    // Below, the area's inverse and its products leave the range of floats.
    constexpr float smallest_area = 1e-30f;
    const std::size_t triangles = mesh.triangle_count();
    const std::shared_ptr<const EmissionProfile> profile = placed_profile(light, at);
    const std::size_t evenly = at.shapes > 0 && triangles % at.shapes == 0 ? triangles / at.shapes : 1;
    std::size_t together = 0;
    for (std::size_t first = 0; first < triangles; first += together) {
        together = first >= mesh.first_quadrilateral ? 2 : evenly;
        const std::size_t begin = lights.size();
        float area = 0;
        for (std::size_t i = first; i < first + together; ++i) {
            TriangleLight source = lamp_of(light, at, surface, i);
            source.profile = profile;
            area += source.area;
            lights.push_back(std::move(source));
        }
        for (std::size_t i = begin; i < lights.size(); ++i) {
            auto& source = std::get<TriangleLight>(lights[i]);
            source.radiance = source.area > smallest_area || source.motion ? light.radiance_of(area) : Rgb(0.0f);
        }
    }
}

}  // namespace

Rgb AreaLight::radiance_of(float area) const {
    const float brightness = picture ? luminance(picture->mean_colour()) : 1.0f;
    const float unscaled = area * pi * (two_sided ? 2.0f : 1.0f) * brightness;
    return !(power > 0) ? radiance : unscaled > 0 ? radiance * (power / unscaled) : Rgb(0.0f);
}

void attach(const AreaLight& light, const LampPlace& at, Surface& surface, std::vector<Light>& lights) {
    if (is_black(light.picture ? light.radiance * light.picture->mean_colour() : light.radiance)) {
        return;
    }
    surface.first_light = static_cast<int>(lights.size());
    if (std::holds_alternative<Quadric>(*surface.shape)) {
        attach_to_quadric(light, at, surface, lights);
    } else {
        attach_to_mesh(light, at, surface, lights);
    }
}

std::string_view round_lamp_difference(std::string_view shape_type, const Shape& shape,
                                       const Transform& world_from_object) {
    const auto* quadric = std::get_if<Quadric>(&shape);
    if (!quadric && shape_type != "cylinder") {
        return "";
    }
    if (quadric && !std::visit([](const auto& s) { return is_whole(s); }, quadric->shape)) {
        return "of which a part is cut out is lit from by pbrt as if it were whole";
    }
    constexpr float tolerance = 1e-3f;
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
        if (std::abs(length_squared(world_from_object.vector(axis)) - 1) > tolerance) {
            return "that is scaled shines in pbrt with the area that it has before";
        }
    }
    return "";
}

}  // namespace wend
