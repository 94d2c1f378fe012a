#include <wend/core/parallel.h>
#include <wend/numeric/fast_math.h>
#include <wend/transport/boundary_field.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wend {
namespace {

/// Index of the cell of an interval of `side` cells.
int cell_of(float x, float low, float high, int side) {
    return high > low ? std::clamp(static_cast<int>((x - low) / (high - low) * static_cast<float>(side)), 0, side - 1)
                      : 0;
}

/// The points of a boundary as sources of exp(-decay r) / r. They stand outside by as much as they are apart: from
/// inside they then look like a smooth surface. There are ten million pairs of cells and sources: numbers of the same
/// kind lie side by side, so that loops over them vectorize.
class Sources {
public:
    Sources(const std::vector<LitPoint>& points, float spacing) : least_distance_(1e-3f * spacing) {
        for (const LitPoint& p : points) {
            const Vec3 place = p.point.position + p.point.normal * spacing;
            x_.push_back(place.x);
            y_.push_back(place.y);
            z_.push_back(place.z);
            irradiance_.push_back(p.irradiance);
        }
    }

    /// All up to one factor.
    struct Light {
        double lit = 0;             ///< of all sources, each as bright as its irradiance
        double unlit = 0;           ///< were they all as bright as 1
        Imath::V3d slope{0, 0, 0};  ///< the gradient of `lit`
    };
    Light at(const Vec3& position, float decay) const {
        const std::size_t count = x_.size();
        std::vector<float> distance(count), reach(count);
        for (std::size_t p = 0; p < count; ++p) {
            const float squared = sqr(x_[p] - position.x) + sqr(y_[p] - position.y) + sqr(z_[p] - position.z);
            distance[p] = std::max(std::sqrt(squared), least_distance_);
        }
        // Relative to the nearest source: so it stays within the range of numbers.
        const float nearest = count > 0 ? *std::min_element(distance.begin(), distance.end()) : 0;
        for (std::size_t p = 0; p < count; ++p) {
            reach[p] = fast_exp(-decay * (distance[p] - nearest)) / distance[p];
        }
        Light light;
        for (std::size_t p = 0; p < count; ++p) {
            const double value = static_cast<double>(irradiance_[p] * reach[p]);
            const double r = static_cast<double>(distance[p]);
            light.lit += value;
            light.unlit += static_cast<double>(reach[p]);
            const Vec3 way(x_[p] - position.x, y_[p] - position.y, z_[p] - position.z);
            light.slope += Imath::V3d(way) * (value * (static_cast<double>(decay) + 1 / r) / r);
        }
        return light;
    }

private:
    float least_distance_;
    std::vector<float> x_, y_, z_, irradiance_;
};

}  // namespace

float steepness(float decay, float curvature, float depth) {
    if (!(curvature > 0)) {
        return 1;
    }
    const float x = decay * std::max(0.0f, 1 / curvature - std::max(0.0f, depth));
    const float e = fast_expm1(-2 * x);
    return x > 0.1f ? -(2 + e) / e - 1 / x : x / 3;
}

BoundaryField::BoundaryField(const Box3& box, std::vector<LitPoint> points, float decay, int threads)
    : box_(box),
      decay_(decay),
      spacing_(length(box_.size()) / std::sqrt(static_cast<float>(points.size()))),
      points_(std::move(points)),
      places_(points_.size()),
      cells_(side * side * side) {
    std::transform(points_.begin(), points_.end(), places_.begin(), [](const LitPoint& p) { return p.point; });
    const Vec3 step = box_.size() * (1.0f / side);
    const Sources sources(points_, spacing_);
    parallel_for(cells_.size(), threads, [&](std::size_t i) {
        const int n = static_cast<int>(i);
        const Vec3 index(static_cast<float>(n % side), static_cast<float>(n / side % side),
                         static_cast<float>(n / side / side));
        const Vec3 centre = box_.min + (index + Vec3(0.5f)) * step;
        Cell& cell = cells_[i];
        const Sources::Light light = sources.at(centre, decay);
        const double size = light.slope.length();
        cell.irradiance = static_cast<float>(light.lit / light.unlit);
        if (light.lit > 0 && size > 0) {
            cell.incident = {Vec3(light.slope / size),
                             static_cast<float>(std::min(1.0, size / (light.lit * static_cast<double>(decay))))};
        } else {
            cell.incident.steepness = 0;
        }
        cell.nearest = nearest_to(centre);
    });
}

auto BoundaryField::nearest_to(const Vec3& position) const -> std::array<std::uint16_t, candidates> {
    std::vector<std::pair<float, std::uint16_t>> distances;
    distances.reserve(points_.size());
    for (std::size_t p = 0; p < points_.size(); ++p) {
        distances.emplace_back(distance2_to(p, position), static_cast<std::uint16_t>(p));
    }
    const auto few = std::min<std::ptrdiff_t>(candidates, std::ssize(distances));
    std::partial_sort(distances.begin(), distances.begin() + few, distances.end());
    std::array<std::uint16_t, candidates> nearest;
    for (std::ptrdiff_t k = 0; k < candidates; ++k) {
        nearest[static_cast<std::size_t>(k)] = distances[static_cast<std::size_t>(std::min(k, few - 1))].second;
    }
    return nearest;
}

std::size_t BoundaryField::cell_at(const Vec3& p) const {
    const int x = cell_of(p.x, box_.min.x, box_.max.x, side);
    const int y = cell_of(p.y, box_.min.y, box_.max.y, side);
    const int z = cell_of(p.z, box_.min.z, box_.max.z, side);
    return static_cast<std::size_t>((z * side + y) * side + x);
}

std::size_t BoundaryField::closest_point(const Cell& cell, const Vec3& position) const {
    // First all distances, then the least of them: which one it is cannot be foretold.
    std::array<float, candidates> distances;
    for (std::size_t k = 0; k < candidates; ++k) {
        distances[k] = distance2_to(cell.nearest[k], position);
    }
    std::size_t best = 0;
    for (std::size_t k = 1; k < candidates; ++k) {
        best = distances[k] < distances[best] ? k : best;
    }
    return cell.nearest[best];
}

BoundaryField::View BoundaryField::at(const Vec3& position) const {
    const Cell& cell = cells_[cell_at(position)];
    return {points_[closest_point(cell, position)], cell, position, decay_};
}

bool BoundaryField::sees_emitters() const {
    return std::any_of(points_.begin(), points_.end(), [](const LitPoint& point) { return point.emitter_count > 0; });
}

EmitterView BoundaryField::View::lamps(const Rgb& returned, const Rgb& decay) const {
    const float depth = std::max(0.0f, depth_);
    EmitterView view{std::span(closest_.lamps).first(static_cast<std::size_t>(closest_.emitter_count)), depth,
                     Rgb(cell_.irradiance)};
    for (int c = 0; c < 3; ++c) {
        view.diffuse[c] *= returned[c] * fast_exp(-decay[c] * depth);
    }
    return view;
}

float BoundaryField::distance2_to(std::size_t point, const Vec3& position) const {
    const BoundaryPoint& place = places_[point];
    const Vec3 way = position - place.position;
    const float height2 = sqr(dot(way, place.normal));
    const float aside = std::max(0.0f, safe_sqrt(length_squared(way) - height2) - spacing_);
    return height2 + sqr(aside);
}

}  // namespace wend
