// A cloud that is computed rather than stored.
#pragma once

#include <wend/core/vector.h>
#include <wend/medium/grid.h>

namespace wend {

struct CloudShape {
    float density = 1;
    float wispiness = 1;  ///< how far the shape is distorted
    float frequency = 5;  ///< of the coarsest lumps, per unit of length
};

/// pbrt-v4's procedural cloud: lumps of noise that thin out with the altitude y, within [0, 1].
float cloud_density(const CloudShape& shape, const Vec3& p);

/// cloud_density() in `box`, sampled at `cells` + 1 points a side, the first and last on the box's faces.
Grid bake_cloud(const CloudShape& shape, const Box3& box, int cells);

}  // namespace wend
