// Light that smooth boundaries and mirrors lead to a place, which walks from there would find by chance alone.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/random.h>
#include <wend/core/vector.h>
#include <wend/decision/caustic_map.h>

#include <cstdint>
#include <optional>

namespace wend {

class Scene;

/// What is seen of a light from a place by way of what refracts or reflects it.
struct CausticSight {
    Vec3 towards{0, 0, 0};  ///< from the place, unit length
    float distance = 0;     ///< of the light, along the way
    Rgb fluence;            ///< an estimate of that of all such light
};

/// Photons, as photon maps have them (jensen1995): from lights to points of smooth boundaries and mirrors, and from
/// there, reflected and refracted as chance will have it, to where they first meet something else. Directions are drawn
/// and guides are taught by them; they need not be exact.
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

    /// What one group of photons, by chance of those close by, tells of a place on a surface, on the side of the
    /// normal, or in a medium, where the normal is zero. Nothing if there is none.
    std::optional<CausticSight> near(const Vec3& position, const Vec3& normal, Pcg32& random) const;

private:
    CausticMap on_surfaces_, in_media_;
};

}  // namespace wend
