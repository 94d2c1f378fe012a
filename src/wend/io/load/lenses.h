// Files of lenses, and what is put into their stops.
#pragma once

#include <wend/io/load/context.h>
#include <wend/scene/camera.h>

namespace wend {

/// Camera "realistic": pbrt's lens files have lines of the radius of curvature, the thickness, the index of refraction
/// and the diameter of the opening in millimetres, from the scene to the film; a radius of 0 is an aperture stop. The
/// rest of a line after # is a comment. `film_size` is in metres.
RealisticCamera load_realistic(LoadContext& context, const pbrt::CameraEntity& camera, const Vec2& film_size);

}  // namespace wend
