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
/// What a flight takes of time, in classical ones, if it is guided or follows the learned field, and how many of these
/// a walk makes beside a stay.
constexpr double cost_of_guided_flight = 2.2, cost_of_field_flight = 2.5;
constexpr double flights_outside = 2;
/// What each strategy beside another takes of a guided flight's time; what is left of variance times cost where it is
/// dropped for that; and by how many stays of equal weight they are compared.
constexpr double cost_of_strategy = 0.1;
constexpr double largest_without = 0.95;
constexpr double enough_to_compare = 500;
/// What a stay may count for, over what is expected.
constexpr float most_expected = 30;
/// How many stays elsewhere what is expected in a cell begins with.
constexpr double few_stays = 16;
/// How much of the variance unguided stays may add while they are watched, and their largest share.
constexpr float variance_for_watching = 0.1f;
constexpr float largest_share_for_watching = 0.0625f;
/// How much of guided stays is told where they have this advantage.
constexpr float least_told = 0.125f;
/// Of a logarithm.
constexpr double clear_advantage = 0.5;
constexpr float first_preference = 16;
constexpr float largest_preference = 1000;
/// Of connections, by preference; and where none has succeeded in so many stays.
float connection_probability(float preference) {
    return 1 / (1 + (preference - 1) / 16);
}
/// Along ways that boundaries refract; in classical flights, what looking for one takes.
constexpr float first_through_boundaries = 0.125f;
constexpr double cost_of_way = 4;
/// On surfaces, each behind many flights.
constexpr int connections_at_surfaces = 8;
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

struct Variance {
    double value = 0;
    double count = 0;  ///< how many stays of equal weight tell it
};

Variance variance(const StayMoments::Kind& sums) {
    const auto& powers = sums.powers;
    const double n = powers[0];
    if (!(n > 0)) {
        return {};
    }
    const double mean = powers[1] / n, value = powers[2] / n - mean * mean;
    const double fourth =
        (powers[4] - 4 * mean * powers[3] + 6 * mean * mean * powers[2]) / n - 3 * mean * mean * mean * mean;
    return value > 1e-6 * mean * mean ? Variance{value, fourth > 0 ? n * value * value / fourth : 0.0} : Variance{};
}

/// What the variance of a kind lacks at least because large values are cut off. Both kinds bring the same on average:
/// of F, cut off at c, E[F²] lacks 2 c times what E[F] lacks, or more. Only what is significant counts.
double cut_off(const StayMoments::Kind& kind, const StayMoments::Kind& other) {
    const auto mean = [](const StayMoments::Kind& k) { return k.powers[1] / k.powers[0]; };
    const auto square_error = [](const StayMoments::Kind& k) { return variance(k).value / k.powers[0]; };
    const double deviation = std::sqrt(square_error(kind) + square_error(other));
    const double lacks = std::max(0.0, mean(other) - mean(kind) - 2 * deviation);
    return (2 * most_expected - mean(kind) - mean(other)) * lacks;
}

/// Of guided stays over others.
struct Advantage {
    double efficiency = 0;  ///< logarithm of the ratio of variance times cost
    double deviation = 1;   ///< of that, as far as it is known
    double variance = 0;    ///< logarithm of the ratio of the variances alone
    double over_field = 0;  ///< that of variance times cost, if every unguided flight followed the learned field

    /// What is rarely found by classical sampling may long seem not to be there: while that is what guides are compared
    /// with they are not given up. In the end a doubt is in favour of the field: what it has just learned is not seen
    /// yet.
    bool is_loss(NextStays seen, NextStays next) const {
        const bool beside_field = seen == NextStays::beside_field;
        return next == NextStays::rendering ? efficiency < (beside_field ? deviation : 0) && deviation < 0.5
                                            : beside_field && efficiency < -clear_advantage - deviation;
    }

    /// The share of unguided stays while both kinds are watched.
    float share_for_watching() const {
        return std::min(largest_share_for_watching, variance_for_watching * std::exp(-static_cast<float>(variance)));
    }

