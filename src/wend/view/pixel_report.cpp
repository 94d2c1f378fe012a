#include <wend/core/random.h>
#include <wend/decision/guided_distance.h>
#include <wend/io/json_text.h>
#include <wend/light/beams.h>
#include <wend/render/preset.h>
#include <wend/view/direction_bins.h>
#include <wend/view/pixel_ray.h>
#include <wend/view/pixel_report.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace wend {
namespace {

using Json = nlohmann::json;

// Of the plots.
constexpr std::size_t flight_bins = 64;
constexpr int flights = 4096;
constexpr DirectionBins bins_of_records{64, 32};
constexpr std::size_t most_cells = 160;

/// The first flight of a pixel: from the camera to the first surface or interface.
struct Segment : RayPart {
    float length = longest_segment;
    float shown = 0;  ///< of the length, what is worth showing
};

/// How far a ray goes before it leaves a box, or 0.
float way_through(const Box3& box, const Ray& ray) {
    float t_in = 0, t_out = infinity;
    for (int axis = 0; axis < 3; ++axis) {
        const float a = (box.min[axis] - ray.origin[axis]) / ray.direction[axis];
        const float b = (box.max[axis] - ray.origin[axis]) / ray.direction[axis];
        t_in = std::max(t_in, std::min(a, b));
        t_out = std::min(t_out, std::max(a, b));
    }
    return t_in < t_out && std::isfinite(t_out) ? t_out : 0.0f;
}

/// None where the camera lets no light through. Through vacuum nothing happens: what counts is the flight that begins
/// at the first boundary. There a ray may meet two triangles in their edge.
std::optional<Segment> first_segment(const Scene& scene, const Vec2i& pixel) {
    const std::vector<RayPart> parts = pixel_ray(scene, pixel);
    if (parts.empty()) {
        return std::nullopt;
    }
    const auto counts = [](const RayPart& part) {
        return !part.ends_at_interface || (part.medium != vacuum && part.hit->distance > part.hit->clearance);
    };
    const auto found = std::find_if(parts.begin(), parts.end(), counts);
    const RayPart& part = found == parts.end() ? parts.back() : *found;
    Segment segment{part, longest_segment, 0};
    if (part.hit) {
        segment.length = segment.shown = part.hit->distance;
    } else {
        segment.shown = way_through(scene.bounds(), part.ray);
    }
    return segment;
}

Json segment_json(const Segment& segment) {
    const char* end = !segment.hit ? "nothing" : segment.ends_at_interface ? "interface" : "surface";
    return {{"origin", json_vector(segment.ray.origin)},
            {"direction", json_vector(segment.ray.direction)},
            {"length", segment.hit ? json_number(segment.length) : Json(nullptr)},
            {"end", end},
            {"in_medium", segment.medium != vacuum}};
}

/// Where flights end, as drawn with evenly spread random numbers.
struct Ends {
    std::vector<float> distances;  ///< of collisions
    std::array<int, flight_bins> bins{};

