#include <wend/guide/product.h>

#include <wend/core/vector_clones.h>
#include <wend/numeric/fast_exp2.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace wend::guide {
namespace {

constexpr float least_integral = 1e-20f;

/// 1 - e^{-2 joint} is 1 from here on. Larger concentrations would pass through numbers too small to be normal, which
/// processors are slow at.
constexpr float saturated = 20;

/// The smaller of two positive numbers. By their bits, since compilers otherwise take the limit for a case of its own
/// and compute what is beyond it all the same, as numbers that are not normal.
inline float smaller(float a, float b) {
    return std::bit_cast<float>(std::min(std::bit_cast<std::int32_t>(a), std::bit_cast<std::int32_t>(b)));
}

/// What ∫ f g dω of two lobes needs but for exponentials: divided by 2 pi times the product of their densities at their
/// means it is 2^exponent · (1 - e^{-2 joint}) / joint. No two terms cancel.
struct Overlap {
    float exponent, joint, reciprocal;

    static float exponentials(float exponent, float joint) {
        return fast_exp2(exponent) * fast_exp2m1(-2 * std::numbers::log2e_v<float> * joint);
    }
    float exponentials() const { return exponentials(exponent, joint); }

    /// From the concentrations and the squared distances of one mean to the other and to its opposite.
    Overlap(float kappa, float other, float to_mean, float to_opposite) {
        const float difference = kappa - other;
        const float both = kappa * other;
        // Never 0.
        const float squared = difference * difference + both * to_opposite + 1e-12f;
        joint = std::sqrt(squared);
        // joint - kappa - other in base 2, and 1 / joint without waiting for the root.
        exponent = -std::numbers::log2e_v<float> * both * to_mean / (joint + (kappa + other));
        reciprocal = joint * (1 / squared);
        joint = smaller(joint, saturated);
    }
};

/// What a lobe's overlaps take from the axial lobe.
struct Scatterer {
    float kappa, amplitude;

    Scatterer(const AxialLobes& lobes, int j)
        : kappa(std::abs(lobes.kappa(j))), amplitude(-2 * pi * lobes.amplitude(j)) {}
};

}  // namespace

MixtureProduct VmfMixture::product(const AxialLobes& lobes) const {
    return MixtureProduct(*this, lobes);
}

MixtureProduct MixtureView::product(const AxialLobes& lobes) const {
    return MixtureProduct(*this, lobes);
}

