// What the learned field knows about one cell of space.
#pragma once

#include <wend/adjoint/adjoint.h>
#include <wend/guide/product.h>

namespace wend::guide {

/// The learned adjoint in one cell. The mixture belongs to a reference point; seen from elsewhere in the cell, lobes
/// whose distance is known turn to keep pointing at their source.
class Region {
public:
    /// Knows nothing: no radiance, equally from everywhere.
    Region() = default;

    /// `inverse_distance`: 1/distance of each lobe's source from the reference point; 0 where it is far or not known.
    Region(const Vec3& reference, const VmfMixture& mixture, const Lanes& inverse_distance, float fluence)
        : reference_(reference), fluence_(fluence), mixture_(mixture), inverse_distance_(inverse_distance) {}

    /// Distribution of the incident radiance at a position of the cell, as a view of this region.
    MixtureView incident(const Vec3& position) const {
        return MixtureView(mixture_, reference_ - position, inverse_distance_);
    }

    /// ∫ L dω averaged over the cell's records, in radiance times sr.
    float fluence() const { return fluence_; }

    const Vec3& reference() const { return reference_; }
    const VmfMixture& mixture() const { return mixture_; }
    const Lanes& inverse_distance() const { return inverse_distance_; }

private:
    Vec3 reference_{0, 0, 0};
    float fluence_ = 0;
    VmfMixture mixture_;
    Lanes inverse_distance_;
};

static_assert(IncidentRadiance<VmfMixture>);
static_assert(IncidentRadiance<MixtureView>);
static_assert(Adjoint<Region>);

}  // namespace wend::guide
