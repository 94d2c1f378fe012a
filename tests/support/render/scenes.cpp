#include <tests/support/scenes.h>

#include <wend/stats/moments.h>
#include <wend/transport/path_tracer.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace wend::test {

SceneDescription scene_with_camera(const Vec3& eye, const Vec3& target, float fov_degrees, int resolution) {
    SceneDescription scene;
    const Vec3 forward = normalize(target - eye);
    const Imath::V3d up = std::abs(forward.y) < 0.9f ? Imath::V3d(0, 1, 0) : Imath::V3d(1, 0, 0);
    const Transform camera_from_world = Transform::look_at(Imath::V3d(eye), Imath::V3d(target), up);
    const float half = std::tan(fov_degrees * pi / 360);
    scene.camera = Camera(PerspectiveCamera{{-half, half, -half, half}, 0, 1}, camera_from_world.inverse(), resolution,
                          resolution);
    return scene;
}

int add_diffuse(SceneDescription& scene, const Rgb& reflectance) {
    scene.materials.push_back(DiffuseMaterial{scene.textures.add_constant(reflectance)});
    return static_cast<int>(scene.materials.size()) - 1;
}

int add_interface(SceneDescription& scene) {
    scene.materials.push_back(InterfaceMaterial{});
    return static_cast<int>(scene.materials.size()) - 1;
}

int add_dielectric(SceneDescription& scene, float ior, float roughness_alpha) {
    const TextureId alpha = scene.textures.add_constant(Rgb(roughness_alpha));
    scene.materials.push_back(DielectricMaterial{ior, {alpha, alpha, false}});
    return static_cast<int>(scene.materials.size()) - 1;
}

namespace {

void add_surface(SceneDescription& scene, Shape shape, int material, MediumId interior, MediumId exterior) {
    scene.world_surfaces.push_back(static_cast<int>(scene.surfaces.size()));
    scene.surfaces.push_back({std::move(shape), material, interior, exterior});
}

}  // namespace

void add_sphere(SceneDescription& scene, const Vec3& centre, float radius, int material, MediumId interior,
                MediumId exterior) {
    add_surface(scene, Quadric(Sphere{radius, -radius, radius}, Transform::translate(centre.x, centre.y, centre.z)),
                material, interior, exterior);
}

void add_parallelogram(SceneDescription& scene, const Vec3& corner, const Vec3& a, const Vec3& b, int material,
                       MediumId interior, MediumId exterior) {
    TriangleMesh mesh;
    mesh.positions = {corner, corner + a, corner + a + b, corner + b};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    add_surface(scene, std::move(mesh), material, interior, exterior);
}

void add_box(SceneDescription& scene, const Box3& box, int material, MediumId interior, MediumId exterior) {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.positions.push_back(
            {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z});
    }
    mesh.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                    2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    add_surface(scene, std::move(mesh), material, interior, exterior);
}

MediumId add_homogeneous(SceneDescription& scene, const Rgb& absorption, const Rgb& scattering, float g) {
    scene.media.push_back(HomogeneousMedium{absorption, scattering, Rgb(0.0f), PhaseFunction(HenyeyGreenstein{g})});
    return static_cast<MediumId>(scene.media.size()) - 1;
}

MediumId add_uniform_grid(SceneDescription& scene, const Box3& box, const Rgb& absorption, const Rgb& scattering,
                          float g) {
    constexpr int n = 12;
    auto grid = std::make_shared<Grid>(
        Vec3i(0, 0, 0), Vec3i(n, n, n), [](const Vec3i&, const Vec3i&) { return true; },
        [](int, int, int) { return 1.0f; });
    const Vec3 size = box.max - box.min;
    // Well inside the voxels, where the density is 1 everywhere.
    const Transform index_from_world = Transform::translate(1, 1, 1) *
                                       Transform::scale((n - 3) / size.x, (n - 3) / size.y, (n - 3) / size.z) *
                                       Transform::translate(-box.min.x, -box.min.y, -box.min.z);
    const Box3 index_box(Vec3(1), Vec3(n - 2));
    scene.media.push_back(
        GridMedium(grid, index_from_world, index_box, absorption, scattering, PhaseFunction(HenyeyGreenstein{g})));
    return static_cast<MediumId>(scene.media.size()) - 1;
}

void add_lamp(SceneDescription& s, const Vec3& p, float size, const Rgb& radiance, int material) {
    Surface lamp{TriangleMesh{{p, p + Vec3(size, 0, 0), p + Vec3(0, 0, size)}, {}, {}, {0, 1, 2}}, material};
    lamp.first_light = static_cast<int>(s.lights.size());
    s.lights.push_back(make_triangle_light(p, p + Vec3(size, 0, 0), p + Vec3(0, 0, size), true, radiance, true));
    s.world_surfaces.push_back(static_cast<int>(s.surfaces.size()));
    s.surfaces.push_back(std::move(lamp));
}

void add_environment(SceneDescription& scene, const Rgb& radiance) {
    scene.lights.push_back(UniformInfiniteLight{radiance});
}

Measured measure_radiance(const Scene& scene, const Ray& ray, const WalkBudget& walks, int max_depth,
                          std::uint64_t seed, const SubsurfacePreset& strategies) {
    // Rare bright walks are not missed where it is asked no sooner whether there are enough.
    constexpr int least = 20000;
    // Well spread samples of as many pixels as tell their noise: the mean of each is one value.
    constexpr int least_pixels = 32, most_samples = 1024;
    const int samples =
        std::clamp(static_cast<int>(std::bit_floor(static_cast<unsigned>(walks.most / least_pixels))), 1, most_samples);
    const ClassicalDecisions decisions;
    const SubsurfaceGuides subsurface(scene, strategies);
    const LightSelection lights(scene);
    const ReflectionProbability reflections(scene.bounds());
    const PathTracer tracer(scene, decisions, subsurface, lights, reflections, max_depth);
    Moments moments;
    const auto enough = [&] {
        const auto pixels = static_cast<int>(moments.count());
        return pixels >= least_pixels && pixels * samples >= least &&
               moments.standard_error() <= walks.error * moments.mean();
    };
    for (int pixel = 0; (pixel + 1) * samples <= walks.most && !enough(); ++pixel) {
        double sum = 0;
        for (int i = 0; i < samples; ++i) {
            Sampler sampler(SamplerKind::sobol, seed, static_cast<std::uint64_t>(pixel), static_cast<std::uint32_t>(i));
            sum += mean(tracer.trace(ray, 0, sampler).sample.radiance);
        }
        moments.add(sum / samples);
    }
    return {moments.mean(), moments.standard_error()};
}

}  // namespace wend::test
