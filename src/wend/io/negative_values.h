#pragma once

#include <wend/core/vector.h>

#include <string>

namespace wend {

/// The values below 0 of a grid that should have none. Resampling with a filter of negative lobes leaves small ones
/// beside large values: these count as 0.
class NegativeValues {
public:
    /// The value, or 0 if it is below; what is not a number stays.
    float raise(float value, const Vec3i& voxel) {
        if (value < lowest_) {
            lowest_ = value;
            voxel_ = voxel;
        }
        return value < 0 ? 0.0f : value;
    }

    /// What to warn of; empty if nothing was below 0. Throws InputError, naming the voxel, if a value was further below
    /// 0 than a tenth of the largest one is above: these are no densities.
    std::string warning(float largest) const;

private:
    float lowest_ = 0;
    Vec3i voxel_{0, 0, 0};
};

}  // namespace wend
