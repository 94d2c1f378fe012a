#include <wend/core/parallel.h>
#include <wend/integrator/boundary_field.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// Index of the cell of an interval of `side` cells.
int cell_of(float x, float low, float high, int side) {
    return high > low ? std::clamp(static_cast<int>((x - low) / (high - low) * static_cast<float>(side)), 0, side - 1)
                      : 0;
}

}  // namespace

BoundaryField::BoundaryField(const Box3& box, std::vector<LitPoint> points, float decay, int threads)
    : box_(box),
      spacing_(length(box_.size()) / std::sqrt(static_cast<float>(points.size()))),
      points_(std::move(points)),
      cells_(side * side * side) {
    const Vec3 step = box_.size() * (1.0f / side);
    parallel_for(cells_.size(), threads, [&](std::size_t i) {
        const int n = static_cast<int>(i);
        const Vec3 index(static_cast<float>(n % side), static_cast<float>(n / side % side),
                         static_cast<float>(n / side / side));
        const Vec3 centre = box_.min + (index + Vec3(0.5f)) * step;
        std::vector<std::pair<float, std::uint16_t>> distances;
        distances.reserve(points_.size());
        for (std::size_t p = 0; p < points_.size(); ++p) {
            distances.emplace_back(distance_to(points_[p].point, centre), static_cast<std::uint16_t>(p));
        }
        Cell& cell = cells_[i];
        double light = 0;
        Imath::V3d slope(0, 0, 0);
        // The sources stand outside by as much as they are apart: from inside they then look like a smooth surface.
        const auto way_to = [&](std::size_t p) {
            return points_[p].point.position + points_[p].point.normal * spacing_ - centre;
        };
        float nearest = infinity;
        for (std::size_t p = 0; p < points_.size(); ++p) {
            nearest = std::min(nearest, length(way_to(p)));
        }
        for (std::size_t p = 0; p < points_.size(); ++p) {
            const Vec3 way = way_to(p);
            const double r = std::max(length(way), 1e-3f * spacing_);
            // The gradient of exp(-decay r) / r, up to a factor that keeps it within the range of numbers.
            const double value = points_[p].irradiance * std::exp(-decay * (r - nearest)) / r;
            light += value;
            slope += Imath::V3d(way) * (value * (decay + 1 / r) / r);
        }
        const double size = slope.length();
        if (light > 0 && size > 0) {
            cell.incident = {Vec3(slope / size),
                             static_cast<float>(std::min(1.0, size / (light * static_cast<double>(decay))))};
        } else {
            cell.incident.steepness = 0;
        }
        const auto few = std::min<std::ptrdiff_t>(candidates, std::ssize(distances));
        std::partial_sort(distances.begin(), distances.begin() + few, distances.end());
        for (std::ptrdiff_t k = 0; k < candidates; ++k) {
            cell.nearest[static_cast<std::size_t>(k)] =
                distances[static_cast<std::size_t>(std::min(k, few - 1))].second;
        }
    });
}

std::size_t BoundaryField::cell_at(const Vec3& p) const {
    const int x = cell_of(p.x, box_.min.x, box_.max.x, side);
    const int y = cell_of(p.y, box_.min.y, box_.max.y, side);
    const int z = cell_of(p.z, box_.min.z, box_.max.z, side);
    return static_cast<std::size_t>((z * side + y) * side + x);
}

const LitPoint& BoundaryField::closest_point(const Vec3& position) const {
    const auto& nearest = cells_[cell_at(position)].nearest;
    const auto best = std::min_element(nearest.begin(), nearest.end(), [&](std::uint16_t a, std::uint16_t b) {
        return distance_to(points_[a].point, position) < distance_to(points_[b].point, position);
    });
    return points_[*best];
}

SlabAim BoundaryField::closest(const Vec3& position) const {
    return {closest_point(position).point.normal, 1};
}

LayerPlace BoundaryField::layer(const Vec3& position) const {
    const LitPoint& lit = closest_point(position);
    const float depth = dot(lit.point.position - position, lit.point.normal);
    return {-lit.point.normal, std::clamp(depth, 0.0f, lit.thickness), lit.thickness, lit.irradiance,
            lit.irradiance_behind};
}

