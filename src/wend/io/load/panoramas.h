// The camera "panorama", which pbrt lacks.
#pragma once

#include <wend/io/pbrt/parameters.h>
#include <wend/scene/panorama.h>

#include <optional>

namespace wend {

/// `window` is the file's, where it has one; `aspect` the picture's width by its height.
///
/// Throws InputError where a parameter has no meaning.
Panorama load_panorama(const pbrt::ParameterSet& parameters, const std::optional<ScreenWindow>& window, float aspect);

}  // namespace wend
