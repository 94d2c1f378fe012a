// Small scenes with known answers, made of values.
#pragma once

#include <wend/render/render.h>
#include <wend/scene/scene.h>

#include <memory>

namespace wend::test {

/// An empty scene with a pinhole camera at `eye` that looks at `target`; its picture is square.
SceneDescription scene_with_camera(const Vec3& eye, const Vec3& target, float fov_degrees, int resolution);

/// Adds a material; returns its index.
int add_diffuse(SceneDescription& scene, const Rgb& reflectance);
int add_interface(SceneDescription& scene);
int add_dielectric(SceneDescription& scene, float ior, float roughness_alpha = 0);

/// Adds a sphere around a point.
void add_sphere(SceneDescription& scene, const Vec3& centre, float radius, int material, MediumId interior = vacuum,
                MediumId exterior = vacuum);

/// Adds a parallelogram; its normal is cross(a, b).
void add_parallelogram(SceneDescription& scene, const Vec3& corner, const Vec3& a, const Vec3& b, int material,
                       MediumId interior = vacuum, MediumId exterior = vacuum);

/// An axis-aligned box, normals outward.
void add_box(SceneDescription& scene, const Box3& box, int material, MediumId interior = vacuum,
             MediumId exterior = vacuum);

MediumId add_homogeneous(SceneDescription& scene, const Rgb& absorption, const Rgb& scattering, float g = 0);

/// The same medium as a grid of constant density 1 that fills `box`.
MediumId add_uniform_grid(SceneDescription& scene, const Box3& box, const Rgb& absorption, const Rgb& scattering,
                          float g = 0);

/// A right-angled triangle that shines on both sides, its legs along x and z from a corner.
void add_lamp(SceneDescription& scene, const Vec3& corner, float size, const Rgb& radiance, int material);

void add_environment(SceneDescription& scene, const Rgb& radiance);

/// A mean with its standard error.
struct Measured {
    double mean = 0;
    double standard_error = 0;
};

/// How many walks to take: at most so many, and no more than make the standard error as small as this part of the mean.
struct WalkBudget {
    int most = 0;
    double error = 0;

    WalkBudget(int most_, double error_ = 0) : most(most_), error(error_) {}
};

/// Mean radiance (average of the channels) along the same ray, by independent walks.
Measured measure_radiance(const Scene& scene, const Ray& ray, const WalkBudget& walks, int max_depth = 100000,
                          std::uint64_t seed = 1, const SubsurfacePreset& strategies = {});

}  // namespace wend::test
