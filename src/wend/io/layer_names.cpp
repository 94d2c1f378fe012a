#include <wend/io/layer_names.h>

#include <wend/core/error.h>
#include <wend/film/cryptomatte.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

namespace wend {
namespace {

struct Name {
    std::string_view of_wend, in_file;
};

constexpr std::array<std::pair<LayerNames, std::string_view>, 3> schemes{
    {{LayerNames::wend, "wend"}, {LayerNames::pbrt, "pbrt"}, {LayerNames::blender, "blender"}}};

// Wend's normals are those that shade.
constexpr std::array<Name, 4> pbrt_names{
    {{"albedo", "Albedo"}, {"normal", "Ns"}, {"face_normal", "N"}, {"position", "P"}}};

// Blender's normals for denoising are the camera's, and Wend's the world's.
constexpr std::array<Name, 8> blender_names{{{"alpha", "Combined"},
                                             {"albedo", "Denoising Albedo"},
                                             {"normal", "Normal"},
                                             {"depth", "Depth"},
                                             {"position", "Position"},
                                             {"emission", "Emission"},
                                             {"background", "Environment"},
                                             {"noisy", "Noisy Image"}}};
// Of light groups, with the group's name behind.
constexpr Name blender_group{"light_", "Combined_"};

constexpr const char* view_layer = "ViewLayer.";
constexpr const char* scheme_text = "wend:layer_names";
constexpr std::string_view variance_of_sample = "Variance", relative_variance = "RelativeVariance";

template <std::size_t n>
std::string_view translated(const std::array<Name, n>& names, std::string_view name, std::string_view Name::*from,
                            std::string_view Name::*to) {
    const auto found = std::find_if(names.begin(), names.end(), [&](const Name& each) { return each.*from == name; });
    return found == names.end() ? name : (*found).*to;
}

std::string in_blender(std::string_view name, std::string_view Name::*from, std::string_view Name::*to) {
    if (name.starts_with(blender_group.*from)) {
        return std::string(blender_group.*to).append(name.substr((blender_group.*from).size()));
    }
    return std::string(translated(blender_names, name, from, to));
}

const Layer* find(const std::vector<Layer>& layers, std::string_view name) {
    const auto found = std::find_if(layers.begin(), layers.end(), [&](const Layer& l) { return l.name == name; });
    return found == layers.end() ? nullptr : &*found;
}

double samples_in(const std::vector<Layer>& layers, std::size_t pixel) {
    const Layer* const samples = find(layers, "samples");
    return samples && samples->channels.size() == 1 ? static_cast<double>(samples->values[pixel]) : 0.0;
}

/// What noise_of_pbrt() made of the variance of means.
void take_back_noise(std::vector<Layer>& layers) {
    std::erase_if(layers, [](const Layer& l) { return l.name == relative_variance; });
    for (Layer& layer : layers) {
        if (layer.name != variance_of_sample || layer.channels.size() != 3) {
            continue;
        }
        layer.name = "variance";
        for (std::size_t k = 0; k < layer.values.size(); ++k) {
            const double n = samples_in(layers, k / 3);
            layer.values[k] = n > 0 ? static_cast<float>(static_cast<double>(layer.values[k]) / n) : 0.0f;
        }
    }
}

/// The metadata of Cryptomatte's layers of one name, under the key of another.
void rename_cryptomatte(std::map<std::string, std::string>& metadata, const std::string& from, const std::string& to) {
    const auto key_of = [](const std::string& name) {
        return "cryptomatte/" + hexadecimal(murmur_hash(name)).substr(0, 7) + '/';
    };
    const auto name = metadata.find(key_of(from) + "name");
    if (from == to || name == metadata.end()) {
        return;
    }
    name->second = to;
    for (const char* what : {"name", "hash", "conversion", "manifest"}) {
        if (auto text = metadata.extract(key_of(from) + what)) {
            text.key() = key_of(to) + what;
            metadata.insert(std::move(text));
        }
    }
}

}  // namespace

LayerNames parse_layer_names(const std::string& name) {
    for (const auto& [scheme, text] : schemes) {
        if (text == name) {
            return scheme;
        }
    }
    throw InputError("unknown names of layers '" + name + "': expected wend, pbrt or blender");
}

std::string to_string(LayerNames names) {
    return std::string(
        std::find_if(schemes.begin(), schemes.end(), [&](const auto& s) { return s.first == names; })->second);
}

std::string beauty_layer(LayerNames names) {
    return names == LayerNames::blender ? std::string(view_layer) + "Combined" : std::string();
}

std::string layer_in_file(const std::string& layer, const PictureFormat& format) {
    if (format.names == LayerNames::blender) {
        return view_layer + in_blender(layer, &Name::of_wend, &Name::in_file);
    }
    if (layer == "alpha" && format.alpha) {
        return {};
    }
    return format.names == LayerNames::pbrt ? std::string(translated(pbrt_names, layer, &Name::of_wend, &Name::in_file))
                                            : layer;
}

std::map<std::string, std::string> metadata_in_file(const Picture& picture, const PictureFormat& format) {
    std::map<std::string, std::string> metadata = picture.metadata;
    if (format.names != LayerNames::wend) {
        metadata[scheme_text] = to_string(format.names);
    }
    rename_cryptomatte(metadata, cryptomatte_name, layer_in_file(cryptomatte_name, format));
    return metadata;
}

std::vector<Layer> noise_of_pbrt(const Picture& picture) {
    const Layer* const variance = find(picture.layers, "variance");
    if (!variance || variance->channels.size() != 3 || !find(picture.layers, "samples")) {
        return {};
    }
    Layer of_sample{std::string(variance_of_sample), variance->channels, {}};
    Layer relative{std::string(relative_variance), variance->channels, {}};
    for (std::size_t k = 0; k < variance->values.size(); ++k) {
        const double mean = static_cast<double>(picture.image.pixels[k / 3][static_cast<int>(k % 3)]);
        const double v = static_cast<double>(variance->values[k]) * samples_in(picture.layers, k / 3);
        of_sample.values.push_back(static_cast<float>(v));
        relative.values.push_back(mean != 0 ? static_cast<float>(v / mean) : 0.0f);
    }
    return {std::move(of_sample), std::move(relative)};
}

FileLayerNames::FileLayerNames(const std::string& beauty, const std::vector<Layer>& layers,
                               const std::map<std::string, std::string>& metadata)
    : is_of_wend_(metadata.count("wend:version") > 0) {
    const auto said = metadata.find(scheme_text);
    if (!beauty.empty()) {
        names_ = LayerNames::blender;
        view_ = beauty.substr(0, beauty.rfind('.') + 1);
    } else if (said != metadata.end() ? said->second == to_string(LayerNames::pbrt)
                                      : !is_of_wend_ && find(layers, "Ns") && find(layers, "Albedo")) {
        names_ = LayerNames::pbrt;
    }
}

std::string FileLayerNames::layer_of(const std::string& name) const {
    switch (names_) {
        case LayerNames::pbrt:
            return name.empty() && is_of_wend_
                       ? "alpha"
                       : std::string(translated(pbrt_names, name, &Name::in_file, &Name::of_wend));
        case LayerNames::blender:
            return name.starts_with(view_) ? in_blender(name.substr(view_.size()), &Name::in_file, &Name::of_wend)
                                           : name;
        case LayerNames::wend:
            break;
    }
    return name.empty() && is_of_wend_ ? "alpha" : name;
}

void FileLayerNames::translate(Picture& picture) const {
    for (Layer& layer : picture.layers) {
        std::string name = layer_of(layer.name);
        const bool is_alpha = name == "alpha";
        if (!find(picture.layers, name) && (!is_alpha || layer.channels == std::vector<std::string>{"A"})) {
            layer.name = std::move(name);
        }
    }
    if (names_ == LayerNames::pbrt && is_of_wend_) {
        take_back_noise(picture.layers);
    }
    picture.metadata.erase(scheme_text);
    rename_cryptomatte(picture.metadata, view_ + cryptomatte_name, cryptomatte_name);
}

}  // namespace wend
