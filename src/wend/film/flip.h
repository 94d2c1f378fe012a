#pragma once

#include <wend/core/image.h>

#include <vector>

namespace wend {

/// A FLIP comparison: the error a viewer sees when flipping between two pictures, in [0,1] pixel by pixel (row-major),
/// and its mean.
struct FlipResult {
    std::vector<float> map;
    double mean = 0;
};

/// Resolution of the viewing situation that published FLIP values assume: 0.7 m from a 0.7 m wide 3840-pixel monitor,
/// rounded.
inline constexpr float default_pixels_per_degree = 67.0f;

/// HDR-FLIP (andersson2021) of linear pictures: LDR-FLIP (andersson2020) after the ACES tone curve, the largest over a
/// range of exposures that the reference's maximum and median luminance determine. Negative values count as black.
/// `pixels_per_degree` is in [1, 1000]. Cost: O(pixels · exposures · pixels_per_degree), on all threads. Throws
/// InputError where sizes differ, a pixel is not finite or the resolution is out of range.
FlipResult flip(const Image& image, const Image& reference, float pixels_per_degree = default_pixels_per_degree);

}  // namespace wend
