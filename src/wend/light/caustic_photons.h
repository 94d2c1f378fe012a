// Light that smooth boundaries and mirrors lead to a place, which walks from there would find by chance alone.
#pragma once

#include <wend/decision/caustic_map.h>

#include <cstdint>

namespace wend {

class Scene;

/// Photons, as photon maps have them (jensen1995): from lights to points of smooth boundaries and mirrors, and from
/// there, reflected and refracted as chance will have it, to where they first meet something else. Directions are drawn
/// by them; they need not be exact.
class CausticPhotons {
public:
    /// None.
    CausticPhotons() = default;
    /// About `count` are sent, in a scene that has smooth surfaces.
    CausticPhotons(const Scene& scene, int count, std::uint64_t seed, int threads);

    /// How many arrived.
    std::size_t size() const { return on_surfaces_.size() + in_media_.size(); }

    const CausticMap& on_surfaces() const { return on_surfaces_; }
    const CausticMap& in_media() const { return in_media_; }

private:
    CausticMap on_surfaces_, in_media_;
};

}  // namespace wend
