// A function of the angle to an axis as a few von Mises–Fisher lobes along it: how a phase function or a BSDF looks to
// whoever multiplies it with a mixture of incident radiance (docs/theory/learned_field.md).
#pragma once

#include <wend/core/vector.h>
#include <wend/numeric/fast_exp2.h>

#include <cstring>
#include <numbers>
#include <span>

namespace wend {

struct AxialLobe {
    /// Share in the sum, not negative.
    float weight;
    /// Concentration, at most Vmf::max_kappa; a negative one belongs to a lobe around the opposite of the axis.
    float kappa;
};

/// A density over directions, Σ w_j vMF_j with all means on one axis, of at most `capacity` lobes whose weights add up
/// to 1. A value of fixed size without heap memory.
class AxialLobes {
public:
    static constexpr int capacity = 24;

    /// The uniform distribution: one lobe of concentration 0.
    AxialLobes();

    /// 1 to `capacity` lobes around +z; weights are scaled to the sum 1, and one at least must be positive.
    explicit AxialLobes(std::span<const AxialLobe> lobes);

    // Written out, to copy no more than the lobes there are.
    AxialLobes(const AxialLobes& other) { *this = other; }
    AxialLobes& operator=(const AxialLobes& other) {
        axis_ = other.axis_;
        size_ = other.size_;
        for (int first = 0; first < size_; first += block) {
            std::memcpy(kappa_ + first, other.kappa_ + first, block * sizeof(float));
            std::memcpy(amplitude_ + first, other.amplitude_ + first, block * sizeof(float));
        }
        return *this;
    }

    /// The cosine of a surface that reflects diffusely, clamped to its upper side, as a single lobe: the least-squares
    /// fit's concentration (ruppert2020).
    static const AxialLobes& cosine();

    /// The same lobes along another axis, of unit length.
    AxialLobes around(const Vec3& axis) const;

    const Vec3& axis() const { return axis_; }
    int size() const { return size_; }
    /// Concentration of a lobe, negative for a backward one.
    float kappa(int j) const { return kappa_[j]; }
    /// Weight of a lobe times its density at its mean, in 1/sr.
    float amplitude(int j) const { return amplitude_[j]; }

    /// Density at a unit direction, in 1/sr.
    float density(const Vec3& direction) const;
    /// Its body, for functions that are compiled for several vector widths.
    [[gnu::always_inline]] float sum_densities(const Vec3& direction) const {
        const float before = 0.5f * std::numbers::log2e_v<float> * length_squared(direction - axis_),
                    behind = 0.5f * std::numbers::log2e_v<float> * length_squared(direction + axis_);
        if (size_ == 1) {
            return amplitude_[0] * fast_exp2(kappa_[0] * (kappa_[0] < 0 ? behind : -before));
        }
        float part[block] = {};
        for (int first = 0; first < size_; first += block) {
            for (int j = 0; j < block; ++j) {
                const float kappa = kappa_[first + j];
                part[j] += amplitude_[first + j] * fast_exp2(kappa * (kappa < 0 ? behind : -before));
            }
        }
        return ((part[0] + part[4]) + (part[2] + part[6])) + ((part[1] + part[5]) + (part[3] + part[7]));
    }

    /// A direction distributed by the density, from a point of [0,1)².
    Vec3 sample(Vec2 u) const;

private:
    /// Vector instructions want inner loops of constant length: a block's lobes that are not there have amplitude 0,
    /// and beyond the last block that is used nothing need be set.
    static constexpr int block = 8;
    static_assert(capacity % block == 0);

    Vec3 axis_;
    int size_;
    float kappa_[capacity];
    float amplitude_[capacity];
};

}  // namespace wend
