// Places where a scene does not say clearly in which medium they are.
#pragma once

#include <wend/scene/scene.h>

#include <vector>

namespace wend {

/// What a scene leaves open about its media.
struct MediumFault {
    enum class Kind {
        camera,   ///< all that is around the camera says that it is in `medium`, and the scene says otherwise
        nested,   ///< the surface lies within `around`, which it does not name as its exterior
        overlap,  ///< the surface lies partly within `around`, another medium
    };
    Kind kind;
    MediumId medium = vacuum;  ///< within the surface
    MediumId around = vacuum;
    int surface = -1;  ///< index in SceneDescription::surfaces; none for the camera
};

/// The first few of them. Regions in object definitions are not looked at. Linear in the number of triangles for the
/// camera and for each pair of closed surfaces of different media whose boxes meet, of which there is a limit.
std::vector<MediumFault> medium_faults(const SceneDescription& scene);

}  // namespace wend
