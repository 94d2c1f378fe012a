#include <wend/core/contracts.h>
#include <wend/core/error.h>
#include <wend/core/parallel.h>
#include <wend/io/exr_check.h>
#include <wend/io/exr_file.h>
#include <wend/io/image_file.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfDoubleAttribute.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTestFile.h>
#include <OpenEXR/ImfThreading.h>
#include <half.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace wend {
namespace {

template <class Value>
Imf::Slice slice(Imf::PixelType type, const Value* first, const Imath::Box2i& window, std::size_t values_per_pixel) {
    const std::size_t pixel = values_per_pixel * sizeof(Value);
    const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
    // The library's one type of slice serves reading and writing, so it wants a mutable pointer.
    return Imf::Slice::Make(type, const_cast<Value*>(first), window, pixel, pixel * width);
}

Imf::Slice float_slice(const float* first, const Imath::Box2i& window, std::size_t values_per_pixel) {
    return slice(Imf::FLOAT, first, window, values_per_pixel);
}

void insert_colours(Imf::FrameBuffer& frame, const Rgb& first, const Imath::Box2i& window) {
    frame.insert("R", float_slice(&first.r, window, 3));
    frame.insert("G", float_slice(&first.g, window, 3));
    frame.insert("B", float_slice(&first.b, window, 3));
}

/// Opens the file and lets `body` read it; whatever the library throws becomes an InputError.
void with_file(const std::filesystem::path& file, const std::function<void(Imf::InputFile&)>& body) {
    const Place place{file.string()};
    try {
        check_exr_attributes(file, place);
        Imf::StdIFStream stream(file.c_str());
        check_exr_size(stream, place);
        Imf::InputFile input(stream);
        if (!input.isComplete()) {
            throw InputError(place, "the picture is truncated");
        }
        body(input);
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(place, std::string("not a readable OpenEXR picture: ") + error.what());
    }
}

bool is_beauty(std::string_view channel) {
    return channel == "R" || channel == "G" || channel == "B";
}

Image read_beauty(Imf::InputFile& input) {
    const Imath::Box2i& window = input.header().dataWindow();
    const Imf::ChannelList& channels = input.header().channels();
    const bool colour = channels.findChannel("R") && channels.findChannel("G") && channels.findChannel("B");
    if (!colour && !channels.findChannel("Y")) {
        throw std::runtime_error("it has neither the channels R, G, B nor Y");
    }
    if (!colour && channels.findChannel("RY")) {
        throw std::runtime_error("it is stored as luminance and chroma, which is not supported");
    }
    Image image(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1);
    Imf::FrameBuffer frame;
    if (colour) {
        insert_colours(frame, image.pixels[0], window);
    } else {
        frame.insert("Y", float_slice(&image.pixels[0].r, window, 3));
    }
    input.setFrameBuffer(frame);
    input.readPixels(window.min.y, window.max.y);
    if (!colour) {
        for (Rgb& pixel : image.pixels) {
            pixel = Rgb(pixel.r);
        }
    }
    return image;
}

/// The file keeps channels in alphabetical order; colours are wanted in theirs.
bool channel_before(const std::string& a, const std::string& b) {
    constexpr std::string_view colours = "RGBA";
    const auto rank = [&](const std::string& name) {
        return std::pair(name.size() == 1 ? std::min(colours.find(name[0]), colours.size()) : colours.size(), name);
    };
    return rank(a) < rank(b);
}

/// The names of all layers and their channels, without values. A lone grey channel is the beauty, too.
std::vector<Layer> layer_names(const Imf::ChannelList& channels) {
    const bool colour = channels.findChannel("R") != nullptr;
    std::vector<Layer> layers;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        const std::string name = channel.name();
        if (is_beauty(name) || (!colour && name == "Y")) {
            continue;
        }
        const std::size_t dot = name.rfind('.');
        const std::string layer = dot == std::string::npos ? "" : name.substr(0, dot);
        auto found = std::find_if(layers.begin(), layers.end(), [&](const Layer& l) { return l.name == layer; });
        if (found == layers.end()) {
            found = layers.insert(layers.end(), {layer, {}, {}});
        }
        found->channels.push_back(dot == std::string::npos ? name : name.substr(dot + 1));
    }
    for (Layer& layer : layers) {
        std::sort(layer.channels.begin(), layer.channels.end(), channel_before);
    }
    return layers;
}

