#include <wend/integrator/stay_plans.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wend {
namespace {

/// How many stays, all alike, would be as good to learn from.
constexpr double trusted = 64;
/// Weights stay below the classical ones over this.
constexpr float least_classical = 0.03f;
/// A guide that is worth less costs more than it brings.
constexpr float least_guided = 0.02f;
constexpr float first_preference = 16;
constexpr float largest_preference = 1000;
/// Of connections, by preference; and where none has succeeded in so many stays.
float connection_probability(float preference) {
    return 1 / (1 + (preference - 1) / 16);
}
constexpr double enough_stays = 2000;
constexpr float least_probability = 1.0f / 64;
/// Of a logarithm, in one round of learning: for each relative change of the variance, and at most.
constexpr double pace = 12;
constexpr double largest_step = 1;

/// Steps of the logarithms.
struct Steps {
    StayMoments::Sums::PerTechnique share{};
    double preference = 0;
};

/// Between what was seen and what is expected elsewhere.
Steps steps(const StayMoments::Sums& sums, const Steps& expected) {
    const double n = sums.powers[0];
    const double mean = n > 0 ? sums.powers[1] / n : 0.0;
    const double variance = n > 0 ? sums.powers[2] / n - mean * mean : 0.0;
    if (!(variance > 1e-6 * mean * mean)) {
        return expected;
    }
    const double fourth = (sums.powers[4] - 4 * mean * sums.powers[3] + 6 * mean * mean * sums.powers[2]) / n -
                          3 * mean * mean * mean * mean;
    const double count = fourth > 0 ? n * variance * variance / fourth : 0.0;
    // `slope` and `squares`: sums of what falls.
    const auto step = [&](double slope, double squares, double elsewhere) {
        const double significance = squares > 0 ? slope * slope / (slope * slope + 4 * squares) : 0.0;
        const double seen = std::clamp(pace * slope / (n * variance), -largest_step, largest_step) * significance;
        return (count * seen + trusted * elsewhere) / (count + trusted);
    };
    Steps result;
    for (std::size_t i = 0; i < result.share.size(); ++i) {
        result.share[i] =
            step(sums.slopes[i] - sums.powers[2] / n * sums.densities[i], sums.slope_squares[i], expected.share[i]);
    }
    result.preference = step(-sums.preference_slope, sums.preference_slope_squares, expected.preference);
    return result;
}

void normalize(SlabGuide::Shares& shares) {
    const float total = std::accumulate(shares.begin(), shares.end(), 0.0f);
    for (float& share : shares) {
        share /= total;
    }
}

}  // namespace

StayMoments::Sums& StayMoments::Sums::operator+=(const Sums& other) {
    const auto add = [](auto& to, const auto& from) {
        for (std::size_t i = 0; i < to.size(); ++i) {
            to[i] += from[i];
        }
    };
    add(powers, other.powers);
    add(slopes, other.slopes);
    add(densities, other.densities);
    connected += other.connected;
    add(slope_squares, other.slope_squares);
    preference_slope += other.preference_slope;
    preference_slope_squares += other.preference_slope_squares;
    return *this;
}

void StayMoments::add(int cell, const Stay& stay) {
    const double f = stay.brought;
    Sums one{{1, f, f * f, f * f * f, f * f * f * f},
             {},
             {},
             stay.connected ? 1.0 : 0.0,
             2 * f * static_cast<double>(stay.slope.preference),
             {},
             0};
    one.preference_slope_squares = sqr(one.preference_slope);
    bool finite = std::isfinite(one.powers[4]) && std::isfinite(one.preference_slope);
    for (std::size_t i = 0; i < one.densities.size(); ++i) {
        one.densities[i] = stay.relative[i];
        one.slopes[i] = 2 * f * static_cast<double>(stay.slope.shares[i]) - f * f * one.densities[i];
        one.slope_squares[i] = sqr(one.slopes[i]);
        finite = finite && std::isfinite(one.densities[i]) && std::isfinite(one.slopes[i]);
    }
    if (finite) {
        media_[stay.medium][cell] += one;
    }
}

StayMoments& StayMoments::operator+=(const StayMoments& other) {
    for (const auto& [medium, cells] : other.media_) {
        for (const auto& [cell, sums] : cells) {
            media_[medium][cell] += sums;
        }
    }
    return *this;
}

const std::map<int, StayMoments::Sums>& StayMoments::of(int medium) const {
    static const std::map<int, Sums> nothing;
    const auto found = media_.find(medium);
    return found == media_.end() ? nothing : found->second;
}

StayPlans::StayPlans(const Box3& box, const SlabGuide::Shares& start)
    : box_(box),
      plans_(side * side * side, StayPlan{start, {first_preference, connection_probability(first_preference)}}) {
}

int StayPlans::cell_at(const Vec3& entry) const {
    int cell = 0;
    for (int axis = 2; axis >= 0; --axis) {
        const float size = box_.max[axis] - box_.min[axis];
        const float u = size > 0 ? (entry[axis] - box_.min[axis]) / size : 0.0f;
        cell = cell * side + std::clamp(static_cast<int>(u * side), 0, side - 1);
    }
    return cell;
}

void StayPlans::learn(const std::map<int, StayMoments::Sums>& moments) {
    StayMoments::Sums all;
    for (const auto& [cell, sums] : moments) {
        all += sums;
    }
    stays_ += all.powers[0];
    connects_ = connects_ || all.connected > 0;
    const Steps overall = steps(all, {});
    for (std::size_t cell = 0; cell < plans_.size(); ++cell) {
        const auto seen = moments.find(static_cast<int>(cell));
        const Steps here = seen == moments.end() ? overall : steps(seen->second, overall);
        StayPlan& plan = plans_[cell];
        StayPlan::Connecting& connecting = plan.connecting;
        connecting.preference =
            std::clamp(connecting.preference * static_cast<float>(std::exp(here.preference)), 1.0f, largest_preference);
        connecting.probability =
            connects_ || stays_ < enough_stays ? connection_probability(connecting.preference) : least_probability;
        SlabGuide::Shares& shares = plan.shares;
        for (std::size_t i = 0; i < shares.size(); ++i) {
            shares[i] *= static_cast<float>(std::exp(here.share[i]));
        }
        normalize(shares);
        for (std::size_t i = 1; i < shares.size(); ++i) {
            shares[i] = shares[i] < least_guided ? 0.0f : shares[i];
        }
        shares[0] = std::max(shares[0], least_classical);
        normalize(shares);
    }
}

}  // namespace wend
