// Where the first flight of a pixel goes: from the camera through media to the first surface.
#pragma once

#include <wend/core/random.h>
#include <wend/guide/fit.h>
#include <wend/view/pixel_ray.h>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace wend {

/// A short piece of the flight within a medium. Probabilities are those of a flight that begins at the camera.
struct FlightPiece {
    double begin = 0, end = 0;  ///< distances from the camera, in scene units
    MediumId medium = vacuum;
    double collides = 0;      ///< probability that a classical flight ends here, as a mean over colours
    double guided = 0;        ///< the same of a flight as `distance` draws it; see PixelFlight::is_guided
    double in_scattered = 0;  ///< radiance scattered towards the camera, as the volume's field tells it
    /// Radiance at the camera from here, by that: `collides` times albedo times `in_scattered`.
    double brings = 0;

    double middle() const { return 0.5 * (begin + end); }
};

/// What lies between two boundaries.
struct FlightPart : RayPart {
    double begin = 0, end = 0;  ///< distances from the camera; without a hit it ends where the scene and the field do
    std::size_t first_piece = 0, pieces = 0;  ///< none in vacuum
    double reached = 1, guided_reached = 1;   ///< probabilities that a flight gets to its beginning
};

/// The flight along the ray through the middle of a pixel, lens and shutter, interfaces passed.
struct PixelFlight {
    Ray ray;
    double length = 0;  ///< to the surface, or to where nothing is looked at any more
    std::optional<Hit> surface;
    double reaches_end = 1;  ///< probability that a classical flight gets there, as a mean over colours
    double end_brings = 0;   ///< radiance at the camera of what the surface is expected to send, emission left out
    bool is_guided = false;  ///< whether there is a field of volumes for flights to follow
    std::vector<FlightPart> parts;    ///< at least one
    std::vector<FlightPiece> pieces;  ///< of all media on the way, the nearest first; equally long within a part

    std::span<const FlightPiece> pieces_of(const FlightPart& part) const {
        return std::span(pieces).subspan(part.first_piece, part.pieces);
    }
    /// Of the light that the field expects, the share that is scattered on the way: how likely a flight in proportion
    /// to it scatters. None where the field expects no light.
    std::optional<double> guided_collides() const;
};

/// Of so many evenly spread numbers guided flights through the first medium are drawn; of half as many in the next.
inline constexpr int guided_flights = 4096;

/// Follows the middle of a pixel, which must be within the picture. What lies beyond the scene and the field is left
/// out. Without fields nothing is guided. None where the camera lets no light through there.
std::optional<PixelFlight> pixel_flight(const Scene& scene, const Vec2i& pixel, const guide::Fields* fields,
                                        Pcg32& random);

/// A place on the flight that is worth a look.
struct FlightStop {
    double distance = 0;  ///< from the camera
    bool on_surface = false;
};

/// At most `most` places in media, each standing for as much of the light that the flight brings from there (of the
/// collisions where the field expects none), and the surface at its end.
std::vector<FlightStop> stops_of(const PixelFlight& flight, int most);

}  // namespace wend
