// Lights at infinity that the camera sees otherwise than what they light.
#pragma once

#include <wend/io/pbrt/description.h>
#include <wend/scene/scene.h>

namespace wend {

/// "cameraview" of a light at infinity. Throws InputError for others than "shown", "hidden" and "only".
enum class BackdropView {
    shown,
    hidden,  ///< not seen by rays that nothing has scattered
    only     ///< seen by these alone
};
BackdropView load_backdrop_view(const pbrt::LightEntity& light);

/// Adds the light as it is seen and as it shines.
void add_light(Light light, BackdropView view, SceneDescription& scene);

}  // namespace wend
