#include <wend/guide/statistics.h>

namespace wend::guide {
namespace {

Statistics scaled(Statistics s, double linear, double quadratic) {
    s.count *= linear;
    s.fluence *= linear;
    for (LobeSums& lobe : s.lobes) {
        lobe.weight *= static_cast<float>(linear);
        lobe.weight_square *= quadratic;
        lobe.direction *= static_cast<float>(linear);
        lobe.inverse_distance *= linear;
        lobe.inverse_distance_square *= linear;
        lobe.turn *= linear;
        lobe.spread *= linear;
    }
    return s;
}

}  // namespace

Statistics Statistics::decayed(double factor) const {
    return scaled(*this, factor, factor * factor);
}

Statistics Statistics::share(double share) const {
    return scaled(*this, share, share);
}

}  // namespace wend::guide
