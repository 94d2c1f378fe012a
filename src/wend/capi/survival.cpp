#include <wend/capi/boundary.h>
#include <wend/capi/decisions.h>
#include <wend/decision/roulette_splitting.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

using namespace wend;
using namespace wend::capi;

namespace {

AdjointRouletteSplitting to_decision(const wend_survival_settings* settings) {
    require(settings, "the settings are null");
    require(settings->sample_variance >= 0, "the variance of a sample must not be negative");
    return {settings->roulette != 0, settings->splitting != 0, settings->sample_variance};
}

ExpectedContribution to_contribution(const wend_expected_contribution* contribution) {
    require(contribution, "the expected contribution is null");
    require(!std::isnan(contribution->ratio), "the ratio must be a number");
    require_weight(contribution->weight, "the weight");
    require(contribution->split_capacity >= 1, "the capacity for splitting must be at least 1");
    return {contribution->ratio >= 0 ? std::optional(contribution->ratio) : std::nullopt, contribution->weight,
            contribution->split_capacity};
}

WalkState to_state(const wend_walk_state* state) {
    require(state, "the state of the walk is null");
    require(state->density_ratio >= 0, "the density ratio must not be negative");
    require_weight(state->index_scale, "the index scale");
    return {to_weight(state->throughput, "the throughput"),
            state->density_ratio,
            state->index_scale,
            state->depth,
            state->is_judged_elsewhere != 0,
            state->in_volume != 0};
}

wend_roulette from_roulette(float ends_below, bool media_absorb) {
    return {ends_below, media_absorb ? 1 : 0};
}

}  // namespace

wend_status wend_survival_before_direction(const wend_survival_settings* settings,
                                           const wend_expected_contribution* contribution, double u,
                                           wend_continuations* continuations, wend_error* error) noexcept {
    return guarded(error, [&] {
        require(continuations, "the place for the continuations is null");
        require_uniform(u);
        bool uses_number = false;
        const auto draw = [&] {
            uses_number = true;
            return u;
        };
        const auto outcome = to_decision(settings).before_direction(to_contribution(contribution), draw);
        const WeightWindow::Outcome decided = outcome.value_or(WeightWindow::Outcome());
        *continuations = {outcome ? 0 : 1, decided.copies, decided.expected, uses_number ? 1 : 0};
        return WEND_OK;
    });
}

wend_status wend_survival_after_direction(const wend_survival_settings* settings, const wend_walk_state* state,
                                          float* probability, wend_error* error) noexcept {
    return guarded(error, [&] {
        require(probability, "the place for the probability is null");
        *probability = to_decision(settings).after_direction(to_state(state));
        return WEND_OK;
    });
}

wend_roulette wend_roulette_unguided(void) noexcept {
    return from_roulette(unguided_walks_end.ends_below(), unguided_walks_end.media_absorb());
}

wend_roulette wend_roulette_guided(void) noexcept {
    return from_roulette(guided_walks_end.ends_below(), guided_walks_end.media_absorb());
}

wend_status wend_roulette_survival(const wend_roulette* roulette, const wend_walk_state* state, float* probability,
                                   wend_error* error) noexcept {
    return guarded(error, [&] {
        require(roulette, "the roulette is null");
        require(roulette->ends_below > 0 && roulette->ends_below <= 1, "walks must end below a throughput in (0,1]");
        require(probability, "the place for the probability is null");
        *probability =
            ClassicalRoulette(roulette->ends_below, roulette->media_absorb != 0).after_direction(to_state(state));
        return WEND_OK;
    });
}

wend_status wend_least_classical_share(float weight, float* share, wend_error* error) noexcept {
    return guarded(error, [&] {
        require_weight(weight, "the weight");
        require(share, "the place for the share is null");
        *share = least_defensive_fraction(weight);
        return WEND_OK;
    });
}

wend_status wend_pixel_estimates(const float* rgb, int width, int height, int samples, float* estimates,
                                 wend_error* error) noexcept {
    return guarded(error, [&] {
        require(rgb, "the picture is null");
        require(estimates, "the place for the estimates is null");
        require(width >= 1 && height >= 1, "a picture must have pixels");
        require(std::int64_t{width} * height <= std::numeric_limits<std::int32_t>::max(),
                "a picture has 2^31 - 1 pixels at most");
        require(samples >= 1, "pixels must have a sample at least");
        Image picture(width, height);
        for (Rgb& pixel : picture.pixels) {
            pixel = {rgb[0], rgb[1], rgb[2]};
            require(is_finite(pixel), "a picture must be finite");
            rgb += 3;
        }
        const std::vector<float> result = pixel_estimates(picture, samples);
        std::copy(result.begin(), result.end(), estimates);
        return WEND_OK;
    });
}
