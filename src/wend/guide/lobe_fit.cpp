#include <wend/guide/lobe_fit.h>

#include <wend/core/contracts.h>
#include <wend/core/vector.h>
#include <wend/guide/kernels.h>

#include <algorithm>
#include <cmath>

namespace wend::guide {
namespace {

/// Sums of this many observations are added to the total: rounding errors grow with the number of blocks only.
constexpr std::size_t block_size = 1024;

LobeLanes lanes_of(const LobeModel& model) {
    constexpr float log_of_nothing = -1e30f;
    LobeLanes lanes{};
    lanes.inverse_distance = model.inverse_distance;
    lanes.blocks = blocks_for(model.mixture.size());
    std::fill(std::begin(lanes.log_amplitude.value), std::end(lanes.log_amplitude.value), log_of_nothing);
    for (int i = 0; i < model.mixture.size(); ++i) {
        const auto [weight, vmf] = model.mixture.lobe(i);
        lanes.x[i] = vmf.mean.x;
        lanes.y[i] = vmf.mean.y;
        lanes.z[i] = vmf.mean.z;
        const Frame frame = Frame::from_z(vmf.mean);
        lanes.u_x[i] = frame.s.x;
        lanes.u_y[i] = frame.s.y;
        lanes.u_z[i] = frame.s.z;
        lanes.v_x[i] = frame.t.x;
        lanes.v_y[i] = frame.t.y;
        lanes.v_z[i] = frame.t.z;
        lanes.half_kappa[i] = 0.5f * vmf.kappa;
        lanes.log_amplitude[i] = weight > 0 ? std::log(weight) + std::log(vmf_peak(vmf.kappa)) : log_of_nothing;
    }
    return lanes;
}

LobeSums sums_of(const SumLanes& lanes, int i) {
    return {lanes.weight[i],
            lanes.weight_square[i],
            {lanes.x[i], lanes.y[i], lanes.z[i]},
            {lanes.offset_x[i], lanes.offset_y[i], lanes.offset_z[i]},
            lanes.inverse_distance[i],
            lanes.inverse_distance_square[i],
            lanes.turn[i],
            lanes.spread[i],
            lanes.straight[i],
            lanes.oblique[i],
            lanes.beyond_square[i],
            lanes.red[i],
            lanes.blue[i]};
}

/// 1 up to `good`, 0 from `bad`, linear between.
double ramp_down(double x, double good, double bad) {
    return std::clamp((bad - x) / (bad - good), 0.0, 1.0);
}

/// The lobe's inverse distance from three witnesses, each with its precision: the distances that records tell, which
/// are worth little where they differ among themselves (vertices inside a medium are not the source); how the
/// directions turn with the position, whatever the records tell; and the belief that sources are far, compared with the
/// cell. A source so near that turning by it is meaningless is not re-aimed at.
double likely_inverse_distance(const LobeSums& s, double kappa, double radius) {
    const double records = effective_records(s);
    if (!(s.weight > 0 && records > 0 && radius > 0)) {
        return 0;
    }
    constexpr double least_relative_variance = 0.01;
    const double told = s.inverse_distance / s.weight;
    const double told_variance =
        s.inverse_distance_square / s.weight - told * told + least_relative_variance * told * told;
    const double recorded_precision = told > 0 ? records / (told_variance * (records + 8)) : 0;

    const double turned = s.spread > 0 ? s.turn / s.spread : 0;
    const double turned_precision = kappa * s.spread / s.weight * records;

    const double far_precision = radius * radius;
    const double likely = (told * recorded_precision + turned * turned_precision) /
                          (recorded_precision + turned_precision + far_precision);
    return std::max(0.0, likely) * ramp_down(likely * radius, 0.75, 1.0);
}

/// The mean cosine of a lobe from the length of the mean of its records' directions. They lie closer to their own mean
/// than to the lobe's, and the next record will not lie around their mean: both widen the lobe, without end where there
/// is but one record.
double likely_mean_cosine(double mean_length, double records, const LobePriors& priors) {
    const double distance = 1 - std::min(mean_length, 1.0);
    return 1 - std::min(1.0, (distance * (records + 1) + priors.mean_cosine) /
                                 (std::max(0.0, records - 1) + priors.mean_cosine));
}

}  // namespace

LobeModel initial_lobes(int lobes) {
    WEND_EXPECT(lobes >= 1 && lobes <= max_lobes);
    constexpr double golden_angle = 2.39996322972865332;
    // Half as wide as the spiral's points are apart.
    const float kappa = static_cast<float>(lobes) * inv_pi;
    std::array<WeightedVmf, max_lobes> start{};
    for (int i = 0; i < lobes; ++i) {
        const double z = 1 - (2 * i + 1.0) / lobes;
        const double r = std::sqrt(1 - z * z);
        const Vec3 mean(static_cast<float>(r * std::cos(golden_angle * i)),
                        static_cast<float>(r * std::sin(golden_angle * i)), static_cast<float>(z));
        start[i] = {1, {normalize(mean), kappa}};
    }
    return {VmfMixture(std::span(start.data(), lobes)), {}};
}

std::array<LobeSums, max_lobes> expectation(const LobeModel& model, std::span<const Observation> observations,
                                            double weight_unit) {
    const LobeLanes lobes = lanes_of(model);
    std::array<LobeSums, max_lobes> sums{};
    while (!observations.empty()) {
        const auto block = observations.first(std::min(block_size, observations.size()));
        SumLanes lanes;
        kernels().add_observations(lobes, block, lanes);
        for (int i = 0; i < max_lobes; ++i) {
            sums[i] += sums_of(lanes, i).scaled(weight_unit, weight_unit * weight_unit);
        }
        observations = observations.subspan(block.size());
    }
    return sums;
}

LobeModel maximization(const std::array<LobeSums, max_lobes>& sums, const LobeModel& previous, const LobePriors& priors,
                       double radius) {
    const int size = previous.mixture.size();
    double weight = 0, weight_square = 0;
    for (const LobeSums& s : std::span(sums.data(), size)) {
        weight += s.weight;
        weight_square += s.weight_square;
    }
    WEND_EXPECT(weight > 0);
    // Squares of what is left beside a freak that has been forgotten may be too small for single precision.
    const double records = weight_square > 0 ? weight * weight / weight_square : 1.0;

    LobeModel model;
    std::array<WeightedVmf, max_lobes> lobes{};
    for (int i = 0; i < size; ++i) {
        const LobeSums& s = sums[i];
        const Imath::V3d direction(s.direction);
        const double resultant = direction.length();
        const double own_records = effective_records(s);
        const double mean_cosine = s.weight > 0 ? likely_mean_cosine(resultant / s.weight, own_records, priors) : 0.0;
        const float share =
            static_cast<float>((records * s.weight / weight + priors.weight) / (records + size * priors.weight));
        const Vec3 mean = resultant > 0 ? Vec3(direction / resultant) : previous.mixture.lobe(i).vmf.mean;
        lobes[i] = {share, {mean, std::min(vmf_kappa(static_cast<float>(mean_cosine)), priors.max_kappa)}};
        model.inverse_distance[i] =
            static_cast<float>(likely_inverse_distance(s, static_cast<double>(lobes[i].vmf.kappa), radius));
    }
    model.mixture = VmfMixture(std::span(lobes.data(), size));
    return model;
}

}  // namespace wend::guide