float BoundaryField::distance_to(const BoundaryPoint& point, const Vec3& position) const {
    const Vec3 way = position - point.position;
    const float height = dot(way, point.normal);
    const float aside = std::max(0.0f, length(way - point.normal * height) - spacing_);
    return std::hypot(height, aside);
}

SlabAim BoundaryField::incident(const Vec3& position) const {
    return cells_[cell_at(position)].incident;
}

namespace {

/// The length of a way through the object, at most `farthest`.
float chord(const Scene& scene, MediumId medium, Ray ray, float farthest) {
    float sum = 0;
    // Past what does not end the medium, such as interfaces within it.
    for (int crossed = 0; crossed < 8 && sum < farthest; ++crossed) {
        const std::optional<Hit> hit = scene.intersect(ray, farthest);
        sum += hit ? hit->distance : farthest;
        if (!hit || !scene.is_interface(*hit) ||
            (hit->surface->bounds_medium() && scene.medium_beyond(*hit, ray.direction, medium) != medium)) {
            break;
        }
        ray = spawn_ray(hit->position, hit->normal, ray.direction);
    }
    return std::min(sum, farthest);
}

float direct_irradiance(const Scene& scene, const BoundaryPoint& point, int samples, Pcg32& random) {
    const LightReceiver receiver{point.position, point.normal};
    float sum = 0;
    for (int i = 0; i < samples; ++i) {
        const float u = random.uniform();
        const Vec2 u2 = random.uniform2();
        const ChosenLight chosen =
            std::visit([&](const auto& s) { return s.sample(receiver, u); }, scene.light_sampler());
        if (chosen.index < 0) {
            continue;
        }
        const auto light = sample_light(scene.lights()[static_cast<std::size_t>(chosen.index)], point.position, u2);
        const float cosine = light ? dot(light->direction, point.normal) : 0.0f;
        if (cosine > 0 && !scene.is_occluded(spawn_ray(point.position, point.normal, light->direction),
                                             light->distance * (1 - 1e-3f))) {
            sum += mean_value(light->radiance) * cosine / (light->density * chosen.probability);
        }
    }
    return std::isfinite(sum) ? sum / static_cast<float>(samples) : 0.0f;
}

}  // namespace

std::vector<LitPoint> lit_points(const Scene& scene, MediumId medium, std::span<const BoundaryPoint> points,
                                 int samples, Pcg32& random) {
    std::vector<LitPoint> result;
    const float diameter = length(bounds_of(points).size());
    float total = 0;
    for (const BoundaryPoint& point : points) {
        const float thickness = chord(scene, medium, spawn_ray(point.position, point.normal, -point.normal), diameter);
        result.push_back({point, direct_irradiance(scene, point, samples, random), thickness, 0});
        total += result.back().irradiance;
    }
    const float least = total > 0 ? 0.02f * total / static_cast<float>(result.size()) : 1.0f;
    for (LitPoint& lit : result) {
        lit.irradiance += least;
    }
    for (LitPoint& lit : result) {
        const Vec3 behind = lit.point.position - lit.point.normal * lit.thickness;
        const auto nearest = std::min_element(result.begin(), result.end(), [&](const LitPoint& a, const LitPoint& b) {
            return length_squared(a.point.position - behind) < length_squared(b.point.position - behind);
        });
        lit.irradiance_behind = nearest->irradiance;
    }
    return result;
}

float mean_chord(const Scene& scene, MediumId medium, std::span<const BoundaryPoint> points, Pcg32& random) {
    const float diameter = length(bounds_of(points).size());
    float sum = 0;
    for (const BoundaryPoint& point : points) {
        const Vec3 inward = Frame::from_z(-point.normal).to_world(to_cosine_hemisphere(random.uniform2()));
        sum += chord(scene, medium, spawn_ray(point.position, point.normal, inward), diameter);
    }
    return points.empty() ? 0.0f : sum / static_cast<float>(points.size());
}

}  // namespace wend
