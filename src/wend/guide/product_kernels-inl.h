// The kernels of a product (kernels.h), for one vector target.
#include <wend/guide/kernels.h>
#include <wend/guide/mixture_kernels-inl.h>
#include <wend/sampling/vmf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#if defined(WEND_GUIDE_PRODUCT_KERNELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WEND_GUIDE_PRODUCT_KERNELS_INL_H
#undef WEND_GUIDE_PRODUCT_KERNELS_INL_H
#else
#define WEND_GUIDE_PRODUCT_KERNELS_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace wend::guide::HWY_NAMESPACE {

/// What ∫ f g dω of two lobes needs but for exponentials: divided by 2 pi times the product of their densities at their
/// means it is 2^exponent · (1 - e^{-2 joint}) / joint. No two terms cancel.
struct Overlaps {
    Floats exponent, joint, reciprocal;

    static HWY_INLINE Floats exponentials(Floats exponent, Floats joint) {
        return fast_exp2(exponent) * fast_exp2m1(-2 * std::numbers::log2e_v<float> * joint);
    }

    /// From the concentrations and the squared distances of one mean to the other and to its opposite.
    HWY_INLINE Overlaps(Floats kappa, Floats other, Floats to_mean, Floats to_opposite) {
        // 1 - e^{-2 joint} is 1 from here on. Larger concentrations would pass through numbers too small to be normal,
        // which processors are slow at.
        constexpr float saturated = 20;
        const Floats difference = kappa - other;
        const Floats both = kappa * other;
        // Never 0.
        const Floats squared = difference * difference + both * to_opposite + 1e-12f;
        joint = sqrt(squared);
        // joint - kappa - other in base 2, and 1 / joint without waiting for the root.
        exponent = -std::numbers::log2e_v<float> * both * to_mean / (joint + (kappa + other));
        reciprocal = joint * (1 / squared);
        joint = min(joint, saturated);
    }
};

/// What a lobe's overlaps take from the axial lobe.
struct Scatterer {
    float kappa, amplitude;

    HWY_INLINE Scatterer(const AxialLobes& lobes, int j)
        : kappa(std::abs(lobes.kappa(j))), amplitude(-2 * pi * lobes.amplitude(j)) {}
};

HWY_INLINE void set_below(int lanes, const float* numbers, SumsBelow& below) {
    static_assert(lanes_per_block == 8);
    below.lanes = lanes;
    float before = 0;
    below.sum[0] = before;
    for (int first = 0; first < lanes; first += lanes_per_block) {
        const float* w = numbers + first;
        const float w01 = w[0] + w[1], w23 = w[2] + w[3], w45 = w[4] + w[5], w67 = w[6] + w[7];
        const float half = before + (w01 + w23), all = half + (w45 + w67);
        // As a whole, by the compiler's own vector, since that is how it will be read.
        using Block [[gnu::vector_size(lanes_per_block * sizeof(float))]] = float;
        const Block sums = {before + w[0], before + w01, before + (w01 + w[2]), half,
                            half + w[4],   half + w45,   half + (w45 + w[6]),   all};
        std::memcpy(below.sum + first + 1, &sums, sizeof sums);
        before = all;
    }
    below.total = before;
}

/// The lane whose share of the total holds the target, in [0, total): never one of 0.
HWY_INLINE int find(const SumsBelow& below, float target) {
    // No branch depends on the target: the processor could not guess it.
    std::size_t passed = 0;
    for_lanes(below.lanes, [&](int i) HWY_ATTR {
        const Floats upto = Floats::load(below.sum + 1 + i);
        passed += hn::CountTrue(Floats::Tag(), hn::Le(upto.raw, Floats(target).raw));
    });
    return static_cast<int>(passed);
}

