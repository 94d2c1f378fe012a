// The names behind the numbers of Cryptomatte, as metadata of pictures.
#pragma once

#include <wend/film/picture.h>
#include <wend/scene/scene.h>
#include <wend/transport/first_surface.h>

#include <map>
#include <string>

namespace wend {

/// Adds the names of the objects that a picture shows to its metadata, if it has layers of them.
void add_manifest(const Scene& scene, const ObjectIds& ids, Picture& picture);

/// Adds what another picture's metadata say of its objects.
void add_manifest(const std::map<std::string, std::string>& other, std::map<std::string, std::string>& metadata);

}  // namespace wend
