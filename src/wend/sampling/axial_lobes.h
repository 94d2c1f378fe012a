// A function of the angle to an axis as a few von Mises–Fisher lobes along it: how a phase function or a BSDF looks to
// whoever multiplies it with a mixture of incident radiance (docs/theory/learned_field.md).
#pragma once

#include <wend/core/export.h>
#include <wend/core/vector.h>

#include <cstring>
#include <span>

namespace wend {

/// One lobe of AxialLobes.
struct AxialLobe {
    /// Share in the sum, not negative.
    float weight;
    /// Concentration, at most Vmf::max_kappa; a negative one belongs to a lobe around the opposite of the axis.
    float kappa;
};

/// A density over directions, Σ w_j vMF_j with all means on one axis, of at most `capacity` lobes whose weights add up
/// to 1. A value of fixed size without heap memory.
class WEND_API AxialLobes {
public:
    /// Most lobes.
    static constexpr int capacity = 24;

    /// The uniform distribution: one lobe of concentration 0.
    AxialLobes();

    /// 1 to `capacity` lobes around +z; weights are scaled to the sum 1, and one at least must be positive.
    explicit AxialLobes(std::span<const AxialLobe> lobes);

    /// Copies no more than the lobes there are.
    AxialLobes(const AxialLobes& other) { *this = other; }
    /// Likewise.
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

    /// What the means of all lobes are on; unit length.
    const Vec3& axis() const { return axis_; }
    /// Number of lobes, 1 to `capacity`.
    int size() const { return size_; }
    /// Concentration of a lobe, negative for a backward one.
    float kappa(int j) const { return kappa_[j]; }
    /// Weight of a lobe times its density at its mean, in 1/sr.
    float amplitude(int j) const { return amplitude_[j]; }
    /// All concentrations, for whoever goes over whole blocks: lanes() numbers, 0 for lobes that are not there.
    const float* kappas() const { return kappa_; }
    /// All amplitudes, likewise.
    const float* amplitudes() const { return amplitude_; }
    /// size() rounded up to whole blocks of 8.
    int lanes() const { return (size_ + block - 1) / block * block; }

    /// Density at a unit direction, in 1/sr.
    float density(const Vec3& direction) const;
    /// A direction distributed by the density, from a point of [0,1)².
    Vec3 sample(Vec2 u) const;

private:
    /// Beyond the last block that is used nothing need be set.
    static constexpr int block = 8;
    static_assert(capacity % block == 0);

    Vec3 axis_;
    int size_;
    float kappa_[capacity];
    float amplitude_[capacity];
};

}  // namespace wend
