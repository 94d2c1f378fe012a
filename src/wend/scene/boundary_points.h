// Points spread over the boundary of a medium: a picture of its shape for guides.
#pragma once

#include <wend/scene/scene.h>

#include <span>
#include <vector>

namespace wend {

/// Of what moves the boundary is known as it is then (Ray::time).
inline constexpr float time_of_boundary_points = 0.5f;

struct BoundaryPoint {
    Vec3 position;
    Vec3 normal;  ///< unit length, out of the medium
};

/// Up to `count` points on the surfaces that have the medium on exactly one side, placed objects included, spread
/// evenly by area; none if there is no such surface. On stretched spheres and disks the spread is not quite even.
std::vector<BoundaryPoint> boundary_points(const SceneDescription& scene, MediumId medium, int count,
                                           std::uint64_t seed);

/// At each point the mean curvature of the boundary around, estimated from the nearest points that face the same way: 1
/// over the radius of a ball, negative in a hollow.
std::vector<float> mean_curvatures(std::span<const BoundaryPoint> points);

Box3 bounds_of(std::span<const BoundaryPoint> points);

}  // namespace wend
