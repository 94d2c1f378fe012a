// Samples where the noise is: how many each pixel gets in a pass.
#pragma once

#include <wend/film/film.h>

#include <cstdint>
#include <vector>

namespace wend {

/// For each pixel of a picture of that width, whose noise is known, samples in the next pass: `count` of them as a
/// mean, more where a sample brings down the picture's relative error by more for its work. The error of a pixel falls
/// as variance over samples, so each should have in the end as many as are proportional to the root of its variance
/// over its work.
///
/// What one half of the chess board shows says what the other gets (film/chess_board.h): no sample has a say in how
/// many follow it in its pixel, so the pixel's mean over all of them has no bias. Rounding is by chance, keyed by
/// `seed` and pixel.
///
/// `most`, if not empty, is of each pixel what it may get; where that is less than what there is to give, all get it.
std::vector<std::uint32_t> sample_counts(const std::vector<PixelNoise>& noise, int width, int count, std::uint64_t seed,
                                         const std::vector<double>& most = {});

}  // namespace wend
