#include <wend/transport/boundary_field.h>

#include <wend/numeric/fast_math.h>

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

/// The flat pieces of surface that points of a boundary stand for. A cell asks all of them: numbers of the same kind
/// lie side by side, so that loops over them vectorize.
class BoundaryField::Pieces {
public:
    Pieces(const std::vector<LitPoint>& points, float spacing) : radius_(spacing) {
        for (const LitPoint& p : points) {
            const Vec3 &place = p.point.position, &normal = p.point.normal;
            x_.push_back(place.x);
            y_.push_back(place.y);
            z_.push_back(place.z);
            normal_x_.push_back(normal.x);
            normal_y_.push_back(normal.y);
            normal_z_.push_back(normal.z);
        }
    }

    /// Square of the distance to one of them.
    float distance2_to(std::size_t piece, const Vec3& position) const {
        const float x = position.x - x_[piece], y = position.y - y_[piece], z = position.z - z_[piece];
        const float height2 = sqr(x * normal_x_[piece] + y * normal_y_[piece] + z * normal_z_[piece]);
        const float length2 = sqr(x) + sqr(y) + sqr(z);
        return height2 + sqr(std::max(0.0f, std::sqrt(std::max(0.0f, length2 - height2)) - radius_));
    }

    /// Those with the least distances, the nearest first.
    std::array<std::uint16_t, candidates> nearest_to(const Vec3& position) const {
        std::vector<float> distances(x_.size());
        for (std::size_t p = 0; p < distances.size(); ++p) {
            distances[p] = distance2_to(p, position);
        }
        std::array<std::uint16_t, candidates> nearest{};
        std::array<float, candidates> least;
        least.fill(infinity);
        for (std::size_t p = 0; p < distances.size(); ++p) {
            if (!(distances[p] < least.back())) {
                continue;
            }
            std::size_t k = candidates - 1;
            for (; k > 0 && distances[p] < least[k - 1]; --k) {
                least[k] = least[k - 1];
                nearest[k] = nearest[k - 1];
            }
            least[k] = distances[p];
            nearest[k] = static_cast<std::uint16_t>(p);
        }
        return nearest;
    }

private:
    float radius_;
    std::vector<float> x_, y_, z_, normal_x_, normal_y_, normal_z_;
};

/// The points of a boundary as sources of exp(-decay r) / r. They stand outside by as much as they are apart: from
/// inside they then look like a smooth surface.
class BoundaryField::Sources {
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
        std::vector<float> distance(count);
        for (std::size_t p = 0; p < count; ++p) {
            const float squared = sqr(x_[p] - position.x) + sqr(y_[p] - position.y) + sqr(z_[p] - position.z);
            distance[p] = std::max(std::sqrt(squared), least_distance_);
        }
        // Relative to the nearest source: so it stays within the range of numbers, in any unit of length.
        const float nearest = count > 0 ? *std::min_element(distance.begin(), distance.end()) : 0;
        // Sums of every eighth source side by side.
        constexpr std::size_t lanes = 8;
        std::array<float, lanes> lit{}, unlit{}, slope_x{}, slope_y{}, slope_z{};
        const auto add = [&](std::size_t p, std::size_t lane) {
            const float closeness = nearest / distance[p];
            const float reach = fast_exp(-decay * (distance[p] - nearest)) * closeness;
            const float value = irradiance_[p] * reach;
            const float steep = value * (decay * nearest + closeness) / distance[p];
            lit[lane] += value;
            unlit[lane] += reach;
            slope_x[lane] += (x_[p] - position.x) * steep;
            slope_y[lane] += (y_[p] - position.y) * steep;
            slope_z[lane] += (z_[p] - position.z) * steep;
        };
        std::size_t p = 0;
        for (; p + lanes <= count; p += lanes) {
            for (std::size_t lane = 0; lane < lanes; ++lane) {
                add(p + lane, lane);
            }
        }
        for (; p < count; ++p) {
            add(p, p % lanes);
        }
        const auto sum = [](const std::array<float, lanes>& of) { return std::accumulate(of.begin(), of.end(), 0.0); };
        Light light;
        light.lit = sum(lit);
        light.unlit = sum(unlit);
        light.slope = Imath::V3d(sum(slope_x), sum(slope_y), sum(slope_z)) / static_cast<double>(nearest);
        return light;
    }

private:
    float least_distance_;
    std::vector<float> x_, y_, z_, irradiance_;
};

float steepness(float decay, float curvature, float depth) {
    if (!(curvature > 0)) {
        return 1;
    }
    const float x = decay * std::max(0.0f, 1 / curvature - std::max(0.0f, depth));
    const float e = fast_expm1(-2 * x);
    return x > 0.1f ? -(2 + e) / e - 1 / x : x / 3;
}

BoundaryField::BoundaryField(const Box3& box, std::vector<LitPoint> points, float decay)
    : box_(box), decay_(decay), points_(std::move(points)), cells_(std::make_unique<Cell[]>(side * side * side)) {
    const float spacing = length(box_.size()) / std::sqrt(static_cast<float>(points_.size()));
    pieces_ = std::make_unique<Pieces>(points_, spacing);
    sources_ = std::make_unique<Sources>(points_, spacing);
}

BoundaryField::BoundaryField(BoundaryField&&) noexcept = default;

BoundaryField::~BoundaryField() = default;

void BoundaryField::work_out(Cell& cell, const Vec3& centre) const {
    const Sources::Light light = sources_->at(centre, decay_);
    const double size = light.slope.length();
    cell.irradiance = static_cast<float>(light.lit / light.unlit);
    if (light.lit > 0 && size > 0) {
        cell.incident = {Vec3(light.slope / size),
                         static_cast<float>(std::min(1.0, size / (light.lit * static_cast<double>(decay_))))};
    } else {
        cell.incident.steepness = 0;
    }
    cell.nearest = pieces_->nearest_to(centre);
}

auto BoundaryField::cell_at(const Vec3& p) const -> const Cell& {
    const int x = cell_of(p.x, box_.min.x, box_.max.x, side);
    const int y = cell_of(p.y, box_.min.y, box_.max.y, side);
    const int z = cell_of(p.z, box_.min.z, box_.max.z, side);
    Cell& cell = cells_[static_cast<std::size_t>((z * side + y) * side + x)];
    std::call_once(cell.once, [&] {
        const Vec3 index(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
        work_out(cell, box_.min + (index + Vec3(0.5f)) * (box_.size() * (1.0f / side)));
    });
    return cell;
}

std::size_t BoundaryField::closest_point(const Cell& cell, const Vec3& position) const {
    // First all distances, then the least of them: which one it is cannot be foretold.
    std::array<float, candidates> distances;
    for (std::size_t k = 0; k < candidates; ++k) {
        distances[k] = pieces_->distance2_to(cell.nearest[k], position);
    }
    std::size_t best = 0;
    for (std::size_t k = 1; k < candidates; ++k) {
        best = distances[k] < distances[best] ? k : best;
    }
    return cell.nearest[best];
}

BoundaryField::View BoundaryField::at(const Vec3& position) const {
    const Cell& cell = cell_at(position);
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

}  // namespace wend
