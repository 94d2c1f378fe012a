// Camera, Film, PixelFilter, Sampler and Integrator: how a scene is looked at, rather than what it consists of.
#pragma once

#include <wend/core/colour_matrix.h>
#include <wend/film/film.h>
#include <wend/film/filter.h>
#include <wend/io/load/context.h>
#include <wend/sampling/sampler.h>
#include <wend/scene/camera.h>

#include <cstdint>
#include <optional>
#include <string>

namespace wend {

struct FilmSettings {
    Vec2i resolution{1280, 720};
    PixelRect crop;
    std::string file;
    float diagonal = 0.035f;  ///< of the film, in metres
    /// ISO over 100; the shutter time is the camera's.
    float sensitivity = 1;
    /// From colours of the scene to those of the picture.
    ColourMatrix balance;
    pbrt::ColourSpace colour_space = pbrt::ColourSpace::srgb;  ///< of the picture
};
/// With another resolution, crop windows given in pixels are scaled with it.
FilmSettings load_film(LoadContext& context, const pbrt::Entity& film, const std::optional<Vec2i>& resolution);

/// The screen window follows the shape of the picture, unless the file fixes it; the field of view is that of the
/// shorter side.
Camera load_camera(LoadContext& context, const pbrt::CameraEntity& camera, const pbrt::TransformTimes& times,
                   const FilmSettings& film);
/// How long the shutter is open, which scales the exposure.
float shutter_time(const pbrt::CameraEntity& camera);

Filter load_filter(LoadContext& context, const pbrt::Entity& filter);

struct SamplerSettings {
    SamplerKind kind = SamplerKind::sobol;
    int samples = 16;
    std::uint64_t seed = 0;
};
SamplerSettings load_sampler(LoadContext& context, const pbrt::Entity& sampler, const pbrt::ParameterSet& options);

struct IntegratorSettings {
    int max_depth = 5;
    bool light_tree = true;
    /// Not with pbrt's integrators of surfaces alone: they leave out all media.
    bool sees_media = true;
};
IntegratorSettings load_integrator(LoadContext& context, const pbrt::Entity& integrator);

}  // namespace wend
