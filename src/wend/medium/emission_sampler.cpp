#include <wend/medium/emission_sampler.h>

#include <wend/core/contracts.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace wend {
namespace {

constexpr int most_cells = 32;  // a side
constexpr int points = 3;       // a side, that a cell is judged by

}  // namespace

EmissionSampler::EmissionSampler(const Box3& box, const Transform& world_from_index,
                                 const std::function<float(const Vec3&)>& emitted)
    : box_(box), index_from_world_(world_from_index.inverse()), world_from_index_(world_from_index) {
    const Vec3 size = box.size();
    for (int axis = 0; axis < 3; ++axis) {
        resolution_[axis] = static_cast<int>(std::clamp(std::ceil(size[axis]), 1.0f, static_cast<float>(most_cells)));
        cell_size_[axis] = size[axis] / static_cast<float>(resolution_[axis]);
    }
    const double volume = std::abs(world_from_index.determinant()) * static_cast<double>(cell_size_.x) *
                          static_cast<double>(cell_size_.y) * static_cast<double>(cell_size_.z);
    cell_volume_ = static_cast<float>(volume);

    const auto cells = static_cast<std::size_t>(resolution_.x * resolution_.y * resolution_.z);
    std::vector<double> sums = {0};
    for (std::size_t cell = 0; cell < cells; ++cell) {
        double sum = 0;
        for (int i = 0; i < points * points * points; ++i) {
            const Vec3 point(Vec3i(i % points, i / points % points, i / (points * points)));
            const Vec3 place = Vec3(place_of(cell)) + (point + Vec3(0.5f)) / points;
            sum += static_cast<double>(emitted(world_from_index_.point(box_.min + place * cell_size_)));
        }
        sums.push_back(sums.back() + sum / (points * points * points));
    }
    power_ = static_cast<float>(sums.back() * volume);
    if (!(power_ > 0 && std::isfinite(power_) && cell_volume_ >= std::numeric_limits<float>::min())) {
        power_ = 0;
        return;
    }
    std::transform(sums.begin(), sums.end(), std::back_inserter(cumulative_),
                   [&](double sum) { return static_cast<float>(sum / sums.back()); });
    double squares = 0;
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const auto share = static_cast<double>(probability(cell));
        squares += share * share;
    }
    unit_ = static_cast<float>(std::cbrt(volume / squares));
}

Box3 EmissionSampler::bounds() const {
    Box3 lit;
    for (std::size_t cell = 0; cell + 1 < cumulative_.size(); ++cell) {
        if (probability(cell) > 0) {
            const Vec3 low(place_of(cell));
            lit.extendBy(low);
            lit.extendBy(low + Vec3(1));
        }
    }
    Box3 result;
    for (int corner = 0; corner < 8 && !lit.isEmpty(); ++corner) {
        const Vec3 place((corner & 1) != 0 ? lit.max.x : lit.min.x, (corner & 2) != 0 ? lit.max.y : lit.min.y,
                         (corner & 4) != 0 ? lit.max.z : lit.min.z);
        result.extendBy(world_from_index_.point(box_.min + place * cell_size_));
    }
    return result;
}

EmissionSampler::Sample EmissionSampler::sample(const Vec2& u, float w) const {
    WEND_EXPECT(power_ > 0);
    // The first bound above u belongs to a cell that has a probability.
    const auto bound = std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, u.x);
    const auto cell = static_cast<std::size_t>(bound - cumulative_.begin()) - 1;
    const float rest = std::clamp((u.x - cumulative_[cell]) / probability(cell), 0.0f, one_minus_epsilon);
    const Vec3 place = Vec3(place_of(cell)) + Vec3(rest, u.y, w);
    return {world_from_index_.point(box_.min + place * cell_size_), probability(cell) / cell_volume_};
}

float EmissionSampler::density(const Vec3& position) const {
    if (cumulative_.empty()) {
        return 0;
    }
    const Vec3 place = (index_from_world_.point(position) - box_.min) / cell_size_;
    for (int axis = 0; axis < 3; ++axis) {
        // Written so that a point that is not a number is outside.
        if (!(place[axis] >= 0 && place[axis] < static_cast<float>(resolution_[axis]))) {
            return 0;
        }
    }
    const int cell = (static_cast<int>(place.z) * resolution_.y + static_cast<int>(place.y)) * resolution_.x +
                     static_cast<int>(place.x);
    return probability(static_cast<std::size_t>(cell)) / cell_volume_;
}

}  // namespace wend
