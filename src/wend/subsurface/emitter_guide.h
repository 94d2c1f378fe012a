// Light that shines into a dense medium through its boundary, for walks inside to head for.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/export.h>
#include <wend/medium/phase.h>
#include <wend/sampling/vmf.h>

#include <array>
#include <span>

namespace wend {

/// A lamp outside as it is seen just inside of a boundary.
struct BoundaryEmitter {
    Vmf lobe;           ///< of the directions in which a walk flies out to it
    float cosine = 1;   ///< of the lobe's mean to the outward normal, in (0, 1]
    float fluence = 0;  ///< radiance over all directions
    float peak = 0;     ///< vmf_peak() of the lobe
};

/// What a walk inside a medium may expect of the light outside, where it is.
struct EmitterView {
    std::span<const BoundaryEmitter> lamps;  ///< at the closest boundary; referred to; EmitterGuide::most at most
    float depth = 0;                         ///< below it, in scene units
    Rgb diffuse{1.0f};                       ///< radiance that a walk may expect that turns away from it
};

/// The part of the light that has not been scattered yet: that of each lamp falls off as exp(-extinction depth /
/// cosine), and is seen within its lobe.
class WEND_API EmitterGuide {
public:
    /// Most lamps; those beyond are left out.
    static constexpr std::size_t most = 4;
    /// One number a lamp, 0 for those that are not there.
    using PerEmitter = std::array<float, most>;

    /// Of no lamp.
    EmitterGuide() = default;
    /// What a view becomes in a medium of this extinction, of which the first `channels` channels, 1 or 3, are asked
    /// for. Refers to the view's lamps.
    EmitterGuide(const EmitterView& view, const Rgb& extinction, int channels);

    /// EmitterView::diffuse, at least 1e-20, so that walks always have somewhere to go.
    const Rgb& diffuse() const { return diffuse_; }
    /// How many lamps there are.
    std::size_t size() const { return size_; }
    /// Directions in which a walk flies out to a lamp.
    const Vmf& lobe(std::size_t lamp) const { return lamps_[lamp].lobe; }

    /// The densities of the lobes in a direction.
    PerEmitter densities(const Vec3& w) const;
    /// The phase function for each lamp, of a walk that arrives along `before`.
    PerEmitter phases(const PhaseFunction& phase, const Vec3& before) const;
    /// The fluence of a lamp where the walk is.
    float fluence(int channel, std::size_t lamp) const { return arriving_[static_cast<std::size_t>(channel)][lamp]; }

private:
    const BoundaryEmitter* lamps_ = nullptr;
    std::size_t size_ = 0;
    std::array<PerEmitter, 3> arriving_{};  // by channel, fluence of each lamp
    Rgb diffuse_;
};

}  // namespace wend
