#include <wend/guide/lobe_revision.h>

#include <wend/core/vector.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace wend::guide {
namespace {

/// Logarithm of κ / (4 pi sinh κ).
double log_normalization(double kappa) {
    constexpr double log_4pi = 2.5310242469692907;
    if (kappa < 1e-3) {
        return -log_4pi - kappa * kappa / 6;
    }
    return std::log(2 * kappa) - kappa - std::log1p(-std::exp(-2 * kappa)) - log_4pi;
}

/// Both lobes as one of the same weight and mean direction vector.
WeightedVmf merged(const WeightedVmf& a, const WeightedVmf& b) {
    const auto resultant = [](const WeightedVmf& lobe) {
        return Imath::V3d(lobe.vmf.mean) * static_cast<double>(lobe.weight * vmf_mean_cosine(lobe.vmf.kappa));
    };
    const Imath::V3d sum = resultant(a) + resultant(b);
    const float weight = a.weight + b.weight;
    const double length = sum.length();
    return {weight, {length > 0 ? Vec3(sum / length) : a.vmf.mean, vmf_kappa(static_cast<float>(length / weight))}};
}

/// How the records of a lobe spread in the plane across its mean: variances along two axes, and the longer axis.
struct Spread {
    double longer = 0, shorter = 0;
    Vec3 axis{0, 0, 0};

    Spread(const LobeSums& s, const Vmf& vmf) {
        const double mean_s = std::max(0.0, 1 - static_cast<double>(dot(s.direction, vmf.mean)) / s.weight);
        // sin² = 2 s - s² with s = 1 - cos
        const double both = std::max(1e-12, 2 * mean_s - static_cast<double>(s.beyond_square) / s.weight);
        const double straight = static_cast<double>(s.straight) / s.weight;
        const double oblique = static_cast<double>(s.oblique) / s.weight;
        const double difference = std::min(std::hypot(straight, oblique), 0.9999 * both);
        longer = 0.5 * (both + difference);
        shorter = 0.5 * (both - difference);
        const double angle = 0.5 * std::atan2(oblique, straight);
        const Frame frame = Frame::from_z(vmf.mean);
        axis = frame.s * static_cast<float>(std::cos(angle)) + frame.t * static_cast<float>(std::sin(angle));
    }
};

/// The sums of two lobes as those of one with the given mean, the shape being moved to its tangent plane.
LobeSums joined(const LobeSums& a, const Vec3& mean_a, const LobeSums& b, const Vec3& mean_b, const Vec3& mean) {
    LobeSums sum = a;
    sum += b;
    sum.straight = sum.oblique = sum.beyond_square = 0;
    const Frame to = Frame::from_z(mean);
    for (const auto& [s, m] : {std::pair(&a, &mean_a), std::pair(&b, &mean_b)}) {
        // Second moments across the lobe's own mean, along its own axes, and as seen along the new ones.
        const Frame from = Frame::from_z(*m);
        const float both = std::max(0.0f, 2 * (s->weight - dot(s->direction, *m)) - s->beyond_square);
        const float uu = 0.5f * (both + s->straight), vv = 0.5f * (both - s->straight), uv = 0.5f * s->oblique;
        const float a1 = dot(from.s, to.s), a2 = dot(from.t, to.s), b1 = dot(from.s, to.t), b2 = dot(from.t, to.t);
        const float xx = a1 * a1 * uu + a2 * a2 * vv + 2 * a1 * a2 * uv;
        const float yy = b1 * b1 * uu + b2 * b2 * vv + 2 * b1 * b2 * uv;
        const float xy = a1 * b1 * uu + a2 * b2 * vv + (a1 * b2 + a2 * b1) * uv;
        const float x = dot(*m, to.s), y = dot(*m, to.t);
        const float shift = x * x + y * y;
        sum.straight += xx - yy + s->weight * (x * x - y * y);
        sum.oblique += 2 * (xy + s->weight * x * y);
        sum.beyond_square += s->beyond_square + 0.25f * s->weight * shift * shift +
                             (x * x * xx + y * y * yy + 2 * x * y * xy) + 0.5f * shift * (xx + yy);
    }
    return sum;
}

/// Of a lobe that was split only the weight of earlier records is known: they are taken to be like all of its records.
LobeSums shaped_like(const LobeSums& all, const LobeSums& earlier) {
    if (!(earlier.weight > 0 && earlier.weight_square == 0)) {
        return earlier;
    }
    const double part = all.weight > 0 ? std::min(1.0, static_cast<double>(earlier.weight) / all.weight) : 0.0;
    return all.scaled(part, part * (2 - part));
}

/// Lobes being revised.
class Revision {
public:
    Revision(LearnedLobes& learned, std::array<LobeSums, max_lobes>& earlier, int most_lobes)
        : learned_(learned), earlier_(earlier), most_lobes_(most_lobes), size_(learned.model.mixture.size()) {
        for (int i = 0; i < size_; ++i) {
            lobes_[i] = learned.model.mixture.lobe(i);
            weight_ += learned.sums[i].weight;
        }
    }

