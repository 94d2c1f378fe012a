#include <wend/core/contracts.h>
#include <wend/core/error.h>
#include <wend/core/parallel.h>
#include <wend/io/exr_file.h>
#include <wend/io/image_file.h>
#include <wend/io/image_size.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTestFile.h>
#include <OpenEXR/ImfThreading.h>
#include <fmt/format.h>
#include <half.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace wend {
namespace {

// More numbers than this in all channels together are refused, and in the lines that are unpacked at once.
constexpr std::int64_t max_values = std::int64_t{1} << 30;
constexpr std::int64_t max_values_at_once = std::int64_t{1} << 27;

int lines_at_once(Imf::Compression compression) {
    switch (compression) {
        case Imf::ZIP_COMPRESSION:
        case Imf::PXR24_COMPRESSION:
            return 16;
        case Imf::PIZ_COMPRESSION:
        case Imf::B44_COMPRESSION:
        case Imf::B44A_COMPRESSION:
        case Imf::DWAA_COMPRESSION:
            return 32;
        case Imf::DWAB_COMPRESSION:
            return 256;
        default:
            return 1;
    }
}

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

/// Whether an attribute holds what its type says: the library reads that, and goes on behind it whatever the size is.
bool is_of_its_size(std::string_view type, std::string_view value) {
    constexpr std::array<std::pair<std::string_view, std::size_t>, 24> sizes{{{"box2f", 16},
                                                                              {"box2i", 16},
                                                                              {"chromaticities", 32},
                                                                              {"compression", 1},
                                                                              {"deepImageState", 1},
                                                                              {"double", 8},
                                                                              {"envmap", 1},
                                                                              {"float", 4},
                                                                              {"int", 4},
                                                                              {"keycode", 28},
                                                                              {"lineOrder", 1},
                                                                              {"m33d", 72},
                                                                              {"m33f", 36},
                                                                              {"m44d", 128},
                                                                              {"m44f", 64},
                                                                              {"rational", 8},
                                                                              {"tiledesc", 9},
                                                                              {"timecode", 8},
                                                                              {"v2d", 16},
                                                                              {"v2f", 8},
                                                                              {"v2i", 8},
                                                                              {"v3d", 24},
                                                                              {"v3f", 12},
                                                                              {"v3i", 12}}};
    for (const auto& [known, size] : sizes) {
        if (type == known) {
            return value.size() == size;
        }
    }
    const auto number = [&value](std::size_t at) {
        std::uint32_t n = 0;
        std::memcpy(&n, value.data() + at, sizeof n);
        return std::uint64_t{n};
    };
    if (type == "preview") {
        return value.size() >= 8 && number(0) < (1u << 16) && number(4) < (1u << 16) &&
               value.size() == 8 + 4 * number(0) * number(4);
    }
    if (type == "stringvector") {
        while (value.size() >= sizeof(std::uint32_t) && number(0) <= value.size() - sizeof(std::uint32_t)) {
            value.remove_prefix(sizeof(std::uint32_t) + number(0));
        }
        return value.empty();
    }
    if (type == "chlist") {
        constexpr std::size_t channel = 16;
        while (!value.empty() && value.front() != 0) {
            const std::size_t name = value.find('\0');
            if (name == std::string_view::npos || value.size() - name - 1 < channel) {
                return false;
            }
            value.remove_prefix(name + 1 + channel);
        }
        return value.size() == 1;
    }
    return true;
}

/// The library takes memory for what an attribute says that it holds: this compares that with the file's size.
void check_attributes(const std::filesystem::path& file, const Place& place) {
    constexpr std::streamoff bytes_before_header = 8;
    constexpr std::size_t longest_name = 255;
    std::ifstream stream(file, std::ios::binary);
    std::uint32_t start[2] = {0, 0};  // the magic number and the version, with flags
    stream.read(reinterpret_cast<char*>(start), bytes_before_header);
    constexpr std::uint32_t magic = 20000630;
    if (stream && start[0] != magic) {
        throw InputError(place, "not an OpenEXR picture");
    }
    constexpr std::uint32_t many_parts = 0x1000;
    auto left = static_cast<std::int64_t>(std::filesystem::file_size(file)) - bytes_before_header;
    const auto take_name = [&] {
        std::string name;
        for (int c = stream.get(); c > 0 && name.size() <= longest_name; c = stream.get()) {
            name += static_cast<char>(c);
        }
        left -= static_cast<std::int64_t>(name.size()) + 1;
        if (name.size() > longest_name) {
            throw InputError(place, "the picture is damaged: an attribute's name does not end");
        }
        return name;
    };
    // Each of many parts has a header, and an empty one ends them.
    int attributes = 0;
    for (bool ends = false; !ends;) {
        if (take_name().empty()) {
            ends = (start[1] & many_parts) == 0 || attributes == 0;
            attributes = 0;
            continue;
        }
        ++attributes;
        const std::string type = take_name();
        std::int32_t size = 0;
        stream.read(reinterpret_cast<char*>(&size), sizeof size);
        left -= sizeof size;
        if (!stream || size < 0 || size > left) {
            throw InputError(place, "the picture is truncated");
        }
        std::string value(static_cast<std::size_t>(size), '\0');
        stream.read(value.data(), size);
        left -= size;
        if (!is_of_its_size(type, value)) {
            throw InputError(place, "the picture is damaged: an attribute is not of its size");
        }
    }
}

/// Looks at the header alone: opening the file for reading already takes memory in proportion to its declared size.
void check_size(Imf::IStream& stream, const Place& place) {
    constexpr int bytes_before_header = 8;
    char start[bytes_before_header];
    stream.read(start, bytes_before_header);
    int version = static_cast<unsigned char>(start[4]);
    Imf::Header header;
    header.readFrom(stream, version);
    stream.seekg(0);

    const Imath::Box2i& window = header.dataWindow();
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
    const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
    check_image_size(width, height, std::filesystem::file_size(place.file), place);
    std::int64_t channels = 0;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
        ++channels;
    }
    if (width * height * channels > max_values ||
        width * lines_at_once(header.compression()) * channels > max_values_at_once) {
        throw InputError(
            place, fmt::format("the picture is too large: {} x {} pixels of {} channels", width, height, channels));
    }
}

/// Opens the file and lets `body` read it; whatever the library throws becomes an InputError.
void with_file(const std::filesystem::path& file, const std::function<void(Imf::InputFile&)>& body) {
    const Place place{file.string()};
    try {
        check_attributes(file, place);
        Imf::StdIFStream stream(file.c_str());
        check_size(stream, place);
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