    /// Unguided stays only ever seem to be better than they are.
    float told_probability() const { return over_field > clear_advantage ? least_told : 1.0f; }
};

Advantage advantage(const StayMoments::Kind& guided, const StayMoments::Kind& unguided, double cost_of_unguided_flight,
                    float through_boundaries) {
    const auto [guided_variance, guided_count] = variance(guided);
    const auto [unguided_variance, unguided_count] = variance(unguided);
    if (!(guided_count > 0 && unguided_count > 0)) {
        return {};
    }
    const double ways = cost_of_way * static_cast<double>(through_boundaries);
    const auto cost = [ways](const StayMoments::Kind& kind, double flight) {
        return std::log(flights_outside + (flight + ways) * kind.flights / kind.powers[0]);
    };
    const double ratio =
        std::log((unguided_variance + cut_off(unguided, guided)) / (guided_variance + cut_off(guided, unguided)));
    const double saved = ratio - cost(guided, cost_of_guided_flight);
    return {saved + cost(unguided, cost_of_unguided_flight), std::sqrt(1 / guided_count + 1 / unguided_count), ratio,
            saved + cost(unguided, cost_of_field_flight)};
}

/// Between what was seen and what is expected elsewhere.
Steps steps(const StayMoments::Sums& sums, const Steps& expected) {
    const double n = sums.guided.powers[0];
    const auto [variance_here, count] = variance(sums.guided);
    if (!(variance_here > 0)) {
        return expected;
    }
    // `slope` and `squares`: sums of what falls.
    const auto step = [&](double slope, double squares, double elsewhere) {
        const double significance = squares > 0 ? slope * slope / (slope * slope + 4 * squares) : 0.0;
        const double seen = std::clamp(pace * slope / (n * variance_here), -largest_step, largest_step) * significance;
        return (count * seen + trusted * elsewhere) / (count + trusted);
    };
    Steps result;
    for (std::size_t i = 0; i < result.share.size(); ++i) {
        result.share[i] = step(sums.slopes[i] - sums.guided.powers[2] / n * sums.densities[i], sums.slope_squares[i],
                               expected.share[i]);
    }
    result.preference = step(-sums.preference_slope, sums.preference_slope_squares, expected.preference);
    return result;
}

/// An estimate of the square of F - 1 without technique i, for a stay drawn with shares a_j. With x = p'/p of the
/// densities without it and with it, it is x (F' - 1)². F' is F / x, but for what is weighted against connections: with
/// b_j = -dF/da_j / F, whose mean b = Σ a_j b_j falls short of 1 by that, F / (1 - b + (b - a_i b_i) / (1 - a_i)).
double error_without(std::size_t i, const Stay& stay, const SlabGuide::Shares& shares) {
    const double share = shares[i], f = stay.brought;
    if (!(share < 1)) {
        return std::pow(f - 1, 2);
    }
    double falling = 0;
    for (std::size_t j = 0; j < shares.size(); ++j) {
        falling += static_cast<double>(shares[j] * stay.slope.shares[j]);
    }
    constexpr double least = 1e-2;
    const double density = std::max(0.0, (1 - share * static_cast<double>(stay.relative[i])) / (1 - share));
    const double weight =
        f > 0 ? (f - falling + (falling - share * static_cast<double>(stay.slope.shares[i])) / (1 - share)) / f : 1.0;
    return density * std::pow(f / std::max(weight, least) - 1, 2);
}

template <std::size_t n>
void add_each(std::array<double, n>& to, const std::array<double, n>& from) {
    for (std::size_t i = 0; i < n; ++i) {
        to[i] += from[i];
    }
}

void normalize(SlabGuide::Shares& shares) {
    const float total = std::accumulate(shares.begin(), shares.end(), 0.0f);
    for (float& share : shares) {
        share /= total;
    }
}

