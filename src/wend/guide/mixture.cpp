#include <wend/guide/mixture.h>

#include <wend/core/contracts.h>
#include <wend/guide/fast_exp.h>

#include <algorithm>
#include <cmath>

namespace wend::guide {
namespace {

constexpr float smallest_weight_in_product = 1e-10f;

/// vmf_peak() without calls. Series and closed form have relative errors below 1e-6 where one takes over.
inline float fast_peak(float kappa) {
    const float k2 = kappa * kappa;
    const float series =
        0.5f * (1 + kappa + k2 * (1.0f / 3 - k2 * (1.0f / 45 - k2 * (2.0f / 945 - k2 * (1.0f / 4725)))));
    const float closed = kappa / (1 - fast_exp(-2 * kappa) + 1e-30f);
    return (0.5f * inv_pi) * (kappa < 0.5f ? series : closed);
}

}  // namespace

VmfMixture::VmfMixture() : size_(1) {
    mean_z_ = mean_x_;
    std::fill(std::begin(mean_z_.value), std::end(mean_z_.value), 1.0f);
    weight_[0] = 1;
    amplitude_[0] = inv_4pi;
}

VmfMixture::VmfMixture(std::span<const WeightedVmf> lobes) : VmfMixture() {
    WEND_EXPECT(!lobes.empty() && lobes.size() <= max_lobes);
    size_ = static_cast<int>(lobes.size());
    double total = 0;
    for (const WeightedVmf& lobe : lobes) {
        WEND_EXPECT(lobe.weight >= 0);
        total += lobe.weight;
    }
    WEND_EXPECT(total > 0);
    // What adds up to 1 but for rounding stays as it is, so that a mixture can be rebuilt from its lobes exactly.
    constexpr double rounding = 1e-6;
    total = std::abs(total - 1) < rounding ? 1 : total;
    for (int i = 0; i < size_; ++i) {
        const Vmf& vmf = lobes[i].vmf;
        mean_x_[i] = vmf.mean.x;
        mean_y_[i] = vmf.mean.y;
        mean_z_[i] = vmf.mean.z;
        kappa_[i] = vmf.kappa;
        weight_[i] = static_cast<float>(lobes[i].weight / total);
        amplitude_[i] = weight_[i] * vmf_peak(vmf.kappa);
    }
}

WeightedVmf VmfMixture::lobe(int i) const {
    WEND_EXPECT(i >= 0 && i < size_);
    return {weight_[i], {Vec3(mean_x_[i], mean_y_[i], mean_z_[i]), kappa_[i]}};
}

float VmfMixture::density(const Vec3& direction) const {
    Lanes densities;
    for_lanes(blocks(), [&](int i) {
        const float x = direction.x - mean_x_[i], y = direction.y - mean_y_[i], z = direction.z - mean_z_[i];
        densities[i] = amplitude_[i] * fast_exp(-0.5f * kappa_[i] * (x * x + y * y + z * z));
    });
    return sum_lanes(blocks(), densities);
}

Vec3 VmfMixture::sample(Vec2 u) const {
    int chosen = 0;
    float rest = u.x;
    for (int i = 0; i < size_; ++i) {
        if (weight_[i] > 0) {
            chosen = i;
            if (rest < weight_[i]) {
                break;
            }
            rest -= weight_[i];
        }
    }
    return lobe(chosen).vmf.sample({std::min(one_minus_epsilon, rest / weight_[chosen]), u.y});
}

MixtureProduct VmfMixture::product(const Vmf& factor) const {
    MixtureProduct result;
    VmfMixture& mixture = result.distribution;
    mixture.size_ = size_;

    // As Vmf::product, lane by lane; the largest exponent is taken out so that the sum cannot underflow.
    const Vec3 pull = factor.mean * factor.kappa;
    Lanes exponent, eligible_exponent;
    for_lanes(blocks(), [&](int i) {
        const float sum_x = kappa_[i] * mean_x_[i] + pull.x;
        const float sum_y = kappa_[i] * mean_y_[i] + pull.y;
        const float sum_z = kappa_[i] * mean_z_[i] + pull.z;
        const float joint = std::sqrt(sum_x * sum_x + sum_y * sum_y + sum_z * sum_z);
        const float scale = 1 / (joint + 1e-30f);
        mixture.mean_x_[i] = joint > 0 ? sum_x * scale : mean_x_[i];
        mixture.mean_y_[i] = joint > 0 ? sum_y * scale : mean_y_[i];
        mixture.mean_z_[i] = joint > 0 ? sum_z * scale : mean_z_[i];
        mixture.kappa_[i] = std::min(joint, Vmf::max_kappa);

        const float x = mean_x_[i] - factor.mean.x, y = mean_y_[i] - factor.mean.y, z = mean_z_[i] - factor.mean.z;
        exponent[i] = -kappa_[i] * factor.kappa * (x * x + y * y + z * z) / (joint + kappa_[i] + factor.kappa + 1e-30f);
        eligible_exponent[i] = weight_[i] > smallest_weight_in_product ? exponent[i] : -1e30f;
    });
    const float largest = largest_lane(blocks(), eligible_exponent);

    for_lanes(blocks(), [&](int i) {
        const float amplitude = amplitude_[i] * fast_exp(exponent[i] - largest);
        mixture.amplitude_[i] = weight_[i] > smallest_weight_in_product ? amplitude : 0.0f;
        mixture.weight_[i] = mixture.amplitude_[i] / fast_peak(mixture.kappa_[i]);
    });
    const float total = sum_lanes(blocks(), mixture.weight_);
    for_lanes(blocks(), [&](int i) {
        mixture.weight_[i] *= 1 / total;
        mixture.amplitude_[i] *= 1 / total;
    });
    result.integral = fast_peak(factor.kappa) * total * std::exp(largest);
    return result;
}

VmfMixture VmfMixture::re_aimed(const Vec3& offset, const Lanes& inverse_distance) const {
    VmfMixture result = *this;
    for_lanes(blocks(), [&](int i) {
        const float x = mean_x_[i] + offset.x * inverse_distance[i];
        const float y = mean_y_[i] + offset.y * inverse_distance[i];
        const float z = mean_z_[i] + offset.z * inverse_distance[i];
        const float length = std::sqrt(x * x + y * y + z * z);
        // On top of the source no direction is better than another.
        const float scale = 1 / (length + 1e-30f);
        result.mean_x_[i] = length > 1e-3f ? x * scale : mean_x_[i];
        result.mean_y_[i] = length > 1e-3f ? y * scale : mean_y_[i];
        result.mean_z_[i] = length > 1e-3f ? z * scale : mean_z_[i];
    });
    return result;
}

}  // namespace wend::guide
