// The modes that guide walks in a dense medium.
#pragma once

#include <wend/medium/medium.h>
#include <wend/subsurface/half_space_mode.h>

#include <vector>

namespace wend {

/// Modes of media with this phase function from no decay (the first) to the decay of the given albedo in [0, 1] (the
/// last), evenly spaced in the rate of decay as far as diffusion theory goes. Of much absorption less is taken: such
/// modes would have a walk go straight for the boundary, and sample all else too rarely.
std::vector<HalfSpaceMode> half_space_modes(double albedo, const PhaseFunction& phase);

/// The same for a medium, channel by channel, or for one channel where all are alike. Throws InputError for
/// coefficients that are negative or not finite.
std::vector<std::vector<HalfSpaceMode>> half_space_modes(const HomogeneousMedium& medium);

}  // namespace wend
