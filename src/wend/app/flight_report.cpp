#include <wend/app/flight_report.h>

#include <wend/io/json_text.h>

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace wend {

nlohmann::json flight_json(const PixelFlight& flight) {
    nlohmann::json pieces = nlohmann::json::array();
    for (const FlightPiece& piece : flight.pieces) {
        pieces.push_back({{"begin", piece.begin},
                          {"end", piece.end},
                          {"medium", piece.medium},
                          {"collides", piece.collides},
                          {"guided", flight.is_guided ? nlohmann::json(piece.guided) : nlohmann::json(nullptr)},
                          {"in_scattered", piece.in_scattered},
                          {"brings", piece.brings}});
    }
    const std::optional<double> guided = flight.guided_collides();
    nlohmann::json surface;
    if (flight.surface) {
        surface = {{"position", json_vector(flight.surface->position)},
                   {"normal", json_vector(flight.surface->normal)}};
    }
    return {{"origin", json_vector(flight.ray.origin)},
            {"direction", json_vector(flight.ray.direction)},
            {"length", flight.length},
            {"surface", std::move(surface)},
            {"scatters", 1 - flight.reaches_end},
            {"guided_scatters", guided ? nlohmann::json(*guided) : nlohmann::json(nullptr)},
            {"pieces", std::move(pieces)}};
}

std::string flight_text(const PixelFlight& flight, const std::string& pixel) {
    const Vec3 &o = flight.ray.origin, &d = flight.ray.direction;
    const std::optional<double> guided = flight.guided_collides();
    const std::string end =
        flight.surface ? fmt::format("meets a surface at {:.4g} {:.4g} {:.4g}, {:.4g} away", flight.surface->position.x,
                                     flight.surface->position.y, flight.surface->position.z, flight.length)
                       : std::string("meets no surface");
    return fmt::format(
        "\npixel {}: from {:.4g} {:.4g} {:.4g} towards {:.4f} {:.4f} {:.4f}, {}\nscatters in media on its way: {:.1f} "
        "% of classical flights{}\n",
        pixel, o.x, o.y, o.z, d.x, d.y, d.z, end, 100 * (1 - flight.reaches_end),
        guided ? fmt::format("; of the light that the field expects {:.1f} % come from there", 100 * *guided)
               : std::string());
}

}  // namespace wend
