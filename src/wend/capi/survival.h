/* How many continuations a walk has, and what the pixels that it is measured against will be, for C. */
#ifndef WEND_CAPI_SURVIVAL_H
#define WEND_CAPI_SURVIVAL_H

#include <wend/capi/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/** @addtogroup wend_c
 * @{ */

/** Roulette and splitting by expected contribution. The functions that take it remember nothing: any number of threads
 * may call them. */
typedef struct wend_survival_settings {
    int roulette;           /**< whether walks of little expected contribution may end, 0 or 1 */
    int splitting;          /**< whether walks of much are split, 0 or 1 */
    double sample_variance; /**< of one sample of a pixel, relative and as a mean over the picture; where it is low,
                               roulette is reluctant. Not negative, INFINITY is allowed */
} wend_survival_settings;

/** What is known of a walk at a vertex before its direction is drawn. */
typedef struct wend_expected_contribution {
    float ratio;        /**< the walk's expected contribution from here on (throughput times albedo times
                           wend_field_in_scattered(), a mean over the channels) over the value that it estimates
                           (wend_pixel_estimates()); negative where it is not known, INFINITY is allowed */
    float weight;       /**< what the walk carries over what it began with, a mean over the channels, times
                           wend_walk_state::index_scale; not negative */
    int split_capacity; /**< most continuations here, at least 1 */
} wend_expected_contribution;

/** How many directions a walk draws at a vertex. */
typedef struct wend_continuations {
    int judged_by_weight; /**< 1: nothing is decided yet. Draw one direction, then wend_survival_after_direction() */
    int copies;           /**< directions to draw; 0 ends the walk */
    double expected;      /**< their mean number, positive: the weight of each is divided by it */
    int uses_number; /**< whether `u` was looked at, 0 or 1: who draws numbers one after another may ask with 0 first,
                        and again with a number where one is needed */
} wend_continuations;

/** Decides at a vertex, by a uniform number `u` in [0,1) of double precision. Where nothing is decided there is one
 * copy, of which 1 is expected. */
WEND_API wend_status wend_survival_before_direction(const wend_survival_settings* settings,
                                                    const wend_expected_contribution* contribution, double u,
                                                    wend_continuations* continuations, wend_error* error) WEND_NOEXCEPT;

/** What a walk knows of itself once its direction is drawn. */
typedef struct wend_walk_state {
    float throughput[3]; /**< by colour channel, the product of all weights so far; not negative */
    float density_ratio; /**< product of the densities of guided decisions over those of classical ones, and of
                            wend_continuations::expected; 1 at first; not negative, INFINITY is allowed */
    float index_scale;   /**< product of the squared ratios of refractive indices passed; 1 at first; not negative */
    int depth;           /**< vertices so far */
    int is_judged_elsewhere; /**< whether this vertex, a mirror or a boundary that refracts, is one of which nothing can
                                be expected, 0 or 1 */
    int in_volume;           /**< whether the last vertex is a collision, 0 or 1 */
} wend_walk_state;

/** The probability of going on after the direction is drawn, in [0,1], for where wend_survival_before_direction() had
 * nothing to say. Who goes on divides the weight by it. */
WEND_API wend_status wend_survival_after_direction(const wend_survival_settings* settings, const wend_walk_state* state,
                                                   float* probability, wend_error* error) WEND_NOEXCEPT;

/** Classical roulette: survive in proportion to the throughput that unguided directions would have left. */
typedef struct wend_roulette {
    float ends_below; /**< throughput from which on walks may end, in (0,1] */
    int media_absorb; /**< whether after collisions walks end as absorption would nonetheless, 0 or 1 */
} wend_roulette;

/** What pays for walks that are not guided. */
WEND_API wend_roulette wend_roulette_unguided(void) WEND_NOEXCEPT;
/** What pays for guided walks. */
WEND_API wend_roulette wend_roulette_guided(void) WEND_NOEXCEPT;

/** The probability of going on, in [0,1]; 1 up to the first vertex. Any number of threads may ask. */
WEND_API wend_status wend_roulette_survival(const wend_roulette* roulette, const wend_walk_state* state,
                                            float* probability, wend_error* error) WEND_NOEXCEPT;

/** The least share of classical sampling, in [0,1], that directions of a walk should have which carries so much over
 * what it began with (wend_expected_contribution::weight): mix with the larger of it and wend_field_classical_share(),
 * and no guided decision makes a heavy walk heavier. */
WEND_API wend_status wend_least_classical_share(float weight, float* share, wend_error* error) WEND_NOEXCEPT;

/** What the pixels of a picture will be, from a mean of so many samples each (at least 1): the mean of the channels,
 * averaged over neighbours, the fewer the more samples, and kept above a tenth of the picture's mean. `rgb` has three
 * finite numbers a pixel, row by row, `estimates` gets one a pixel; they may not overlap. Zero everywhere as long as
 * the picture is black: nothing is known then. Pixels are 2^31 - 1 at most. */
WEND_API wend_status wend_pixel_estimates(const float* rgb, int width, int height, int samples, float* estimates,
                                          wend_error* error) WEND_NOEXCEPT;

/** @} */

#ifdef __cplusplus
}
#endif

#endif
