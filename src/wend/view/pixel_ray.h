// The straight way that a pixel looks, cut at the boundaries of media.
#pragma once

#include <wend/scene/scene.h>

#include <optional>
#include <vector>

namespace wend {

/// A part of the way between two boundaries.
struct RayPart {
    Ray ray;  ///< from where the part begins
    MediumId medium = vacuum;
    std::optional<Hit> hit;  ///< what it ends at; none: it goes on for ever
    bool ends_at_interface = false;
};

/// What the middle of a pixel, of the lens and of the shutter's time sees: interfaces are passed, and the last part
/// ends at a surface, or goes on for ever. Empty where the camera lets no light through to there.
std::vector<RayPart> pixel_ray(const Scene& scene, const Vec2i& pixel);

}  // namespace wend
