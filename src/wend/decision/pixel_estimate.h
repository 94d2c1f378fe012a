// What the pixels of a picture will be, from noisy beginnings: what decisions on survival and weights of samples
// measure against.
#pragma once

#include <wend/core/export.h>
#include <wend/core/image.h>

#include <vector>

namespace wend {

/// The mean of the colour channels at each pixel, row by row: averaged over a square of neighbours, the smaller the
/// more samples a pixel has had, and kept above a tenth of the picture's mean, as the relative error is measured. Zero
/// everywhere as long as the picture is black.
WEND_API std::vector<float> pixel_estimates(const Image& picture, int samples);

}  // namespace wend
