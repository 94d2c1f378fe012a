// Media and phase functions, number by number.
#pragma once

#include <wend/capi/decisions.h>
#include <wend/medium/homogeneous.h>

#include <span>

namespace wend::capi {

/// Of up to 4 parts, isotropic without any. Throws a Refusal for numbers out of range.
PhaseFunction to_phase(std::span<const wend_phase_part> parts);
/// Throws a Refusal for numbers out of range, and for null.
HomogeneousMedium to_medium(const wend_medium* medium);

}  // namespace wend::capi
