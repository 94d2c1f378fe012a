// From a pbrt-v4 file to a scene that can be rendered.
#pragma once

#include <wend/core/colour_matrix.h>
#include <wend/film/film.h>
#include <wend/film/filter.h>
#include <wend/io/pbrt/description.h>
#include <wend/sampling/sampler.h>
#include <wend/scene/scene.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace wend {

class LoadedParts;

/// What a scene file asks for.
struct LoadedScene {
    SceneDescription scene;
    Vec2i resolution{0, 0};
    PixelRect crop;
    float exposure = 1;    ///< multiplies the film's samples: shutter time times ISO / 100
    ColourMatrix balance;  ///< multiplies them as well: what makes the film's white and colours those of the picture
    pbrt::ColourSpace colour_space = pbrt::ColourSpace::srgb;  ///< of the picture
    Filter filter = Filter::box();
    SamplerKind sampler = SamplerKind::sobol;
    int samples = 16;  ///< per pixel
    int max_depth = 5;
    std::uint64_t seed = 0;
    std::string film_file;  ///< where the file wants the picture
    /// All that was read, in order of their names.
    std::vector<std::filesystem::path> files;
    /// Those of them that were not read again, since an earlier scene has what is in them.
    std::set<std::filesystem::path> kept_files;
    /// What Wend lacks or ignores, each kind once, and shapes that do not hold their medium, as `file:line:column:
    /// warning: ...`.
    std::vector<std::string> warnings;
};

/// What the command line says instead of the file.
struct LoadOverrides {
    /// Size of the picture. What the camera sees changes only with the shape of the picture: as in pbrt, the field of
    /// view is that of the shorter side.
    std::optional<Vec2i> resolution;
};

/// Reads a pbrt-v4 scene file and everything it refers to. Throws InputError, with the place, for whatever is wrong in
/// it; what is right but not implemented is replaced by the nearest there is, and named in a warning.
LoadedScene load_scene(const std::filesystem::path& file, const LoadOverrides& overrides = {});

/// The same for a file that has been parsed. What `parts` holds of an earlier scene, whose description is the same but
/// for parameters, is shared where the parameters are the same; afterwards it holds those of this scene.
LoadedScene load_scene(pbrt::Description description, const LoadOverrides& overrides = {},
                       LoadedParts* parts = nullptr);

}  // namespace wend
