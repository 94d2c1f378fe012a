#pragma once

#include <wend/core/image.h>
#include <wend/core/vector.h>
#include <wend/core/view_matrices.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace wend {

/// Named channels beside the beauty of a picture: "albedo" with channels R, G, B; "depth" with channel Z.
struct Layer {
    std::string name;
    std::vector<std::string> channels;
    std::vector<float> values;  ///< channel-interleaved: values[(y * width + x) * channels.size() + channel]
};

/// What a render leaves: the beauty, its layers, and where it comes from. `image` is the crop window, `offset` its
/// corner in the full picture of size `full_size`.
struct Picture {
    Image image;
    std::vector<Layer> layers;
    std::map<std::string, std::string> metadata;
    Vec2i offset{0, 0};
    Vec2i full_size{0, 0};
    std::optional<ViewMatrices> view = std::nullopt;  ///< where it is known, and straight lines stay straight
};

}  // namespace wend
