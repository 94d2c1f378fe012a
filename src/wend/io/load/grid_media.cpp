#include <wend/io/load/grid_media.h>

#include <wend/io/load/colours.h>
#include <wend/io/load/media_parameters.h>
#include <wend/io/load/phase_functions.h>
#include <wend/io/negative_values.h>

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <utility>

namespace wend {
namespace {

/// Index space of a grid of cells that fill the box: sample i is in the middle of cell i.
Transform index_from_box(const Box3& box, const Vec3i& cells) {
    const Vec3 size = box.size();
    return Transform::translate(-0.5, -0.5, -0.5) *
           Transform::scale(cells.x / static_cast<double>(size.x), cells.y / static_cast<double>(size.y),
                            cells.z / static_cast<double>(size.z)) *
           Transform::translate(-box.min.x, -box.min.y, -box.min.z);
}
Box3 all_cells(const Vec3i& cells) {
    return {Vec3(-0.5f),
            Vec3(static_cast<float>(cells.x), static_cast<float>(cells.y), static_cast<float>(cells.z)) - Vec3(0.5f)};
}

/// "nx", "ny", "nz", whose product must be `count`.
Vec3i load_size(const pbrt::ParameterSet& p, std::size_t count, std::string_view name) {
    const Vec3i size(p.get_int("nx", 1), p.get_int("ny", 1), p.get_int("nz", 1));
    // In double precision, which overflows nowhere and is exact as far as numbers fit into memory.
    const double voxels = static_cast<double>(size.x) * size.y * size.z;
    if (size.x < 1 || size.y < 1 || size.z < 1 || voxels != static_cast<double>(count)) {
        throw InputError(p.place_of(name), fmt::format("\"{}\" has {} values where nx * ny * nz = {} * {} * {}", name,
                                                       count, size.x, size.y, size.z));
    }
    return size;
}

/// "wrap": whether a grid goes on as it is at its faces.
bool is_clamped(const pbrt::ParameterSet& p) {
    const std::string wrap = p.get_string("wrap", "black");
    if (wrap != "black" && wrap != "clamp") {
        throw InputError(p.place_of("wrap"),
                         fmt::format("the wrap mode \"{}\" is unknown; known are black, clamp", wrap));
    }
    return wrap == "clamp";
}

/// The place in the file of the voxel that is at (x, y, z), or nearest to it.
std::size_t nearest_voxel(const Vec3i& size, int x, int y, int z) {
    const auto within = [](int i, int n) { return static_cast<std::size_t>(std::clamp(i, 0, n - 1)); };
    return (within(z, size.z) * static_cast<std::size_t>(size.y) + within(y, size.y)) *
               static_cast<std::size_t>(size.x) +
           within(x, size.x);
}

/// Values in the order of the file, x fastest; with a ring around them where they go on.
std::shared_ptr<const Grid> make_grid(LoadContext& context, const std::vector<float>& values, const Vec3i& size,
                                      const Place& place, std::string_view name, bool clamped = false) {
    NegativeValues negative;
    const auto at = [&](int x, int y, int z) {
        return negative.raise(values[nearest_voxel(size, x, y, z)], {x, y, z});
    };
    const Vec3i ring(clamped ? 1 : 0);
    const VoxelBox all{-ring, size - Vec3i(1) + ring};
    try {
        auto grid = std::make_shared<const Grid>(-ring, size + ring * 2, std::span(&all, 1), at);
        if (const std::string warning = negative.warning(grid->max_value()); !warning.empty()) {
            context.warnings.add(place, fmt::format("\"{}\": {}", name, warning));
        }
        return grid;
    } catch (const InputError& error) {
        throw InputError(place, fmt::format("\"{}\": {}", name, error.what()));
    }
}

/// Without "Lescale" pbrt looks up a grid of a single 1, in the middle of the box: half of that is left at its faces.
void set_default_strength(GridEmission& emission, const Vec3i& size, const Transform& index_from_world) {
    const VoxelBox middle{Vec3i(0), Vec3i(0)};
    emission.strength =
        std::make_shared<const Grid>(Vec3i(0), Vec3i(1), std::span(&middle, 1), [](int, int, int) { return 1.0f; });
    // The box is from -1/2 to 1/2 then.
    emission.strength_from_world =
        AffineMap(Transform::scale(1.0 / size.x, 1.0 / size.y, 1.0 / size.z) *
                  Transform::translate(0.5 * (1 - size.x), 0.5 * (1 - size.y), 0.5 * (1 - size.z)) * index_from_world);
}

/// What a "uniformgrid" emits: by a grid of temperatures, or "Le" times a number or a grid of numbers.
std::shared_ptr<GridEmission> load_grid_emission(LoadContext& context, const pbrt::ParameterSet& p, const Vec3i& size,
                                                 const Transform& index_from_world) {
    const auto grid_of = [&](const std::vector<float>& values, std::string_view name) {
        load_size(p, values.size(), name);
        return make_grid(context, values, size, p.place_of(name), name);
    };
    const std::string_view scales_name = emission_scale_name(p);
    const std::vector<float> scales = p.get_floats(scales_name);
    // One number in place of one a voxel, which pbrt refuses, is the same everywhere.
    const bool is_uniform = scales.empty() || (scales.size() == 1 && size != Vec3i(1));
    const float scale = is_uniform && !scales.empty() ? non_negative_float(p, scales_name, 1) : 1.0f;
    const std::vector<float> temperature = p.get_floats("temperature");
    const Rgb emitted = load_emitted(context, p);
    if (!temperature.empty()) {
        if (p.has("Le")) {
            throw InputError(p.place_of("Le"), "a medium takes either \"Le\" or \"temperature\"");
        }
        auto emission = make_emission_sampler(p, grid_of(temperature, "temperature"), index_from_world, scale);
        if (!is_uniform) {
            emission->strength = grid_of(scales, scales_name);
            emission->strength_from_world = AffineMap(index_from_world);
        } else if (scales.empty()) {
            set_default_strength(*emission, size, index_from_world);
        }
        return emission;
    }
    if (is_black(emitted)) {
        return nullptr;
    }
    if (scales.empty()) {
        context.warnings.add(p.place_of("Le"),
                             "\"Le\" is the same everywhere: without \"Lescale\", pbrt lets it fall from the middle of "
                             "the box to a half at its faces, and to 0.42 on average");
    }
    auto emission = std::make_shared<GridEmission>();
    emission->radiance = emitted * scale;
    if (!is_uniform) {
        emission->field = grid_of(scales, scales_name);
        emission->field_from_world = AffineMap(index_from_world);
    }
    return emission;
}

/// The colours of a grid's voxels; none where the parameter is not given.
std::vector<Rgb> load_colours(LoadContext& context, const pbrt::ParameterSet& p, std::string_view name) {
    std::vector<Rgb> values;
    for (const pbrt::RgbColour& colour : p.get_rgbs(name)) {
        values.push_back(reduce_colour(context, colour, SpectrumKind::unbounded, p.place_of(name)));
        if (const Rgb& value = values.back(); !is_finite(value) || !(min_value(value) >= 0)) {
            throw InputError(p.place_of(name),
                             fmt::format("\"{}\": voxel {} holds ({}, {}, {}): values must be finite and not negative",
                                         name, values.size() - 1, value.r, value.g, value.b));
        }
    }
    return values;
}

/// A grid of the voxels of a "rgbgrid" and of a ring around them, which is `outside`: there coefficients that are the
/// same everywhere go on. None: there all go on.
Grid make_ringed_grid(const Place& place, const Vec3i& size, std::optional<float> outside,
                      const std::function<float(std::size_t)>& value) {
    const VoxelBox all{Vec3i(-1), size};
    const auto at = [&](int x, int y, int z) {
        const bool is_outside = x < 0 || y < 0 || z < 0 || x >= size.x || y >= size.y || z >= size.z;
        return is_outside && outside ? *outside : value(nearest_voxel(size, x, y, z));
    };
    try {
        return {Vec3i(-1), size + Vec3i(2), std::span(&all, 1), at};
    } catch (const InputError& error) {
        throw InputError(place, fmt::format("\"rgbgrid\": {}", error.what()));
    }
}

/// One of the parameters of a "rgbgrid": colours of voxels, times a scale, or the scale everywhere where there are
/// none.
struct VoxelColours {
    std::vector<Rgb> values;
    float scale = 1;
    bool clamped = false;

