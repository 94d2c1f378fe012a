// Media whose voxels are numbers in the scene file.
#pragma once

#include <wend/io/load/context.h>
#include <wend/medium/medium.h>

namespace wend {

/// "uniformgrid": densities that multiply one colour. Beyond the middles of the outermost voxels they fall to 0 half a
/// voxel outside of the box, as in pbrt, or with "string wrap" "clamp" stay as they are there, up to the box. Throws
/// InputError for what is wrong in it.
Medium load_uniform_grid(LoadContext& context, const pbrt::MediumEntity& entity);

/// "rgbgrid": a colour at each voxel, likewise.
Medium load_rgb_grid(LoadContext& context, const pbrt::MediumEntity& entity);

}  // namespace wend
