#include <wend/guide/mixture.h>

#include <wend/core/contracts.h>
#include <wend/core/vector_clones.h>
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
    return sum_densities(direction);
}

Vec3 VmfMixture::sample(Vec2 u) const {
    const int chosen = select({weight_.value, static_cast<std::size_t>(size_)}, 1, u.x);
    return lobe(chosen).vmf.sample(u);
}

WEND_VECTOR_CLONES VmfMixture VmfMixture::re_aimed(const Vec3& offset, const Lanes& inverse_distance) const {
    VmfMixture result(size_, Unset{});
    for_lanes(blocks(), [&, offset](int i) {
        const Mean mean = turned_mean(i, offset, inverse_distance);
        result.mean_x_[i] = mean.x;
        result.mean_y_[i] = mean.y;
        result.mean_z_[i] = mean.z;
    });
    result.kappa_.copy(blocks(), kappa_);
    result.weight_.copy(blocks(), weight_);
    result.amplitude_.copy(blocks(), amplitude_);
    return result;
}

}  // namespace wend::guide
