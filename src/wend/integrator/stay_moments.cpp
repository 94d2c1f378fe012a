#include <wend/integrator/stay_moments.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

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
    sums.preference_slope_squares = sums.preference_slope * sums.preference_slope;
    bool finite = std::isfinite(sums.preference_slope);
    for (std::size_t i = 0; i < sums.densities.size(); ++i) {
        sums.densities[i] = stay.relative[i];
        sums.slopes[i] = 2 * f * static_cast<double>(stay.slope.shares[i]) - f * f * sums.densities[i];
        sums.slope_squares[i] = sums.slopes[i] * sums.slopes[i];
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

}  // namespace wend