    /// Beyond the voxels; none: as in them.
    std::optional<float> outside() const {
        return clamped ? std::nullopt : std::optional(values.empty() ? scale : 0.0f);
    }
    Rgb at(std::size_t voxel) const { return values.empty() ? Rgb(scale) : values[voxel] * scale; }
    Rgb mean(std::size_t voxels) const {
        Rgb sum;
        for (std::size_t i = 0; i < voxels; ++i) {
            sum += at(i) / static_cast<float>(voxels);
        }
        return sum;
    }
    ColourGrid grid(const Place& place, const Vec3i& size) const {
        const auto channel = [&](int c) {
            return make_ringed_grid(place, size, outside(), [&](std::size_t voxel) { return at(voxel)[c]; });
        };
        return ColourGrid({channel(0), channel(1), channel(2)});
    }
};

/// Throws InputError where tracking through the medium would not end: it makes a step for each mean free path of the
/// densest channel, also where another one sees nothing.
void require_trackable(const pbrt::MediumEntity& entity, const Grid& bound, const Transform& world_from_index,
                       const Box3& box) {
    constexpr double thickest = 1e5;
    const Vec3 size = box.size();
    double diagonal = 0;
    for (const Vec3& side : {Vec3(size.x, 0, 0), Vec3(0, size.y, 0), Vec3(0, 0, size.z)}) {
        diagonal += double{length(world_from_index.vector(side))};
    }
    if (!(bound.max_value() * diagonal <= thickest)) {
        throw InputError(entity.place,
                         fmt::format("the \"rgbgrid\" is up to {:g} mean free paths thick, but {:g} are the most",
                                     bound.max_value() * diagonal, thickest));
    }
}

}  // namespace

Medium load_uniform_grid(LoadContext& context, const pbrt::MediumEntity& entity) {
    const pbrt::ParameterSet& p = entity.parameters;
    const std::vector<float> density = p.get_floats("density");
    if (density.empty()) {
        throw InputError(entity.place, "\"uniformgrid\" needs the parameter \"float density\"");
    }
    const Vec3i size = load_size(p, density.size(), "density");
    const Transform index_from_world = index_from_box(load_box(p), size) * entity.world_from_medium.inverse();
    const Coefficients c = load_coefficients(context, p);
    return GridMedium(make_grid(context, density, size, p.place_of("density"), "density", is_clamped(p)),
                      index_from_world, all_cells(size), c.absorption, c.scattering, load_phase(context, p),
                      load_grid_emission(context, p, size, index_from_world));
}

Medium load_rgb_grid(LoadContext& context, const pbrt::MediumEntity& entity) {
    const pbrt::ParameterSet& p = entity.parameters;
    const float scale = non_negative_float(p, "scale", 1);
    const bool clamped = is_clamped(p);
    const VoxelColours absorption{load_colours(context, p, "sigma_a"), scale, clamped};
    const VoxelColours scattering{load_colours(context, p, "sigma_s"), scale, clamped};
    // Not divided by the luminance of a spectrum of 1 here, other than in all other media of pbrt.
    constexpr float luminance_of_equal_energy = 106.856895f;
    const bool shines_apart = p.has("glow");
    const VoxelColours emitted =
        shines_apart
            ? VoxelColours{load_colours(context, p, "glow"), 1, clamped}
            : VoxelColours{load_colours(context, p, "Le"),
                           luminance_of_equal_energy * non_negative_float(p, emission_scale_name(p), 1), clamped};
    const std::size_t count = std::max(absorption.values.size(), scattering.values.size());
    if (count == 0) {
        throw InputError(entity.place, "\"rgbgrid\" needs the parameter \"rgb sigma_a\" or \"rgb sigma_s\"");
    }
    if (!emitted.values.empty() && absorption.values.empty() && !shines_apart) {
        throw InputError(p.place_of("Le"), "\"rgbgrid\" needs the parameter \"rgb sigma_a\" beside \"rgb Le\"");
    }
    const Vec3i size = load_size(p, count, absorption.values.empty() ? "sigma_s" : "sigma_a");
    for (const auto& [colours, name] :
         {std::pair(&absorption, "sigma_a"), {&scattering, "sigma_s"}, {&emitted, shines_apart ? "glow" : "Le"}}) {
        if (!colours->values.empty()) {
            load_size(p, colours->values.size(), name);
        }
    }
    const Transform index_from_world = index_from_box(load_box(p), size) * entity.world_from_medium.inverse();
    auto bound = std::make_shared<const Grid>(make_ringed_grid(
        entity.place, size, clamped ? std::nullopt : std::optional(*absorption.outside() + *scattering.outside()),
        [&](std::size_t voxel) { return max_value(absorption.at(voxel) + scattering.at(voxel)); }));
    require_trackable(entity, *bound, index_from_world.inverse(), all_cells(size));
    std::shared_ptr<GridEmission> emission;
    if (!emitted.values.empty()) {
        emission = std::make_shared<GridEmission>();
        emission->is_apart = shines_apart;
        emission->radiance = Rgb(1.0f);
        emission->colours = std::make_shared<const ColourGrid>(emitted.grid(entity.place, size));
        emission->field_from_world = AffineMap(index_from_world);
    }
    auto voxels = std::make_shared<VoxelCoefficients>();
    voxels->absorption = absorption.grid(entity.place, size);
    voxels->scattering = scattering.grid(entity.place, size);
    return GridMedium(std::move(bound), index_from_world, all_cells(size), std::move(voxels), absorption.mean(count),
                      scattering.mean(count), load_phase(context, p), std::move(emission));
}

}  // namespace wend
