// Where OpenEXR's library finds the numbers of pictures in memory.
#pragma once

#include <wend/core/colour.h>
#include <wend/film/picture.h>

#include <Imath/ImathBox.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfPixelType.h>

#include <cstddef>
#include <string>

namespace wend {

/// `first` is the upper left pixel of the window.
template <class Value>
Imf::Slice slice_of(Imf::PixelType type, const Value* first, const Imath::Box2i& window, std::size_t values_per_pixel) {
    const std::size_t pixel = values_per_pixel * sizeof(Value);
    const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
    // The library's one type of slice serves reading and writing, so it wants a mutable pointer.
    return Imf::Slice::Make(type, const_cast<Value*>(first), window, pixel, pixel * width);
}

inline Imf::Slice float_slice(const float* first, const Imath::Box2i& window, std::size_t values_per_pixel) {
    return slice_of(Imf::FLOAT, first, window, values_per_pixel);
}

/// The name of a channel: the layer's, if any, and its own.
inline std::string channel_name(const std::string& layer, const std::string& channel) {
    return layer.empty() ? channel : layer + '.' + channel;
}

/// The channels of a layer, under the layer's name.
inline void insert_layer(Imf::FrameBuffer& frame, const Layer& layer, const Imath::Box2i& window) {
    for (std::size_t c = 0; c < layer.channels.size(); ++c) {
        frame.insert(channel_name(layer.name, layer.channels[c]),
                     float_slice(layer.values.data() + c, window, layer.channels.size()));
    }
}

/// R, G and B of a layer.
inline void insert_colours(Imf::FrameBuffer& frame, const std::string& layer, const Rgb& first,
                           const Imath::Box2i& window) {
    frame.insert(channel_name(layer, "R"), float_slice(&first.r, window, 3));
    frame.insert(channel_name(layer, "G"), float_slice(&first.g, window, 3));
    frame.insert(channel_name(layer, "B"), float_slice(&first.b, window, 3));
}

}  // namespace wend
