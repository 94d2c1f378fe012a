// How a camera sees the world, for programs that put pictures together.
#pragma once

#include <array>

namespace wend {

/// Matrices that a row vector is multiplied with, row by row, as OpenEXR has them. The camera looks along +z, with x to
/// the right and y up. In normalized device coordinates (0, 0) is the upper left corner of the full picture, (1, 1) the
/// lower right one; z is not meant.
struct ViewMatrices {
    std::array<float, 16> camera_from_world{}, ndc_from_world{};
};

}  // namespace wend
