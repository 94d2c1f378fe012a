#include <wend/view/pixel_flight.h>

#include <wend/decision/guided_distance.h>
#include <wend/light/beams.h>
#include <wend/medium/transmittance.h>
#include <wend/render/preset.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace wend {
namespace {

/// So far from the camera that all of the scene and of the field is nearer.
double farthest(const Scene& scene, const guide::Fields* fields, const Vec3& from) {
    Box3 box = scene.bounds();
    if (fields) {
        box.extendBy(fields->volume.bounds());
        box.extendBy(fields->surface.bounds());
    }
    const Vec3 reach(std::max(std::abs(box.min.x - from.x), std::abs(box.max.x - from.x)),
                     std::max(std::abs(box.min.y - from.y), std::abs(box.max.y - from.y)),
                     std::max(std::abs(box.min.z - from.z), std::abs(box.max.z - from.z)));
    return static_cast<double>(length(reach));
}

/// The way of the pixel by distances from the camera; notes the ray, its surface, and how far that is.
void follow(const std::vector<RayPart>& parts, double limit, PixelFlight& flight) {
    double begin = 0;
    for (const RayPart& part : parts) {
        const double length = part.hit ? static_cast<double>(part.hit->distance) : std::max(0.0, limit - begin);
        FlightPart& followed = flight.parts.emplace_back();
        static_cast<RayPart&>(followed) = part;
        followed.begin = begin;
        begin += length;
        followed.end = begin;
    }
    flight.ray = parts.front().ray;
    if (!parts.back().ends_at_interface) {
        flight.surface = parts.back().hit;
    }
    flight.length = begin;
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
void add_pieces(const Scene& scene, int count, const guide::Fields* fields, Rgb& passed, Pcg32& random,
                FlightPart& part, PixelFlight& flight) {
    const Medium& medium = scene.medium(part.medium);
    const double scattered = static_cast<double>(mean_value(albedo(medium)));
    part.first_piece = flight.pieces.size();
    part.pieces = static_cast<std::size_t>(count);
    for (int i = 0; i < count; ++i) {
        FlightPiece piece;
        piece.begin = part.begin + (part.end - part.begin) * i / count;
        piece.end = part.begin + (part.end - part.begin) * (i + 1) / count;
        piece.medium = part.medium;
        const Rgb next = passed * transmittance_between(medium, flight.ray, piece.begin, piece.end, random);
        piece.collides = static_cast<double>(mean_value(passed) - mean_value(next));
        passed = next;
        const Vec3 middle = flight.ray.at(static_cast<float>(piece.middle()));
        if (const guide::ScatteredLight* light = fields ? fields->volume.scattered_light(middle) : nullptr) {
            piece.in_scattered = static_cast<double>(light->in_scattered(flight.ray.direction, phase_of(medium)));
        }
        piece.brings = piece.collides * scattered * piece.in_scattered;
        flight.pieces.push_back(piece);
    }
}

/// A flight through a part as walks begin it.
FlightStart start_of(const FlightPart& part) {
    FlightStart start;
    start.ray = part.ray;
    start.length = part.hit ? part.hit->distance : longest_segment;
    if (part.hit) {
        const Vec3 normal = part.hit->normal;
        start.end = {part.ends_at_interface ? FlightEnd::Kind::interface : FlightEnd::Kind::surface, part.hit->position,
                     dot(normal, part.ray.direction) < 0 ? normal : -normal, 0};
    }
    return start;
}

/// How likely guided flights end in each piece, as drawn with evenly spread random numbers.
void draw_guided(const Scene& scene, const guide::Fields& fields, PixelFlight& flight) {
    constexpr int fewest = 64;
    const std::vector<Beam> beams = beams_of(scene.lights(), scene.radius());
    const GuidedDistance distance(&fields.surface, &fields.volume, classical_flights,
                                  DistanceGuiding::scatter_and_distance, std::span<const Beam>(beams));
    Pcg32 random(0);
    double reached = 1;
    int count = guided_flights;
    for (FlightPart& part : flight.parts) {
        part.guided_reached = reached;
        if (part.pieces == 0) {
            continue;
        }
        const FlightStart start = start_of(part);
        const double each = reached / count, in_length = static_cast<double>(part.pieces) / (part.end - part.begin);
        // In a part without end some go beyond what is looked at.
        const auto longest = static_cast<float>(part.end - part.begin);
        for (int i = 0; i < count; ++i) {
            const float u = (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
            const Flight drawn = distance.sample(scene.medium(part.medium), start, u, random);
            if (!drawn.scatters || (!part.hit && drawn.distance >= longest)) {
                continue;
            }
            const auto piece = static_cast<std::size_t>(static_cast<double>(drawn.distance) * in_length);
            flight.pieces[part.first_piece + std::min(piece, part.pieces - 1)].guided += each;
            reached = std::max(0.0, reached - each);
        }
        count = std::max(fewest, count / 2);
    }
    flight.is_guided = true;
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

std::optional<PixelFlight> pixel_flight(const Scene& scene, const Vec2i& pixel, const guide::Fields* fields,
                                        Pcg32& random) {
    const std::vector<RayPart> parts = pixel_ray(scene, pixel);
    if (parts.empty()) {
        return std::nullopt;
    }
    PixelFlight flight;
    follow(parts, farthest(scene, fields, parts.front().ray.origin), flight);
    const auto in_media = std::count_if(flight.parts.begin(), flight.parts.end(),
                                        [](const FlightPart& part) { return part.medium != vacuum; });
    // A power of two, so that a plot can join pieces.
    const auto pieces = std::max(4u, std::bit_floor(256u / std::max(1u, static_cast<unsigned>(in_media))));
    Rgb passed(1.0f);
    for (FlightPart& part : flight.parts) {
        part.reached = static_cast<double>(mean_value(passed));
        if (part.medium != vacuum && part.end > part.begin) {
            add_pieces(scene, static_cast<int>(pieces), fields, passed, random, part, flight);
        }
    }
    flight.reaches_end = static_cast<double>(mean_value(passed));
    if (fields && fields->volume.is_trained()) {
        draw_guided(scene, *fields, flight);
    }
    if (flight.surface && fields) {
        const Vec3& n = flight.surface->normal;
        const Vec3 facing = dot(n, flight.ray.direction) < 0 ? n : -n;
        flight.end_brings =
            flight.reaches_end * static_cast<double>(fields->surface.leaving(flight.surface->position, facing));
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
