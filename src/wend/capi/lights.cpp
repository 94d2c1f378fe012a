#include <wend/capi/boundary.h>
#include <wend/capi/decisions.h>
#include <wend/decision/learned_lights.h>

#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

using namespace wend;
using namespace wend::capi;

struct wend_lights {
    LearnedLights value;
    std::size_t count;
};

namespace {

/// A choice by probabilities at one receiver.
struct GivenChoice {
    std::span<const float> probabilities;

    float probability(const LightReceiver&, int light) const { return probabilities[static_cast<std::size_t>(light)]; }
    ChosenLight sample(const LightReceiver&, float u) const {
        // Of rounding, which may leave the sum below 1, the last light that can be chosen has the rest.
        ChosenLight chosen;
        for (std::size_t i = 0; i < probabilities.size(); ++i) {
            if (probabilities[i] > 0) {
                chosen = {static_cast<int>(i), probabilities[i]};
                if (u < probabilities[i]) {
                    break;
                }
            }
            u -= probabilities[i];
        }
        return chosen;
    }
};
/// A choice by the probability of the one light that is asked for.
struct GivenProbability {
    float given;

    float probability(const LightReceiver&, int) const { return given; }
    ChosenLight sample(const LightReceiver&, float) const { return {}; }
};

LightReceiver to_receiver(const wend_light_receiver* receiver) {
    require(receiver, "the receiver is null");
    const Vec3 normal = to_vector(receiver->normal);
    return {to_position(receiver->position, "the position"),
            normal == Vec3(0, 0, 0) ? normal : to_direction(receiver->normal, "the normal")};
}

wend_light_receiver from_receiver(const LightReceiver& receiver) {
    return {from_vector(receiver.position), from_vector(receiver.normal)};
}

bool is_probability(float p) {
    return p >= 0 && p <= 1;
}

std::span<const float> to_choice(const float* first, std::size_t count) {
    constexpr double tolerance = 1e-3;
    require(first, "the probabilities of the first choice are null");
    double sum = 0;
    for (const float p : std::span(first, count)) {
        require(is_probability(p), "the probabilities of the first choice must be in [0,1]");
        sum += static_cast<double>(p);
    }
    require(sum == 0 || std::abs(sum - 1) <= tolerance, "the probabilities of the first choice must have the sum 1");
    return {first, count};
}

void require_light(const wend_lights* lights, int light) {
    require(lights, "the lights are null");
    require(light >= 0 && static_cast<std::size_t>(light) < lights->count, "there is no light of this number");
}

}  // namespace

wend_status wend_lights_create(wend_bounds bounds, size_t count, wend_lights** lights, wend_error* error) noexcept {
    return guarded(error, [&] {
        require(lights, "the place for the lights is null");
        require(count >= 1 && count <= LearnedLights::most_lights, "choices are learned of 1 to 256 lights");
        *lights = new wend_lights{LearnedLights(to_box(bounds), count), count};
        return WEND_OK;
    });
}

void wend_lights_destroy(wend_lights* lights) noexcept {
    delete lights;
}

wend_status wend_lights_sample(const wend_lights* lights, const wend_light_receiver* receiver, const float* first,
                               float u, int* light, float* probability, wend_error* error) noexcept {
    return guarded(error, [&] {
        require(lights, "the lights are null");
        require(light && probability, "the place for the light or its probability is null");
        require_uniform(u);
        const ChosenLight chosen =
            lights->value.sample(GivenChoice{to_choice(first, lights->count)}, to_receiver(receiver), u);
        *light = chosen.index;
        *probability = chosen.probability;
        return WEND_OK;
    });
}

wend_status wend_lights_probability(const wend_lights* lights, const wend_light_receiver* receiver, int light,
                                    float first, float* probability, wend_error* error) noexcept {
    return guarded(error, [&] {
        require_light(lights, light);
        require(is_probability(first), "the probability of the first choice must be in [0,1]");
        require(probability, "the place for the probability is null");
        *probability = lights->value.probability(GivenProbability{first}, to_receiver(receiver), light);
        return WEND_OK;
    });
}

wend_status wend_lights_record(const wend_lights* lights, const wend_light_receiver* receiver, int light, float brought,
                               wend_light_record* record, wend_error* error) noexcept {
    return guarded(error, [&] {
        require_light(lights, light);
        require(!(brought < 0), "what a connection brought must not be negative");
        require(record, "the place for the record is null");
        const LightRecord made = lights->value.record(to_receiver(receiver), light, brought);
        *record = {made.cell, made.light, made.brought};
        return WEND_OK;
    });
}

wend_status wend_lights_add(wend_lights* lights, const wend_light_record* records, size_t count,
                            wend_error* error) noexcept {
    return guarded(error, [&] {
        require(lights, "the lights are null");
        require(records || count == 0, "the records are null");
        std::vector<LightRecord> copies;
        copies.reserve(count);
        for (const wend_light_record& r : std::span(records, count)) {
            require(r.cell < VertexCells::count && r.light < lights->count && !(r.brought < 0),
                    "a record of a connection was not made for these lights");
            copies.push_back({r.cell, r.light, r.brought});
        }
        lights->value.add(copies);
        return WEND_OK;
    });
}

wend_status wend_lights_learn(wend_lights* lights, wend_first_choice first, void* user, int threads,
                              wend_error* error) noexcept {
    return guarded(error, [&] {
        require(lights, "the lights are null");
        require(first, "the first choice is null");
        require_threads(threads);
        LearnedLights next = lights->value;
        next.learn(
            [&](const LightReceiver& receiver, int light) {
                const wend_light_receiver asked = from_receiver(receiver);
                const float probability = first(user, &asked, light);
                require(is_probability(probability), "the first choice's answers must be in [0,1]");
                return probability;
            },
            threads);
        lights->value = std::move(next);
        return WEND_OK;
    });
}
