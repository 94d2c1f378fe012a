// Materials that are mixed of others.
#pragma once

#include <wend/io/load/context.h>
#include <wend/io/load/materials.h>

#include <vector>

namespace wend {

/// Throws InputError where a mixture is made of itself; what fills a part of a mixture fills it all. A mixture with an
/// interface becomes the other part where it is present, with a warning; but within another mixture that everywhere.
void check_mixtures(LoadContext& context, TextureLoader& textures, std::vector<LoadedMaterial>& loaded,
                    const std::vector<pbrt::MaterialEntity>& materials);

}  // namespace wend