template <class MeansAt>
HWY_INLINE void multiply_with(const MixtureLanes& source, const MeansAt& means_at, ProductLanes& product) {
    constexpr float least_integral = 1e-20f;
    const int blocks = source.blocks(), lanes = source.lanes();
    const AxialLobes& scatterers = product.scatterer;
    const Directions towards(scatterers.axis()), away(-scatterers.axis());
    // Each step goes over all pairs before the next one: a single long chain of dependent operations leaves most of a
    // processor waiting.
    float exponent[AxialLobes::capacity * max_lobes], joint[AxialLobes::capacity * max_lobes],
        factor[AxialLobes::capacity * max_lobes];
    for_lanes(lanes, [&](int i) HWY_ATTR {
        const Directions mean = means_at(i);
        mean.store(i, product.mixture);
        const Floats kappa = at(source.kappa, i), amplitude = at(source.amplitude, i),
                     to_axis = mean.squared_distance(towards), to_opposite = mean.squared_distance(away);
        for (int j = 0; j < scatterers.size(); ++j) {
            const Scatterer scatterer(scatterers, j);
            const bool forward = scatterers.kappa(j) >= 0;
            const Overlaps overlap(kappa, scatterer.kappa, forward ? to_axis : to_opposite,
                                   forward ? to_opposite : to_axis);
            const int k = j * lanes + i;
            overlap.exponent.store(exponent + k);
            overlap.joint.store(joint + k);
            (scatterer.amplitude * amplitude * overlap.reciprocal).store(factor + k);
        }
    });
    for_lanes(lanes, [&](int i) HWY_ATTR {
        Floats sum = 0;
        for (int j = 0; j < scatterers.size(); ++j) {
            const int k = j * lanes + i;
            sum = sum + Floats::load(factor + k) *
                            Overlaps::exponentials(Floats::load(exponent + k), Floats::load(joint + k));
            sum.store(product.pair_sums + k);
        }
    });
    set_below(lanes, product.parts(), product.below);
    product.mixture.kappa.copy(blocks, source.kappa);
    product.mixture.amplitude.copy(blocks, source.amplitude);
    product.integral = product.below.total;
    product.scale = 1 / product.integral;
    if (!(product.integral > least_integral)) {
        product.scatterer = AxialLobes();
        std::copy_n(source.weight.value, lanes, product.pair_sums);
        set_below(lanes, product.pair_sums, product.below);
        product.integral = 0;
        product.scale = 4 * pi;
    }
}

inline void multiply(const MixtureLanes& mixture, ProductLanes& product) {
    multiply_with(
        mixture, [&](int i) HWY_ATTR { return means(mixture, i); }, product);
}

inline void turn_and_multiply(const MixtureLanes& mixture, const Vec3& offset, const Lanes& inverse_distance,
                              ProductLanes& product) {
    multiply_with(
        mixture, [&, offset](int i) HWY_ATTR { return turned_means(mixture, i, offset, inverse_distance); }, product);
}

/// Σ_j w_j vMF_j of lobes on an axis.
HWY_INLINE float density(const AxialLobes& lobes, const Vec3& direction) {
    const float before = 0.5f * std::numbers::log2e_v<float> * length_squared(direction - lobes.axis()),
                behind = 0.5f * std::numbers::log2e_v<float> * length_squared(direction + lobes.axis());
    if (lobes.size() == 1) {
        return lobes.amplitude(0) * wend::fast_exp2(lobes.kappa(0) * (lobes.kappa(0) < 0 ? behind : -before));
    }
    return sum_over(lobes.lanes(), [&](int j) HWY_ATTR {
        const Floats kappa = Floats::load(lobes.kappas() + j);
        return Floats::load(lobes.amplitudes() + j) * fast_exp2(kappa * where_greater(0, kappa, behind, -before));
    });
}

inline float product_density(const ProductLanes& product, const Vec3& direction) {
    const float scattered = product.scale * density(product.scatterer, direction);
    return scattered * density(product.mixture, direction);
}

inline Vec3 product_sample(const ProductLanes& product, Vec2 u) {
    const float* sums = product.pair_sums;
    const AxialLobes& scatterers = product.scatterer;
    const MixtureLanes& mixture = product.mixture;
    const float chosen = u.x * product.below.total;
    const int i = find(product.below, chosen);
    float target = chosen - product.below.sum[i];
    float before = 0, upto = sums[i];
    int j = 0;
    if (const int last = scatterers.size() - 1; last > 0) {
        const int stride = mixture.lanes();
        // By rounding it could be all of the part.
        target = std::min(target, sums[last * stride + i] * one_minus_epsilon);
        for (int k = 0; k < last; ++k) {
            j += sums[k * stride + i] <= target ? 1 : 0;
        }
        before = j > 0 ? sums[(j - 1) * stride + i] : 0.0f;
        upto = sums[j * stride + i];
    }
    u.x = std::min(one_minus_epsilon, (target - before) / (upto - before));

    const Vec3 mean(mixture.mean_x[i], mixture.mean_y[i], mixture.mean_z[i]);
    const Vec3 sum = mean * mixture.kappa[i] + scatterers.axis() * scatterers.kappa(j);
    const float squared = length_squared(sum), joint = std::sqrt(squared);
    // 1 / joint without waiting for the root.
    const float reciprocal = joint * (1 / squared);
    const bool uniform = !(squared > 1e-20f);
    return Vmf{uniform ? mean : sum * reciprocal, uniform ? 0 : joint}.sample(u, reciprocal);
}

}  // namespace wend::guide::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
