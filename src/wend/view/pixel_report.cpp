#include <wend/view/pixel_report.h>

#include <wend/core/random.h>
#include <wend/io/json_text.h>
#include <wend/view/direction_bins.h>
#include <wend/view/pixel_flight.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace wend {
namespace {

using Json = nlohmann::json;

// Of the plots.
constexpr std::size_t flight_bins = 64;
constexpr DirectionBins bins_of_records{64, 32};
constexpr std::size_t most_cells = 160;

/// The part of the flight that a pixel's walks begin with. Through vacuum nothing happens: what counts is the flight
/// that begins at the first boundary. There a ray may meet two triangles in their edge.
const FlightPart& first_segment(const PixelFlight& flight) {
    const auto counts = [](const FlightPart& part) {
        return !part.ends_at_interface || (part.medium != vacuum && part.hit->distance > part.hit->clearance);
    };
    const auto found = std::find_if(flight.parts.begin(), flight.parts.end(), counts);
    return found == flight.parts.end() ? flight.parts.back() : *found;
}

Json segment_json(const FlightPart& segment) {
    const char* end = !segment.hit ? "nothing" : segment.ends_at_interface ? "interface" : "surface";
    return {{"origin", json_vector(segment.ray.origin)},
            {"direction", json_vector(segment.ray.direction)},
            {"length", segment.hit ? json_number(segment.hit->distance) : Json(nullptr)},
            {"end", end},
            {"in_medium", segment.medium != vacuum}};
}

/// Where flights that begin at a segment end, by the length of its pieces.
struct Ends {
    std::vector<double> shares;
    double scatters = 0;  ///< their sum
};

Ends ends_of(const PixelFlight& flight, const FlightPart& segment, double FlightPiece::*probability, double reached) {
    Ends ends;
    for (const FlightPiece& piece : flight.pieces_of(segment)) {
        ends.shares.push_back(reached > 0 ? piece.*probability / reached : 0.0);
        ends.scatters += ends.shares.back();
    }
    return ends;
}

Json ends_json(const Ends& ends) {
    const std::size_t joined = std::max<std::size_t>(1, ends.shares.size() / flight_bins);
    std::vector<double> sums(ends.shares.size() / joined);
    for (std::size_t i = 0; i < ends.shares.size(); ++i) {
        sums[i / joined] += ends.shares[i];
    }
    std::vector<int> bins;
    std::transform(sums.begin(), sums.end(), std::back_inserter(bins),
                   [](double share) { return static_cast<int>(std::lround(guided_flights * share)); });
    return {{"scatters", json_number(ends.scatters)}, {"bins", bins}};
}

/// Where a flight of these most likely ends: in the middle of its collisions, or at the surface.
std::optional<float> likely_end(const Ends& ends, double length) {
    if (ends.scatters < 0.5) {
        return std::nullopt;
    }
    const double half = 0.5 * ends.scatters, pieces = static_cast<double>(ends.shares.size());
    double sum = 0;
    std::size_t i = 0;
    while (i + 1 < ends.shares.size() && sum + ends.shares[i] < half) {
        sum += ends.shares[i++];
    }
    const double within = std::clamp((half - sum) / ends.shares[i], 0.0, 1.0);
    return static_cast<float>(length * (static_cast<double>(i) + within) / pieces);
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
    Pcg32 random(0);
    const std::optional<PixelFlight> flight = pixel_flight(scene, question.pixel, question.fields, random);
    if (!flight) {
        return nullptr;
    }
    const FlightPart& segment = first_segment(*flight);
    Json report = {{"segment", segment_json(segment)},
                   {"flight", nullptr},
                   {"at", nullptr},
                   {"guide", nullptr},
                   {"cells", nullptr}};
    std::optional<float> distance = question.distance;
    const bool has_flight = segment.pieces > 0;
    if (has_flight) {
        const Ends classical = ends_of(*flight, segment, &FlightPiece::collides, segment.reached);
        const Ends guided = ends_of(*flight, segment, &FlightPiece::guided, segment.guided_reached);
        const double shown = segment.end - segment.begin;
        report["flight"] = {{"length", json_number(shown)},
                            {"flights", guided_flights},
                            {"classical", ends_json(classical)},
                            {"guided", flight->is_guided ? ends_json(guided) : Json(nullptr)}};
        distance = distance ? distance : likely_end(flight->is_guided ? guided : classical, shown);
    }
    const float length = segment.hit ? segment.hit->distance : longest_segment;
    const bool is_surface = !has_flight || !distance || *distance >= length;
    if (is_surface && !segment.hit) {
        return report;
    }
    const float at = is_surface ? length : std::max(*distance, 0.0f);
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
