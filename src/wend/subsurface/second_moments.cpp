#include <wend/subsurface/technique_mixes.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

template <std::size_t n>
void add_each(std::array<double, n>& to, const std::array<double, n>& from) {
    for (std::size_t i = 0; i < n; ++i) {
        to[i] += from[i];
    }
}

}  // namespace

SecondMoments::Kind& SecondMoments::Kind::operator+=(const Kind& other) {
    add_each(powers, other.powers);
    flights += other.flights;
    return *this;
}

SecondMoments::Sums& SecondMoments::Sums::operator+=(const Sums& other) {
    guided += other.guided;
    unguided += other.unguided;
    add_each(slopes, other.slopes);
    add_each(densities, other.densities);
    connected += other.connected;
    connected_through += other.connected_through;
    add_each(slope_squares, other.slope_squares);
    preference_slope += other.preference_slope;
    preference_slope_squares += other.preference_slope_squares;
    return *this;
}

void SecondMoments::add(int cell, const InteriorWalkRecord& interior_walk) {
    const double f = interior_walk.brought;
    const Kind one{{1, f, f * f, f * f * f, f * f * f * f}, static_cast<double>(interior_walk.flights)};
    if (!std::isfinite(one.powers[4])) {
        return;
    }
    Sums sums;
    sums.connected = interior_walk.connected ? 1 : 0;
    sums.connected_through = interior_walk.connected_through ? 1 : 0;
    if (!interior_walk.guided) {
        sums.unguided = one;
        media_[interior_walk.medium][cell] += sums;
        return;
    }
    sums.guided = one;
    sums.preference_slope = 2 * f * static_cast<double>(interior_walk.slope.preference);
    sums.preference_slope_squares = sums.preference_slope * sums.preference_slope;
    bool finite = std::isfinite(sums.preference_slope);
    for (std::size_t i = 0; i < sums.densities.size(); ++i) {
        sums.densities[i] = interior_walk.relative[i];
        sums.slopes[i] = 2 * f * static_cast<double>(interior_walk.slope.shares[i]) - f * f * sums.densities[i];
        sums.slope_squares[i] = sums.slopes[i] * sums.slopes[i];
        finite = finite && std::isfinite(sums.densities[i]) && std::isfinite(sums.slopes[i]);
    }
    if (finite) {
        media_[interior_walk.medium][cell] += sums;
    }
}

SecondMoments& SecondMoments::operator+=(const SecondMoments& other) {
    for (const auto& [medium, cells] : other.media_) {
        for (const auto& [cell, sums] : cells) {
            media_[medium][cell] += sums;
        }
    }
    return *this;
}

const std::map<int, SecondMoments::Sums>& SecondMoments::of(int medium) const {
    static const std::map<int, Sums> nothing;
    const auto found = media_.find(medium);
    return found == media_.end() ? nothing : found->second;
}

}  // namespace wend
