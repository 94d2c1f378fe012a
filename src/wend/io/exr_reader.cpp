#include <wend/core/error.h>
#include <wend/io/exr_check.h>
#include <wend/io/exr_file.h>
#include <wend/io/exr_slices.h>
#include <wend/io/layer_names.h>
#include <wend/io/spectrum/colour_space.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTestFile.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace wend {
namespace {

/// Opens the file and lets `body` read it; whatever the library throws becomes an InputError.
void with_file(const std::filesystem::path& file, const std::function<void(Imf::MultiPartInputFile&)>& body) {
    const Place place{file.string()};
    try {
        check_exr_attributes(file, place);
        Imf::StdIFStream stream(file.c_str());
        check_exr_size(stream, place);
        Imf::MultiPartInputFile input(stream);
        for (int part = 0; part < input.parts(); ++part) {
            if (!input.partComplete(part)) {
                throw InputError(place, "the picture is truncated");
            }
        }
        body(input);
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(place, std::string("not a readable OpenEXR picture: ") + error.what());
    }
}

/// Where a file has its colours.
struct Beauty {
    int part = 0;
    std::string layer{};  ///< of R, G and B; empty: of none
    std::string grey{};   ///< the channel that is all colours; empty: there are three
};

/// The layer that has all three colours: none, or the one that Blender calls so.
std::optional<std::string> layer_with_colours(const Imf::ChannelList& channels) {
    const auto has_all = [&](const std::string& layer) {
        return channels.findChannel(channel_name(layer, "R")) && channels.findChannel(channel_name(layer, "G")) &&
               channels.findChannel(channel_name(layer, "B"));
    };
    if (has_all({})) {
        return std::string();
    }
    constexpr std::string_view of_blender = ".Combined.R";
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        const std::string_view name = channel.name();
        if (name.ends_with(of_blender)) {
            std::string layer(name.substr(0, name.rfind('.')));
            if (has_all(layer)) {
                return layer;
            }
        }
    }
    return std::nullopt;
}

/// `as_texture`: a file's only channel is grey whatever its name, as to pbrt.
Beauty find_beauty(const Imf::MultiPartInputFile& input, bool as_texture) {
    for (int part = 0; part < input.parts(); ++part) {
        const Imf::ChannelList& channels = input.header(part).channels();
        if (auto layer = layer_with_colours(channels)) {
            return {part, *std::move(layer)};
        }
        if (channels.findChannel("Y")) {
            if (channels.findChannel("RY")) {
                throw std::runtime_error("it is stored as luminance and chroma, which is not supported");
            }
            return {part, {}, "Y"};
        }
    }
    const Imf::ChannelList& first = input.header(0).channels();
    if (as_texture && input.parts() == 1 && first.begin() != first.end() && ++first.begin() == first.end()) {
        return {0, {}, first.begin().name()};
    }
    throw std::runtime_error("it has neither the channels R, G, B nor Y, nor a layer 'Combined' of Blender");
}

void read_pixels(Imf::MultiPartInputFile& input, int part, const Imf::FrameBuffer& frame) {
    Imf::InputPart source(input, part);
    source.setFrameBuffer(frame);
    source.readPixels(source.header().dataWindow().min.y, source.header().dataWindow().max.y);
}

Image read_beauty(Imf::MultiPartInputFile& input, const Beauty& beauty) {
    const Imath::Box2i& window = input.header(beauty.part).dataWindow();
    Image image(window.max.x - window.min.x + 1, window.max.y - window.min.y + 1);
    Imf::FrameBuffer frame;
    if (!beauty.grey.empty()) {
        frame.insert(beauty.grey, float_slice(&image.pixels[0].r, window, 3));
    } else {
        insert_colours(frame, beauty.layer, image.pixels[0], window);
    }
    read_pixels(input, beauty.part, frame);
    if (!beauty.grey.empty()) {
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
        const auto upper = static_cast<char>(std::toupper(static_cast<unsigned char>(name.empty() ? ' ' : name[0])));
        return std::pair(name.size() == 1 ? std::min(colours.find(upper), colours.size()) : colours.size(), name);
    };
    return rank(a) < rank(b);
}

/// The channels of a layer, by their own names in their order: what the part calls them.
struct PartLayer {
    std::string name;
    std::vector<std::pair<std::string, std::string>> channels;
};

/// The layers of a part, without values. Channels that belong to no layer are the part's, where that is not the
/// beauty's.
std::vector<PartLayer> layers_of(const Imf::Header& header, const Beauty& beauty, bool is_of_beauty) {
    const std::string unnamed = is_of_beauty || !header.hasName() ? std::string() : header.name();
    std::vector<PartLayer> layers;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
        const std::string full = channel.name();
        const std::size_t dot = full.rfind('.');
        const std::string layer = dot == std::string::npos ? "" : full.substr(0, dot);
        const std::string own = dot == std::string::npos ? full : full.substr(dot + 1);
        const bool is_colour = !beauty.grey.empty() ? own == beauty.grey : own == "R" || own == "G" || own == "B";
        if (is_of_beauty && layer == beauty.layer && is_colour) {
            continue;
        }
        const std::string& name = layer.empty() ? unnamed : layer;
        auto found = std::find_if(layers.begin(), layers.end(), [&](const PartLayer& l) { return l.name == name; });
        if (found == layers.end()) {
            found = layers.insert(layers.end(), PartLayer{name, {}});
        }
        found->channels.emplace_back(own, full);
    }
    for (PartLayer& layer : layers) {
        std::sort(layer.channels.begin(), layer.channels.end(),
                  [](const auto& a, const auto& b) { return channel_before(a.first, b.first); });
    }
    return layers;
}