    bool run() && {
        const bool has_merged = merge_all();
        const bool has_split = split_all();
        if (has_merged || has_split) {
            learned_.model.mixture = VmfMixture(std::span(lobes_.data(), static_cast<std::size_t>(size_)));
        }
        return has_merged || has_split;
    }

private:
    /// Nats that a lobe's records must gain by a split: two for each of the five unknowns of a lobe.
    static constexpr double splitting_evidence = 10;
    /// Nats that two lobes' records may lose by a merger.
    static constexpr double merging_evidence = 1.5;
    /// Nats that are worth a lobe.
    static constexpr double least_gain = 0.002;

    double records_of(int i) const { return effective_records(learned_.sums[i]); }
    double share_of(int i) const { return static_cast<double>(learned_.sums[i].weight) / weight_; }

    /// Nats lost when both become one. Of neighbours, that is how badly one lobe fits the records of both: two lobes
    /// that share the records of one source differ, but need not. Of others it is how much they differ.
    double merging_loss(int a, int b) const {
        const LobeSums &s = learned_.sums[a], &t = learned_.sums[b];
        const double both = static_cast<double>(s.weight) + t.weight;
        if (!(s.weight > 0 && t.weight > 0)) {
            return 0;
        }
        const double p = s.weight / both;
        const double kappa = std::min(lobes_[a].vmf.kappa, lobes_[b].vmf.kappa);
        const double parallax = static_cast<double>(learned_.model.inverse_distance[a]) -
                                static_cast<double>(learned_.model.inverse_distance[b]);
        const double turning =
            0.5 * kappa * p * (1 - p) * parallax * parallax * (static_cast<double>(s.spread) + t.spread) / both;
        const Vec3 &x = lobes_[a].vmf.mean, &y = lobes_[b].vmf.mean;
        constexpr float neighbours = 0.8f;
        constexpr double narrow = 10;
        const bool close = dot(x, y) > neighbours && kappa > narrow;
        double loss = 0;
        if (close) {
            const LobeSums sum = joined(s, x, t, y, merged(lobes_[a], lobes_[b]).vmf.mean);
            const float direction = length(sum.direction);
            const double apart = p * misfit(s, lobes_[a].vmf).total() + (1 - p) * misfit(t, lobes_[b].vmf).total();
            loss = misfit(sum, {sum.direction / direction, vmf_kappa(direction / sum.weight)}).total() - apart;
            loss = std::max(0.0, loss);
        } else {
            loss = 0.5 * merging_divergence(lobes_[a], lobes_[b]);
        }
        return both / weight_ * (loss + turning);
    }

    bool merge_all() {
        bool changed = false;
        for (int a = 0; a < size_; ++a) {
            for (int b = size_ - 1; b > a; --b) {
                const double loss = merging_loss(a, b);
                const double records = records_of(a) + records_of(b);
                const double share = share_of(a) + share_of(b);
                if (loss < 0.25 * least_gain || loss / share * records < merging_evidence) {
                    merge(a, b);
                    changed = true;
                }
            }
        }
        return changed;
    }

    void merge(int a, int b) {
        const WeightedVmf one = merged(lobes_[a], lobes_[b]);
        for (const int i : {a, b}) {
            earlier_[i] = shaped_like(learned_.sums[i], earlier_[i]);
        }
        for (auto* sums : {&learned_.sums, &earlier_}) {
            (*sums)[a] = joined((*sums)[a], lobes_[a].vmf.mean, (*sums)[b], lobes_[b].vmf.mean, one.vmf.mean);
        }
        lobes_[a] = one;
        is_joined_[a] = true;
        --size_;
        lobes_[b] = lobes_[size_];
        is_joined_[b] = is_joined_[size_];
        learned_.model.inverse_distance[b] = learned_.model.inverse_distance[size_];
        learned_.model.inverse_distance[size_] = 0;
        for (auto* sums : {&learned_.sums, &earlier_}) {
            (*sums)[b] = (*sums)[size_];
            (*sums)[size_] = {};
        }
    }

    bool split_all() {
        struct Candidate {
            int lobe;
            double gain;
        };
        std::array<Candidate, max_lobes> candidates{};
        int count = 0;
        for (int i = 0; i < size_; ++i) {
            if (records_of(i) > 1 && !is_joined_[i]) {
                const double own_gain = misfit(learned_.sums[i], lobes_[i].vmf).total();
                if (own_gain * records_of(i) > splitting_evidence && own_gain * share_of(i) > least_gain) {
                    candidates[count++] = {i, own_gain * share_of(i)};
                }
            }
        }
        std::stable_sort(candidates.begin(), candidates.begin() + count,
                         [](const Candidate& a, const Candidate& b) { return a.gain > b.gain; });
        count = std::min(count, most_lobes_ - size_);
        for (int i = 0; i < count; ++i) {
            split(candidates[i].lobe);
        }
        return count > 0;
    }

