#pragma once

#include <wend/decision/flight_pieces.h>
#include <wend/scene/light.h>

#include <span>
#include <vector>

namespace wend {

/// The beams of spot lights and projectors that are narrow enough to be worth finding on a flight's way.
std::vector<Beam> beams_of(std::span<const Light> lights);

}  // namespace wend
