#include <wend/guide/statistics.h>

#include <algorithm>
#include <iterator>

namespace wend::guide {
namespace {

Statistics scaled(Statistics s, double linear, double quadratic) {
    s.count *= linear;
    s.fluence *= linear;
    s.fluence_square *= linear;
    for (KeptLobeSums& lobe : s.lobes) {
        lobe = lobe.scaled(linear, quadratic);
    }
    s.share_sums = s.share_sums.scaled(linear, quadratic);
    return s;
}

}  // namespace

LobeSums LobeSums::scaled(double linear, double quadratic) const {
    const auto factor = static_cast<float>(linear);
    LobeSums s = *this;
    s.weight *= factor;
    s.weight_square *= static_cast<float>(quadratic);
    s.direction *= factor;
    s.offset *= factor;
    s.inverse_distance *= factor;
    s.inverse_distance_square *= factor;
    s.turn *= factor;
    s.spread *= factor;
    s.straight *= factor;
    s.oblique *= factor;
    s.beyond_square *= factor;
    s.red *= factor;
    s.blue *= factor;
    return s;
}

LobeSums& LobeSums::operator+=(const LobeSums& other) {
    weight += other.weight;
    weight_square += other.weight_square;
    direction += other.direction;
    offset += other.offset;
    inverse_distance += other.inverse_distance;
    inverse_distance_square += other.inverse_distance_square;
    turn += other.turn;
    spread += other.spread;
    straight += other.straight;
    oblique += other.oblique;
    beyond_square += other.beyond_square;
    red += other.red;
    blue += other.blue;
    return *this;
}

KeptLobeSums::KeptLobeSums(const LobeSums& s)
    : weight(s.weight), weight_square(s.weight_square), direction(s.direction) {
    if (weight > 0) {
        const float values[] = {s.offset.x, s.offset.y, s.offset.z, s.inverse_distance, s.inverse_distance_square,
                                s.turn,     s.spread,   s.straight, s.oblique,          s.beyond_square,
                                s.red,      s.blue};
        std::transform(std::begin(values), std::end(values), per_weight.begin(),
                       [&](float value) { return BriefFloat(value / weight); });
    }
}

LobeSums KeptLobeSums::sums() const {
    const auto value = [&](std::size_t i) { return weight * per_weight[i]; };
    return {weight,   weight_square, direction, {value(0), value(1), value(2)},
            value(3), value(4),      value(5),  value(6),
            value(7), value(8),      value(9),  value(10),
            value(11)};
}

KeptLobeSums KeptLobeSums::scaled(double linear, double quadratic) const {
    KeptLobeSums s = *this;
    s.weight *= static_cast<float>(linear);
    s.weight_square *= static_cast<float>(quadratic);
    s.direction *= static_cast<float>(linear);
    return s;
}

std::array<LobeSums, max_lobes> Statistics::lobe_sums() const {
    std::array<LobeSums, max_lobes> sums;
    std::transform(lobes.begin(), lobes.end(), sums.begin(), [](const KeptLobeSums& kept) { return kept.sums(); });
    return sums;
}

void Statistics::keep(const std::array<LobeSums, max_lobes>& sums) {
    std::copy(sums.begin(), sums.end(), lobes.begin());
}

Statistics Statistics::decayed(double factor) const {
    return scaled(*this, factor, factor * factor);
}

Statistics Statistics::share(double share) const {
    return scaled(*this, share, share);
}

Statistics Statistics::in_unit(double other) const {
    const double factor = unit / other;
    Statistics s = *this;
    s.unit = other;
    for (KeptLobeSums& lobe : s.lobes) {
        lobe = lobe.scaled(factor, factor * factor);
    }
    return s;
}

double Statistics::unit_with(double mean_weight) const {
    double remembered = 0;
    for (const KeptLobeSums& lobe : lobes) {
        remembered += static_cast<double>(lobe.weight);
    }
    return std::max(mean_weight, unit * std::min(1.0, remembered));
}

}  // namespace wend::guide
