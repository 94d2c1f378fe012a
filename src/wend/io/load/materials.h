#pragma once

#include <wend/io/load/textures.h>
#include <wend/medium/medium.h>
#include <wend/scene/material.h>
#include <wend/scene/surface_detail.h>

#include <optional>
#include <vector>

namespace wend {

/// A material, and what fills the objects made of it where that is part of the material (subsurface).
struct LoadedMaterial {
    Material material;
    std::optional<HomogeneousMedium> inside{};
    SurfaceDetail detail{};
    /// How likely it is at a point that there is anything at all; -1: certain.
    TextureId presence = -1;
};

/// The materials of a scene file, in its order. Throws InputError for an unknown type or name and for values out of
/// range.
std::vector<LoadedMaterial> load_materials(LoadContext& context, TextureLoader& textures,
                                           const std::vector<pbrt::MaterialEntity>& materials);

}  // namespace wend
