// Pictures of lights that are not as pbrt shows them between their pixels.
#pragma once

#include <wend/core/image.h>
#include <wend/io/pbrt/parameters.h>

namespace wend {

/// Of a light, whose picture is interpolated between its pixels, and goes on beyond the middles of the outermost ones
/// as it is there. Beyond pbrt, "filter" is "bilinear" or "point", and "wrap" is "clamp" or "repeat": a picture of few
/// pixels becomes a finer one that shows them so. Throws InputError for another.
Image refined(Image image, const pbrt::ParameterSet& parameters);

}  // namespace wend
