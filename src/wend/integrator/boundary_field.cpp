#include <wend/core/parallel.h>
#include <wend/integrator/boundary_field.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wend {
namespace {

Box3 bounds_of(std::span<const BoundaryPoint> points) {
    Box3 box;
    for (const BoundaryPoint& point : points) {
        box.extendBy(point.position);
    }
    return box;
}

/// Index of the cell of an interval of `side` cells.
int cell_of(float x, float low, float high, int side) {
    return high > low ? std::clamp(static_cast<int>((x - low) / (high - low) * static_cast<float>(side)), 0, side - 1)
                      : 0;
}

}  // namespace

BoundaryField::BoundaryField(std::span<const BoundaryPoint> points, std::span<const float> irradiance, float decay,
                             int threads)
    : box_(bounds_of(points)),
      spacing_(length(box_.size()) / std::sqrt(static_cast<float>(points.size()))),
      points_(points.begin(), points.end()),
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
            distances.emplace_back(distance_to(points_[p], centre), static_cast<std::uint16_t>(p));
        }
        Cell& cell = cells_[i];
        double light = 0;
        Imath::V3d slope(0, 0, 0);
        // The sources stand outside by as much as they are apart: from inside they then look like a smooth surface.
        const auto way_to = [&](std::size_t p) { return points_[p].position + points_[p].normal * spacing_ - centre; };
        float nearest = infinity;
        for (std::size_t p = 0; p < points_.size(); ++p) {
            nearest = std::min(nearest, length(way_to(p)));
        }
        for (std::size_t p = 0; p < points_.size(); ++p) {
            const Vec3 way = way_to(p);
            const double r = std::max(length(way), 1e-3f * spacing_);
            // The gradient of exp(-decay r) / r, up to a factor that keeps it within the range of numbers.
            const double value = irradiance[p] * std::exp(-decay * (r - nearest)) / r;
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

SlabAim BoundaryField::closest(const Vec3& position) const {
    const auto& nearest = cells_[cell_at(position)].nearest;
    const auto best = std::min_element(nearest.begin(), nearest.end(), [&](std::uint16_t a, std::uint16_t b) {
        return distance_to(points_[a], position) < distance_to(points_[b], position);
    });
    return {points_[*best].normal, 1};
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

std::vector<float> boundary_irradiance(const Scene& scene, std::span<const BoundaryPoint> points, int samples,
                                       Pcg32& random) {
    std::vector<float> result;
    for (const BoundaryPoint& point : points) {
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
        result.push_back(std::isfinite(sum) ? sum / static_cast<float>(samples) : 0.0f);
    }
    const float total = std::accumulate(result.begin(), result.end(), 0.0f);
    const float least = total > 0 ? 0.02f * total / static_cast<float>(result.size()) : 1.0f;
    for (float& value : result) {
        value += least;
    }
    return result;
}

float mean_chord(const Scene& scene, MediumId medium, std::span<const BoundaryPoint> points, Pcg32& random) {
    const float diameter = length(bounds_of(points).size());
    float sum = 0;
    for (const BoundaryPoint& point : points) {
        Ray ray = spawn_ray(point.position, point.normal,
                            Frame::from_z(-point.normal).to_world(to_cosine_hemisphere(random.uniform2())));
        float chord = 0;
        // Past what does not end the medium, such as interfaces within it.
        for (int crossed = 0; crossed < 8 && chord < diameter; ++crossed) {
            const std::optional<Hit> hit = scene.intersect(ray, diameter);
            chord += hit ? hit->distance : diameter;
            if (!hit || !scene.is_interface(*hit) ||
                (hit->surface->bounds_medium() && scene.medium_beyond(*hit, ray.direction, medium) != medium)) {
                break;
            }
            ray = spawn_ray(hit->position, hit->normal, ray.direction);
        }
        sum += std::min(chord, diameter);
    }
    return points.empty() ? 0.0f : sum / static_cast<float>(points.size());
}

}  // namespace wend
