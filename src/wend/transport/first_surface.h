// What a camera ray shows of the scene, whatever paths do there: for layers of the picture.
#pragma once

#include <wend/core/random.h>
#include <wend/core/ray.h>
#include <wend/film/film.h>
#include <wend/scene/scene.h>

namespace wend {

/// The ray's first surface, media left out: its distance, and the albedo and normal of what is seen there, through
/// smooth mirrors and glass where it is of these. How much of its light media take away or scatter on the straight way
/// there is told apart. What any surface covers, glass too, is opaque: alpha tells where nothing but sky is behind.
FilmFeatures first_surface(const Scene& scene, const Ray& camera_ray, Pcg32& random);

}  // namespace wend
