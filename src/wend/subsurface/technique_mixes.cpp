#include <wend/subsurface/technique_mixes.h>

#include <wend/subsurface/technique_comparison.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wend {
namespace {

/// How many interior walks, all alike, would be as good to learn from.
constexpr double trusted = 64;
/// Weights stay below the classical ones over this.
constexpr float least_defensive_fraction = 0.03f;
/// A guide that is worth less costs more than it brings.
constexpr float least_guided = 0.02f;
/// How many interior walks elsewhere what is expected in a cell begins with.
constexpr double few_walks = 16;
constexpr float first_preference = 16;
constexpr float largest_preference = 1000;
/// Of connections, by preference; and where none has succeeded in so many interior walks.
float connection_probability(float preference) {
    return 1 / (1 + (preference - 1) / 16);
}
/// Along ways that boundaries refract.
constexpr float first_through_boundaries = 0.125f;
/// On surfaces, each behind many flights.
constexpr int connections_at_surfaces = 8;
constexpr double enough_walks = 2000;
constexpr float least_probability = 1.0f / 64;
/// Of a logarithm, in one round of learning: for each relative change of the variance, and at most.
constexpr double pace = 12;
constexpr double largest_step = 1;

/// Steps of the logarithms.
struct Steps {
    SecondMoments::Sums::PerTechnique share{};
    double preference = 0;
};

/// Between what was seen and what is expected elsewhere.
Steps steps(const SecondMoments::Sums& sums, const Steps& expected) {
    const double n = sums.guided.powers[0];
    const TechniqueVariance here = variance(sums.guided);
    if (!(here.value > 0)) {
        return expected;
    }
    // `slope` and `squares`: sums of what falls.
    const auto step = [&](double slope, double squares, double elsewhere) {
        const double significance = squares > 0 ? slope * slope / (slope * slope + 4 * squares) : 0.0;
        const double seen = std::clamp(pace * slope / (n * here.value), -largest_step, largest_step) * significance;
        return (here.count * seen + trusted * elsewhere) / (here.count + trusted);
    };
    Steps result;
    for (std::size_t i = 0; i < result.share.size(); ++i) {
        result.share[i] = step(sums.slopes[i] - sums.guided.powers[2] / n * sums.densities[i], sums.slope_squares[i],
                               expected.share[i]);
    }
    result.preference = step(-sums.preference_slope, sums.preference_slope_squares, expected.preference);
    return result;
}

/// Makes the steps.
void learn_guided(TechniqueMix& plan, const Steps& steps) {
    plan.guided.preference =
        std::clamp(plan.guided.preference * static_cast<float>(std::exp(steps.preference)), 1.0f, largest_preference);
    const float classical = plan.defensive_fraction * static_cast<float>(std::exp(steps.share[0]));
    const float guided = (1 - plan.defensive_fraction) * static_cast<float>(std::exp(steps.share[1]));
    const bool is_useless = guided < least_guided * (classical + guided);
    plan.defensive_fraction = is_useless ? 1 : std::max(classical / (classical + guided), least_defensive_fraction);
}

}  // namespace

TechniqueMixes::TechniqueMixes(const Box3& box, float defensive_fraction)
    : box_(box),
      plans_(side * side * side, TechniqueMix{defensive_fraction,
                                              largest_share_for_watching,
                                              true,
                                              {first_preference, connection_probability(first_preference),
                                               first_through_boundaries, connections_at_surfaces},
                                              {1, 1, first_through_boundaries, connections_at_surfaces},
                                              1}),
      brought_(plans_.size()) {
}

int TechniqueMixes::cell_at(const Vec3& entry) const {
    int cell = 0;
    for (int axis = 2; axis >= 0; --axis) {
        const float size = box_.max[axis] - box_.min[axis];
        const float u = size > 0 ? (entry[axis] - box_.min[axis]) / size : 0.0f;
        cell = cell * side + std::clamp(static_cast<int>(u * side), 0, side - 1);
    }
    return cell;
}

