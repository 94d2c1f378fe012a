// A mixture of von Mises–Fisher lobes: what a learned field says about the incident radiance at a point; and its
// product with what scatters, the distribution that guided directions are drawn from.
#pragma once

#include <wend/core/export.h>
#include <wend/sampling/axial_lobes.h>
#include <wend/sampling/vmf.h>

#include <cstring>
#include <span>

namespace wend::guide {

/// Most lobes of a mixture.
inline constexpr int max_lobes = 16;
/// Loops run over whole blocks of lanes; unused lanes hold harmless numbers.
inline constexpr int lanes_per_block = 8;

/// How many blocks hold that many lobes.
constexpr int blocks_for(int lobes) {
    return (lobes + lanes_per_block - 1) / lanes_per_block;
}

/// Asks for lanes without numbers: every lane of a used block must be written before it is read.
struct Unset {};

/// One number per lobe.
struct alignas(16) Lanes {
    float value[max_lobes];  ///< by lobe; those beyond the mixture's size are of no meaning

    /// All 0.
    Lanes() : value{} {}
    /// All to be written.
    explicit Lanes(Unset) {}
    /// Written out, since compilers copy a structure of many lanes by a slow string instruction otherwise.
    Lanes(const Lanes& other) { std::memcpy(value, other.value, sizeof value); }
    /// Likewise.
    Lanes& operator=(const Lanes& other) {
        std::memcpy(value, other.value, sizeof value);
        return *this;
    }

    /// Takes the first `blocks` blocks of another; the rest stays.
    void copy(int blocks, const Lanes& other) {
        for (int block = 0; block < blocks; ++block) {
            const int first = block * lanes_per_block;
            std::memcpy(value + first, other.value + first, lanes_per_block * sizeof(float));
        }
    }

    /// The number of a lobe, to be written.
    float& operator[](int i) { return value[i]; }
    /// The number of a lobe.
    float operator[](int i) const { return value[i]; }
};

/// The lobes of a mixture (mixture.h).
struct MixtureLanes {
    int size;         ///< lobes in use, 1 to max_lobes
    Lanes mean_x;     ///< first coordinate of the means, which have unit length
    Lanes mean_y;     ///< their second coordinate
    Lanes mean_z;     ///< their third
    Lanes kappa;      ///< concentrations
    Lanes weight;     ///< shares, with the sum 1
    Lanes amplitude;  ///< weight times density at the mean, in 1/sr

    /// As many lobes, of which all numbers are 0.
    explicit MixtureLanes(int lobes) : size(lobes) {}
    /// As many lobes, of which all numbers are to be written.
    MixtureLanes(int lobes, Unset unset)
        : size(lobes), mean_x(unset), mean_y(unset), mean_z(unset), kappa(unset), weight(unset), amplitude(unset) {}

    /// Blocks in use.
    int blocks() const { return blocks_for(size); }
    /// Numbers in these blocks, those of unused lobes included.
    int lanes() const { return blocks() * lanes_per_block; }
};

/// One lobe of a mixture.
struct WeightedVmf {
    /// Share in the mixture, not negative.
    float weight;
    /// Its directions.
    Vmf vmf;
};

class MixtureProduct;

/// A density over directions, Σ w_i vMF_i, of at most max_lobes lobes whose weights add up to 1. A value of fixed size
/// without heap memory.
class WEND_API VmfMixture {
public:
    /// The uniform distribution: one lobe of concentration 0.
    VmfMixture();

    /// A mixture of 1 to max_lobes lobes; weights are scaled to the sum 1 (unless they have it but for
    /// rounding), and one at least must be positive.
    explicit VmfMixture(std::span<const WeightedVmf> lobes);

    /// Number of lobes, 1 to max_lobes.
    int size() const { return lanes_.size; }
    /// A lobe, i in [0, size()).
    WeightedVmf lobe(int i) const;

    /// Density at a unit direction, in 1/sr. Relative error 1e-6 · (1 + kappa angle²).
    float density(const Vec3& direction) const;

    /// A direction distributed by the density, from a point of [0,1)²; u.x selects the lobe, and what is left of it is
    /// used again within the lobe.
    Vec3 sample(Vec2 u) const;

    /// The normalized product with lobes of what scatters.
    MixtureProduct product(const AxialLobes& lobes) const;

