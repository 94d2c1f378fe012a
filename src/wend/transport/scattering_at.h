// What scatters where a path meets a surface.
#pragma once

#include <wend/light/scattering.h>
#include <wend/scene/scene.h>
#include <wend/transport/path_state.h>
#include <wend/transport/reflection_probability.h>
#include <wend/transport/vertex.h>

namespace wend {

/// The BSDF at a vertex that the path has just come to; boundaries reflect as often as it pays there.
inline SurfaceScattering scattering_at(const Scene& scene, const ReflectionProbability& reflections,
                                       const PathState& path, const Vertex& v) {
    SurfaceScattering f(scene, *v.hit, path.ray.direction);
    if (f.reflects_or_refracts()) {
        f.prefer_reflection(reflections.odds(v.side()), path.weight_to_bound());
    }
    return f;
}

}  // namespace wend
