#include <wend/guide/lobe_fit.h>

#include <wend/core/contracts.h>
#include <wend/core/frame.h>
#include <wend/core/vector_clones.h>
#include <wend/numeric/fast_exp.h>

#include <algorithm>
#include <cmath>

namespace wend::guide {
namespace {

/// Sums of this many observations are added to the total: rounding errors grow with the number of blocks only.
constexpr std::size_t block_size = 1024;

/// Lanes that are read as soon as they were written must not lie in two cache lines.
constexpr std::size_t cache_line = 64;

/// The model in lanes.
struct alignas(cache_line) LobeLanes {
    Lanes x, y, z, u_x, u_y, u_z, v_x, v_y, v_z, half_kappa, log_amplitude, inverse_distance;
    int blocks;

    explicit LobeLanes(const LobeModel& model)
        : inverse_distance(model.inverse_distance), blocks(blocks_for(model.mixture.size())) {
        constexpr float log_of_nothing = -1e30f;
        std::fill(std::begin(log_amplitude.value), std::end(log_amplitude.value), log_of_nothing);
        for (int i = 0; i < model.mixture.size(); ++i) {
            const auto [weight, vmf] = model.mixture.lobe(i);
            x[i] = vmf.mean.x;
            y[i] = vmf.mean.y;
            z[i] = vmf.mean.z;
            const Frame frame = Frame::from_z(vmf.mean);
            u_x[i] = frame.s.x;
            u_y[i] = frame.s.y;
            u_z[i] = frame.s.z;
            v_x[i] = frame.t.x;
            v_y[i] = frame.t.y;
            v_z[i] = frame.t.z;
            half_kappa[i] = 0.5f * vmf.kappa;
            log_amplitude[i] = weight > 0 ? std::log(weight) + std::log(vmf_peak(vmf.kappa)) : log_of_nothing;
        }
    }
};

/// The sums of LobeSums in lanes.
struct alignas(cache_line) SumLanes {
    Lanes weight, weight_square, x, y, z, offset_x, offset_y, offset_z, inverse_distance, inverse_distance_square, turn,
        spread, straight, oblique, beyond_square, red, blue;

