// Incident radiance times what scatters it: the distribution that guided directions are drawn from.
#pragma once

#include <wend/guide/mixture.h>
#include <wend/sampling/axial_lobes.h>

#include <span>

namespace wend::guide {

/// The normalized product V H / Z of a mixture V and lobes H, exact in both: samples come from the products of all
/// pairs of their lobes, which are lobes again; the density asks V and H alone. Where the product is too small to tell
/// (Z below 1e-20), it is V instead, and the integral 0. Two kilobytes, filled where it is constructed: to be passed by
/// reference.
class MixtureProduct {
public:
    MixtureProduct(const VmfMixture& mixture, const AxialLobes& lobes)
        : mixture_(mixture.size(), Unset{}), lobes_(lobes) {
        weigh(mixture);
    }
    MixtureProduct(const MixtureView& view, const AxialLobes& lobes)
        : mixture_(view.mixture_.size(), Unset{}), lobes_(lobes) {
        turn_and_weigh(view);
    }

    /// Z = ∫ V H dω, in 1/sr.
    float integral() const { return integral_; }

    /// The part of Z that each lobe of V has, if Z is not 0.
    std::span<const float> parts() const {
        return {sums_ + (lobes_.size() - 1) * lanes(), static_cast<std::size_t>(mixture_.size())};
    }

    /// Density at a unit direction, in 1/sr.
    float density(const Vec3& direction) const;

    /// A direction distributed by the density, from a point of [0,1)².
    Vec3 sample(Vec2 u) const;

private:
    /// Numbers for pairs of lobes, those of one axial lobe side by side. Only the pairs there are have some.
    using Pairs = float[AxialLobes::capacity * max_lobes];

    /// Set the lobes' means, concentrations and amplitudes (nothing asks for their weights) and the numbers below, and
    /// the axial lobes to the uniform one where the product is too small.
    void weigh(const VmfMixture& mixture);
    void turn_and_weigh(const MixtureView& view);
    /// Their body, of which each compiles its own copy for several vector widths.
    template <class MeanOf>
    void weigh_parts(const VmfMixture& source, const MeanOf& mean_of);

    int lanes() const { return mixture_.blocks() * lanes_per_block; }

    VmfMixture mixture_;
    AxialLobes lobes_;
    /// Of the parts that the lobes of the mixture have of ∫ V H dω.
    SumsBelow below_;
    float integral_;
    float scale_;
    /// Of each pair, what the pairs up to it have of the part, so that a sample need not find them again.
    Pairs sums_;
};

}  // namespace wend::guide
