// Light that shines into a dense medium through its boundary, for walks inside to head for.
#pragma once

#include <wend/core/colour.h>
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
class EmitterGuide {
public:
    static constexpr std::size_t most = 4;
    using PerEmitter = std::array<float, most>;

    EmitterGuide() = default;
    EmitterGuide(const EmitterView& view, const Rgb& extinction, int channels);

    const Rgb& diffuse() const { return diffuse_; }
    std::size_t size() const { return size_; }
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
