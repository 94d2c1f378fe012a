// How freaks among noisy estimates are kept from teaching alone.
#pragma once

#include <span>

namespace wend::guide {

/// The weight above which a record is cut, for fitting only: sqrt(n) times the mean of the n cut weights (ionides2008,
/// with the mean made robust). One freak among ordinary records counts as sqrt(n) of them, and nothing is cut from many
/// equals. The weights are not negative.
double weight_limit(std::span<const double> weights);

}  // namespace wend::guide