    double share() const { return static_cast<double>(distances.size()) / flights; }
    Json json() const { return {{"scatters", share()}, {"bins", bins}}; }
};

template <class Distance>
Ends draw(const Distance& distance, const Medium& medium, const FlightStart& start, float shown) {
    Ends ends;
    Pcg32 random(0);
    for (int i = 0; i < flights; ++i) {
        const Flight flight =
            distance.sample(medium, start, (static_cast<float>(i) + 0.5f) / static_cast<float>(flights), random);
        if (flight.scatters) {
            ends.distances.push_back(flight.distance);
            const auto bin = static_cast<std::size_t>(flight.distance / shown * static_cast<float>(flight_bins));
            if (bin < flight_bins) {
                ++ends.bins[bin];
            }
        }
    }
    return ends;
}

struct FlightEnds {
    Ends classical;
    std::optional<Ends> guided;
};

FlightEnds ends_of_flights(const Scene& scene, const Segment& segment, const guide::Fields* fields) {
    const Medium& medium = scene.medium(segment.medium);
    FlightStart start;
    start.ray = segment.ray;
    start.length = segment.length;
    if (segment.hit) {
        const Vec3 normal = segment.hit->normal;
        start.end = {segment.ends_at_interface ? FlightEnd::Kind::interface : FlightEnd::Kind::surface,
                     segment.hit->position, dot(normal, segment.ray.direction) < 0 ? normal : -normal, 0};
    }
    FlightEnds ends{draw(ClassicalDistance(), medium, start, segment.shown), std::nullopt};
    if (fields && fields->volume.is_trained()) {
        const std::vector<Beam> beams = beams_of(scene.lights());
        ends.guided = draw(GuidedDistance(&fields->surface, &fields->volume, classical_flights,
                                          DistanceGuiding::scatter_and_distance, std::span<const Beam>(beams)),
                           medium, start, segment.shown);
    }
    return ends;
}

/// Where a flight of these most likely ends: in the middle of its collisions, or at the surface.
std::optional<float> likely_end(const FlightEnds& ends) {
    std::vector<float> distances = (ends.guided ? *ends.guided : ends.classical).distances;
    if (2 * distances.size() < flights) {
        return std::nullopt;
    }
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    return *middle;
}

Json radiance_of_records(const guide::Records& records) {
    Json map = Json::array();
    for (const float radiance : radiance_by_direction(records, bins_of_records)) {
        map.push_back(json_number(radiance));
    }
    return {{"count", records.size()},
            {"around", bins_of_records.columns},
            {"down", bins_of_records.rows},
            {"radiance", std::move(map)}};
}

Json guide_json(const guide::Field& field, const Vec3& position, const SharedRecords* records, bool is_surface) {
    const guide::Region* region = field.find(position);
    if (!region) {
        return nullptr;
    }
    const guide::VmfMixture incident = region->incident(position);
    Json lobes = Json::array();
    for (int i = 0; i < incident.size(); ++i) {
        const auto [weight, vmf] = incident.lobe(i);
        const auto inverse = static_cast<double>(region->inverse_distance()[i]);
        const Rgb colour = region->colours()[i];
        lobes.push_back({{"weight", json_number(weight)},
                         {"mean", json_vector(vmf.mean)},
                         {"kappa", json_number(vmf.kappa)},
                         {"colour", {json_number(colour.r), json_number(colour.g), json_number(colour.b)}},
                         {"distance", inverse > 0 ? json_number(1 / inverse) : Json(nullptr)}});
    }
    const Box3& bounds = field.bounds();
    bool is_inside = true;
    for (int axis = 0; axis < 3; ++axis) {
        is_inside = is_inside && position[axis] >= bounds.min[axis] && position[axis] <= bounds.max[axis];
    }
    return {{"fluence", json_number(region->fluence())},
            {"classical_share", json_number(region->defensive_fraction())},
            {"is_inside", is_inside},
            {"lobes", std::move(lobes)},
            {"records", records ? radiance_of_records(records->in(field, region, is_surface)) : Json(nullptr)}};
}

/// The cells nearest to a point.
Json cells_json(const guide::Field& field, const Vec3& position) {
    struct Cell {
        Box3 box;
        float distance, fluence, classical_share;
        double records;
        bool is_here;
    };
    std::vector<Cell> cells;
    const guide::Region* here = field.find(position);
    field.for_each_cell([&](const Box3& box, const guide::Region& region, double records) {
        Vec3 away(0, 0, 0);
        for (int axis = 0; axis < 3; ++axis) {
            away[axis] = std::max({box.min[axis] - position[axis], position[axis] - box.max[axis], 0.0f});
        }
        cells.push_back({box, length(away), region.fluence(), region.defensive_fraction(), records, &region == here});
    });
    const auto end = cells.begin() + static_cast<std::ptrdiff_t>(std::min(cells.size(), most_cells));
    std::partial_sort(cells.begin(), end, cells.end(),
                      [](const Cell& a, const Cell& b) { return a.distance < b.distance; });
    Json list = Json::array();
    for (auto cell = cells.begin(); cell != end; ++cell) {
        list.push_back({{"min", json_vector(cell->box.min)},
                        {"max", json_vector(cell->box.max)},
                        {"fluence", json_number(cell->fluence)},
                        {"classical_share", json_number(cell->classical_share)},
                        {"records", json_number(cell->records)},
                        {"is_here", cell->is_here}});
    }
    return {{"all", cells.size()}, {"nearest", std::move(list)}};
}

}  // namespace

void SharedRecords::add(std::span<const guide::PathRecords> records) {
    const std::lock_guard lock(mutex_);
    samples_.add(records);
}

guide::Records SharedRecords::in(const guide::Field& field, const guide::Region* region, bool is_surface) const {
    const std::lock_guard lock(mutex_);
    return records_in(is_surface ? samples_.surface : samples_.volume, field, region);
}

Json pixel_report(const Scene& scene, const PixelQuestion& question) {
    const std::optional<Segment> first = first_segment(scene, question.pixel);
    if (!first) {
        return nullptr;
    }
    const Segment& segment = *first;
    Json report = {{"segment", segment_json(segment)},
                   {"flight", nullptr},
                   {"at", nullptr},
                   {"guide", nullptr},
                   {"cells", nullptr}};
    std::optional<float> distance = question.distance;
    const bool has_flight = segment.medium != vacuum && segment.shown > 0;
    if (has_flight) {
        const FlightEnds ends = ends_of_flights(scene, segment, question.fields);
        report["flight"] = {{"length", json_number(segment.shown)},
                            {"flights", flights},
                            {"classical", ends.classical.json()},
                            {"guided", ends.guided ? ends.guided->json() : Json(nullptr)}};
        distance = distance ? distance : likely_end(ends);
    }
    const bool is_surface = !has_flight || !distance || *distance >= segment.length;
    if (is_surface && !segment.hit) {
        return report;
    }
    const float at = is_surface ? segment.length : std::max(*distance, 0.0f);
    const Vec3 position = is_surface ? segment.hit->position : segment.ray.origin + segment.ray.direction * at;
    report["at"] = {{"distance", json_number(at)},
                    {"position", json_vector(position)},
                    {"part", is_surface ? "surface" : "volume"},
                    {"normal", is_surface ? json_vector(segment.hit->normal) : Json(nullptr)}};
    if (question.fields) {
        const guide::Field& field = is_surface ? question.fields->surface : question.fields->volume;
        report["guide"] = guide_json(field, position, question.records, is_surface);
        report["cells"] = field.is_trained() ? cells_json(field, position) : Json(nullptr);
    }
    return report;
}

}  // namespace wend
