#include <wend/core/contracts.h>
#include <wend/core/parallel.h>
#include <wend/io/exr_file.h>
#include <wend/io/exr_slices.h>
#include <wend/io/layer_names.h>
#include <wend/io/spectrum/colour_space.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfThreading.h>
#include <half.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <forward_list>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace wend {
namespace {

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
    const auto insert_integer = [&](const char* name, const char* text) {
        if (const auto number = number_of<int>(metadata, text)) {
            insert(name, Imf::IntAttribute(*number));
        }
    };
    insert_integer("samplesPerPixel", "wend:spp");
    if (const auto seconds = number_of<double>(metadata, "wend:seconds")) {
        insert("renderTimeSeconds", Imf::FloatAttribute(static_cast<float>(*seconds)));
    }
    insert_integer("seed", "wend:seed");
}

/// Of what its metadata say that its colours are in, and else of Rec. 709, which others take for granted, but like to
/// be told.
Imf::Chromaticities chromaticities_of(const Picture& picture) {
    const auto said = picture.metadata.find(std::string(colour_space_text));
    const auto space = said == picture.metadata.end() ? std::nullopt : pbrt::colour_space_named(said->second);
    const Primaries& p = primaries_of(space.value_or(pbrt::ColourSpace::srgb));
    const auto point = [](const Primaries::Point& q) {
        return Imath::V2f(static_cast<float>(q.x), static_cast<float>(q.y));
    };
    return {point(p.red), point(p.green), point(p.blue), point(p.white)};
}

/// Writes the slices of a frame, each in its own type, with the picture's place and metadata.
void write_frame(const std::filesystem::path& file, const Picture& picture, const PictureFormat& format,
                 const Imf::FrameBuffer& frame) {
    const Imath::Box2i window = data_window(picture);
    const Vec2i full_size = picture.full_size == Vec2i(0, 0) ? window.max + Vec2i(1) : picture.full_size;
    try {
        start_threads();
        Imf::Header header(Imath::Box2i(Vec2i(0, 0), full_size - Vec2i(1)), window);
        header.compression() = Imf::ZIP_COMPRESSION;
        // Noise hardly gets smaller by trying harder.
        header.zipCompressionLevel() = 2;
        for (const auto& [name, value] : metadata_in_file(picture, format)) {
            header.insert(name, Imf::StringAttribute(value));
        }
        insert_numbers(header, picture.metadata);
        Imf::addChromaticities(header, chromaticities_of(picture));
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

/// What is written, as half floats where these are wanted and fit.
class Slices {
public:
    explicit Slices(const Imath::Box2i& window) : window_(window) {}

    void add(const std::string& layer, const std::vector<std::string>& channels, const float* values, bool as_halves) {
        const std::size_t n = channels.size();
        const half* const halves = as_halves ? halves_of(values, n) : nullptr;
        for (std::size_t c = 0; c < n; ++c) {
            frame_.insert(channel_name(layer, channels[c]),
                          halves ? slice_of(Imf::HALF, halves + c, window_, n) : float_slice(values + c, window_, n));
        }
    }
    const Imf::FrameBuffer& frame() const { return frame_; }

private:
    /// Null where one of them is too large; what is no finite number stays what it is.
    const half* halves_of(const float* values, std::size_t channels) {
        const Imath::V2i size = window_.size() + Imath::V2i(1);
        const float* const end =
            values + channels * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
        const auto is_too_large = [](float v) {
            return std::isfinite(v) && std::abs(v) > static_cast<float>(HALF_MAX);
        };
        if (std::any_of(values, end, is_too_large)) {
            return nullptr;
        }
        std::vector<half>& kept = halves_.emplace_front(values, end);
        return kept.data();
    }

    Imath::Box2i window_;
    Imf::FrameBuffer frame_;
    std::forward_list<std::vector<half>> halves_;
};

const std::vector<std::string> colour_channels = {"R", "G", "B"};

void add_beauty(Slices& slices, const Picture& picture, LayerNames names, bool as_halves) {
    slices.add(beauty_layer(names), colour_channels, &picture.image.pixels[0].r, as_halves);
}

bool is_colour(const Layer& layer) {
    return layer.name == "alpha" || (layer.channels == colour_channels && layer.name != "variance");
}

}  // namespace

void write_exr(const std::filesystem::path& file, const Picture& picture, const PictureFormat& format) {
    Slices slices(data_window(picture));
    add_beauty(slices, picture, format.names, format.half);
    const std::vector<Layer> noise = format.names == LayerNames::pbrt ? noise_of_pbrt(picture) : std::vector<Layer>();
    for (const Layer& layer : noise) {
        slices.add(layer.name, layer.channels, layer.values.data(), false);
    }
    for (const Layer& layer : picture.layers) {
        WEND_EXPECT(layer.values.size() == picture.image.pixels.size() * layer.channels.size());
        if (noise.empty() || layer.name != "variance") {
            slices.add(layer_in_file(layer.name, format), layer.channels, layer.values.data(),
                       format.half && is_colour(layer));
        }
    }
    write_frame(file, picture, format, slices.frame());
}

void write_exr_colours(const std::filesystem::path& file, const Picture& picture) {
    Slices slices(data_window(picture));
    add_beauty(slices, picture, LayerNames::wend, true);
    write_frame(file, picture, {}, slices.frame());
}

}  // namespace wend
