#include <wend/io/mitsuba/media.h>

#include <wend/core/error.h>
#include <wend/io/mitsuba/directive.h>
#include <wend/io/mitsuba/phase_functions.h>
#include <wend/io/mitsuba/spectra.h>
#include <wend/io/mitsuba/volumes.h>

#include <fmt/format.h>

#include <algorithm>

namespace wend::mitsuba {
namespace {

constexpr float default_albedo = 0.75f;

Rgb scattering_of(const Rgb& extinction, const Rgb& albedo) {
    return extinction * albedo;
}
Rgb absorption_of(const Rgb& extinction, const Rgb& albedo) {
    return extinction * (Rgb(1.0f) - albedo);
}

void require_albedo(const Element& element, float largest) {
    if (!(largest <= 1)) {
        throw InputError(element.place, fmt::format("an albedo must lie between 0 and 1, not be {}", largest));
    }
}

/// What a medium has of a property, the same everywhere where it is absent.
Volume volume_of(const Object& medium, std::string_view name, float fallback) {
    const Element* element = medium.find(name);
    return element ? read_volume(medium.context(), *element) : Volume{Rgb(fallback)};
}

struct MediumVolumes {
    Volume extinction, albedo;
    double scale;
};

MediumVolumes volumes_of(const Object& medium) {
    MediumVolumes volumes{volume_of(medium, "sigma_t", 1), volume_of(medium, "albedo", default_albedo),
                          medium.non_negative("scale", 1)};
    if (const Element* albedo = medium.find("albedo")) {
        require_albedo(*albedo, volumes.albedo.largest());
    }
    for (const char* name :
         {"sample_emitters", "has_spectral_extinction", "majorant_resolution_factor", "majorant_grid_resolution"}) {
        medium.ignore(name);
    }
    return volumes;
}

void set_homogeneous(const Object& medium, Parameters& p) {
    const MediumVolumes volumes = volumes_of(medium);
    if (volumes.extinction.voxels || volumes.albedo.voxels) {
        throw InputError(medium.place(), "what varies is for <medium type=\"heterogeneous\">");
    }
    const Rgb extinction = volumes.extinction.colour * static_cast<float>(volumes.scale);
    p.text("type", "homogeneous")
        .colour("sigma_a", absorption_of(extinction, volumes.albedo.colour))
        .colour("sigma_s", scattering_of(extinction, volumes.albedo.colour));
}

/// A grid of densities, with one colour for all.
void set_grey_grid(const MediumVolumes& volumes, Parameters& p) {
    const VoxelData& voxels = *volumes.extinction.voxels;
    const Rgb& albedo = volumes.albedo.colour;
    p.text("type", "uniformgrid")
        .real("scale", volumes.scale)
        .colour("sigma_a", absorption_of(Rgb(1.0f), albedo))
        .colour("sigma_s", scattering_of(Rgb(1.0f), albedo))
        .integer("nx", voxels.size.x)
        .integer("ny", voxels.size.y)
        .integer("nz", voxels.size.z)
        .add(pbrt::ParameterType::real, "density", voxels.values);
}

/// A grid of colours: the voxels of the extinction, or those of the albedo where that is the same everywhere.
void set_colour_grid(const MediumVolumes& volumes, Parameters& p) {
    const Vec3i size = (volumes.extinction.voxels ? *volumes.extinction.voxels : *volumes.albedo.voxels).size;
    std::vector<float> absorption, scattering;
    const Transform world_from_box = volumes.extinction.world_from_box;
    const Transform albedo_from_world = volumes.albedo.world_from_box.inverse();
    for (int z = 0; z < size.z; ++z) {
        for (int y = 0; y < size.y; ++y) {
            for (int x = 0; x < size.x; ++x) {
                const Vec3 at((static_cast<float>(x) + 0.5f) / static_cast<float>(size.x),
                              (static_cast<float>(y) + 0.5f) / static_cast<float>(size.y),
                              (static_cast<float>(z) + 0.5f) / static_cast<float>(size.z));
                const Rgb extinction = volumes.extinction.at(at);
                const Rgb albedo = volumes.albedo.at(albedo_from_world.point(world_from_box.point(at)));
                const Rgb absorbed = absorption_of(extinction, albedo), scattered = scattering_of(extinction, albedo);
                absorption.insert(absorption.end(), {absorbed.r, absorbed.g, absorbed.b});
                scattering.insert(scattering.end(), {scattered.r, scattered.g, scattered.b});
            }
        }
    }
    p.text("type", "rgbgrid")
        .real("scale", volumes.scale)
        .integer("nx", size.x)
        .integer("ny", size.y)
        .integer("nz", size.z)
        .add(pbrt::ParameterType::rgb, "sigma_a", std::move(absorption))
        .add(pbrt::ParameterType::rgb, "sigma_s", std::move(scattering));
}

/// Returns where the box of the medium is.
Transform set_heterogeneous(const Object& medium, Parameters& p) {
    MediumVolumes volumes = volumes_of(medium);
    Volume& extinction = volumes.extinction;
    if (!extinction.voxels && !volumes.albedo.voxels) {
        auto one = std::make_shared<VoxelData>();
        one->channels = 3;
        one->values = {extinction.colour.r, extinction.colour.g, extinction.colour.b};
        extinction.voxels = one;
    }
    if (extinction.voxels && extinction.voxels->channels == 1 && !volumes.albedo.voxels) {
        set_grey_grid(volumes, p);
    } else {
        set_colour_grid(volumes, p);
    }
    // Beyond the middles of the outermost voxels everything is as it is there.
    p.text("wrap", "clamp");
    return extinction.world_from_box;
}

}  // namespace

std::string Media::name_of(const Element& element) {
    const auto [known, is_new] = names_.try_emplace(&element);
    if (!is_new) {
        return known->second;
    }
    const Object medium(context_, element);
    const std::string name = element.has("id") ? std::string(element.attribute("id")) : context_.new_name();
    known->second = name;
    Parameters p(medium.place());
    Transform world_from_medium;
    if (medium.type() == "homogeneous") {
        set_homogeneous(medium, p);
    } else if (medium.type() == "heterogeneous") {
        world_from_medium = set_heterogeneous(medium, p);
    } else {
        refuse_type(medium, "heterogeneous, homogeneous");
    }
    set_phase(context_, medium.nested_one("phase"), p);
    medium.warn_of_unused();
    in_block(context_, world_from_medium, medium.place(),
             [&] { context_.builder.make_named_medium(name, p.take(), medium.place()); });
    return name;
}

}  // namespace wend::mitsuba
