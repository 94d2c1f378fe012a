#include <wend/io/load/media.h>

#include <wend/io/load/cloud.h>
#include <wend/io/load/colours.h>
#include <wend/io/load/grid_media.h>
#include <wend/io/load/loaded_parts.h>
#include <wend/io/load/media_parameters.h>
#include <wend/io/load/phase_functions.h>
#include <wend/io/negative_values.h>
#include <wend/io/volume_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <utility>

namespace wend {
namespace {

constexpr int cloud_cells = 128;

Medium load_homogeneous(LoadContext& context, const pbrt::MediumEntity& entity) {
    const pbrt::ParameterSet& p = entity.parameters;
    const float scale = non_negative_float(p, "scale", 1);
    HomogeneousMedium medium;
    const std::string preset = p.get_string("preset", "");
    const auto measured = medium_preset(preset);
    if (!preset.empty() && !measured) {
        context.warnings.add(p.place_of("preset"),
                             fmt::format("the medium \"{}\" is unknown; known are {}: \"sigma_a\" and \"sigma_s\" "
                                         "take its place, as in pbrt",
                                         preset, fmt::join(medium_preset_names(), ", ")));
    }
    if (measured) {
        medium.absorption = measured->sigma_a * scale;
        medium.scattering = measured->sigma_prime_s * scale;
    } else {
        const Coefficients coefficients = load_coefficients(context, p);
        medium.absorption = coefficients.absorption;
        medium.scattering = coefficients.scattering;
    }
    medium.emission = medium.absorption * load_emitted(context, p) * non_negative_float(p, emission_scale_name(p), 1);
    medium.phase = load_phase(context, p);
    return medium;
}

/// One of the grids of a volume file; null where the file has none of that name, and may lack it.
std::shared_ptr<const Volume> load_volume(LoadContext& context, const std::filesystem::path& file,
                                          const std::string& grid, bool may_lack) {
    return read_part(context, &LoadedParts::volumes, {file.lexically_normal().string(), grid}, file,
                     [&]() -> std::shared_ptr<const Volume> {
                         if (!may_lack) {
                             return std::make_shared<const Volume>(read_volume(file, grid));
                         }
                         std::optional<Volume> volume = try_read_volume(file, grid);
                         return volume ? std::make_shared<const Volume>(std::move(*volume)) : nullptr;
                     });
}

Medium load_volume_file(LoadContext& context, const pbrt::MediumEntity& entity) {
    const pbrt::ParameterSet& p = entity.parameters;
    const std::filesystem::path file = required_file(context, entity, "filename");
    const Transform medium_from_world = entity.world_from_medium.inverse();
    const auto density = load_volume(context, file, p.get_string("gridname", "density"), false);
    const bool shines_apart = p.has("glow");
    const std::string heat = p.get_string("temperaturename", shines_apart ? "" : "temperature");
    const auto temperature = heat.empty() ? nullptr : load_volume(context, file, heat, true);
    for (const Volume* volume : {density.get(), temperature.get()}) {
        if (volume && !volume->warning.empty()) {
            context.warnings.add(p.place_of("filename"), volume->warning);
        }
    }
    std::shared_ptr<GridEmission> emission = shines_apart ? load_glow(context, p) : nullptr;
    if (temperature) {
        auto field = std::make_shared<const Grid>(temperature->grid);
        const Transform index_from_world = temperature->world_from_index.inverse() * medium_from_world;
        if (!emission) {
            const float scale = non_negative_float(p, emission_scale_name(p), 1);
            emission = make_emission_sampler(p, std::move(field), index_from_world, scale);
        } else if (!emission->black_body.empty()) {
            set_temperature(p, std::move(field), index_from_world, *emission);
        }
    } else if (emission && !emission->black_body.empty()) {
        throw InputError(p.place_of("glow"),
                         fmt::format("colours by temperature need a grid of them, and there is no \"{}\"", heat));
    }
    const Vec3i first = density->grid.first();
    const Vec3i last = first + density->grid.size();
    Coefficients c = load_coefficients(context, p);
    if (shines_apart && is_black(c.absorption + c.scattering)) {
        // What is followed has to meet something.
        c.absorption = Rgb(1e-6f);
    }
    return GridMedium(std::make_shared<const Grid>(density->grid),
                      density->world_from_index.inverse() * medium_from_world, Box3(Vec3(first), Vec3(last)),
                      c.absorption, c.scattering, load_phase(context, p), std::move(emission));
}

Medium load_cloud(LoadContext& context, const pbrt::MediumEntity& entity) {
    const pbrt::ParameterSet& p = entity.parameters;
    const CloudShape shape{non_negative_float(p, "density", 1), non_negative_float(p, "wispiness", 1),
                           non_negative_float(p, "frequency", 5)};
    const Box3 box = load_box(p);
    const Vec3 size = box.size();
    const Transform index_from_medium =
        Transform::scale(cloud_cells / static_cast<double>(size.x), cloud_cells / static_cast<double>(size.y),
                         cloud_cells / static_cast<double>(size.z)) *
        Transform::translate(-box.min.x, -box.min.y, -box.min.z);
    const Rgb absorption = load_coefficient(context, p, "sigma_a");
    const Rgb scattering = load_coefficient(context, p, "sigma_s");
    return GridMedium(std::make_shared<const Grid>(bake_cloud(shape, box, cloud_cells)),
                      index_from_medium * entity.world_from_medium.inverse(), Box3(Vec3(0.0f), Vec3(cloud_cells)),
                      absorption, scattering, load_phase(context, p));
}

/// Throws InputError where products of the medium's numbers would leave the range of floats.
void require_countable(const pbrt::MediumEntity& entity, const Medium& medium) {
    constexpr double densest = 1e18;
    double most = 0;
    if (const auto* grid = std::get_if<GridMedium>(&medium)) {
        most = double{max_value(grid->extinction())} * grid->density().max_value();
    } else {
        most = max_value(std::get<HomogeneousMedium>(medium).extinction());
    }
    if (!(most <= densest)) {
        throw InputError(entity.place,
                         fmt::format("the medium \"{}\" has an extinction of {:g} per unit, but {:g} is the most",
                                     entity.name, most, densest));
    }
}

}  // namespace

Medium load_medium(LoadContext& context, const pbrt::MediumEntity& medium) {
    const auto load = [&]() -> Medium {
        if (medium.type == "homogeneous") {
            return load_homogeneous(context, medium);
        }
        if (medium.type == "uniformgrid") {
            return load_uniform_grid(context, medium);
        }
        if (medium.type == "rgbgrid") {
            return load_rgb_grid(context, medium);
        }
        if (medium.type == "nanovdb") {
            return load_volume_file(context, medium);
        }
        if (medium.type == "cloud") {
            return load_cloud(context, medium);
        }
        refuse_type("Medium", medium, {"cloud", "homogeneous", "nanovdb", "rgbgrid", "uniformgrid"});
    };
    Medium result = load();
    require_countable(medium, result);
    context.warnings.add_unused("Medium", medium);
    return result;
}

float load_mean_cosine(LoadContext& context, const pbrt::ParameterSet& parameters) {
    constexpr float sharpest = 0.99f;
    const float g = parameters.get_float("g", 0);
    if (!(std::abs(g) < 1)) {
        throw InputError(parameters.place_of("g"), fmt::format("\"g\" must lie between -1 and 1, not {}", g));
    }
    if (std::abs(g) > sharpest) {
        context.warnings.add(parameters.place_of("g"), fmt::format("\"g\" is limited to {} either way", sharpest));
    }
    return std::clamp(g, -sharpest, sharpest);
}

MediumPreset required_preset(const pbrt::ParameterSet& parameters, std::string_view name) {
    const std::string preset = parameters.get_string(name, "");
    const auto found = medium_preset(preset);
    if (!found) {
        throw InputError(parameters.place_of(name), fmt::format("the medium \"{}\" is unknown; known are {}", preset,
                                                                fmt::join(medium_preset_names(), ", ")));
    }
    return *found;
}

}  // namespace wend
