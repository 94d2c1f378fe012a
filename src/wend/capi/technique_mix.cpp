#include <wend/capi/boundary.h>
#include <wend/capi/interior.h>
#include <wend/subsurface/technique_mixes.h>

#include <cmath>
#include <span>
#include <vector>

using namespace wend;
using namespace wend::capi;

struct wend_technique_mixes {
    TechniqueMixes value;
};

namespace {

InteriorGuide::PerTechnique to_densities(const float* densities) {
    require(densities, "relative densities are null");
    for (int i = 0; i < 2; ++i) {
        require_weight(densities[i], "a relative density");
    }
    return {densities[0], densities[1]};
}

wend_next_event from(const NextEventSettings& settings) {
    return {settings.preference, settings.probability};
}

void bring(wend_technique_record* record, float light, float by_connections, const MixGradient& gradient) {
    require(record, "the record is null");
    require_weight(light, "the light");
    require(by_connections >= 0 && by_connections <= 1, "the part of connections must be in [0,1]");
    record->brought += light;
    record->slope[0] += light * gradient.shares[0];
    record->slope[1] += light * gradient.shares[1];
    record->preference_slope += light * gradient.preference;
}

InteriorWalkRecord to_record(const wend_technique_record& record) {
    require((record.guided == 0 || record.guided == 1) && (record.connected == 0 || record.connected == 1),
            "guided and connected must be 0 or 1");
    require(record.flights >= 0, "the number of flights must not be negative");
    InteriorWalkRecord result;
    result.entry = to_position(record.entry, "the entry");
    result.guided = record.guided == 1;
    result.connected = record.connected == 1;
    result.flights = record.flights;
    result.brought = record.brought;
    result.relative = to_densities(record.relative);
    result.slope = {to_densities(record.slope), record.preference_slope};
    return result;
}

}  // namespace

wend_status wend_technique_record_begin(wend_vec3 entry, int guided, wend_technique_record* record,
                                        wend_error* error) noexcept {
    return guarded(error, [&] {
        require(guided == 0 || guided == 1, "guided must be 0 or 1");
        require(record, "the place for the record is null");
        to_position(entry, "the entry");
        *record = {};
        record->entry = entry;
        record->guided = guided;
        return WEND_OK;
    });
}

wend_status wend_technique_record_hit(wend_technique_record* record, float light, const float before[2],
                                      const float now[2], float by_connections, wend_error* error) noexcept {
    return guarded(error, [&] {
        bring(record, light, by_connections, gradient_of_hit(to_densities(before), to_densities(now), by_connections));
        return WEND_OK;
    });
}

wend_status wend_technique_record_connection(wend_technique_record* record, float light, const float here[2],
                                             const float towards[2], float by_connections, wend_error* error) noexcept {
    return guarded(error, [&] {
        bring(record, light, by_connections,
              gradient_of_connection(to_densities(here), to_densities(towards), by_connections));
        return WEND_OK;
    });
}

wend_status wend_technique_mixes_create(wend_bounds bounds, float classical_share, wend_technique_mixes** mixes,
                                        wend_error* error) noexcept {
    return guarded(error, [&] {
        require(classical_share > 0 && classical_share <= 1, "the share of classical sampling must be in (0,1]");
        require(mixes, "the place for the mixes is null");
        *mixes = new wend_technique_mixes{TechniqueMixes(to_box(bounds), classical_share)};
        return WEND_OK;
    });
}

void wend_technique_mixes_destroy(wend_technique_mixes* mixes) noexcept {
    delete mixes;
}

wend_status wend_technique_mixes_at(const wend_technique_mixes* mixes, wend_vec3 entry, wend_technique_mix* mix,
                                    wend_error* error) noexcept {
    return guarded(error, [&] {
        require(mixes, "the mixes are null");
        require(mix, "the place for the mix is null");
        const TechniqueMix& plan = mixes->value.plan(mixes->value.cell_at(to_position(entry, "the entry")));
        *mix = {plan.defensive_fraction, plan.unguided_probability, from(plan.guided), from(plan.unguided)};
        return WEND_OK;
    });
}

wend_status wend_technique_mixes_learn(wend_technique_mixes* mixes, const wend_technique_record* records, size_t count,
                                       int is_last, wend_error* error) noexcept {
    return guarded(error, [&] {
        require(mixes, "the mixes are null");
        require(records || count == 0, "the records are null");
        require(is_last == 0 || is_last == 1, "is_last must be 0 or 1");
        std::vector<InteriorWalkRecord> walks;
        walks.reserve(count);
        for (const wend_technique_record& record : std::span(records, count)) {
            walks.push_back(to_record(record));
        }
        mixes->value.learn_from(walks, is_last == 1 ? NextWalks::rendering : NextWalks::beside_classical);
        return WEND_OK;
    });
}
