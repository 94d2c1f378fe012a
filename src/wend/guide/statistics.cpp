#include <wend/guide/statistics.h>

namespace wend::guide {
namespace {

Statistics scaled(Statistics s, double linear, double quadratic) {
    s.count *= linear;
    s.fluence *= linear;
    s.fluence_square *= linear;
    for (LobeSums& lobe : s.lobes) {
        lobe = lobe.scaled(linear, quadratic);
    }
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
    return *this;
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
    for (LobeSums& lobe : s.lobes) {
        lobe = lobe.scaled(factor, factor * factor);
    }
    return s;
}

}  // namespace wend::guide
