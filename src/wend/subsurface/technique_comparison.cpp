#include <wend/subsurface/technique_comparison.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// What a flight takes of time, in classical ones, if it is guided or follows the learned field, and how many of these
/// a walk makes beside an interior walk.
constexpr double cost_of_guided_flight = 2.2, cost_of_field_flight = 2.5;
constexpr double flights_outside = 2;
/// In classical flights, what looking for a way that boundaries refract takes.
constexpr double cost_of_way = 4;
/// How much of the variance unguided interior walks may add while they are watched.
constexpr float variance_for_watching = 0.1f;
/// How much of guided interior walks is recorded where they have this advantage.
constexpr float least_told = 0.125f;
/// Of a logarithm.
constexpr double clear_advantage = 0.5;

/// What the variance of a kind lacks at least because large values are cut off. Both kinds bring the same on average:
/// of F, cut off at c, E[F²] lacks 2 c times what E[F] lacks, or more. Only what is significant counts.
double cut_off(const SecondMoments::Kind& kind, const SecondMoments::Kind& other) {
    const auto mean = [](const SecondMoments::Kind& k) { return k.powers[1] / k.powers[0]; };
    const auto square_error = [](const SecondMoments::Kind& k) { return variance(k).value / k.powers[0]; };
    const double deviation = std::sqrt(square_error(kind) + square_error(other));
    const double lacks = std::max(0.0, mean(other) - mean(kind) - 2 * deviation);
    return (2 * static_cast<double>(SecondMoments::most_expected) - mean(kind) - mean(other)) * lacks;
}

}  // namespace

TechniqueVariance variance(const SecondMoments::Kind& sums) {
    const auto& powers = sums.powers;
    const double n = powers[0];
    if (!(n > 0)) {
        return {};
    }
    const double mean = powers[1] / n, value = powers[2] / n - mean * mean;
    const double fourth =
        (powers[4] - 4 * mean * powers[3] + 6 * mean * mean * powers[2]) / n - 3 * mean * mean * mean * mean;
    return value > 1e-6 * mean * mean ? TechniqueVariance{value, fourth > 0 ? n * value * value / fourth : 0.0}
                                      : TechniqueVariance{};
}

bool TechniqueAdvantage::is_loss(NextWalks seen, NextWalks next) const {
    const bool beside_field = seen == NextWalks::beside_field;
    return next == NextWalks::rendering ? efficiency < (beside_field ? deviation : 0) && deviation < 0.5
                                        : beside_field && efficiency < -clear_advantage - deviation;
}

float TechniqueAdvantage::share_for_watching() const {
    return std::min(largest_share_for_watching, variance_for_watching * std::exp(-static_cast<float>(variance)));
}

float TechniqueAdvantage::recording_probability() const {
    return over_field > clear_advantage ? least_told : 1.0f;
}

TechniqueAdvantage advantage(const SecondMoments::Sums& sums, NextWalks seen, float through_boundaries) {
    const SecondMoments::Kind &guided = sums.guided, &unguided = sums.unguided;
    const auto [guided_variance, guided_count] = variance(guided);
    const auto [unguided_variance, unguided_count] = variance(unguided);
    if (!(guided_count > 0 && unguided_count > 0)) {
        return {};
    }
    const double ways = cost_of_way * static_cast<double>(through_boundaries);
    const auto cost = [ways](const SecondMoments::Kind& kind, double flight) {
        return std::log(flights_outside + (flight + ways) * kind.flights / kind.powers[0]);
    };
    const double ratio =
        std::log((unguided_variance + cut_off(unguided, guided)) / (guided_variance + cut_off(guided, unguided)));
    const double saved = ratio - cost(guided, cost_of_guided_flight);
    const double cost_of_unguided_flight = seen == NextWalks::beside_field ? cost_of_field_flight : 1;
    return {saved + cost(unguided, cost_of_unguided_flight), std::sqrt(1 / guided_count + 1 / unguided_count), ratio,
            saved + cost(unguided, cost_of_field_flight)};
}

}  // namespace wend
