#pragma once

#include <wend/app/gains.h>

#include <span>
#include <string>
#include <vector>

namespace wend {

/// Gains on a logarithmic axis as one <svg> element in the look of plot_svg(), a strip for each way of sampling: a dot
/// for each scene, which leads to #scene-NUMBER and says its name and gain; the range of its runs; a box over the
/// middle half of the scenes with their median, and a diamond at the geometric mean. The line at 1 is classical
/// sampling.
std::string gains_svg(const std::vector<GainDistribution>& gains, std::span<const Comparison> comparisons);

}  // namespace wend
