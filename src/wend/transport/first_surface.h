// What a camera ray shows of the scene, whatever paths do there: for layers of the picture.
#pragma once

#include <wend/core/random.h>
#include <wend/core/vector.h>
#include <wend/film/cryptomatte.h>
#include <wend/film/film.h>
#include <wend/scene/scene.h>

#include <cstdint>
#include <vector>

namespace wend {

/// Numbers that stand for the objects of a scene: cryptomatte_id().
struct ObjectIds {
    std::vector<std::uint32_t> of_surfaces, of_media;

    bool is_empty() const { return of_surfaces.empty(); }
};

/// Which objects a ray shows: media on its straight way by what they take of it, the first surface by what is left.
struct SeenObjects {
    const ObjectIds& ids;
    std::vector<Coverage> parts{};
};

/// The ray's first surface, media left out: its distance, and the albedo and normal of what is seen there, through
/// smooth mirrors and glass where it is of these. How much of its light media take away or scatter on the straight way
/// there is told apart. What any surface covers, glass too, is opaque: alpha tells where nothing but sky is behind.
/// What is held out is as if it were sky. `objects` takes which these are, and may be null.
FilmFeatures first_surface(const Scene& scene, const Ray& camera_ray, Pcg32& random, SeenObjects* objects = nullptr);

}  // namespace wend
