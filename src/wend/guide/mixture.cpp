#include <wend/guide/mixture.h>

#include <wend/core/contracts.h>
#include <wend/core/vector_clones.h>
#include <wend/numeric/fast_exp.h>
#include <wend/sampling/discrete.h>

#include <algorithm>
#include <cmath>

namespace wend::guide {

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

WEND_VECTOR_CLONES float VmfMixture::density(const Vec3& direction) const {
    Lanes densities;
    for_lanes(blocks(), [&](int i) {
        const float x = direction.x - mean_x_[i], y = direction.y - mean_y_[i], z = direction.z - mean_z_[i];
        densities[i] = amplitude_[i] * fast_exp(-0.5f * kappa_[i] * (x * x + y * y + z * z));
    });
    return sum_lanes(blocks(), densities);
}

Vec3 VmfMixture::sample(Vec2 u) const {
    const int chosen = select({weight_.value, static_cast<std::size_t>(size_)}, 1, u.x);
    return lobe(chosen).vmf.sample(u);
}

WEND_VECTOR_CLONES VmfMixture VmfMixture::re_aimed(const Vec3& offset, const Lanes& inverse_distance) const {
    VmfMixture result(*this, Unset{});
    for_lanes(blocks(), [&, offset](int i) {
        const float x = mean_x_[i] + offset.x * inverse_distance[i];
        const float y = mean_y_[i] + offset.y * inverse_distance[i];
        const float z = mean_z_[i] + offset.z * inverse_distance[i];
        const float length = std::sqrt(x * x + y * y + z * z);
        // On top of the source no direction is better than another.
        const float scale = 1 / (length + 1e-30f);
        const float own_x = mean_x_[i], own_y = mean_y_[i], own_z = mean_z_[i];
        const bool far = length > 1e-3f;
        result.mean_x_[i] = far ? x * scale : own_x;
        result.mean_y_[i] = far ? y * scale : own_y;
        result.mean_z_[i] = far ? z * scale : own_z;
    });
    return result;
}

}  // namespace wend::guide
