#include <wend/guide/evidence.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace wend::guide {
namespace {

/// Sum of squares of `freedom` standard normal variables if nothing differs.
struct Chance {
    double chi_square = 0;
    double freedom = 0;

    double deviations() const { return freedom > 0 ? (chi_square - freedom) / std::sqrt(2 * freedom) : 0.0; }
};

}  // namespace

SplitEvidence split_evidence(const LobeModel& model, const std::array<LobeSums, max_lobes>& sums,
                             const Places& places) {
    const std::span lobes(sums.data(), static_cast<std::size_t>(model.mixture.size()));
    double weight = 0;
    for (const LobeSums& s : lobes) {
        weight += s.weight;
    }
    SplitEvidence best;
    if (!(weight > 0)) {
        return best;
    }

    double turn_gain = 0;
    Chance turn;
    for (int k = 0; k < model.mixture.size(); ++k) {
        const LobeSums& s = sums[k];
        if (s.spread > 0) {
            const double unexplained = s.turn / s.spread - static_cast<double>(model.inverse_distance[k]);
            const double kappa = model.mixture.lobe(k).vmf.kappa;
            const double loss = 0.5 * kappa * unexplained * unexplained * s.spread;
            turn_gain += loss / weight;
            turn.chi_square += 2 * loss / s.weight * effective_records(s);
            ++turn.freedom;
        }
    }

    for (int axis = 0; axis < 3; ++axis) {
        const double variance = places.variance[axis];
        if (!(variance > 0)) {
            continue;
        }
        double gain = 0;
        Chance chance;
        for (const LobeSums& s : lobes) {
            const double own_records = effective_records(s);
            if (own_records >= 1) {
                const double shift = static_cast<double>(s.offset[axis]) / s.weight - places.mean[axis];
                const double square = shift * shift / variance;
                gain += 0.5 * s.weight / weight * (square - 1 / own_records);
                chance.chi_square += own_records * square;
                ++chance.freedom;
            }
        }
        // Lobes turn along all axes: it counts where the cell is longest.
        const double longest = std::max({places.variance.x, places.variance.y, places.variance.z});
        if (variance >= longest) {
            gain += turn_gain;
            chance.chi_square += turn.chi_square;
            chance.freedom += turn.freedom;
        }
        if (best.axis < 0 || gain > best.gain) {
            best = {axis, gain, chance.deviations()};
        }
    }
    return best;
}

}  // namespace wend::guide
