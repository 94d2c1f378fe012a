// Volumes of Mitsuba scenes: what media have at every place.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/transform.h>
#include <wend/io/mitsuba/object.h>
#include <wend/io/mitsuba/vol_file.h>

#include <memory>

namespace wend::mitsuba {

/// A colour everywhere, or voxels in a box.
struct Volume {
    Rgb colour{1.0f};
    std::shared_ptr<const VoxelData> voxels{};
    Transform world_from_box{};  ///< the box is the unit cube

    /// At a place of the unit cube.
    Rgb at(const Vec3& p) const;
    float largest() const;
};

/// `<volume>`, or a colour. Throws InputError for one that there is not, or that Wend lacks, and for negative numbers.
Volume read_volume(Context& context, const Element& element);

}  // namespace wend::mitsuba