std::string full_name(const Layer& layer, const std::string& channel) {
    return layer.name.empty() ? channel : layer.name + '.' + channel;
}

void insert_layer(Imf::FrameBuffer& frame, const Layer& layer, const Imath::Box2i& window) {
    for (std::size_t c = 0; c < layer.channels.size(); ++c) {
        frame.insert(full_name(layer, layer.channels[c]),
                     float_slice(layer.values.data() + c, window, layer.channels.size()));
    }
}

Imath::Box2i data_window(const Picture& picture) {
    return {picture.offset, picture.offset + Vec2i(picture.image.width, picture.image.height) - Vec2i(1)};
}

/// The library's own threads compress: a picture that is written while a render rests, or has been told to stop, must
/// not take long.
void start_threads() {
    static const bool are_started = [] {
        Imf::setGlobalThreadCount(hardware_threads());
        return true;
    }();
    static_cast<void>(are_started);
}

Imath::M44f to_matrix(const std::array<float, 16>& numbers) {
    Imath::M44f m;
    std::copy(numbers.begin(), numbers.end(), m.getValue());
    return m;
}

std::array<float, 16> from_matrix(const Imath::M44f& m) {
    std::array<float, 16> numbers;
    std::copy_n(m.getValue(), numbers.size(), numbers.begin());
    return numbers;
}

template <class Number>
std::optional<Number> number_of(const std::map<std::string, std::string>& metadata, const char* name) {
    const auto found = metadata.find(name);
    if (found == metadata.end()) {
        return std::nullopt;
    }
    Number number{};
    const char* const end = found->second.data() + found->second.size();
    const auto [read, error] = std::from_chars(found->second.data(), end, number);
    return error == std::errc() && read == end ? std::optional(number) : std::nullopt;
}

/// What others look for as numbers, from our texts: by pbrt's names, and the seed. The texts hold all digits; a number
/// that its type cannot hold is left out, as is the seed of a picture with several.
void insert_numbers(Imf::Header& header, const std::map<std::string, std::string>& metadata) {
    const auto insert = [&](const char* name, const Imf::Attribute& number) {
        if (metadata.count(name) == 0) {
            header.insert(name, number);
        }
    };
    const auto samples = number_of<std::uint64_t>(metadata, "wend:spp");
    if (samples && *samples <= static_cast<std::uint64_t>(std::numeric_limits<int>::max())) {
        insert("samplesPerPixel", Imf::IntAttribute(static_cast<int>(*samples)));
    }
    if (const auto seconds = number_of<double>(metadata, "wend:seconds")) {
        insert("renderTimeSeconds", Imf::FloatAttribute(static_cast<float>(*seconds)));
    }
    constexpr std::uint64_t most_exact = std::uint64_t{1} << std::numeric_limits<double>::digits;
    const auto seed = number_of<std::uint64_t>(metadata, "wend:seed");
    if (seed && *seed <= most_exact) {
        insert("seed", Imf::DoubleAttribute(static_cast<double>(*seed)));
    }
}

/// Writes the slices of a frame, each in its own type, with the picture's place and metadata.
void write_frame(const std::filesystem::path& file, const Picture& picture, const Imf::FrameBuffer& frame) {
    const Imath::Box2i window = data_window(picture);
    const Vec2i full_size = picture.full_size == Vec2i(0, 0) ? window.max + Vec2i(1) : picture.full_size;
    try {
        start_threads();
        Imf::Header header(Imath::Box2i(Vec2i(0, 0), full_size - Vec2i(1)), window);
        header.compression() = Imf::ZIP_COMPRESSION;
        // Noise hardly gets smaller by trying harder.
        header.zipCompressionLevel() = 2;
        for (const auto& [name, value] : picture.metadata) {
            header.insert(name, Imf::StringAttribute(value));
        }
        insert_numbers(header, picture.metadata);
        // Colours are those of Rec. 709, which is what the library takes for granted; others like to be told.
        Imf::addChromaticities(header, Imf::Chromaticities());
        if (picture.view) {
            Imf::addWorldToCamera(header, to_matrix(picture.view->camera_from_world));
            Imf::addWorldToNDC(header, to_matrix(picture.view->ndc_from_world));
        }
        for (auto slice = frame.begin(); slice != frame.end(); ++slice) {
            header.channels().insert(slice.name(), Imf::Channel(slice.slice().type));
        }
        Imf::OutputFile output(file.c_str(), header);
        output.setFrameBuffer(frame);
        output.writePixels(picture.image.height);
    } catch (const std::exception& error) {
        throw std::runtime_error(file.string() + ": cannot write: " + error.what());
    }
}

}  // namespace

