#include <wend/core/parallel.h>
#include <wend/integrator/boundary_field.h>
#include <wend/medium/fresnel.h>

#include <algorithm>
#include <cmath>
#include <map>

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
            distances.emplace_back(distance2_to(points_[p].point, centre), static_cast<std::uint16_t>(p));
        }
        Cell& cell = cells_[i];
        double light = 0, unlit = 0;
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
            const double reach = std::exp(-decay * (r - nearest)) / r;
            const double value = points_[p].irradiance * reach;
            light += value;
            unlit += reach;
            slope += Imath::V3d(way) * (value * (decay + 1 / r) / r);
        }
        const double size = slope.length();
        cell.irradiance = static_cast<float>(light / unlit);
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

const LitPoint& BoundaryField::closest_point(const Cell& cell, const Vec3& position) const {
    std::uint16_t best = cell.nearest[0];
    float least = infinity;
    for (const std::uint16_t candidate : cell.nearest) {
        const float distance2 = distance2_to(points_[candidate].point, position);
        if (distance2 < least) {
            least = distance2;
            best = candidate;
        }
    }
    return points_[best];
}

BoundaryField::View BoundaryField::at(const Vec3& position) const {
    const Cell& cell = cells_[cell_at(position)];
    return {closest_point(cell, position), cell, position};
}

LayerPlace BoundaryField::View::layer() const {
    return {-closest_.point.normal, std::clamp(depth_, 0.0f, closest_.thickness), closest_.thickness,
            closest_.irradiance, closest_.irradiance_behind};
}

LampView BoundaryField::View::lamps() const {
    return {std::span(closest_.lamps).first(static_cast<std::size_t>(closest_.lamp_count)), std::max(0.0f, depth_),
            Rgb(cell_.irradiance)};
}

float BoundaryField::distance2_to(const BoundaryPoint& point, const Vec3& position) const {
    const Vec3 way = position - point.position;
    const float height = dot(way, point.normal);
    const float aside = std::max(0.0f, safe_sqrt(length_squared(way) - sqr(height)) - spacing_);
    return sqr(height) + sqr(aside);
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

/// Light of one of the scene's lights, just inside of the boundary.
struct Refracted {
    float fluence = 0;
    Vec3 towards{0, 0, 0};  ///< directions out to it, weighted with the fluence
};

/// Sums up samples of lights as they arrive at a point of a boundary.
class LightAtPoint {
public:
    LightAtPoint(const Scene& scene, const BoundaryPoint& point, const BoundarySurface& boundary)
        : scene_(scene), point_(point), boundary_(boundary) {}

    void add_sample(Pcg32& random) {
        const LightReceiver receiver{point_.position, point_.normal};
        const float u = random.uniform();
        const Vec2 u2 = random.uniform2();
        const ChosenLight chosen =
            std::visit([&](const auto& s) { return s.sample(receiver, u); }, scene_.light_sampler());
        if (chosen.index < 0) {
            return;
        }
        const auto light = sample_light(scene_.lights()[static_cast<std::size_t>(chosen.index)], point_.position, u2);
        const float cosine = light ? dot(light->direction, point_.normal) : 0.0f;
        if (!(cosine > 0) || scene_.is_occluded(spawn_ray(point_.position, point_.normal, light->direction),
                                                light->distance * (1 - 1e-3f))) {
            return;
        }
        const float brought = mean_value(light->radiance) * cosine / (light->density * chosen.probability);
        if (!std::isfinite(brought)) {
            return;
        }
        irradiance_ += brought;
        const auto refracted = refract(light->direction, point_.normal, boundary_.ior);
        // Walks cannot find what only connections reach, unless they can be connected at the boundary.
        if (refracted && (!light->point_like || boundary_.alpha > 0)) {
            const float fluence =
                brought * (1 - fresnel_dielectric(cosine, boundary_.ior)) / -dot(refracted->direction, point_.normal);
            Refracted& sum = by_light_[chosen.index];
            sum.fluence += fluence;
            sum.towards -= refracted->direction * fluence;
        }
    }

    float irradiance(int samples) const { return irradiance_ / static_cast<float>(samples); }

    void write_lamps(int samples, LitPoint& lit) const {
        std::vector<BoundaryLamp> lamps;
        for (const auto& [index, light] : by_light_) {
            const float size = length(light.towards);
            const float kappa = vmf_kappa(size / light.fluence);
            if (!(kappa > least_kappa)) {
                continue;
            }
            const Vmf seen = convolve({light.towards / size, kappa}, boundary_.blur());
            lamps.push_back({seen, std::max(0.05f, dot(seen.mean, point_.normal)),
                             certainty * light.fluence / static_cast<float>(samples), vmf_peak(seen.kappa)});
        }
        const auto count = static_cast<std::ptrdiff_t>(std::min(lamps.size(), lit.lamps.size()));
        std::partial_sort(lamps.begin(), lamps.begin() + count, lamps.end(),
                          [](const BoundaryLamp& a, const BoundaryLamp& b) { return a.fluence > b.fluence; });
        std::copy_n(lamps.begin(), count, lit.lamps.begin());
        lit.lamp_count = static_cast<int>(count);
    }

private:
    // What is so wide that the diffuse light does as well.
    static constexpr float least_kappa = 4;
    // What goes on scattering varies much more than what flies out to a lamp, and walks are drawn by second moments:
    // of 0.07, 0.2, 1 and 4 this was the best on three scenes.
    static constexpr float certainty = 0.2f;

    const Scene& scene_;
    const BoundaryPoint& point_;
    const BoundarySurface& boundary_;
    float irradiance_ = 0;
    std::map<int, Refracted> by_light_;
};

}  // namespace

float BoundarySurface::blur() const {
    // Normals tilted by theta move the refracted direction by about (1 - 1/ior) theta; a flat piece of boundary stands
    // for a curved one.
    constexpr float curvature = 0.03f;
    const float spread = alpha * 0.7f * std::abs(1 - 1 / ior);
    return 1 / (sqr(spread) + sqr(curvature));
}

std::vector<LitPoint> lit_points(const Scene& scene, MediumId medium, std::span<const BoundaryPoint> points,
                                 const BoundarySurface& boundary, int samples, Pcg32& random) {
    std::vector<LitPoint> result;
    const float diameter = length(bounds_of(points).size());
    float total = 0;
    for (const BoundaryPoint& point : points) {
        const float thickness = chord(scene, medium, spawn_ray(point.position, point.normal, -point.normal), diameter);
        LightAtPoint light(scene, point, boundary);
        for (int i = 0; i < samples; ++i) {
            light.add_sample(random);
        }
        result.push_back({point, light.irradiance(samples), thickness, 0});
        light.write_lamps(samples, result.back());
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
