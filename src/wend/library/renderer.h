// The renderer as a library, wend::render: scenes, renders that are stepped, and the films they leave. A program that
// links it needs none of what the renderer is built of.
//
// Whatever is wrong with what a caller gives is an InputError, with its place where it is in a file; what fails
// otherwise, such as writing to a full disk, is a std::runtime_error. Nothing is changed by a call that throws.
#pragma once

#include <wend/core/error.h>
#include <wend/core/export.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace wend {

class OwnedRender;
class ParsedScene;

namespace renderer {

/// What to take in place of what the scene says.
struct SceneOverrides {
    std::string resolution;        ///< of the picture, such as "640x360"; empty: the scene's
    std::string crop;              ///< the part to render, "x0,x1,y0,y1" as fractions; empty: the scene's
    std::optional<int> max_depth;  ///< largest number of scattering events of a walk; 0: no limit
    std::string sampler;           ///< "sobol" or "independent"; empty: the scene's
};

/// A scene that does not change any more. Copies are the same scene; any number of renders, in any threads, may be of
/// it.
class WEND_API Scene {
public:
    /// Of a pbrt-v4 file, or of Mitsuba 3 (`.xml`). Throws InputError for whatever is wrong in it, with file, line and
    /// column.
    static Scene load(const std::filesystem::path& file, const SceneOverrides& overrides = {});
    /// Of a text in that format, which refers to files in the folder; `name` is what messages call it.
    static Scene of_text(const std::string& text, const std::filesystem::path& folder, const std::string& name,
                         const SceneOverrides& overrides = {});

    /// Of the whole picture, in pixels.
    int width() const;
    /// Of the whole picture, in pixels.
    int height() const;
    /// That it asks for, per pixel.
    int samples() const;
    /// What the renderer lacks or ignores of the file, each kind once, as "file:line:column: warning: ...".
    const std::vector<std::string>& warnings() const;

private:
    friend class Render;
    explicit Scene(std::shared_ptr<const ParsedScene> scene) : scene_(std::move(scene)) {}

    std::shared_ptr<const ParsedScene> scene_;
};

/// How to render.
struct Settings {
    int samples = 0;          ///< per pixel; 0: the scene's or, with a noise, as many as it takes
    double seconds = 0;       ///< to spend, training included, in place of samples; 0: any
    double noise = 0;         ///< ends where no square of 16x16 pixels has more relative noise; 0: does not
    std::vector<int> passes;  ///< of an earlier render, which is repeated exactly; in place of samples and seconds
    /// "classical"; "full", whatever pays, where it pays; or decisions to guide everywhere, joined by '+': scatter,
    /// distance, direction, roulette, splitting.
    std::string sampling = "full";
    std::string subsurface = "auto";    ///< walks inside dense media: "auto", "classical" or the name of a technique
    std::optional<std::uint64_t> seed;  ///< none: the scene's
    int threads = 0;                    ///< 0: all; the picture does not depend on it
    /// More layers of the film: emission, background, direct, indirect, volume, lights, halves, geometry.
    std::vector<std::string> layers;
};

/// How far a render is.
struct Progress {
    double fraction = 0;        ///< done, 0 to 1
    double seconds = 0;         ///< so far
    double seconds_left = 0;    ///< at the pace of the last pass
    int samples = 0;            ///< per pixel, so far
    double relative_noise = 0;  ///< after the last pass; of the noisiest square where noise ends it
};

/// What a render leaves: linear colour and other layers of a crop window, rows from the top.
class WEND_API Film {
public:
    /// One of its pictures.
    struct Layer {
        std::vector<std::string> channels;  ///< such as R, G, B, or Z
        std::vector<float> values;          ///< values[(y * width + x) * channels.size() + channel]
    };

    int width = 0;   ///< of the crop window, in pixels
    int height = 0;  ///< of the crop window, in pixels
    /// By name; "" is the picture itself, R, G and B. "variance" is of its pixels' means.
    std::map<std::string, Layer> layers;
    /// Where it comes from: scene, settings, seed, samples, version.
    std::map<std::string, std::string> metadata;
    int offset_x = 0;     ///< of the crop window in the whole picture
    int offset_y = 0;     ///< of the crop window in the whole picture
    int full_width = 0;   ///< of the whole picture, in pixels
    int full_height = 0;  ///< of the whole picture, in pixels

    /// Writes it, by the extension: .exr with all layers and metadata, .png or .jpg. An older file of that name stays
    /// as it is where that fails.
    void save(const std::filesystem::path& file) const;
};

/// A render. The picture does not depend on how it is divided into steps, nor on whether it was saved and resumed in
/// between, as long as it is not time that ends it. Any thread may call it; all calls but set_stop() wait for a step
/// that is under way.
class WEND_API Render {
public:
    /// Seconds that never end.
    static constexpr double endless = std::numeric_limits<double>::infinity();

    /// Throws InputError for settings that there are not.
    explicit Render(const Scene& scene, const Settings& settings = {});
    /// Takes the other's place, which may only be assigned to or destroyed from then on.
    Render(Render&& other) noexcept;
    /// The same.
    Render& operator=(Render&& other) noexcept;
    ~Render();

    /// Goes on for about so many seconds, or to the end of a pass if that comes first. False where there is no more to
    /// do, or it was told to stop.
    bool step(double seconds = endless);
    /// Once true, a step that is under way and all later ones end at once, with all finished walks in the film. Once
    /// false again, the render goes on.
    void set_stop(bool stop);
    /// So far.
    Progress progress() const;
    /// Samples per pixel of each pass so far, for Settings::passes.
    std::vector<int> passes() const;
    /// So far.
    Film film() const;

    /// Writes all that is needed to go on. An older file of that name stays as it is where that fails.
    void save(const std::filesystem::path& file) const;
    /// Lets a render that has not begun go on where another was saved. Throws InputError, naming what is different, for
    /// one of another scene or other settings; how long to render, and the threads, may differ.
    void resume(const std::filesystem::path& file);

private:
    std::unique_ptr<OwnedRender> render_;
};

}  // namespace renderer
}  // namespace wend
