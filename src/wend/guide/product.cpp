#include <wend/guide/product.h>

#include <wend/core/vector_clones.h>
#include <wend/numeric/fast_exp.h>
#include <wend/sampling/discrete.h>

#include <cmath>
#include <numeric>
#include <span>

namespace wend::guide {
namespace {

constexpr float least_integral = 1e-20f;

/// Numbers for pairs of lobes, those of one axial lobe side by side. Each step of a computation goes over all pairs
/// before the next one: a single long chain of dependent operations leaves most of a processor waiting.
using Pairs = float[AxialLobes::capacity * max_lobes];

/// What ∫ f g dω of two lobes needs but for exponentials: divided by 2 pi times the product of their densities at their
/// means it is e^exponent · (1 - e^{-2 joint}) / joint. No two terms cancel.
struct Overlap {
    float exponent, joint, reciprocal;

    /// From the concentrations and the squared distances of one mean to the other and to its opposite.
    Overlap(float kappa, float other, float to_mean, float to_opposite) {
        const float difference = kappa - other;
        const float both = kappa * other;
        const float squared = difference * difference + both * to_opposite;
        constexpr float least = 1e-12f;
        joint = std::sqrt(squared > least ? squared : least);
        // 1 / joint, and 1 / sum for joint - kappa - other, by one division.
        const float sum = joint + (kappa + other);
        const float of_both = 1 / (joint * sum);
        exponent = -both * to_mean * (of_both * joint);
        reciprocal = of_both * sum;
    }
};

}  // namespace

MixtureProduct VmfMixture::product(const AxialLobes& lobes) const {
    return MixtureProduct(*this, lobes);
}

MixtureProduct::MixtureProduct(const VmfMixture& mixture, const AxialLobes& lobes) : mixture_(mixture), lobes_(lobes) {
    weigh_parts();
    total_ = sum_lanes(mixture_.blocks(), parts_);
    integral_ = total_;
    if (!(total_ > least_integral)) {
        lobes_ = AxialLobes();
        parts_ = mixture_.weight_;
        total_ = 1;
        integral_ = 0;
    }
    scale_ = (integral_ > 0 ? 1 : 4 * pi) / total_;
}

WEND_VECTOR_CLONES void MixtureProduct::weigh_parts() {
    const int blocks = mixture_.blocks();
    Lanes to_axis, to_opposite;
    for_lanes(blocks, [&, axis = lobes_.axis()](int i) {
        const float x = mixture_.mean_x_[i], y = mixture_.mean_y_[i], z = mixture_.mean_z_[i];
        to_axis[i] = sqr(x - axis.x) + sqr(y - axis.y) + sqr(z - axis.z);
        to_opposite[i] = sqr(x + axis.x) + sqr(y + axis.y) + sqr(z + axis.z);
    });
    const int lanes = blocks * lanes_per_block;
    Pairs exponent, joint, factor;
    for (int j = 0; j < lobes_.size(); ++j) {
        const float kappa = std::abs(lobes_.kappa(j)), amplitude = lobes_.amplitude(j);
        const bool forward = lobes_.kappa(j) >= 0;
        const Lanes &near = forward ? to_axis : to_opposite, &far = forward ? to_opposite : to_axis;
        for_lanes(blocks, [&, first = j * lanes](int i) {
            const Overlap overlap(mixture_.kappa_[i], kappa, near[i], far[i]);
            exponent[first + i] = overlap.exponent;
            joint[first + i] = overlap.joint;
            factor[first + i] = -amplitude * overlap.reciprocal;
        });
    }
    for_lanes(blocks * lobes_.size(), [&](int k) { factor[k] *= fast_exp(exponent[k]) * fast_expm1(-2 * joint[k]); });
    for (int j = 0; j < lobes_.size(); ++j) {
        for_lanes(blocks, [&](int i) { parts_[i] += factor[j * lanes + i]; });
    }
    for_lanes(blocks, [&](int i) { parts_[i] *= 2 * pi * mixture_.amplitude_[i]; });
}

WEND_VECTOR_CLONES Vec3 MixtureProduct::sample(Vec2 u) const {
    const int i = select({parts_.value, static_cast<std::size_t>(mixture_.size())}, total_, u.x);
    const auto [weight, vmf] = mixture_.lobe(i);
    float kappa = lobes_.kappa(0);
    if (lobes_.size() > 1) {
        const float to_axis = length_squared(vmf.mean - lobes_.axis());
        const float to_opposite = length_squared(vmf.mean + lobes_.axis());
        float parts[AxialLobes::capacity];
        for_lanes(blocks_for(lobes_.size()), [&, own = vmf.kappa](int j) {
            const float k = lobes_.kappa(j);
            const float near = k < 0 ? to_opposite : to_axis, far = k < 0 ? to_axis : to_opposite;
            const Overlap overlap(own, std::abs(k), near, far);
            parts[j] =
                -lobes_.amplitude(j) * overlap.reciprocal * fast_exp(overlap.exponent) * fast_expm1(-2 * overlap.joint);
        });
        const std::span some(parts, static_cast<std::size_t>(lobes_.size()));
        kappa = lobes_.kappa(select(some, std::accumulate(some.begin(), some.end(), 0.0f), u.x));
    }
    const Vec3 sum = vmf.mean * vmf.kappa + lobes_.axis() * kappa;
    const float joint = length(sum);
    return Vmf{joint > 0 ? sum * (1 / joint) : vmf.mean, joint}.sample(u);
}

}  // namespace wend::guide
