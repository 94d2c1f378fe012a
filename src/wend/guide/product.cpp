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

/// 1 - e^{-2 joint} is 1 from here on. Larger concentrations would pass through numbers too small to be normal, which
/// processors are slow at.
constexpr float saturated = 20;

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

/// The first of the weights, each `stride` after the other, at which their sum passes the target; the target becomes
/// what is missing there. One weight at least must be positive.
inline int descend(const float* weights, int count, int stride, float& target) {
    // No branch depends on the target: the processor could not guess it.
    int chosen = 0;
    float sum = 0, below = 0;
    for (int i = 0; i < count; ++i) {
        sum += weights[i * stride];
        const bool passed = sum <= target;
        chosen += passed ? 1 : 0;
        below = passed ? sum : below;
    }
    target -= below;
    if (chosen == count) {  // by rounding
        do {
            --chosen;
        } while (chosen > 0 && !(weights[chosen * stride] > 0));
        target = weights[chosen * stride];
    }
    return chosen;
}

}  // namespace

MixtureProduct VmfMixture::product(const AxialLobes& lobes) const {
    return MixtureProduct(*this, lobes);
}

MixtureProduct MixtureView::product(const AxialLobes& lobes) const {
    return MixtureProduct(*this, lobes);
}

WEND_VECTOR_CLONES void MixtureProduct::weigh_parts(const VmfMixture& source) {
    const int blocks = source.blocks(), lanes = blocks * lanes_per_block;
    Lanes to_axis(Unset{}), to_opposite(Unset{});
    for_lanes(blocks, [&, axis = lobes_.axis()](int i) {
        const float x = mixture_.mean_x_[i], y = mixture_.mean_y_[i], z = mixture_.mean_z_[i];
        to_axis[i] = sqr(x - axis.x) + sqr(y - axis.y) + sqr(z - axis.z);
        to_opposite[i] = sqr(x + axis.x) + sqr(y + axis.y) + sqr(z + axis.z);
    });
    // Each step goes over all pairs before the next one: a single long chain of dependent operations leaves most of a
    // processor waiting.
    Pairs exponent, joint, factor;
    for (int j = 0; j < lobes_.size(); ++j) {
        const float kappa = std::abs(lobes_.kappa(j)), amplitude = -2 * pi * lobes_.amplitude(j);
        const bool forward = lobes_.kappa(j) >= 0;
        const Lanes &near = forward ? to_axis : to_opposite, &far = forward ? to_opposite : to_axis;
        for_lanes(blocks, [&, first = j * lanes](int i) {
            const Overlap overlap(source.kappa_[i], kappa, near[i], far[i]);
            exponent[first + i] = overlap.exponent;
            joint[first + i] = overlap.joint < saturated ? overlap.joint : saturated;
            factor[first + i] = amplitude * source.amplitude_[i] * overlap.reciprocal;
        });
    }
    for_lanes(blocks * lobes_.size(),
              [&](int k) { pairs_[k] = factor[k] * fast_exp(exponent[k]) * fast_expm1(-2 * joint[k]); });
    for (int first = 0; first < lanes; first += lanes_per_block) {
        sum_rows(pairs_ + first, lobes_.size(), lanes, parts_.value + first);
    }
    total_ = sum_lanes(blocks, parts_);
    integral_ = total_;
    if (!(total_ > least_integral)) {
        lobes_ = AxialLobes();
        parts_ = mixture_.weight_;
        for_lanes(blocks, [&](int i) { pairs_[i] = mixture_.weight_[i]; });
        total_ = 1;
        integral_ = 0;
    }
    scale_ = (integral_ > 0 ? 1 : 4 * pi) / total_;
}

float MixtureProduct::density(const Vec3& direction) const {
    return scale_ * mixture_.density(direction) * lobes_.density(direction);
}

WEND_VECTOR_CLONES Vec3 MixtureProduct::sample(Vec2 u) const {
    float target = u.x * total_;
    const int i = descend(parts_.value, mixture_.size(), 1, target);
    const int stride = mixture_.blocks() * lanes_per_block;
    const int j = descend(pairs_ + i, lobes_.size(), stride, target);
    const float own = target / pairs_[j * stride + i];
    const Vec3 mean(mixture_.mean_x_[i], mixture_.mean_y_[i], mixture_.mean_z_[i]);
    const Vec3 sum = mean * mixture_.kappa_[i] + lobes_.axis() * lobes_.kappa(j);
    const float joint = length(sum);
    return Vmf{joint > 0 ? sum * (1 / joint) : mean, joint}.sample({std::min(own, one_minus_epsilon), u.y});
}

}  // namespace wend::guide
