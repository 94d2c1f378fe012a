#include <wend/app/field_place.h>

#include <wend/app/options.h>
#include <wend/app/text_table.h>
#include <wend/core/error.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace wend {
namespace {

double distance_to(const Box3& box, const Vec3& p) {
    Vec3 off(0, 0, 0);
    for (int axis = 0; axis < 3; ++axis) {
        off[axis] = std::max({box.min[axis] - p[axis], p[axis] - box.max[axis], 0.0f});
    }
    return static_cast<double>(length(off));
}

}  // namespace

FieldPlace field_place(const FieldPart& part, const Vec3& position, const std::string& file) {
    const guide::Region* region = part.field->find(position);
    if (!region) {
        throw InputError(fmt::format("{}: the {} field has learned nothing", file, part.name));
    }
    FieldPlace place{part, position, distance_to(part.field->bounds(), position), region, region->incident(position),
                     {},   0};
    const auto sums = part.field->lobe_sums(position);
    place.lobe_sums.assign(sums.begin(), sums.begin() + place.incident.size());
    place.connected_fluence = part.field->scattered_light(position)->connected.fluence;
    return place;
}

std::string outside_text(const FieldPlace& place) {
    if (!(place.outside > 0)) {
        return {};
    }
    const Box3& b = place.part.field->bounds();
    return fmt::format(
        "{:.4g} {:.4g} {:.4g} is {:.4g} outside of the {} field, which reaches from {:.4g} {:.4g} {:.4g} to {:.4g} "
        "{:.4g} {:.4g}: what follows is of the cell at its rim",
        place.position.x, place.position.y, place.position.z, place.outside, place.part.name, b.min.x, b.min.y, b.min.z,
        b.max.x, b.max.y, b.max.z);
}

std::vector<LobeFacts> lobe_facts(const FieldPlace& place) {
    std::vector<LobeFacts> facts;
    for (int i = 0; i < place.incident.size(); ++i) {
        const auto [weight, vmf] = place.incident.lobe(i);
        const double inverse = static_cast<double>(place.region->inverse_distance()[i]);
        const guide::LobeSums& seen = place.lobe_sums[static_cast<std::size_t>(i)];
        LobeFacts& lobe = facts.emplace_back();
        lobe.share = weight;
        lobe.mean = vmf.mean;
        lobe.concentration = vmf.kappa;
        lobe.distance = inverse > 0 ? std::optional(1 / inverse) : std::nullopt;
        lobe.records = guide::effective_records(seen);
        lobe.misfit = guide::misfit(seen, place.region->mixture().lobe(i).vmf).total();
        lobe.colour = place.region->colours()[i];
    }
    return facts;
}

std::string lobe_table(const FieldPlace& place) {
    std::vector<std::vector<std::string>> rows = {
        {"lobe", "share", "towards", "concentration", "distance", "records", "misfit", "colour"}};
    for (const LobeFacts& lobe : lobe_facts(place)) {
        rows.push_back({std::to_string(rows.size()), fmt::format("{:.4f}", lobe.share),
                        fmt::format("{:.3f} {:.3f} {:.3f}", lobe.mean.x, lobe.mean.y, lobe.mean.z),
                        fmt::format("{:.4g}", lobe.concentration),
                        lobe.distance ? fmt::format("{:.4g}", *lobe.distance) : "far",
                        fmt::format("{:.1f}", lobe.records), fmt::format("{:.3f}", lobe.misfit),
                        fmt::format("{:.2f} {:.2f} {:.2f}", lobe.colour.r, lobe.colour.g, lobe.colour.b)});
    }
    return text_table(rows);
}

nlohmann::json place_json(const FieldPlace& place) {
    nlohmann::json lobes = nlohmann::json::array();
    for (const LobeFacts& lobe : lobe_facts(place)) {
        lobes.push_back({{"weight", lobe.share},
                         {"mean", json_vector(lobe.mean)},
                         {"kappa", lobe.concentration},
                         {"records", json_number(lobe.records)},
                         {"misfit", json_number(lobe.misfit)},
                         {"colour", {lobe.colour.r, lobe.colour.g, lobe.colour.b}},
                         {"distance", lobe.distance ? nlohmann::json(*lobe.distance) : nlohmann::json(nullptr)}});
    }
    return {{"position", json_vector(place.position)},
            {"part", place.part.name},
            {"outside", place.outside},
            {"fluence", place.region->fluence()},
            {"classical_share", place.region->defensive_fraction()},
            {"connected_fluence", place.connected_fluence},
            {"reference", json_vector(place.region->reference())},
            {"lobes", std::move(lobes)}};
}

}  // namespace wend
