#include <wend/io/mitsuba/volumes.h>

#include <wend/core/error.h>
#include <wend/io/mitsuba/spectra.h>

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace wend::mitsuba {
namespace {

Volume read_grid(const Object& volume) {
    Volume grid;
    const std::filesystem::path file = volume.file("filename");
    auto voxels = std::make_shared<VoxelData>(read_vol(file));
    grid.world_from_box = volume.transform("to_world");
    if (volume.flag("use_grid_bbox", false)) {
        const Vec3 low = voxels->box_min, size = voxels->box_max - low;
        try {
            grid.world_from_box = grid.world_from_box * Transform::translate(low.x, low.y, low.z) *
                                  Transform::scale(size.x, size.y, size.z);
        } catch (const std::domain_error&) {
            throw InputError(volume.place_of("use_grid_bbox"), "the box that the file gives is empty or not finite");
        }
    }
    for (const char* name : {"filter_type", "wrap_mode"}) {
        const std::string usual = name == std::string("filter_type") ? "trilinear" : "clamp";
        if (const std::string value = volume.text(name, usual); value != usual) {
            volume.context().warn(
                volume.place_of(name),
                fmt::format("\"{}\" of a gridvolume is always \"{}\" here, not \"{}\"", name, usual, value));
        }
    }
    volume.ignore("raw");
    volume.ignore("accel");
    if (*std::min_element(voxels->values.begin(), voxels->values.end()) < 0) {
        throw InputError(volume.place_of("filename"), "a voxel holds a negative number");
    }
    grid.voxels = std::move(voxels);
    return grid;
}

}  // namespace

Rgb Volume::at(const Vec3& p) const {
    if (!voxels) {
        return colour;
    }
    if (voxels->channels == 1) {
        return Rgb(voxels->at(p, 0));
    }
    return {voxels->at(p, 0), voxels->at(p, 1), voxels->at(p, 2)};
}

float Volume::largest() const {
    return voxels ? *std::max_element(voxels->values.begin(), voxels->values.end()) : max_value(colour);
}

Volume read_volume(Context& context, const Element& element) {
    if (element.tag != "volume") {
        return {colour_of(context, element, SpectrumUse::unbounded)};
    }
    const Object object(context, element);
    Volume volume;
    if (object.type() == "constvolume") {
        const Element* value = object.find("value");
        if (!value) {
            throw InputError(object.place(), "a \"constvolume\" needs a \"value\"");
        }
        volume.colour = colour_of(context, *value, SpectrumUse::unbounded);
        volume.world_from_box = object.transform("to_world");
    } else if (object.type() == "gridvolume") {
        volume = read_grid(object);
    } else {
        refuse_type(object, "constvolume, gridvolume");
    }
    object.warn_of_unused();
    return volume;
}

}  // namespace wend::mitsuba