    void add_to(std::array<LobeSums, max_lobes>& sums, double unit) const {
        for (int i = 0; i < max_lobes; ++i) {
            const LobeSums own{weight[i],
                               weight_square[i],
                               {x[i], y[i], z[i]},
                               {offset_x[i], offset_y[i], offset_z[i]},
                               inverse_distance[i],
                               inverse_distance_square[i],
                               turn[i],
                               spread[i],
                               straight[i],
                               oblique[i],
                               beyond_square[i],
                               red[i],
                               blue[i]};
            sums[i] += own.scaled(unit, unit * unit);
        }
    }
};

/// An observation as each lobe sees it.
struct alignas(cache_line) SeenByLobes {
    /// Re-aimed at the reference point, and its squared distance from the lobe's mean.
    Lanes x{Unset{}}, y{Unset{}}, z{Unset{}}, beyond{Unset{}};
    /// The logarithm of the lobe's density there; then the density over the largest one's.
    Lanes density;
    /// The observation's weight over the sum of these.
    float scale;
};

/// Shares of a record below this count as none: their squares would be too small to be normal numbers, which processors
/// are slow at.
constexpr float negligible = 1e-15f;

WEND_VECTOR_CLONES SumLanes sums_of(const LobeLanes& lobes, std::span<const Observation> observations) {
    SumLanes sums;
    // A few at a time, step by step: a single observation is one long chain of dependent operations, which leaves most
    // of a processor waiting.
    constexpr std::size_t group_size = 8;
    std::array<SeenByLobes, group_size> seen;
    for (; !observations.empty(); observations = observations.subspan(std::min(group_size, observations.size()))) {
        const auto group = observations.first(std::min(group_size, observations.size()));
        for (std::size_t k = 0; k < group.size(); ++k) {
            SeenByLobes& s = seen[k];
            const Vec3 w = group[k].direction, t = group[k].offset;
            const float along = dot(w, t);
            const float across = std::max(0.0f, length_squared(t) - along * along);
            for_lanes(lobes.blocks, [&](int i) {
                // The inverse of VmfMixture::re_aimed: where the ray meets the sphere of the lobe's distance, seen from
                // the reference point.
                const float b = lobes.inverse_distance[i];
                const float inside = 1 - b * b * across;
                const float distance = b * along + std::sqrt(inside > 0 ? inside : 0.0f);
                s.x[i] = distance * w.x - b * t.x;
                s.y[i] = distance * w.y - b * t.y;
                s.z[i] = distance * w.z - b * t.z;
                const float dx = s.x[i] - lobes.x[i], dy = s.y[i] - lobes.y[i], dz = s.z[i] - lobes.z[i];
                s.beyond[i] = dx * dx + dy * dy + dz * dz;
                s.density[i] = lobes.log_amplitude[i] - lobes.half_kappa[i] * s.beyond[i];
            });
        }
        for (std::size_t k = 0; k < group.size(); ++k) {
            SeenByLobes& s = seen[k];
            const float largest = largest_lane(lobes.blocks, s.density);
            for_lanes(lobes.blocks, [&](int i) {
                const float share = fast_exp(s.density[i] - largest);
                s.density[i] = share > negligible ? share : 0.0f;
            });
            s.scale = group[k].weight / sum_lanes(lobes.blocks, s.density);
        }
        for (std::size_t k = 0; k < group.size(); ++k) {
            const SeenByLobes& s = seen[k];
            const Observation& o = group[k];
            const Vec3 t = o.offset;
            const float offset_squared = length_squared(t);
            for_lanes(lobes.blocks, [&](int i) {
                const float weight = s.density[i] * s.scale;
                const float weighted_inverse = weight * o.inverse_distance;
                sums.weight[i] += weight;
                sums.weight_square[i] += weight * weight;
                sums.x[i] += weight * s.x[i];
                sums.y[i] += weight * s.y[i];
                sums.z[i] += weight * s.z[i];
                sums.offset_x[i] += weight * t.x;
                sums.offset_y[i] += weight * t.y;
                sums.offset_z[i] += weight * t.z;
                sums.inverse_distance[i] += weighted_inverse;
                sums.inverse_distance_square[i] += weighted_inverse * o.inverse_distance;
                // What is left of the turning after re-aiming, and what re-aiming has taken away.
                const float mean_offset = t.x * lobes.x[i] + t.y * lobes.y[i] + t.z * lobes.z[i];
                const float direction_offset = t.x * s.x[i] + t.y * s.y[i] + t.z * s.z[i];
                const float mean_direction = s.x[i] * lobes.x[i] + s.y[i] * lobes.y[i] + s.z[i] * lobes.z[i];
                const float spread = weight * (offset_squared - mean_offset * mean_offset);
                sums.turn[i] +=
                    weight * (direction_offset - mean_offset * mean_direction) + lobes.inverse_distance[i] * spread;
                sums.spread[i] += spread;
                const float u = s.x[i] * lobes.u_x[i] + s.y[i] * lobes.u_y[i] + s.z[i] * lobes.u_z[i];
                const float v = s.x[i] * lobes.v_x[i] + s.y[i] * lobes.v_y[i] + s.z[i] * lobes.v_z[i];
                sums.straight[i] += weight * (u * u - v * v);
                sums.oblique[i] += weight * (2 * u * v);
                // 1 - cos is half the squared chord.
                sums.beyond_square[i] += 0.25f * weight * (s.beyond[i] * s.beyond[i]);
            });
            // Apart from the others: a loop over too many arrays is not vectorized.
            for_lanes(lobes.blocks, [&, red = o.red * s.scale, blue = o.blue * s.scale](int i) {
                sums.red[i] += s.density[i] * red;
                sums.blue[i] += s.density[i] * blue;
            });
        }
    }
    return sums;
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
    const double told_precision = told > 0 ? records / (told_variance * (records + 8)) : 0;

    const double turned = s.spread > 0 ? s.turn / s.spread : 0;
    const double turned_precision = kappa * s.spread / s.weight * records;

    const double far_precision = radius * radius;
    const double likely =
        (told * told_precision + turned * turned_precision) / (told_precision + turned_precision + far_precision);
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
    const LobeLanes lobes(model);
    std::array<LobeSums, max_lobes> sums{};
    while (!observations.empty()) {
        const auto block = observations.first(std::min(block_size, observations.size()));
        sums_of(lobes, block).add_to(sums, weight_unit);
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
    const double records = weight * weight / weight_square;

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
