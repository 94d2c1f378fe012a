#include <wend/app/pixel_flight.h>
#include <wend/core/error.h>
#include <wend/medium/transmittance.h>
#include <wend/view/pixel_ray.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wend {
namespace {

/// A part of the ray between boundaries.
struct Stretch {
    double begin, end;
    MediumId medium;
};

/// So far from the camera that all of the scene and of the field is nearer.
double farthest(const Scene& scene, const guide::Fields& fields, const Vec3& from) {
    Box3 box = scene.bounds();
    box.extendBy(fields.volume.bounds());
    box.extendBy(fields.surface.bounds());
    const Vec3 reach(std::max(std::abs(box.min.x - from.x), std::abs(box.max.x - from.x)),
                     std::max(std::abs(box.min.y - from.y), std::abs(box.max.y - from.y)),
                     std::max(std::abs(box.min.z - from.z), std::abs(box.max.z - from.z)));
    return static_cast<double>(length(reach));
}

/// The way of the pixel by distances from the camera; notes the ray, its surface, and how far that is.
std::vector<Stretch> stretches_along(const std::vector<RayPart>& parts, double limit, PixelFlight& flight) {
    std::vector<Stretch> stretches;
    double begin = 0;
    for (const RayPart& part : parts) {
        const double length = part.hit ? static_cast<double>(part.hit->distance) : std::max(0.0, limit - begin);
        stretches.push_back({begin, begin + length, part.medium});
        begin += length;
    }
    flight.ray = parts.front().ray;
    if (!parts.back().ends_at_interface) {
        flight.surface = parts.back().hit;
    }
    flight.length = begin;
    return stretches;
}

/// Transmittance of a part of the ray: exact, or a mean of estimates where the medium has a grid.
Rgb transmittance_between(const Medium& medium, const Ray& ray, double begin, double end, Pcg32& random) {
    const Ray from{ray.at(static_cast<float>(begin)), ray.direction, ray.time};
    const auto length = static_cast<float>(end - begin);
    const int estimates = std::holds_alternative<HomogeneousMedium>(medium) ? 1 : 32;
    Rgb sum;
    for (int i = 0; i < estimates; ++i) {
        sum += estimate_transmittance(medium, from, length, random);
    }
    return sum / static_cast<float>(estimates);
}

const PhaseFunction& phase_of(const Medium& medium) {
    const auto* grid = std::get_if<GridMedium>(&medium);
    return grid ? grid->phase() : std::get<HomogeneousMedium>(medium).phase;
}

/// Cuts what lies in a medium into pieces and adds them; `passed` is what gets there, and then what gets through.
void add_pieces(const Scene& scene, const Stretch& stretch, int count, const guide::Field& field, Rgb& passed,
                Pcg32& random, PixelFlight& flight) {
    const Medium& medium = scene.medium(stretch.medium);
    const double scattered = static_cast<double>(mean_value(albedo(medium)));
    for (int i = 0; i < count; ++i) {
        FlightPiece piece;
        piece.begin = stretch.begin + (stretch.end - stretch.begin) * i / count;
        piece.end = stretch.begin + (stretch.end - stretch.begin) * (i + 1) / count;
        piece.medium = stretch.medium;
        const Rgb next = passed * transmittance_between(medium, flight.ray, piece.begin, piece.end, random);
        piece.collides = static_cast<double>(mean_value(passed) - mean_value(next));
        passed = next;
        const Vec3 middle = flight.ray.at(static_cast<float>(piece.middle()));
        if (const guide::ScatteredLight* light = field.scattered_light(middle)) {
            piece.in_scattered = static_cast<double>(light->in_scattered(flight.ray.direction, phase_of(medium)));
        }
        piece.brings = piece.collides * scattered * piece.in_scattered;
        flight.pieces.push_back(piece);
    }
}

}  // namespace

std::optional<double> PixelFlight::guided_collides() const {
    double media = 0;
    for (const FlightPiece& piece : pieces) {
        media += piece.brings;
    }
    const double all = media + end_brings;
    return all > 0 ? std::optional(media / all) : std::nullopt;
}

PixelFlight pixel_flight(const Scene& scene, const Vec2i& pixel, const guide::Fields& fields, Pcg32& random) {
    const std::vector<RayPart> parts = pixel_ray(scene, pixel);
    if (parts.empty()) {
        throw InputError(
            fmt::format("--pixel {},{}: the camera lets no light through to its middle", pixel.x, pixel.y));
    }
    PixelFlight flight;
    const double limit = farthest(scene, fields, parts.front().ray.origin);
    const std::vector<Stretch> stretches = stretches_along(parts, limit, flight);
    const auto in_media =
        std::count_if(stretches.begin(), stretches.end(), [](const Stretch& s) { return s.medium != vacuum; });
    const int pieces = std::max(4, 256 / std::max(1, static_cast<int>(in_media)));
    Rgb passed(1.0f);
    for (const Stretch& stretch : stretches) {
        if (stretch.medium != vacuum && stretch.end > stretch.begin) {
            add_pieces(scene, stretch, pieces, fields.volume, passed, random, flight);
        }
    }
    flight.reaches_end = static_cast<double>(mean_value(passed));
    if (flight.surface) {
        const Vec3& n = flight.surface->normal;
        const Vec3 facing = dot(n, flight.ray.direction) < 0 ? n : -n;
        flight.end_brings =
            flight.reaches_end * static_cast<double>(fields.surface.leaving(flight.surface->position, facing));
    }
    return flight;
}

std::vector<FlightStop> stops_of(const PixelFlight& flight, int most) {
    const bool is_lit =
        std::any_of(flight.pieces.begin(), flight.pieces.end(), [](const FlightPiece& p) { return p.brings > 0; });
    std::vector<double> sums;
    double sum = 0;
    for (const FlightPiece& piece : flight.pieces) {
        sum += is_lit ? piece.brings : piece.collides;
        sums.push_back(sum);
    }
    std::vector<FlightStop> stops;
    for (int i = 0; i < most && sum > 0; ++i) {
        const auto at = std::lower_bound(sums.begin(), sums.end(), (i + 0.5) / most * sum);
        const double distance = flight.pieces[static_cast<std::size_t>(at - sums.begin())].middle();
        if (stops.empty() || stops.back().distance != distance) {
            stops.push_back({distance, false});
        }
    }
    if (flight.surface) {
        stops.push_back({flight.length, true});
    }
    return stops;
}

}  // namespace wend