/// Leaves a strategy out, unless it is the only one.
void drop(std::size_t technique, SlabGuide::Shares& shares) {
    SlabGuide::Shares others = shares;
    others[technique] = 0;
    if (std::any_of(others.begin() + 1, others.end(), [](float share) { return share > 0; })) {
        normalize(others);
        shares = others;
    }
}

/// Makes the steps.
void learn_guided(StayPlan& plan, const Steps& steps) {
    plan.guided.preference =
        std::clamp(plan.guided.preference * static_cast<float>(std::exp(steps.preference)), 1.0f, largest_preference);
    SlabGuide::Shares& shares = plan.shares;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        shares[i] *= static_cast<float>(std::exp(steps.share[i]));
    }
    normalize(shares);
    for (std::size_t i = 1; i < shares.size(); ++i) {
        shares[i] = shares[i] < least_guided ? 0.0f : shares[i];
    }
    shares[0] = std::max(shares[0], least_classical);
    normalize(shares);
}

}  // namespace

StayMoments::Kind& StayMoments::Kind::operator+=(const Kind& other) {
    add_each(powers, other.powers);
    flights += other.flights;
    return *this;
}

StayMoments::Sums& StayMoments::Sums::operator+=(const Sums& other) {
    guided += other.guided;
    unguided += other.unguided;
    add_each(slopes, other.slopes);
    add_each(densities, other.densities);
    connected += other.connected;
    connected_through += other.connected_through;
    add_each(slope_squares, other.slope_squares);
    preference_slope += other.preference_slope;
    preference_slope_squares += other.preference_slope_squares;
    add_each(errors_without, other.errors_without);
    return *this;
}

