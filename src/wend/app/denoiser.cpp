#include <wend/app/denoiser.h>
#include <wend/app/oidn_library.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

namespace wend {
namespace {

const Layer* find_layer(const Picture& picture, const std::string& name, std::size_t channels) {
    const auto found = std::find_if(picture.layers.begin(), picture.layers.end(), [&](const Layer& layer) {
        return layer.name == name && layer.channels.size() == channels;
    });
    return found == picture.layers.end() ? nullptr : &*found;
}

/// A layer of three channels as it shows behind media: what they hide is `hidden` instead.
std::vector<float> faded(const Layer& layer, const Layer* opacity, float hidden) {
    std::vector<float> values = layer.values;
    if (opacity) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            const float passed = 1 - std::clamp(opacity->values[i / 3], 0.0f, 1.0f);
            values[i] = values[i] * passed + hidden * (1 - passed);
        }
    }
    return values;
}

}  // namespace

struct Denoiser::Device {
    using Object = OidnLibrary::Object;

    OidnLibrary library;
    Object device;

    Device(const std::filesystem::path& given, int threads)
        : library(oidn_candidates(given)), device(library.new_device(OidnLibrary::cpu)) {
        if (!device) {
            throw std::runtime_error("Open Image Denoise does not run on this processor");
        }
        library.set_device_int(device, "numThreads", threads);
        library.commit_device(device);
        check();
    }
    ~Device() { library.release_device(device); }
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    /// Throws where the last calls failed.
    void check() const {
        const char* message = nullptr;
        if (library.get_error(device, &message) != 0) {
            throw std::runtime_error(std::string("Open Image Denoise: ") + (message ? message : "an error"));
        }
    }
};

Denoiser::Denoiser(const std::filesystem::path& library, int threads)
    : device_(std::make_unique<Device>(library, threads)) {
}

Denoiser::~Denoiser() = default;

std::string Denoiser::version() const {
    const auto part = [this](const char* name) {
        return std::to_string(device_->library.get_device_int(device_->device, name));
    };
    return part("versionMajor") + "." + part("versionMinor") + "." + part("versionPatch");
}

Image Denoiser::filter(const Picture& picture) const {
    const OidnLibrary& l = device_->library;
    const auto width = static_cast<std::size_t>(picture.image.width);
    const auto height = static_cast<std::size_t>(picture.image.height);
    Image colours = picture.image, result(picture.image.width, picture.image.height);
    const std::unique_ptr<void, void (*)(void*)> filter(l.new_filter(device_->device, "RT"), l.release_filter);
    const auto set = [&](const char* name, void* values) {
        l.set_image(filter.get(), name, values, OidnLibrary::three_floats, width, height, 0, 0, 0);
    };
    set("color", colours.pixels.data());
    set("output", result.pixels.data());
    std::vector<float> albedo, normal;
    const Layer* const opacity = find_layer(picture, "scatter", 1);
    if (const Layer* layer = find_layer(picture, "albedo", 3)) {
        constexpr float grey = 0.5f;
        albedo = faded(*layer, opacity, grey);
        set("albedo", albedo.data());
        // Normals alone are of no use to it.
        if (const Layer* normals = find_layer(picture, "normal", 3)) {
            normal = faded(*normals, opacity, 0);
            set("normal", normal.data());
        }
        l.set_bool(filter.get(), "cleanAux", true);
    }
    l.set_bool(filter.get(), "hdr", true);
    l.commit_filter(filter.get());
    l.execute(filter.get());
    device_->check();
    return result;
}

Picture denoised(const Picture& picture, const Denoiser& denoiser) {
    Picture result = picture;
    result.image = denoiser.filter(picture);
    Layer noisy{"noisy", {"R", "G", "B"}, {}};
    for (const Rgb& pixel : picture.image.pixels) {
        noisy.values.insert(noisy.values.end(), {pixel.r, pixel.g, pixel.b});
    }
    result.layers.push_back(std::move(noisy));
    result.metadata["wend:denoised"] = "Open Image Denoise " + denoiser.version();
    return result;
}

}  // namespace wend
