// A render for those who call the renderer from a program: with its scene and its film, from any thread.
#pragma once

#include <wend/app/parsed_scene.h>
#include <wend/film/picture.h>
#include <wend/render/render.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace wend {

/// How to render. The scene says the rest.
struct RenderChoices {
    int samples = 0;  ///< per pixel; 0: the scene's, or, where a noise is given, as many as it takes
    double seconds = 0;
    double noise = 0;
    std::vector<int> passes;
    std::string sampling = "full";
    std::string subsurface = "auto";
    std::shared_ptr<const guide::Fields> fields;
    bool keeps_fields = false;
    std::optional<std::uint64_t> seed;
    int threads = 0;
    std::vector<std::string> layers;  ///< those of `wend render --layers`
};

/// All calls but set_stop() wait for a step that is under way.
class OwnedRender {
public:
    /// Throws InputError for choices that there are not.
    OwnedRender(std::shared_ptr<const ParsedScene> scene, const RenderChoices& choices);

    const std::shared_ptr<const ParsedScene>& scene() const { return scene_; }

    /// As those of Render.
    bool step(double seconds);
    bool is_within_pass() const;
    bool is_stopped() const;
    RenderProgress progress() const;
    RenderStatistics statistics() const;
    std::shared_ptr<const guide::Fields> fields() const;

    /// Whether steps end at once.
    void set_stop(bool stop) { stop_ = stop; }
    Picture picture() const;
    /// As save_checkpoint() and resume_from().
    void save(const std::filesystem::path& file) const;
    void resume(const std::filesystem::path& file);

private:
    std::shared_ptr<const ParsedScene> scene_;
    RenderSettings settings_;
    Film film_;
    std::atomic<bool> stop_{false};
    std::optional<Render> render_;
    mutable std::mutex mutex_;
};

}  // namespace wend
