#include <wend/sampling/axial_lobes.h>

#include <wend/core/contracts.h>
#include <wend/numeric/fast_math.h>
#include <wend/sampling/discrete.h>
#include <wend/sampling/vmf.h>

#include <array>
#include <cmath>

namespace wend {

AxialLobes::AxialLobes() : axis_(0, 0, 1), size_(1), kappa_{}, amplitude_{inv_4pi} {
}

AxialLobes::AxialLobes(std::span<const AxialLobe> lobes)
    : axis_(0, 0, 1), size_(static_cast<int>(lobes.size())), kappa_{}, amplitude_{} {
    WEND_EXPECT(!lobes.empty() && lobes.size() <= capacity);
    double total = 0;
    for (const AxialLobe& lobe : lobes) {
        WEND_EXPECT(lobe.weight >= 0 && std::abs(lobe.kappa) <= Vmf::max_kappa);
        total += lobe.weight;
    }
    WEND_EXPECT(total > 0);
    for (int j = 0; j < size_; ++j) {
        kappa_[j] = lobes[j].kappa;
        amplitude_[j] = static_cast<float>(lobes[j].weight / total) * vmf_peak(std::abs(kappa_[j]));
    }
}

const AxialLobes& AxialLobes::cosine() {
    static const AxialLobes lobe(std::array{AxialLobe{1, 2.18853f}});
    return lobe;
}

AxialLobes AxialLobes::around(const Vec3& axis) const {
    AxialLobes result = *this;
    result.axis_ = axis;
    return result;
}

float AxialLobes::density(const Vec3& direction) const {
    const float before = 0.5f * length_squared(direction - axis_), behind = 0.5f * length_squared(direction + axis_);
    float sum = 0;
    for (int j = 0; j < size_; ++j) {
        sum += amplitude_[j] * fast_exp(kappa_[j] * (kappa_[j] < 0 ? behind : -before));
    }
    return sum;
}

Vec3 AxialLobes::sample(Vec2 u) const {
    float weights[capacity];
    for (int j = 0; j < size_; ++j) {
        weights[j] = amplitude_[j] / vmf_peak(std::abs(kappa_[j]));
    }
    const int chosen = select({weights, static_cast<std::size_t>(size_)}, 1, u.x);
    return Vmf{kappa_[chosen] < 0 ? -axis_ : axis_, std::abs(kappa_[chosen])}.sample(u);
}

}  // namespace wend
