#pragma once

#include <wend/io/load/context.h>
#include <wend/scene/scene.h>

#include <string>
#include <vector>

namespace wend {

/// Warns of shapes that do not hold the homogeneous medium that is inside them: one warning a shape and kind, for the
/// first few. And of places where the scene does not say clearly in which medium they are. `places` are those of the
/// scene's surfaces; `names` of its media, empty for one that belongs to a material; `camera` is that of the camera.
void warn_of_boundaries(LoadContext& context, const SceneDescription& scene, const std::vector<Place>& places,
                        const std::vector<std::string>& names, const Place& camera);

}  // namespace wend