bool is_exr(const std::filesystem::path& file) {
    return Imf::isOpenExrFile(file.c_str());
}

ImageWithOpacity read_exr_image(const std::filesystem::path& file) {
    ImageWithOpacity picture;
    with_file(file, [&](Imf::InputFile& input) {
        picture.image = read_beauty(input);
        if (input.header().channels().findChannel("A")) {
            Layer opacity{"", {"A"}, std::vector<float>(picture.image.pixels.size())};
            Imf::FrameBuffer frame;
            insert_layer(frame, opacity, input.header().dataWindow());
            input.setFrameBuffer(frame);
            input.readPixels(input.header().dataWindow().min.y, input.header().dataWindow().max.y);
            picture.opacity = std::move(opacity.values);
        }
    });
    return picture;
}

Picture read_exr(const std::filesystem::path& file) {
    Picture picture;
    with_file(file, [&](Imf::InputFile& input) {
        const Imf::Header& header = input.header();
        const Imath::Box2i &window = header.dataWindow(), &display = header.displayWindow();
        picture.image = read_beauty(input);
        picture.offset = window.min - display.min;
        picture.full_size = display.max - display.min + Vec2i(1);
        picture.layers = layer_names(header.channels());
        if (!picture.layers.empty()) {
            Imf::FrameBuffer frame;
            for (Layer& layer : picture.layers) {
                layer.values.resize(picture.image.pixels.size() * layer.channels.size());
                insert_layer(frame, layer, window);
            }
            input.setFrameBuffer(frame);
            input.readPixels(window.min.y, window.max.y);
        }
        if (Imf::hasWorldToCamera(header) && Imf::hasWorldToNDC(header)) {
            picture.view = {from_matrix(Imf::worldToCamera(header)), from_matrix(Imf::worldToNDC(header))};
        }
        for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
            if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute())) {
                picture.metadata[attribute.name()] = text->value();
            }
        }
    });
    return picture;
}

void write_exr(const std::filesystem::path& file, const Picture& picture) {
    const Imath::Box2i window = data_window(picture);
    Imf::FrameBuffer frame;
    insert_colours(frame, picture.image.pixels[0], window);
    for (const Layer& layer : picture.layers) {
        WEND_EXPECT(layer.values.size() == picture.image.pixels.size() * layer.channels.size());
        insert_layer(frame, layer, window);
    }
    write_frame(file, picture, frame);
}

void write_exr_colours(const std::filesystem::path& file, const Picture& picture) {
    const Imath::Box2i window = data_window(picture);
    const std::vector<Rgb>& pixels = picture.image.pixels;
    const bool fit = std::all_of(pixels.begin(), pixels.end(), [](const Rgb& p) {
        return std::max({std::abs(p.r), std::abs(p.g), std::abs(p.b)}) <= static_cast<float>(HALF_MAX);
    });
    Imf::FrameBuffer frame;
    std::vector<half> halves;
    if (fit) {
        halves.reserve(3 * pixels.size());
        for (const Rgb& p : pixels) {
            halves.insert(halves.end(), {half(p.r), half(p.g), half(p.b)});
        }
        frame.insert("R", slice(Imf::HALF, &halves[0], window, 3));
        frame.insert("G", slice(Imf::HALF, &halves[1], window, 3));
        frame.insert("B", slice(Imf::HALF, &halves[2], window, 3));
    } else {
        insert_colours(frame, pixels[0], window);
    }
    write_frame(file, picture, frame);
}

}  // namespace wend