void StayMoments::add(int cell, const Stay& stay, const SlabGuide::Shares& shares) {
    const double f = stay.brought;
    const Kind one{{1, f, f * f, f * f * f, f * f * f * f}, static_cast<double>(stay.flights)};
    if (!std::isfinite(one.powers[4])) {
        return;
    }
    Sums sums;
    sums.connected = stay.connected ? 1 : 0;
    sums.connected_through = stay.connected_through ? 1 : 0;
    if (!stay.guided) {
        sums.unguided = one;
        media_[stay.medium][cell] += sums;
        return;
    }
    sums.guided = one;
    sums.preference_slope = 2 * f * static_cast<double>(stay.slope.preference);
    sums.preference_slope_squares = sqr(sums.preference_slope);
    bool finite = std::isfinite(sums.preference_slope);
    for (std::size_t i = 0; i < sums.densities.size(); ++i) {
        sums.densities[i] = stay.relative[i];
        sums.slopes[i] = 2 * f * static_cast<double>(stay.slope.shares[i]) - f * f * sums.densities[i];
        sums.slope_squares[i] = sqr(sums.slopes[i]);
        sums.errors_without[i] = error_without(i, stay, shares);
        finite = finite && std::isfinite(sums.densities[i]) && std::isfinite(sums.slopes[i]) &&
                 std::isfinite(sums.errors_without[i]);
    }
    if (finite) {
        media_[stay.medium][cell] += sums;
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
      plans_(side * side * side, StayPlan{start,
                                          largest_share_for_watching,
                                          true,
                                          {first_preference, connection_probability(first_preference),
                                           first_through_boundaries, connections_at_surfaces},
                                          {1, 1, first_through_boundaries, connections_at_surfaces},
                                          1}),
      brought_(plans_.size()) {
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

void StayPlans::learn(const std::map<int, StayMoments::Sums>& moments, NextStays next) {
    StayMoments::Sums all;
    for (const auto& [cell, sums] : moments) {
        all += sums;
    }
    // The first stays are not relative to anything, and cannot be compared.
    const bool is_first = expected_.empty();
    expect(moments);
    connects_ = connects_ || all.connected > 0;
    connects_through_ = connects_through_ || all.connected_through > 0;
    const bool is_early = all_brought().stays < enough_stays;
    const auto most = [is_early](bool connects) { return connects || is_early ? 1.0f : least_probability; };
    const float most_connected = most(connects_);
    const float through_boundaries = first_through_boundaries * most(connects_through_);
    const double cost_of_unguided_flight = seen_ == NextStays::beside_field ? cost_of_field_flight : 1;
    const Advantage guided =
        is_first ? Advantage() : advantage(all.guided, all.unguided, cost_of_unguided_flight, through_boundaries);
    is_given_up_ = is_given_up_ || guided.is_loss(seen_, next);
    const float unguided_probability = is_given_up_                   ? 1.0f
                                       : next == NextStays::rendering ? 0.0f
                                                                      : guided.share_for_watching();
    const Steps overall = steps(all, {});
    const std::size_t dispensed_with = is_first ? 0 : dispensable(all);
    for (std::size_t cell = 0; cell < plans_.size(); ++cell) {
        const auto seen = moments.find(static_cast<int>(cell));
        StayPlan& plan = plans_[cell];
        learn_guided(plan, seen == moments.end() ? overall : steps(seen->second, overall));
        if (dispensed_with > 0) {
            drop(dispensed_with, plan.shares);
        }
        plan.unguided_probability = unguided_probability;
        plan.is_unguided_classical = next == NextStays::beside_classical;
        plan.told_probability = guided.told_probability();
        plan.guided.probability = std::min(connection_probability(plan.guided.preference), most_connected);
        plan.unguided.probability = most_connected;
        plan.guided.through_boundaries = plan.unguided.through_boundaries = through_boundaries;
    }
    seen_ = next;
}

std::size_t StayPlans::dispensable(const StayMoments::Sums& all) const {
    const auto [variance_of_all, count] = variance(all.guided);
    if (!(count > enough_to_compare)) {
        return 0;
    }
    const double n = all.guided.powers[0];
    const double flights = cost_of_guided_flight * all.guided.flights / n;
    const double offset = all.guided.powers[1] / n - 1;
    double least = largest_without * variance_of_all * (flights_outside + flights);
    std::size_t best = 0;
    int in_use = 0;
    for (std::size_t i = 1; i < all.densities.size(); ++i) {
        if (std::none_of(plans_.begin(), plans_.end(), [i](const StayPlan& plan) { return plan.shares[i] > 0; })) {
            continue;
        }
        ++in_use;
        const double product =
            (all.errors_without[i] / n - offset * offset) * (flights_outside + (1 - cost_of_strategy) * flights);
        if (product < least) {
            least = product;
            best = i;
        }
    }
    return in_use > 1 ? best : 0;
}

auto StayPlans::all_brought() const -> Brought {
    return std::accumulate(brought_.begin(), brought_.end(), Brought{}, [](const Brought& a, const Brought& b) {
        return Brought{a.stays + b.stays, a.light + b.light};
    });
}

void StayPlans::expect(const std::map<int, StayMoments::Sums>& moments) {
    for (const auto& [index, sums] : moments) {
        const auto cell = static_cast<std::size_t>(index);
        const double scale = expected_.empty() ? 1.0 : static_cast<double>(expected_[cell]);
        brought_[cell].stays += sums.guided.powers[0] + sums.unguided.powers[0];
        brought_[cell].light += scale * (sums.guided.powers[1] + sums.unguided.powers[1]);
    }
    const Brought all = all_brought();
    if (!(all.light > 0)) {
        return;
    }
    const double mean = all.light / all.stays;
    expected_.resize(brought_.size());
    std::transform(brought_.begin(), brought_.end(), expected_.begin(), [mean](const Brought& b) {
        return static_cast<float>((b.light + few_stays * mean) / (b.stays + few_stays));
    });
}

Stay StayPlans::relative(const Stay& stay) const {
    if (expected_.empty()) {
        return stay;
    }
    const float expected = expected_[static_cast<std::size_t>(cell_at(stay.entry))];
    return stay.times(1 / std::max(expected, stay.brought / most_expected));
}

}  // namespace wend
