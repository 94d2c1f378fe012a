// The modes that guide walks in a dense medium, from theory.
#pragma once

#include <wend/decision/slab_guide.h>

#include <vector>

namespace wend {

/// Modes of media with this phase function from no decay (the first) to the decay of the given albedo in [0, 1] (the
/// last), evenly spaced in the rate of decay as far as diffusion theory goes. Of much absorption less is taken: such
/// modes would have a walk go straight for the boundary, and sample all else too rarely.
std::vector<SlabMode> slab_modes(double albedo, const PhaseFunction& phase);

/// The guide of a medium, channel by channel unless they are all alike, with classical sampling alone.
SlabGuide slab_guide(const HomogeneousMedium& medium);

}  // namespace wend
