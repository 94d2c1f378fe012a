// What the metadata of a picture say of the render that it comes from, and whether several are estimates of one
// picture.
#pragma once

#include <wend/film/picture.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace wend {

/// Where a picture comes from.
struct RenderOrigin {
    std::string file;                   ///< of the picture
    std::string scene;                  ///< as it was named to the render
    std::optional<std::string> digest;  ///< of the scene's content, where it was kept
    std::vector<std::uint64_t> seeds;   ///< more than one if the picture was merged
    std::uint64_t samples = 0;          ///< per pixel
    std::optional<double> seconds;      ///< that it took, where they were kept
    std::string resolution, crop;       ///< of the picture, as text
    nlohmann::json settings;            ///< an object
};

/// Reads the metadata that `wend render` writes. Throws InputError naming the file where they are missing or damaged.
RenderOrigin render_origin(const std::string& file, const Picture& picture);

/// The origins of pictures that are independent estimates of the same picture.
class RenderOrigins {
public:
    /// Throws InputError, naming both files and both values, where the next one does not go with those before: another
    /// scene (by its digest where both have one, else by its file's name), resolution, crop or limit of depth, or a
    /// seed that one of those has. How paths are sampled may differ.
    void add(const RenderOrigin& next);

    /// Samples per pixel of all together.
    std::uint64_t samples() const { return samples_; }
    bool has_seed(std::uint64_t seed) const { return file_of_seed_.contains(seed); }
    std::size_t seeds() const { return seeds_.size(); }

    /// What the picture that is merged of them keeps: sums (of seconds where all say theirs), all seeds, and the first
    /// one's scene and settings. At least one was added.
    std::map<std::string, std::string> metadata() const;

private:
    void require_same_scene(const RenderOrigin& next) const;

    std::optional<RenderOrigin> first_, first_with_digest_;
    std::map<std::uint64_t, std::string> file_of_seed_;
    std::vector<std::uint64_t> seeds_;
    std::uint64_t samples_ = 0;
    std::optional<double> seconds_ = 0;  ///< none once there is one that does not say
};

}  // namespace wend