std::vector<Layer> read_layers(Imf::MultiPartInputFile& input, const Beauty& beauty) {
    const Imath::Box2i window = input.header(beauty.part).dataWindow();
    const auto pixels = static_cast<std::size_t>(window.max.x - window.min.x + 1) *
                        static_cast<std::size_t>(window.max.y - window.min.y + 1);
    std::vector<Layer> layers;
    for (int part = 0; part < input.parts(); ++part) {
        if (input.header(part).dataWindow() != window) {
            continue;
        }
        const std::vector<PartLayer> of_part = layers_of(input.header(part), beauty, part == beauty.part);
        if (of_part.empty()) {
            continue;
        }
        Imf::FrameBuffer frame;
        for (const PartLayer& each : of_part) {
            const std::size_t n = each.channels.size();
            Layer& layer = layers.emplace_back(Layer{each.name, {}, std::vector<float>(pixels * n)});
            for (std::size_t c = 0; c < n; ++c) {
                layer.channels.push_back(each.channels[c].first);
                frame.insert(each.channels[c].second, float_slice(layer.values.data() + c, window, n));
            }
        }
        read_pixels(input, part, frame);
    }
    return layers;
}

std::array<float, 16> from_matrix(const Imath::M44f& m) {
    std::array<float, 16> numbers;
    std::copy_n(m.getValue(), numbers.size(), numbers.begin());
    return numbers;
}

pbrt::ColourSpace colour_space_of(const Imf::Chromaticities& given) {
    using pbrt::ColourSpace;
    for (const auto space : {ColourSpace::dci_p3, ColourSpace::rec2020, ColourSpace::aces2065_1}) {
        const Primaries& p = primaries_of(space);
        const auto is_near = [](const Imath::V2f& a, const Primaries::Point& b) {
            constexpr double tolerance = 1e-3;
            return std::abs(double{a.x} - b.x) < tolerance && std::abs(double{a.y} - b.y) < tolerance;
        };
        if (is_near(given.red, p.red) && is_near(given.green, p.green) && is_near(given.blue, p.blue) &&
            is_near(given.white, p.white)) {
            return space;
        }
    }
    return ColourSpace::srgb;
}

/// All but what the file itself is made of.
std::map<std::string, std::string> texts_of(const Imf::Header& header) {
    std::map<std::string, std::string> texts;
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
        const std::string_view name = attribute.name();
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
        if (text && name != "type" && name != "name") {
            texts[attribute.name()] = text->value();
        }
    }
    return texts;
}

}  // namespace

bool is_exr(const std::filesystem::path& file) {
    return Imf::isOpenExrFile(file.c_str());
}

ImageWithOpacity read_exr_image(const std::filesystem::path& file) {
    ImageWithOpacity picture;
    with_file(file, [&](Imf::MultiPartInputFile& input) {
        const Beauty beauty = find_beauty(input, true);
        picture.image = read_beauty(input, beauty);
        const Imf::Header& header = input.header(beauty.part);
        if (const std::string opacity = channel_name(beauty.layer, "A"); header.channels().findChannel(opacity)) {
            picture.opacity.resize(picture.image.pixels.size());
            Imf::FrameBuffer frame;
            frame.insert(opacity, float_slice(picture.opacity.data(), header.dataWindow(), 1));
            read_pixels(input, beauty.part, frame);
        }
    });
    return picture;
}

pbrt::ColourSpace exr_colour_space(const std::filesystem::path& file) {
    pbrt::ColourSpace space = pbrt::ColourSpace::srgb;
    with_file(file, [&](Imf::MultiPartInputFile& input) {
        const Imf::Header& header = input.header(find_beauty(input, true).part);
        if (Imf::hasChromaticities(header)) {
            space = colour_space_of(Imf::chromaticities(header));
        }
    });
    return space;
}

Picture read_exr(const std::filesystem::path& file) {
    Picture picture;
    with_file(file, [&](Imf::MultiPartInputFile& input) {
        const Beauty beauty = find_beauty(input, false);
        const Imf::Header& header = input.header(beauty.part);
        const Imath::Box2i &window = header.dataWindow(), &display = header.displayWindow();
        picture.image = read_beauty(input, beauty);
        picture.offset = window.min - display.min;
        picture.full_size = display.max - display.min + Vec2i(1);
        picture.layers = read_layers(input, beauty);
        if (Imf::hasWorldToCamera(header) && Imf::hasWorldToNDC(header)) {
            picture.view = {from_matrix(Imf::worldToCamera(header)), from_matrix(Imf::worldToNDC(header))};
        }
        picture.metadata = texts_of(header);
        FileLayerNames(beauty.layer, picture.layers, picture.metadata).translate(picture);
    });
    return picture;
}

}  // namespace wend
