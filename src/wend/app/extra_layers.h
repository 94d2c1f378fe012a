// Layers of pictures that are there only where they are asked for, by name.
#pragma once

#include <wend/film/film_layers.h>
#include <wend/render/render.h>
#include <wend/scene/scene.h>

#include <string>
#include <vector>

namespace wend {

/// The names that there are, for help and messages.
std::string extra_layer_names();

/// Throws InputError, naming those there are, for a name that there is not.
void check_extra_layers(const std::vector<std::string>& names);

/// What a film has to hold for them.
FilmLayers film_layers(const std::vector<std::string>& names, const Scene& scene);

/// What a render has to sort for that film. Throws like check_extra_layers().
void ask_for_layers(const std::vector<std::string>& names, const Scene& scene, RenderSettings& settings);

}  // namespace wend