void TechniqueMixes::learn(const std::map<int, SecondMoments::Sums>& moments, NextWalks next) {
    SecondMoments::Sums all;
    for (const auto& [cell, sums] : moments) {
        all += sums;
    }
    // The first interior walks are not relative to anything, and cannot be compared.
    const bool is_first = expected_.empty();
    expect(moments);
    connects_ = connects_ || all.connected > 0;
    connects_through_ = connects_through_ || all.connected_through > 0;
    const bool is_early = all_brought().interior_walks < enough_walks;
    const auto most = [is_early](bool connects) { return connects || is_early ? 1.0f : least_probability; };
    const float most_connected = most(connects_);
    const float through_boundaries = first_through_boundaries * most(connects_through_);
    const TechniqueAdvantage guided = is_first ? TechniqueAdvantage() : advantage(all, seen_, through_boundaries);
    is_given_up_ = is_given_up_ || guided.is_loss(seen_, next);
    const float unguided_probability = is_given_up_                   ? 1.0f
                                       : next == NextWalks::rendering ? 0.0f
                                                                      : guided.share_for_watching();
    const Steps overall = steps(all, {});
    for (std::size_t cell = 0; cell < plans_.size(); ++cell) {
        const auto seen = moments.find(static_cast<int>(cell));
        TechniqueMix& plan = plans_[cell];
        learn_guided(plan, seen == moments.end() ? overall : steps(seen->second, overall));
        plan.unguided_probability = unguided_probability;
        plan.is_unguided_classical = next == NextWalks::beside_classical;
        plan.recording_probability = guided.recording_probability();
        plan.guided.probability = std::min(connection_probability(plan.guided.preference), most_connected);
        plan.unguided.probability = most_connected;
        plan.guided.through_boundaries = plan.unguided.through_boundaries = through_boundaries;
    }
    seen_ = next;
}

void TechniqueMixes::learn_from(std::span<const InteriorWalkRecord> interior_walks, NextWalks next) {
    constexpr int here = 0;
    SecondMoments moments;
    for (const InteriorWalkRecord& walk : interior_walks) {
        InteriorWalkRecord counted = relative(walk);
        counted.medium = here;
        moments.add(cell_at(walk.entry), counted);
    }
    learn(moments.of(here), next);
}

auto TechniqueMixes::all_brought() const -> Brought {
    return std::accumulate(brought_.begin(), brought_.end(), Brought{}, [](const Brought& a, const Brought& b) {
        return Brought{a.interior_walks + b.interior_walks, a.light + b.light};
    });
}

void TechniqueMixes::expect(const std::map<int, SecondMoments::Sums>& moments) {
    for (const auto& [index, sums] : moments) {
        const auto cell = static_cast<std::size_t>(index);
        const double scale = expected_.empty() ? 1.0 : static_cast<double>(expected_[cell]);
        brought_[cell].interior_walks += sums.guided.powers[0] + sums.unguided.powers[0];
        brought_[cell].light += scale * (sums.guided.powers[1] + sums.unguided.powers[1]);
    }
    const Brought all = all_brought();
    if (!(all.light > 0)) {
        return;
    }
    const double mean = all.light / all.interior_walks;
    expected_.resize(brought_.size());
    std::transform(brought_.begin(), brought_.end(), expected_.begin(), [mean](const Brought& b) {
        return static_cast<float>((b.light + few_walks * mean) / (b.interior_walks + few_walks));
    });
}

InteriorWalkRecord TechniqueMixes::relative(const InteriorWalkRecord& interior_walk) const {
    if (expected_.empty()) {
        return interior_walk;
    }
    const float expected = expected_[static_cast<std::size_t>(cell_at(interior_walk.entry))];
    return interior_walk.times(1 / std::max(expected, interior_walk.brought / SecondMoments::most_expected));
}

}  // namespace wend
