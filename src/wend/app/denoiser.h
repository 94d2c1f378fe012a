// Open Image Denoise, loaded at run time from where it is: nothing needs it to be built.
#pragma once

#include <wend/film/picture.h>

#include <filesystem>
#include <memory>
#include <string>

namespace wend {

/// The layer of light from media, which Denoiser takes apart (--layers).
inline constexpr const char* layer_of_media = "volume";

class Denoiser {
public:
    /// Loads the library: of a file, or in a folder; if the path is empty, of what the environment's WEND_OIDN names,
    /// or of the system, or of the package pyoidn in the Python environment that is active (VIRTUAL_ENV, CONDA_PREFIX)
    /// or that the program lies in. `threads`: 0: all. Throws InputError, in one sentence, where it is not to be had.
    explicit Denoiser(const std::filesystem::path& library = {}, int threads = 0);
    ~Denoiser();
    Denoiser(const Denoiser&) = delete;
    Denoiser& operator=(const Denoiser&) = delete;

    /// The picture's colours without noise, by its layers `albedo`, `normal`, `scatter` and `volume` as far as there
    /// are any. What media hide is faded from the first two: these leave media out. With `volume`, the result is the
    /// mean of what comes of all light together, and of light from media and from surfaces apart; the first alone where
    /// a medium has a sharp edge. Throws std::runtime_error where the library fails.
    Image filter(const Picture& picture) const;
    /// "2.3.1", say.
    std::string version() const;

private:
    struct Device;
    std::unique_ptr<Device> device_;
};

/// The picture denoised; what it was is kept as the layer `noisy`, and `wend:denoised` in the metadata says by what.
Picture denoised(const Picture& picture, const Denoiser& denoiser);

}  // namespace wend
