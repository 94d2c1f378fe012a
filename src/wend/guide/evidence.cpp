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
    double weight = 0, weight_square = 0;
    Imath::V3d seen(0, 0, 0);
    for (const LobeSums& s : lobes) {
        weight += s.weight;
        weight_square += s.weight_square;
        seen += Imath::V3d(s.offset);
    }
    SplitEvidence best;
    if (!(weight > 0 && weight_square > 0)) {
        return best;
    }
    seen /= weight;
    const double records = weight * weight / weight_square;

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
        const double shift = seen[axis] - static_cast<double>(places.mean[axis]);
        double gain = 0.5 * shift * shift / variance;
        Chance chance{records * shift * shift / variance, 1};
        for (const LobeSums& s : lobes) {
            const double own_records = effective_records(s);
            if (own_records >= 1) {
                const double own_shift = static_cast<double>(s.offset[axis]) / s.weight - seen[axis];
                gain += 0.5 * s.weight / weight * own_shift * own_shift / variance;
                chance.chi_square += own_records * own_shift * own_shift / variance;
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
