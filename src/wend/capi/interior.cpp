#include <wend/capi/interior.h>

#include <wend/capi/media.h>
#include <wend/capi/opaque.h>
#include <wend/core/vector.h>
#include <wend/subsurface/half_space_mode.h>
#include <wend/subsurface/interior_walk.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

using namespace wend;
using namespace wend::capi;

struct wend_interior_guide {
    InteriorGuide value;
};

struct wend_interior_lamps {
    std::vector<BoundaryEmitter> value;
};

namespace {

/// A walk, and how far it has been told what it needs.
struct Begun {
    InteriorWalk walk{};
    bool is_aimed = false;
    bool has_headed = false;
};
using Interior = Stored<Begun, 0x57454e44494e5431>;

const Begun& find(const wend_interior_walk* walk) {
    require_object(walk, "the walk is null");
    const Begun* begun = stored<Interior>(*walk);
    require(begun, "the walk has not entered: wend_interior_enter() comes first");
    return *begun;
}
const Begun& aimed(const wend_interior_walk* walk) {
    const Begun& begun = find(walk);
    require(begun.is_aimed, "the walk is not aimed: wend_interior_aim() comes before");
    return begun;
}
const Begun& headed(const wend_interior_walk* walk) {
    const Begun& begun = find(walk);
    require(begun.has_headed, "the walk has no direction: wend_interior_head() comes before");
    return begun;
}
/// The walk is changed in a copy, which is put in its place.
void put_back(const Begun& begun, wend_interior_walk& walk) {
    store<Interior>(walk, begun);
}

InteriorGuide solve(const wend_medium* medium, float classical_share) {
    const HomogeneousMedium made = to_medium(medium);
    require(max_value(made.scattering) > 0, "the medium must scatter");
    // Sums over the moments of what is still more peaked would not end.
    constexpr float most_peaked = 0.96f;
    for (const wend_phase_part& part : std::span(medium->phase, static_cast<std::size_t>(medium->phase_parts))) {
        require(std::abs(part.g) <= most_peaked, "the mean cosines must be within -0.96 and 0.96");
    }
    return interior_guide(made, half_space_modes(made), classical_share);
}

wend_status enter(const wend_interior_guide* guide, const float channels[3], float classical_share,
                  wend_interior_walk* walk) {
    constexpr float tolerance = 1e-3f;
    require(guide, "the guide is null");
    require(channels, "the probabilities of the channels are null");
    require_object(walk, "the place for the walk is null");
    require(classical_share > 0 && classical_share <= 1, "the share of classical sampling must be in (0,1]");
    const Rgb probabilities(channels[0], channels[1], channels[2]);
    require(min_value(probabilities) >= 0 && std::abs(3 * mean_value(probabilities) - 1) <= tolerance,
            "the probabilities of the channels must not be negative and have the sum 1");
    Begun begun;
    begun.walk.enter(guide->value, probabilities, classical_share);
    put_back(begun, *walk);
    return WEND_OK;
}

}  // namespace

wend_status wend_interior_guide_create(const wend_medium* medium, float classical_share, wend_interior_guide** guide,
                                       wend_error* error) noexcept {
    return guarded(error, [&] {
        require(guide, "the place for the guide is null");
        *guide = new wend_interior_guide{solve(medium, classical_share)};
        return WEND_OK;
    });
}

wend_status wend_interior_guide_create_for_lamps(const wend_medium* medium, float classical_share, int connects,
                                                 wend_interior_guide** guide, wend_error* error) noexcept {
    return guarded(error, [&] {
        require(guide, "the place for the guide is null");
        require(connects == 0 || connects == 1, "connects must be 0 or 1");
        InteriorGuide solved = solve(medium, classical_share);
        solved.heads_for_emitters = true;
        solved.connects_at_boundary = connects == 1;
        *guide = new wend_interior_guide{std::move(solved)};
        return WEND_OK;
    });
}

void wend_interior_guide_destroy(wend_interior_guide* guide) noexcept {
    delete guide;
}

