// A mixture of von Mises–Fisher lobes: what a learned field says about the incident radiance at a point.
#pragma once

#include <wend/guide/lanes.h>
#include <wend/numeric/fast_exp2.h>
#include <wend/sampling/axial_lobes.h>
#include <wend/sampling/vmf.h>

#include <cmath>
#include <numbers>
#include <span>

namespace wend::guide {

struct WeightedVmf {
    /// Share in the mixture, not negative.
    float weight;
    Vmf vmf;
};

class MixtureProduct;

/// A density over directions, Σ w_i vMF_i, of at most max_lobes lobes whose weights add up to 1. A value of fixed size
/// without heap memory.
class VmfMixture {
public:
    /// The uniform distribution: one lobe of concentration 0.
    VmfMixture();

    /// A mixture of 1 to max_lobes lobes; weights are scaled to the sum 1 (unless they have it but for
    /// rounding), and one at least must be positive.
    explicit VmfMixture(std::span<const WeightedVmf> lobes);

    int size() const { return size_; }
    WeightedVmf lobe(int i) const;

    /// Density at a unit direction, in 1/sr. Relative error 1e-6 · (1 + kappa angle²).
    float density(const Vec3& direction) const;

    /// A direction distributed by the density, from a point of [0,1)²; u.x selects the lobe, and what is left of it is
    /// used again within the lobe.
    Vec3 sample(Vec2 u) const;

    /// The normalized product with lobes of what scatters (product.h).
    MixtureProduct product(const AxialLobes& lobes) const;

    /// The mixture as seen from a point displaced by -`offset`, where lobe i comes from a distance
    /// 1/inverse_distance[i]: each mean m turns to the direction of m + offset · inverse_distance. Weights and
    /// concentrations stay.
    VmfMixture re_aimed(const Vec3& offset, const Lanes& inverse_distance) const;

private:
    friend class MixtureProduct;

    /// The body of density(), for functions that are compiled for several vector widths.
    [[gnu::always_inline]] float sum_densities(const Vec3& direction) const {
        return sum_over_lanes(blocks(), [&, x = direction.x, y = direction.y, z = direction.z](int i) {
            const float squared = sqr(x - mean_x_[i]) + sqr(y - mean_y_[i]) + sqr(z - mean_z_[i]);
            return amplitude_[i] * fast_exp2(-0.5f * std::numbers::log2e_v<float> * kappa_[i] * squared);
        });
    }

    /// The mean of a lobe, turned.
    struct Mean {
        float x, y, z;

        float squared_distance(const Vec3& to) const { return sqr(x - to.x) + sqr(y - to.y) + sqr(z - to.z); }
    };
    [[gnu::always_inline]] Mean turned_mean(int i, const Vec3& offset, const Lanes& inverse_distance) const {
        const float own_x = mean_x_[i], own_y = mean_y_[i], own_z = mean_z_[i], inverse = inverse_distance[i];
        const float x = own_x + offset.x * inverse, y = own_y + offset.y * inverse, z = own_z + offset.z * inverse;
        const float squared = x * x + y * y + z * z, length = std::sqrt(squared);
        // 1 / length without waiting for the root.
        const float scale = length * (1 / squared);
        // On top of the source no direction is better than another.
        const bool far = length > 1e-3f;
        return {far ? x * scale : own_x, far ? y * scale : own_y, far ? z * scale : own_z};
    }

    /// A mixture of as many lobes, all of them still to be written.
    VmfMixture(int size, Unset unset)
        : size_(size),
          mean_x_(unset),
          mean_y_(unset),
          mean_z_(unset),
          kappa_(unset),
          weight_(unset),
          amplitude_(unset) {}

    int blocks() const { return blocks_for(size_); }

    int size_;
    Lanes mean_x_, mean_y_, mean_z_, kappa_, weight_;
    /// Weight times density at the mean.
    Lanes amplitude_;
};

/// A mixture as seen from a displaced point (VmfMixture::re_aimed), before it is turned: its product comes cheaper
/// than that of a mixture turned first. Refers to the mixture and the distances, which must outlive it; the other
/// questions turn the mixture each time, so whoever has many of them should make a VmfMixture of this.
class MixtureView {
public:
    MixtureView(const VmfMixture& mixture, const Vec3& offset, const Lanes& inverse_distance)
        : mixture_(mixture), inverse_distance_(inverse_distance), offset_(offset) {}

    operator VmfMixture() const { return mixture_.re_aimed(offset_, inverse_distance_); }

    float density(const Vec3& direction) const { return VmfMixture(*this).density(direction); }
    Vec3 sample(Vec2 u) const { return VmfMixture(*this).sample(u); }
    MixtureProduct product(const AxialLobes& lobes) const;

private:
    friend class MixtureProduct;

    const VmfMixture& mixture_;
    const Lanes& inverse_distance_;
    Vec3 offset_;
};

}  // namespace wend::guide
