#include <wend/scene/boundary_points.h>

#include <wend/sampling/sobol.h>
#include <wend/scene/surface_sampler.h>

#include <algorithm>
#include <cmath>

namespace wend {

std::vector<BoundaryPoint> boundary_points(const SceneDescription& scene, MediumId medium, int count,
                                           std::uint64_t seed) {
    const SurfaceSampler sampler(scene, [medium](const Surface& surface) {
        return (surface.interior == medium) != (surface.exterior == medium);
    });
    std::vector<BoundaryPoint> points;
    for (int i = 0; i < count && !sampler.is_empty(); ++i) {
        const auto index = static_cast<std::uint32_t>(i);
        const auto [surface, position, normal] = sampler.sample(
            owen_sobol(index, hash_of(seed, 0)).x, owen_sobol(index, hash_of(seed, 1)), time_of_boundary_points);
        if (is_finite(position) && is_finite(normal)) {
            points.push_back({position, surface->interior == medium ? normal : -normal});
        }
    }
    return points;
}

std::vector<float> mean_curvatures(std::span<const BoundaryPoint> points) {
    constexpr std::size_t neighbours = 12;
    std::vector<float> result;
    result.reserve(points.size());
    for (const BoundaryPoint& point : points) {
        std::vector<std::pair<float, const BoundaryPoint*>> around;
        for (const BoundaryPoint& other : points) {
            if (dot(other.normal, point.normal) > 0) {
                around.emplace_back(length_squared(other.position - point.position), &other);
            }
        }
        const auto few = static_cast<std::ptrdiff_t>(std::min(neighbours + 1, around.size()));
        std::partial_sort(around.begin(), around.begin() + few, around.end());
        // The normal curvature towards each, weighted with its square distance; its mean over directions is the mean
        // curvature.
        float turn = 0, distance2 = 0;
        for (const auto& [d2, other] : std::span(around).first(static_cast<std::size_t>(few))) {
            turn += dot(other->normal - point.normal, other->position - point.position);
            distance2 += d2;
        }
        result.push_back(distance2 > 0 ? turn / distance2 : 0.0f);
    }
    return result;
}

Box3 bounds_of(std::span<const BoundaryPoint> points) {
    Box3 box;
    for (const BoundaryPoint& point : points) {
        box.extendBy(point.position);
    }
    return box;
}

}  // namespace wend
