// Incident radiance times what scatters it: the distribution that guided directions are drawn from.
#pragma once

#include <wend/guide/mixture.h>
#include <wend/sampling/axial_lobes.h>

namespace wend::guide {

/// The normalized product V H / Z of a mixture V and lobes H, exact in both: samples come from the products of all
/// pairs of their lobes, which are lobes again; the density asks V and H alone. Where the product is too small to tell
/// (Z below 1e-20), it is V instead, and the integral 0.
class MixtureProduct {
public:
    MixtureProduct(const VmfMixture& mixture, const AxialLobes& lobes);

    /// Z = ∫ V H dω, in 1/sr.
    float integral() const { return integral_; }

    /// The part of Z that each lobe of V has, if Z is not 0.
    const Lanes& parts() const { return parts_; }

    /// Density at a unit direction, in 1/sr.
    float density(const Vec3& direction) const {
        return scale_ * mixture_.density(direction) * lobes_.density(direction);
    }

    /// A direction distributed by the density, from a point of [0,1)².
    Vec3 sample(Vec2 u) const;

private:
    void weigh_parts();

    VmfMixture mixture_;
    AxialLobes lobes_;
    /// Of each lobe of the mixture, its part of ∫ V H dω; and their sum.
    Lanes parts_;
    float total_;
    float integral_;
    float scale_;
};

}  // namespace wend::guide
