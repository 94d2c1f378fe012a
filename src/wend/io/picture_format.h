// How pictures are written to files that leave a choice.
#pragma once

#include <string>

namespace wend {

/// How the channels of an OpenEXR file are called: by Wend, as pbrt's GBufferFilm does, or as Blender's multilayer
/// files are.
enum class LayerNames { wend, pbrt, blender };

/// Throws InputError, naming those there are, for another name.
LayerNames parse_layer_names(const std::string& name);
std::string to_string(LayerNames names);

/// Choices for OpenEXR; other formats have none.
struct PictureFormat {
    LayerNames names = LayerNames::wend;
    bool alpha = false;  ///< the layer `alpha` as channel A beside R, G and B; Blender's names always have it there
    bool half = false;   ///< colours and alpha as half floats, where they fit; what is no colour stays 32-bit float
};

}  // namespace wend
