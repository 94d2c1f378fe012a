#include <wend/guide/lobe_learning.h>

#include <numeric>
#include <vector>

namespace wend::guide {
namespace {

double total_weight(const std::array<LobeSums, max_lobes>& sums) {
    return std::accumulate(sums.begin(), sums.end(), 0.0,
                           [](double t, const LobeSums& s) { return t + static_cast<double>(s.weight); });
}

/// All sums, of earlier records and new ones. Where only the weight of earlier ones is known, as of a lobe that was
/// split, they are taken to be like the new ones, and forgotten if there are none.
std::array<LobeSums, max_lobes> continued(const std::array<LobeSums, max_lobes>& earlier,
                                          std::array<LobeSums, max_lobes> sums) {
    for (int i = 0; i < max_lobes; ++i) {
        if (earlier[i].weight > 0 && earlier[i].weight_square == 0) {
            if (sums[i].weight > 0) {
                const double factor = 1 + static_cast<double>(earlier[i].weight) / sums[i].weight;
                sums[i] = sums[i].scaled(factor, factor * factor);
            }
        } else {
            sums[i] += earlier[i];
        }
    }
    return sums;
}

/// Sum over the lobes of how far their resultant vectors are apart.
double movement(const std::array<LobeSums, max_lobes>& a, const std::array<LobeSums, max_lobes>& b) {
    double sum = 0;
    for (int i = 0; i < max_lobes; ++i) {
        sum += (Imath::V3d(a[i].direction) - Imath::V3d(b[i].direction)).length();
    }
    return sum;
}

}  // namespace

LearnedLobes LobeLearning::learn(const LobeModel& start, std::array<LobeSums, max_lobes>& earlier,
                                 std::span<const Observation> observations) const {
    constexpr int splitting_revisions = 2, revisions = 3;
    LearnedLobes learned = improve(start, earlier, observations, settings_.max_iterations);
    for (int i = 0; i < revisions; ++i) {
        // The shape of the records is to be seen from where the lobes are now.
        learned.sums = continued(earlier, expectation(learned.model, observations, unit_));
        // The last one cleans up: it only merges.
        const int most = i < splitting_revisions ? settings_.most_lobes : learned.model.mixture.size();
        if (!revise_lobes(learned, earlier, most)) {
            break;
        }
        learned = improve(learned.model, earlier, observations, (settings_.max_iterations + 1) / 2);
    }
    return learned;
}

LearnedLobes LobeLearning::learn_by_sample(const LobeModel& start, std::array<LobeSums, max_lobes> earlier,
                                           std::span<const Observation> observations) const {
    constexpr double enough = 256;
    double squares = 0;
    for (const Observation& o : observations) {
        squares += static_cast<double>(sqr(o.weight));
    }
    const auto size = static_cast<double>(observations.size());  // and the sum of the weights
    const auto stride = static_cast<std::size_t>(size * size / squares / enough);
    if (stride <= 1) {
        return learn(start, earlier, observations);
    }
    std::vector<Observation> sample;
    sample.reserve(observations.size() / stride + 1);
    for (std::size_t i = 0; i < observations.size(); i += stride) {
        sample.push_back(observations[i]);
    }
    const double scale = size / static_cast<double>(sample.size());
    const LobeModel near = with_unit(unit_ * scale).learn(start, earlier, sample).model;
    return improve(near, earlier, observations, 1);
}

// Rounds of expectation maximization, until the lobes hardly move.
LearnedLobes LobeLearning::improve(const LobeModel& model, const std::array<LobeSums, max_lobes>& earlier,
                                   std::span<const Observation> observations, int rounds) const {
    LearnedLobes learned{model, earlier};
    for (int round = 0; round < rounds; ++round) {
        const std::array<LobeSums, max_lobes> last = learned.sums;
        learned.sums = continued(earlier, expectation(learned.model, observations, unit_));
        learned.model = maximization(learned.sums, learned.model, settings_.priors, radius_);
        if (round > 0 && movement(learned.sums, last) < settings_.tolerance * total_weight(learned.sums)) {
            break;
        }
    }
    return learned;
}

LobeColours colours_of(const LearnedLobes& learned) {
    LobeColours colours;
    for (int i = 0; i < learned.model.mixture.size(); ++i) {
        const LobeSums& s = learned.sums[static_cast<std::size_t>(i)];
        if (s.weight > 0) {
            colours.set(i, s.red / s.weight, s.blue / s.weight);
        }
    }
    return colours;
}

}  // namespace wend::guide
