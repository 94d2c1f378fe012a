#include <wend/app/denoiser.h>

#include <wend/app/oidn_library.h>

#include <algorithm>
#include <cstddef>
#include <memory>
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

Image image_of(const Layer& layer, const Image& size) {
    Image image(size.width, size.height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        image.pixels[i] = {layer.values[3 * i], layer.values[3 * i + 1], layer.values[3 * i + 2]};
    }
    return image;
}

/// What the network gets beside the colours; empty where there is nothing.
struct Guides {
    Image albedo, normal;
};

/// What shows of surfaces behind media of an opacity: what they hide is grey, and looks nowhere.
Guides faded(Guides guides, const Layer& opacity) {
    const Rgb grey(0.5f);
    for (std::size_t i = 0; i < opacity.values.size(); ++i) {
        const float passed = 1 - std::clamp(opacity.values[i], 0.0f, 1.0f);
        if (!guides.albedo.pixels.empty()) {
            guides.albedo.pixels[i] = guides.albedo.pixels[i] * passed + grey * (1 - passed);
        }
        if (!guides.normal.pixels.empty()) {
            guides.normal.pixels[i] *= passed;
        }
    }
    return guides;
}

/// Media as though they were surfaces of that albedo which look nowhere.
Guides guides_of_media(const Layer& opacity, const Image& size) {
    Guides guides{size, Image(size.width, size.height)};
    for (std::size_t i = 0; i < opacity.values.size(); ++i) {
        guides.albedo.pixels[i] = Rgb(std::clamp(opacity.values[i], 0.0f, 1.0f));
    }
    return guides;
}

Guides guides_of_surfaces(const Picture& picture) {
    Guides guides;
    if (const Layer* albedo = find_layer(picture, "albedo", 3)) {
        guides.albedo = image_of(*albedo, picture.image);
        // Normals alone are of no use to the network.
        if (const Layer* normal = find_layer(picture, "normal", 3)) {
            guides.normal = image_of(*normal, picture.image);
        }
    }
    return guides;
}

/// Turns an image upside down, or its left side to the right, or both: bits 0 and 1 of `way`.
Image mirrored(const Image& image, int way) {
    Image result(image.width, image.height);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            result.at(x, y) =
                image.at((way & 1) != 0 ? image.width - 1 - x : x, (way & 2) != 0 ? image.height - 1 - y : y);
        }
    }
    return result;
}

/// How much, from 0 to 1, light of media may be taken apart in each pixel: not where a medium begins at once, since the
/// network blurs that edge in both parts, and each in its own way.
std::vector<float> trust_in_parts(const Layer& opacity, int width, int height) {
    constexpr int reach = 2;
    constexpr float lowest_jump = 0.8f, highest_jump = 1.0f;
    std::vector<float> trust;
    trust.reserve(opacity.values.size());
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            float least = 1, most = 0;
            for (int v = std::max(0, y - reach); v <= std::min(height - 1, y + reach); ++v) {
                for (int u = std::max(0, x - reach); u <= std::min(width - 1, x + reach); ++u) {
                    const float here = opacity.values[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                                                      static_cast<std::size_t>(u)];
                    least = std::min(least, here);
                    most = std::max(most, here);
                }
            }
            trust.push_back(std::clamp((highest_jump - (most - least)) / (highest_jump - lowest_jump), 0.0f, 1.0f));
        }
    }
    return trust;
}

/// Adds the second image, times a factor.
void add(Image& sum, const Image& image, float factor) {
    for (std::size_t i = 0; i < sum.pixels.size(); ++i) {
        sum.pixels[i] += image.pixels[i] * factor;
    }
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

    Image filter(const Image& colours, const Guides& guides) const;
    Image filter_all_ways(const Image& colours, const Guides& guides) const;
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

Image Denoiser::Device::filter(const Image& colours, const Guides& guides) const {
    const auto width = static_cast<std::size_t>(colours.width);
    const auto height = static_cast<std::size_t>(colours.height);
    Image result(colours.width, colours.height);
    const std::unique_ptr<void, void (*)(void*)> filter(library.new_filter(device, "RT"), library.release_filter);
    const auto set = [&](const char* name, const Image& image) {
        // The interface has one pointer for what it reads and what it writes.
        library.set_image(filter.get(), name, const_cast<Rgb*>(image.pixels.data()), OidnLibrary::three_floats, width,
                          height, 0, 0, 0);
    };
    set("color", colours);
    set("output", result);
    if (!guides.albedo.pixels.empty()) {
        set("albedo", guides.albedo);
        if (!guides.normal.pixels.empty()) {
            set("normal", guides.normal);
        }
        library.set_bool(filter.get(), "cleanAux", true);
    }
    library.set_bool(filter.get(), "hdr", true);
    library.commit_filter(filter.get());
    library.execute(filter.get());
    check();
    return result;
}

/// The network errs otherwise in an image that is mirrored, and a mean of four errs less.
Image Denoiser::Device::filter_all_ways(const Image& colours, const Guides& guides) const {
    constexpr int ways = 4;
    Image sum(colours.width, colours.height);
    for (int way = 0; way < ways; ++way) {
        const Image result =
            filter(mirrored(colours, way), {mirrored(guides.albedo, way), mirrored(guides.normal, way)});
        add(sum, mirrored(result, way), 1.0f / ways);
    }
    return sum;
}

Image Denoiser::filter(const Picture& picture) const {
    const Guides surfaces = guides_of_surfaces(picture);
    const Layer* const opacity = find_layer(picture, "scatter", 1);
    Image together = device_->filter_all_ways(picture.image, opacity ? faded(surfaces, *opacity) : surfaces);
    const Layer* const volume = find_layer(picture, layer_of_media, 3);
    const bool has_media =
        volume && std::any_of(volume->values.begin(), volume->values.end(), [](float v) { return v > 0; });
    if (!opacity || !has_media) {
        return together;
    }
    const Image of_media = image_of(*volume, picture.image);
    Image of_surfaces = picture.image;
    for (std::size_t i = 0; i < of_surfaces.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            of_surfaces.pixels[i][c] = std::max(0.0f, of_surfaces.pixels[i][c] - of_media.pixels[i][c]);
        }
    }
    Image apart = device_->filter_all_ways(of_surfaces, surfaces);
    add(apart, device_->filter_all_ways(of_media, guides_of_media(*opacity, picture.image)), 1);
    const std::vector<float> trust = trust_in_parts(*opacity, picture.image.width, picture.image.height);
    for (std::size_t i = 0; i < together.pixels.size(); ++i) {
        const float share = 0.5f * trust[i];
        together.pixels[i] = together.pixels[i] * (1 - share) + apart.pixels[i] * share;
    }
    return together;
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
