// Names of layers in files, and what else differs with them. In memory layers always have Wend's names.
#pragma once

#include <wend/film/picture.h>
#include <wend/io/picture_format.h>

#include <map>
#include <string>
#include <vector>

namespace wend {

/// The layer of an OpenEXR file that R, G and B are channels of; empty: of none.
std::string beauty_layer(LayerNames names);

/// What a layer is called in a file; empty where its channels have no layer's name.
std::string layer_in_file(const std::string& layer, const PictureFormat& format);

/// Metadata as a file has them: those of Cryptomatte say what their layer is called.
std::map<std::string, std::string> metadata_in_file(const Picture& picture, const PictureFormat& format);

/// The noise of a picture as pbrt has it, under its names: the variance of one sample, and the same over the mean.
/// Empty where the picture lacks the layers `variance` and `samples`.
std::vector<Layer> noise_of_pbrt(const Picture& picture);

/// How a file calls its layers, as far as its channels and metadata tell.
class FileLayerNames {
public:
    /// `beauty`: the layer of R, G and B. The texts are those of the header.
    FileLayerNames(const std::string& beauty, const std::vector<Layer>& layers,
                   const std::map<std::string, std::string>& metadata);

    /// Gives the layers Wend's names, and what they hold Wend's meaning. A layer that has none, or whose name another
    /// has, keeps its own. The metadata no longer say how the file called them.
    void translate(Picture& picture) const;

private:
    std::string layer_of(const std::string& name) const;

    LayerNames names_ = LayerNames::wend;
    std::string view_;  ///< Blender's view layer, with a dot
    bool is_of_wend_;
};

}  // namespace wend
