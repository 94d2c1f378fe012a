// Materials that are mixed of others.
#pragma once

#include <wend/io/load/context.h>
#include <wend/io/load/materials.h>

#include <vector>

namespace wend {

/// Throws InputError where a mixture is made of itself; what fills a part of a mixture fills it all. An interface in a
/// mixture gives its place to the other part, with a warning.
void check_mixtures(LoadContext& context, std::vector<LoadedMaterial>& loaded,
                    const std::vector<pbrt::MaterialEntity>& materials);

}  // namespace wend
