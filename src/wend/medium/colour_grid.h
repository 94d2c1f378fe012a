// A colour at each voxel.
#pragma once

#include <wend/core/colour.h>
#include <wend/medium/grid.h>

#include <array>
#include <utility>

namespace wend {

/// Three grids of the same voxels, one a channel.
class ColourGrid {
public:
    ColourGrid() = default;
    /// Red, green and blue.
    explicit ColourGrid(std::array<Grid, 3> channels) : channels_(std::move(channels)) {}

    /// At a point in index space.
    Rgb interpolate(const Vec3& p) const {
        return {channels_[0].interpolate(p), channels_[1].interpolate(p), channels_[2].interpolate(p)};
    }
    /// The colour of one of the eight voxels around p, the same that Grid::sample_nearest draws of any grid of these
    /// voxels: its mean is interpolate(p).
    Rgb sample_nearest(const Vec3& p, const Vec3& u) const {
        return {channels_[0].sample_nearest(p, u), channels_[1].sample_nearest(p, u),
                channels_[2].sample_nearest(p, u)};
    }
    /// Red, green and blue.
    const std::array<Grid, 3>& channels() const { return channels_; }

private:
    std::array<Grid, 3> channels_;
};

}  // namespace wend