template <class MeanOf>
[[gnu::always_inline]] inline void MixtureProduct::weigh_parts(const VmfMixture& source, const MeanOf& mean_of) {
    const int blocks = source.blocks(), lanes = blocks * lanes_per_block;
    // Not written to the mixture at once: compilers cannot know that it is not the source.
    Lanes mean_x(Unset{}), mean_y(Unset{}), mean_z(Unset{});
    const auto set_mean = [&](int i, const VmfMixture::Mean& mean) {
        mean_x[i] = mean.x;
        mean_y[i] = mean.y;
        mean_z[i] = mean.z;
    };
    const Vec3 axis = lobes_.axis();
    if (lobes_.size() == 1 && blocks == 1) {
        // What is only one block is done at one go: nothing but the result has to be stored.
        const Scatterer scatterer(lobes_, 0);
        Lanes parts(Unset{});
        const Vec3 towards = lobes_.kappa(0) >= 0 ? axis : -axis;
        for_lanes(1, [&](int i) {
            const VmfMixture::Mean mean = mean_of(i);
            const Overlap overlap(source.kappa_[i], scatterer.kappa, mean.squared_distance(towards),
                                  mean.squared_distance(-towards));
            parts[i] = scatterer.amplitude * source.amplitude_[i] * overlap.reciprocal * overlap.exponentials();
            set_mean(i, mean);
        });
        std::copy_n(parts.value, lanes_per_block, sums_);
        below_.set(1, parts.value);
    } else {
        Lanes to_axis(Unset{}), to_opposite(Unset{});
        for_lanes(blocks, [&](int i) {
            const VmfMixture::Mean mean = mean_of(i);
            to_axis[i] = mean.squared_distance(axis);
            to_opposite[i] = mean.squared_distance(-axis);
            set_mean(i, mean);
        });
        // Each step goes over all pairs before the next one: a single long chain of dependent operations leaves most of
        // a processor waiting.
        Pairs exponent, joint, factor;
        for (int j = 0; j < lobes_.size(); ++j) {
            const Scatterer scatterer(lobes_, j);
            const bool forward = lobes_.kappa(j) >= 0;
            const Lanes &near = forward ? to_axis : to_opposite, &far = forward ? to_opposite : to_axis;
            for_lanes(blocks, [&, first = j * lanes](int i) {
                const Overlap overlap(source.kappa_[i], scatterer.kappa, near[i], far[i]);
                exponent[first + i] = overlap.exponent;
                joint[first + i] = overlap.joint;
                factor[first + i] = scatterer.amplitude * source.amplitude_[i] * overlap.reciprocal;
            });
        }
        Lanes running;
        for (int j = 0; j < lobes_.size(); ++j) {
            for_lanes(blocks, [&, first = j * lanes](int i) {
                const int k = first + i;
                running[i] += factor[k] * Overlap::exponentials(exponent[k], joint[k]);
                sums_[k] = running[i];
            });
        }
        below_.set(blocks, sums_ + (lobes_.size() - 1) * lanes);
    }
    mixture_.mean_x_.copy(blocks, mean_x);
    mixture_.mean_y_.copy(blocks, mean_y);
    mixture_.mean_z_.copy(blocks, mean_z);
    mixture_.kappa_.copy(blocks, source.kappa_);
    mixture_.amplitude_.copy(blocks, source.amplitude_);
    integral_ = below_.total();
    scale_ = 1 / integral_;
    if (!(integral_ > least_integral)) {
        lobes_ = AxialLobes();
        std::copy_n(source.weight_.value, lanes, sums_);
        below_.set(blocks, sums_);
        integral_ = 0;
        scale_ = 4 * pi;
    }
}

WEND_VECTOR_CLONES void MixtureProduct::weigh(const VmfMixture& mixture) {
    weigh_parts(mixture, [&](int i) {
        return VmfMixture::Mean{mixture.mean_x_[i], mixture.mean_y_[i], mixture.mean_z_[i]};
    });
}

WEND_VECTOR_CLONES void MixtureProduct::turn_and_weigh(const MixtureView& view) {
    weigh_parts(view.mixture_, [&, offset = view.offset_](int i) {
        return view.mixture_.turned_mean(i, offset, view.inverse_distance_);
    });
}

WEND_VECTOR_CLONES float MixtureProduct::density(const Vec3& direction) const {
    const float scattered = scale_ * lobes_.sum_densities(direction);
    return scattered * mixture_.sum_densities(direction);
}

WEND_VECTOR_CLONES Vec3 MixtureProduct::sample(Vec2 u) const {
    const float chosen = u.x * below_.total();
    const int i = below_.find(chosen);
    float target = chosen - below_[i];
    float before = 0, upto = sums_[i];
    int j = 0;
    if (const int last = lobes_.size() - 1; last > 0) {
        const int stride = lanes();
        // By rounding it could be all of the part.
        target = std::min(target, sums_[last * stride + i] * one_minus_epsilon);
        for (int k = 0; k < last; ++k) {
            j += sums_[k * stride + i] <= target ? 1 : 0;
        }
        before = j > 0 ? sums_[(j - 1) * stride + i] : 0.0f;
        upto = sums_[j * stride + i];
    }
    u.x = std::min(one_minus_epsilon, (target - before) / (upto - before));

    const Vec3 mean(mixture_.mean_x_[i], mixture_.mean_y_[i], mixture_.mean_z_[i]);
    const Vec3 sum = mean * mixture_.kappa_[i] + lobes_.axis() * lobes_.kappa(j);
    const float squared = length_squared(sum), joint = std::sqrt(squared);
    // 1 / joint without waiting for the root.
    const float reciprocal = joint * (1 / squared);
    const bool uniform = !(squared > 1e-20f);
    return Vmf{uniform ? mean : sum * reciprocal, uniform ? 0 : joint}.sample(u, reciprocal);
}

}  // namespace wend::guide