wend_status wend_interior_lamps_create(const wend_interior_lamp* lamps, size_t count, wend_interior_lamps** made,
                                       wend_error* error) noexcept {
    return guarded(error, [&] {
        require(lamps || count == 0, "the lamps are null");
        require(count <= EmitterGuide::most, "there may be at most 4 lamps");
        require(made, "the place for the lamps is null");
        auto result = std::make_unique<wend_interior_lamps>();
        for (const wend_interior_lamp& lamp : std::span(lamps, count)) {
            require(lamp.concentration >= 0 && lamp.concentration <= Vmf::max_kappa,
                    "the concentration of a lamp must be 0 to 1e5");
            require(lamp.cosine > 0 && lamp.cosine <= 1, "the cosine of a lamp must be in (0,1]");
            require_weight(lamp.fluence, "the fluence of a lamp");
            const Vmf lobe{to_direction(lamp.direction, "the direction of a lamp"), lamp.concentration};
            result->value.push_back({lobe, lamp.cosine, lamp.fluence, vmf_peak(lobe.kappa)});
        }
        *made = result.release();
        return WEND_OK;
    });
}

void wend_interior_lamps_destroy(wend_interior_lamps* lamps) noexcept {
    delete lamps;
}

wend_status wend_interior_enter(const wend_interior_guide* guide, const float channels[3], wend_interior_walk* walk,
                                wend_error* error) noexcept {
    return guarded(error, [&] { return enter(guide, channels, guide ? guide->value.defensive_fraction : 1, walk); });
}

wend_status wend_interior_enter_with(const wend_interior_guide* guide, const float channels[3], float classical_share,
                                     wend_interior_walk* walk, wend_error* error) noexcept {
    return guarded(error, [&] { return enter(guide, channels, classical_share, walk); });
}

wend_status wend_interior_aim(wend_interior_walk* walk, wend_vec3 normal, float steepness, wend_error* error) noexcept {
    return guarded(error, [&] {
        Begun begun = find(walk);
        require(steepness >= 0 && steepness <= 1, "the steepness must be in [0,1]");
        begun.walk.aim(to_direction(normal, "the normal"), steepness);
        begun.is_aimed = true;
        put_back(begun, *walk);
        return WEND_OK;
    });
}

wend_status wend_interior_aim_lamps(wend_interior_walk* walk, const wend_interior_lamps* lamps, float depth,
                                    const float diffuse[3], wend_error* error) noexcept {
    return guarded(error, [&] {
        Begun begun = aimed(walk);
        require(lamps, "the lamps are null");
        require_length(depth);
        require(diffuse, "the diffuse radiance is null");
        for (int c = 0; c < 3; ++c) {
            require_weight(diffuse[c], "the diffuse radiance");
        }
        begun.walk.aim(EmitterView{lamps->value, depth, Rgb(diffuse[0], diffuse[1], diffuse[2])});
        put_back(begun, *walk);
        return WEND_OK;
    });
}

wend_status wend_interior_head(wend_interior_walk* walk, wend_vec3 direction, wend_error* error) noexcept {
    return guarded(error, [&] {
        Begun begun = aimed(walk);
        begun.walk.head(to_direction(direction, "the direction"));
        begun.has_headed = true;
        put_back(begun, *walk);
        return WEND_OK;
    });
}

wend_status wend_interior_draw_distance(const wend_interior_walk* walk, float u, float* distance,
                                        wend_error* error) noexcept {
    return guarded(error, [&] {
        const Begun& begun = headed(walk);
        require_uniform(u);
        require(distance, "the place for the distance is null");
        *distance = begun.walk.draw_distance(u);
        return WEND_OK;
    });
}

wend_status wend_interior_fly(wend_interior_walk* walk, float length, float drawn, wend_interior_flight* flight,
                              wend_error* error) noexcept {
    return guarded(error, [&] {
        Begun begun = headed(walk);
        require_length(length);
        require(drawn >= 0, "the distance that was drawn must not be negative");
        require(flight, "the place for the flight is null");
        const InteriorFlight flown = begun.walk.fly(length, drawn);
        put_back(begun, *walk);
        flight->scatters = flown.flight.scatters ? 1 : 0;
        flight->distance = flown.flight.distance;
        put(flown.flight.weight, flight->weight);
        flight->pass_probability = flown.pass_probability;
        return WEND_OK;
    });
}

