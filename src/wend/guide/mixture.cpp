#include <wend/guide/mixture.h>

#include <wend/core/contracts.h>
#include <wend/guide/kernels.h>
#include <wend/sampling/discrete.h>

#include <algorithm>
#include <cmath>

namespace wend::guide {

VmfMixture::VmfMixture() : lanes_(1) {
    lanes_.mean_z = lanes_.mean_x;
    std::fill(std::begin(lanes_.mean_z.value), std::end(lanes_.mean_z.value), 1.0f);
    lanes_.weight[0] = 1;
    lanes_.amplitude[0] = inv_4pi;
}

VmfMixture::VmfMixture(std::span<const WeightedVmf> lobes) : VmfMixture() {
    WEND_EXPECT(!lobes.empty() && lobes.size() <= max_lobes);
    lanes_.size = static_cast<int>(lobes.size());
    double total = 0;
    for (const WeightedVmf& lobe : lobes) {
        WEND_EXPECT(lobe.weight >= 0);
        total += lobe.weight;
    }
    WEND_EXPECT(total > 0);
    // What adds up to 1 but for rounding stays as it is, so that a mixture can be rebuilt from its lobes exactly.
    constexpr double rounding = 1e-6;
    total = std::abs(total - 1) < rounding ? 1 : total;
    for (int i = 0; i < size(); ++i) {
        const Vmf& vmf = lobes[i].vmf;
        lanes_.mean_x[i] = vmf.mean.x;
        lanes_.mean_y[i] = vmf.mean.y;
        lanes_.mean_z[i] = vmf.mean.z;
        lanes_.kappa[i] = vmf.kappa;
        lanes_.weight[i] = static_cast<float>(lobes[i].weight / total);
        lanes_.amplitude[i] = lanes_.weight[i] * vmf_peak(vmf.kappa);
    }
}

WeightedVmf VmfMixture::lobe(int i) const {
    WEND_EXPECT(i >= 0 && i < size());
    return {lanes_.weight[i], {Vec3(lanes_.mean_x[i], lanes_.mean_y[i], lanes_.mean_z[i]), lanes_.kappa[i]}};
}

float VmfMixture::density(const Vec3& direction) const {
    return kernels().density(lanes_, direction);
}

Vec3 VmfMixture::sample(Vec2 u) const {
    const int chosen = select({lanes_.weight.value, static_cast<std::size_t>(size())}, 1, u.x);
    return lobe(chosen).vmf.sample(u);
}

VmfMixture VmfMixture::re_aimed(const Vec3& offset, const Lanes& inverse_distance) const {
    VmfMixture result(size(), Unset{});
    kernels().turn(lanes_, offset, inverse_distance, result.lanes_);
    return result;
}

}  // namespace wend::guide
