// Incident radiance times what scatters it: the distribution that guided directions are drawn from.
#pragma once

#include <wend/guide/mixture.h>
#include <wend/sampling/axial_lobes.h>

namespace wend::guide {

/// The normalized product V H / Z of a mixture V and lobes H, exact in both: samples come from the products of all
/// pairs of their lobes, which are lobes again; the density asks V and H alone. Where the product is too small to tell
/// (Z below 1e-20), it is V instead, and the integral 0. Two kilobytes, filled where it is constructed: to be passed by
/// reference.
class MixtureProduct {
public:
    MixtureProduct(const VmfMixture& mixture, const AxialLobes& lobes) : mixture_(mixture), lobes_(lobes) {
        weigh_parts(mixture);
    }
    MixtureProduct(const MixtureView& view, const AxialLobes& lobes) : mixture_(view), lobes_(lobes) {
        weigh_parts(view.mixture_);
    }

    /// Z = ∫ V H dω, in 1/sr.
    float integral() const { return integral_; }

    /// The part of Z that each lobe of V has, if Z is not 0.
    const Lanes& parts() const { return parts_; }

    /// Density at a unit direction, in 1/sr.
    float density(const Vec3& direction) const;

    /// A direction distributed by the density, from a point of [0,1)².
    Vec3 sample(Vec2 u) const;

private:
    /// Numbers for pairs of lobes, those of one axial lobe side by side. Only the pairs there are have some.
    using Pairs = float[AxialLobes::capacity * max_lobes];

    /// Sets the numbers below, and the lobes to the uniform one where the product is too small. What does not depend on
    /// the position is read from the mixture that was copied: reading what has just been written is slower.
    void weigh_parts(const VmfMixture& source);

    VmfMixture mixture_;
    AxialLobes lobes_;
    /// Of each lobe of the mixture, its part of ∫ V H dω; and their sum.
    Lanes parts_{Unset{}};
    float total_;
    float integral_;
    float scale_;
    /// Of each pair, its share of the part, so that a sample need not find them again.
    Pairs pairs_;
};

}  // namespace wend::guide
