// What a guiding field says at a place.
#pragma once

#include <wend/app/field_vtk.h>
#include <wend/guide/lobe_revision.h>

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace wend {

struct FieldPlace {
    FieldPart part;
    Vec3 position;
    double outside = 0;  ///< how far from the part's bounds, in scene units; 0: within them
    const guide::Region* region;
    guide::VmfMixture incident;              ///< as seen from the position
    std::vector<guide::LobeSums> lobe_sums;  ///< of the lobes of `incident`
    float connected_fluence = 0;             ///< of what connections to lights found
};

/// Throws InputError, naming the file, where the part has learned nothing. The field must outlive it.
FieldPlace field_place(const FieldPart& part, const Vec3& position, const std::string& file);

/// That the place is outside of the bounds, in words; empty where it is not.
std::string outside_text(const FieldPlace& place);

/// What a lobe says, and how well it is known.
struct LobeFacts {
    float share = 0;  ///< of the fluence
    Vec3 mean;        ///< towards where its light comes from
    float concentration = 0;
    std::optional<double> distance;  ///< to its source, in scene units; none: far or not known
    double records = 0;              ///< of equal weight, that would know as much of it
    double misfit = 0;               ///< in nats
    Rgb colour;                      ///< over the mean of its channels
};
std::vector<LobeFacts> lobe_facts(const FieldPlace& place);

/// The lobes as a table.
std::string lobe_table(const FieldPlace& place);
/// All that is known of the place.
nlohmann::json place_json(const FieldPlace& place);

}  // namespace wend