    void split(int i) {
        const Spread spread(learned_.sums[i], lobes_[i].vmf);
        const Vmf vmf = lobes_[i].vmf;
        const Misfit reason = misfit(learned_.sums[i], vmf);
        // Records with a heavy tail around one mean are a source before a wide background; others lie side by side.
        const bool concentric = reason.heavy_tailed && reason.radial > reason.unequal;
        constexpr float tail = 3;
        const double between = concentric ? 0.0 : std::max(spread.longer - spread.shorter, 0.25 * spread.longer);
        const auto shift = static_cast<float>(std::sqrt(between));
        const auto sharper =
            concentric ? tail : static_cast<float>(std::sqrt(0.5 * (spread.longer + spread.shorter) / spread.shorter));
        const int other = size_++;
        learned_.model.inverse_distance[other] = learned_.model.inverse_distance[i];
        for (const auto& [lobe, sign] : {std::pair(i, 1.0f), std::pair(other, -1.0f)}) {
            const float factor = concentric && sign < 0 ? 1 / tail : sharper;
            lobes_[lobe] = {0.5f * lobes_[i].weight,
                            {normalize(vmf.mean + spread.axis * (sign * shift)),
                             std::min(vmf.kappa * factor, 0.1f * Vmf::max_kappa)}};
        }
        lobes_[other].weight = lobes_[i].weight;
        LobeSums half;
        half.weight = 0.5f * earlier_[i].weight;
        earlier_[i] = earlier_[other] = half;
    }

    LearnedLobes& learned_;
    std::array<LobeSums, max_lobes>& earlier_;
    int most_lobes_;
    int size_;
    std::array<WeightedVmf, max_lobes> lobes_{};
    /// The shape of a lobe that was just made of two is known too roughly to be judged.
    std::array<bool, max_lobes> is_joined_{};
    double weight_ = 0;
};

}  // namespace

double merging_divergence(const WeightedVmf& a, const WeightedVmf& b) {
    const double p = a.weight / (static_cast<double>(a.weight) + b.weight);
    const Vmf c = merged(a, b).vmf;
    const auto scaled = [](const Vmf& vmf) { return Imath::V3d(vmf.mean) * static_cast<double>(vmf.kappa); };
    const auto overlap = [&](const Vmf& x, const Vmf& y) {
        const double exponent = log_normalization(x.kappa) + log_normalization(y.kappa) - log_normalization(c.kappa) -
                                log_normalization((scaled(x) + scaled(y) - scaled(c)).length());
        constexpr double largest = 100;
        return exponent < largest ? std::exp(exponent) : std::numeric_limits<double>::infinity();
    };
    const auto term = [](double factor, double value) { return factor > 0 ? factor * value : 0.0; };
    return term(p * p, overlap(a.vmf, a.vmf)) + term(2 * p * (1 - p), overlap(a.vmf, b.vmf)) +
           term((1 - p) * (1 - p), overlap(b.vmf, b.vmf)) - 1;
}

Misfit misfit(const LobeSums& sums, const Vmf& vmf) {
    if (!(sums.weight > 0)) {
        return {};
    }
    const Spread spread(sums, vmf);
    const double mean = 0.5 * (spread.longer + spread.shorter);
    const double unequal = 0.5 * std::log(mean * mean / (spread.longer * spread.shorter));

    // s = 1 - cos of a lobe has the variance 1 - r² - 2 r / κ, 1/κ² for all but wide lobes. The gain of a gamma
    // distribution of the right variance over the exponential one is about 0.3 times the square of the log ratio.
    const double mean_s = 1 - static_cast<double>(dot(sums.direction, vmf.mean)) / sums.weight;
    const double variance = static_cast<double>(sums.beyond_square) / sums.weight - mean_s * mean_s;
    const double kappa = vmf.kappa, r = vmf_mean_cosine(vmf.kappa);
    const double expected = kappa > 50 ? 1 / (kappa * kappa) : (kappa > 0.05 ? 1 - r * r - 2 * r / kappa : 1.0 / 3);
    const double ratio = std::log(std::max(variance, 1e-3 * expected) / expected);
    return {unequal, 0.3 * ratio * ratio, ratio > 0};
}

bool revise_lobes(LearnedLobes& learned, std::array<LobeSums, max_lobes>& earlier, int most_lobes) {
    return Revision(learned, earlier, most_lobes).run();
}

}  // namespace wend::guide
