// What `wend field --pixel` writes of a flight from the camera.
#pragma once

#include <wend/view/pixel_flight.h>

#include <nlohmann/json.hpp>

#include <string>

namespace wend {

/// The ray, what it meets, its chances of scattering, and its pieces.
nlohmann::json flight_json(const PixelFlight& flight);

/// The same in two lines; `pixel` as it was asked for.
std::string flight_text(const PixelFlight& flight, const std::string& pixel);

}  // namespace wend