    /// The mixture as seen from a point displaced by -`offset`, where lobe i comes from a distance
    /// 1/inverse_distance[i]: each mean m turns to the direction of m + offset · inverse_distance. Weights and
    /// concentrations stay.
    VmfMixture re_aimed(const Vec3& offset, const Lanes& inverse_distance) const;

private:
    friend class MixtureProduct;

    /// Of as many lobes, all of them still to be written.
    VmfMixture(int size, Unset unset) : lanes_(size, unset) {}

    MixtureLanes lanes_;
};

/// A mixture as seen from a displaced point (VmfMixture::re_aimed), before it is turned: its product comes cheaper
/// than that of a mixture turned first. Refers to the mixture and the distances, which must outlive it; the other
/// questions turn the mixture each time, so whoever has many of them should make a VmfMixture of this.
class WEND_API MixtureView {
public:
    /// The arguments of VmfMixture::re_aimed().
    MixtureView(const VmfMixture& mixture, const Vec3& offset, const Lanes& inverse_distance)
        : mixture_(mixture), inverse_distance_(inverse_distance), offset_(offset) {}

    /// The mixture, turned.
    operator VmfMixture() const { return mixture_.re_aimed(offset_, inverse_distance_); }

    /// VmfMixture::density() of the turned mixture.
    float density(const Vec3& direction) const { return VmfMixture(*this).density(direction); }
    /// VmfMixture::sample() of the turned mixture.
    Vec3 sample(Vec2 u) const { return VmfMixture(*this).sample(u); }
    /// The product of the turned mixture, which is turned on the way.
    MixtureProduct product(const AxialLobes& lobes) const;

private:
    friend class MixtureProduct;

    const VmfMixture& mixture_;
    const Lanes& inverse_distance_;
    Vec3 offset_;
};

/// Of numbers that are not negative, what those before each one add up to, by a tree of few steps: never less than for
/// the one before, and the same across a 0.
struct SumsBelow {
    int lanes;    ///< how many numbers there are
    float total;  ///< of all of them
    /// By index, what those before it have; behind the last one the total again.
    float sum[max_lobes + 1];
};

/// A product V H / Z.
struct ProductLanes {
    /// Its weights are not set: nothing asks for them.
    MixtureLanes mixture;
    /// H, along its axis.
    AxialLobes scatterer;
    /// Of the parts that the lobes of the mixture have of Z.
    SumsBelow below;
    /// Z, in 1/sr; 0 where it is too small to tell.
    float integral;
    /// What the product of densities is multiplied by to be one.
    float scale;
    /// Of each pair of lobes, those of one axial lobe side by side, what the pairs up to it have of the part, so that a
    /// sample need not find them again. Only the pairs there are have some.
    float pair_sums[AxialLobes::capacity * max_lobes];

    /// For a mixture of as many lobes; the product itself is to be written.
    ProductLanes(int lobes, const AxialLobes& other) : mixture(lobes, Unset{}), scatterer(other) {}

    /// The part of Z that each lobe of the mixture has.
    const float* parts() const { return pair_sums + (scatterer.size() - 1) * mixture.lanes(); }
};

/// The normalized product V H / Z of a mixture V and lobes H, exact in both: samples come from the products of all
/// pairs of their lobes, which are lobes again; the density asks V and H alone. Where the product is too small to tell
/// (Z below 1e-20), it is V instead, and the integral 0. Two kilobytes, filled where it is constructed: to be passed by
/// reference.
class WEND_API MixtureProduct {
public:
    /// The product of a mixture as it is. Refers to neither afterwards.
    MixtureProduct(const VmfMixture& mixture, const AxialLobes& lobes);
    /// The product of a mixture as it is seen from elsewhere. Refers to neither afterwards.
    MixtureProduct(const MixtureView& view, const AxialLobes& lobes);

    /// Z = ∫ V H dω, in 1/sr.
    float integral() const { return lanes_.integral; }

    /// The part of Z that each lobe of V has, if Z is not 0.
    std::span<const float> parts() const { return {lanes_.parts(), static_cast<std::size_t>(lanes_.mixture.size)}; }

    /// Density at a unit direction, in 1/sr.
    float density(const Vec3& direction) const;

    /// A direction distributed by the density, from a point of [0,1)².
    Vec3 sample(Vec2 u) const;

private:
    ProductLanes lanes_;
};

}  // namespace wend::guide
