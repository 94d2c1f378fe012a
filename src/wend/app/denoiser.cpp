#include <wend/app/denoiser.h>
#include <wend/core/error.h>

#include <dlfcn.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

namespace wend {
namespace {

constexpr const char* file_name = "libOpenImageDenoise.so.2";

std::string where_to_look(const std::filesystem::path& given) {
    const char* const named = std::getenv("WEND_OIDN");
    const std::filesystem::path path = !given.empty() ? given : named ? std::filesystem::path(named) : file_name;
    std::error_code ignored;
    return std::filesystem::is_directory(path, ignored) ? (path / file_name).string() : path.string();
}

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

/// The functions of the library's interface for C, as its documentation has them.
struct Denoiser::Library {
    using Object = void*;
    static constexpr int cpu = 1, three_floats = 3;

    Object handle = nullptr;
    Object (*new_device)(int) = nullptr;
    void (*set_device_int)(Object, const char*, int) = nullptr;
    int (*get_device_int)(Object, const char*) = nullptr;
    void (*commit_device)(Object) = nullptr;
    void (*release_device)(Object) = nullptr;
    int (*get_error)(Object, const char**) = nullptr;
    Object (*new_filter)(Object, const char*) = nullptr;
    void (*set_image)(Object, const char*, void*, int, std::size_t, std::size_t, std::size_t, std::size_t,
                      std::size_t) = nullptr;
    void (*set_bool)(Object, const char*, bool) = nullptr;
    void (*commit_filter)(Object) = nullptr;
    void (*execute)(Object) = nullptr;
    void (*release_filter)(Object) = nullptr;
    Object device = nullptr;

    explicit Library(const std::string& file) : handle(dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) {
        if (!handle) {
            throw InputError("no Open Image Denoise: " + file +
                             " cannot be loaded; say where the library is (--oidn PATH, or WEND_OIDN)");
        }
        find(file, "oidnNewDevice", new_device);
        find(file, "oidnSetDeviceInt", set_device_int);
        find(file, "oidnGetDeviceInt", get_device_int);
        find(file, "oidnCommitDevice", commit_device);
        find(file, "oidnReleaseDevice", release_device);
        find(file, "oidnGetDeviceError", get_error);
        find(file, "oidnNewFilter", new_filter);
        find(file, "oidnSetSharedFilterImage", set_image);
        find(file, "oidnSetFilterBool", set_bool);
        find(file, "oidnCommitFilter", commit_filter);
        find(file, "oidnExecuteFilter", execute);
        find(file, "oidnReleaseFilter", release_filter);
    }
    // The library stays loaded: threads of its own may still be ending.
    ~Library() {
        if (device) {
            release_device(device);
        }
    }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;

    template <class Function>
    void find(const std::string& file, const char* name, Function& function) {
        function = reinterpret_cast<Function>(dlsym(handle, name));
        if (!function) {
            throw InputError(file + " is no Open Image Denoise of version 2: it lacks " + name);
        }
    }
    /// Throws where the last calls failed.
    void check() const {
        const char* message = nullptr;
        if (get_error(device, &message) != 0) {
            throw std::runtime_error(std::string("Open Image Denoise: ") + (message ? message : "an error"));
        }
    }
};

Denoiser::Denoiser(const std::filesystem::path& library, int threads)
    : library_(std::make_unique<Library>(where_to_look(library))) {
    library_->device = library_->new_device(Library::cpu);
    if (!library_->device) {
        throw std::runtime_error("Open Image Denoise does not run on this processor");
    }
    library_->set_device_int(library_->device, "numThreads", threads);
    library_->commit_device(library_->device);
    library_->check();
}

Denoiser::~Denoiser() = default;

std::string Denoiser::version() const {
    const auto part = [this](const char* name) {
        return std::to_string(library_->get_device_int(library_->device, name));
    };
    return part("versionMajor") + "." + part("versionMinor") + "." + part("versionPatch");
}

Image Denoiser::filter(const Picture& picture) const {
    const Library& l = *library_;
    const auto width = static_cast<std::size_t>(picture.image.width);
    const auto height = static_cast<std::size_t>(picture.image.height);
    Image colours = picture.image, result(picture.image.width, picture.image.height);
    const std::unique_ptr<void, void (*)(void*)> filter(l.new_filter(l.device, "RT"), l.release_filter);
    const auto set = [&](const char* name, void* values) {
        l.set_image(filter.get(), name, values, Library::three_floats, width, height, 0, 0, 0);
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
    l.check();
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
