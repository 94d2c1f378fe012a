// Scenes of a few surfaces, for tests of what a ray meets.
#pragma once

#include <wend/scene/scene.h>

#include <optional>
#include <utility>

namespace wend::test {

/// A description with two materials: 0 is diffuse, 1 an interface.
inline SceneDescription two_materials() {
    SceneDescription scene;
    scene.materials.push_back(DiffuseMaterial{scene.textures.add_constant(Rgb(0.5f))});
    scene.materials.push_back(InterfaceMaterial{});
    return scene;
}

/// The materials of two_materials().
constexpr int opaque = 0, interface = 1;

/// Adds a surface to the world; it can be changed until the scene is built.
inline Surface& add(SceneDescription& scene, Shape shape, int material = 0) {
    scene.world_surfaces.push_back(static_cast<int>(scene.surfaces.size()));
    scene.surfaces.push_back({std::move(shape), material});
    return scene.surfaces.back();
}

/// The first place ahead where a ray meets a quadric, in object space.
inline std::optional<float> first_crossing(const Quadric& quadric, const Vec3& origin, const Vec3& direction) {
    for (const auto& crossing : crossings(quadric, origin, direction)) {
        if (crossing.t > 0) {
            return crossing.t;
        }
    }
    return std::nullopt;
}

/// Two triangles from (-1,-1) to (1,1) at a height, normal +z.
inline TriangleMesh square(float z = 0) {
    TriangleMesh mesh;
    mesh.positions = {{-1, -1, z}, {1, -1, z}, {1, 1, z}, {-1, 1, z}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

}  // namespace wend::test
