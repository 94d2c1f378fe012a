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
    parallel_for(cells_.size(), threads, [&](std::size_t i) {
        const int n = static_cast<int>(i);
        const Vec3 index(static_cast<float>(n % side), static_cast<float>(n / side % side),
                         static_cast<float>(n / side / side));
        const Vec3 centre = box_.min + (index + Vec3(0.5f)) * step;
        std::vector<std::pair<float, std::uint16_t>> distances;
        distances.reserve(points_.size());
        for (std::size_t p = 0; p < points_.size(); ++p) {
            distances.emplace_back(distance2_to(p, centre), static_cast<std::uint16_t>(p));
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