wend_status wend_interior_pass(wend_interior_walk* walk, float length, float* probability, wend_error* error) noexcept {
    return guarded(error, [&] {
        Begun begun = headed(walk);
        require_length(length);
        require(probability, "the place for the probability is null");
        *probability = begun.walk.pass(length);
        put_back(begun, *walk);
        return WEND_OK;
    });
}

wend_status wend_interior_sample(const wend_interior_walk* walk, wend_vec3 before, float choice, float u, float v,
                                 uint64_t key, wend_interior_direction* direction, wend_error* error) noexcept {
    return guarded(error, [&] {
        const Begun& begun = headed(walk);
        require_uniform(choice);
        require_uniform(u);
        require_uniform(v);
        require(direction, "the place for the direction is null");
        Pcg32 random(key);
        const InteriorWalk::Directions directions(begun.walk, to_direction(before, "the direction before"), random);
        const auto s = directions.sample(choice, {u, v});
        *direction = {from_vector(s->direction), s->weight().r, s->density};
        return WEND_OK;
    });
}

wend_status wend_interior_density(const wend_interior_walk* walk, wend_vec3 before, wend_vec3 direction, float* density,
                                  wend_error* error) noexcept {
    return guarded(error, [&] {
        const Begun& begun = headed(walk);
        require(density, "the place for the density is null");
        Pcg32 unused(0);
        const InteriorWalk::Directions directions(begun.walk, to_direction(before, "the direction before"), unused);
        *density = directions.density(to_direction(direction, "the direction"));
        return WEND_OK;
    });
}

wend_status wend_interior_sample_lamps(const wend_interior_walk* walk, wend_vec3 before, uint64_t key,
                                       wend_vec3* direction, int* found, wend_error* error) noexcept {
    return guarded(error, [&] {
        const Begun& begun = headed(walk);
        require(direction, "the place for the direction is null");
        require(found, "the place for the answer is null");
        Pcg32 random(key);
        const InteriorWalk::Directions directions(begun.walk, to_direction(before, "the direction before"), random);
        const auto w = directions.sample_emitters();
        *found = w ? 1 : 0;
        *direction = from_vector(w.value_or(Vec3(0, 0, 0)));
        return WEND_OK;
    });
}

wend_status wend_interior_lamps_density(const wend_interior_walk* walk, wend_vec3 before, wend_vec3 direction,
                                        float* density, wend_error* error) noexcept {
    return guarded(error, [&] {
        const Begun& begun = headed(walk);
        require(density, "the place for the density is null");
        Pcg32 unused(0);
        const InteriorWalk::Directions directions(begun.walk, to_direction(before, "the direction before"), unused);
        *density = directions.emitter_density(to_direction(direction, "the direction"));
        return WEND_OK;
    });
}

wend_status wend_interior_turn(wend_interior_walk* walk, wend_vec3 before, wend_vec3 direction,
                               wend_error* error) noexcept {
    return guarded(error, [&] {
        Begun begun = headed(walk);
        Pcg32 unused(0);
        const InteriorWalk::Directions directions(begun.walk, to_direction(before, "the direction before"), unused);
        begun.walk.turn(directions, to_direction(direction, "the direction"));
        put_back(begun, *walk);
        return WEND_OK;
    });
}

wend_status wend_interior_has_turned(const wend_interior_walk* walk, int* has_turned, wend_error* error) noexcept {
    return guarded(error, [&] {
        const Begun& begun = find(walk);
        require(has_turned, "the place for the answer is null");
        *has_turned = begun.walk.has_turned() ? 1 : 0;
        return WEND_OK;
    });
}

wend_status wend_interior_survival(wend_interior_walk* walk, float throughput, float* probability,
                                   wend_error* error) noexcept {
    return guarded(error, [&] {
        Begun begun = headed(walk);
        require_weight(throughput, "the throughput");
        require(probability, "the place for the probability is null");
        *probability = begun.walk.survival(throughput);
        put_back(begun, *walk);
        return WEND_OK;
    });
}

wend_status wend_interior_relative_densities(const wend_interior_walk* walk, float relative[2],
                                             wend_error* error) noexcept {
    return guarded(error, [&] {
        const Begun& begun = headed(walk);
        require(relative, "the place for the densities is null");
        const InteriorGuide::PerTechnique densities = begun.walk.relative_densities();
        std::copy(densities.begin(), densities.end(), relative);
        return WEND_OK;
    });
}
