#pragma once

#include <wend/decision/flight_pieces.h>
#include <wend/scene/light.h>

#include <span>
#include <vector>

namespace wend {

/// The beams of spot lights and projectors that are narrow enough to be worth finding on a flight's way. The light of
/// the others is taken to be spread evenly over the scene, whose radius is positive.
std::vector<Beam> beams_of(std::span<const Light> lights, float scene_radius);

}  // namespace wend
