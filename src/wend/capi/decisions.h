/* How far walks fly, how many continuations they have, and which lights their vertices are connected to, for C. */
#ifndef WEND_CAPI_DECISIONS_H
#define WEND_CAPI_DECISIONS_H

#include <wend/capi/field.h>

#ifdef __cplusplus
extern "C" {
#endif

/** @addtogroup wend_c
 * @{ */

/** A medium that is the same everywhere and does not glow. Coefficients are by colour channel, per scene unit, finite
 * and not negative, and so are their sums. */
typedef struct wend_medium {
    float absorption[3];      /**< coefficient */
    float scattering[3];      /**< coefficient */
    wend_phase_part phase[4]; /**< where collisions send light: the parts of a phase function */
    int phase_parts;          /**< how many of them there are, 0 to 4; 0: isotropic */
} wend_medium;

/** What the segment of a flight ends at. */
typedef enum wend_flight_end_kind {
    WEND_END_NOTHING = 0,  /**< nothing that is known */
    WEND_END_SURFACE = 1,  /**< a surface that scatters, emits or absorbs */
    WEND_END_INTERFACE = 2 /**< a boundary of media, behind which the ray goes straight on */
} wend_flight_end_kind;

/** What is known of the end of a flight's segment. */
typedef struct wend_flight_end {
    int kind;           /**< a wend_flight_end_kind */
    wend_vec3 position; /**< of the surface or interface */
    wend_vec3 normal;   /**< of a surface, towards the segment, of unit length */
    float emitted;      /**< radiance of lights at the end with their weights of multiple importance sampling, as a
                           scalar; not negative */
} wend_flight_end;

/** What is known before a flight. */
typedef struct wend_flight_start {
    wend_vec3 origin;    /**< where it begins, in scene units */
    wend_vec3 direction; /**< of unit length */
    float length;        /**< to the end of the segment; 0 to 1e30, and may so be beyond any scene */
    float throughput[3]; /**< of the walk so far, not negative: chooses among colour channels */
    float weight;        /**< of the walk over what it began with (wend_expected_contribution::weight), not negative:
                            flights of heavy walks are classical; 0 where that does not matter */
    wend_flight_end end; /**< for guided flights */
} wend_flight_start;

/** What comes of a flight. */
typedef struct wend_flight {
    int scatters;        /**< whether it ends in a collision, 0 or 1 */
    float distance;      /**< of the collision; the segment's length if it does not scatter */
    float weight[3];     /**< what the walk multiplies its throughput by, complete: transmittance times scattering
                            coefficient over density, or transmittance over probability */
    float density_ratio; /**< density over what classical sampling would have had: for wend_walk_state */
} wend_flight;

/** A classical flight by a number `u` in [0,1): in proportion to transmittance times extinction. Media that do not
 * scatter are passed. Any number of threads may ask. */
WEND_API wend_status wend_flight_classical(const wend_medium* medium, const wend_flight_start* start, float u,
                                           wend_flight* flight, wend_error* error) WEND_NOEXCEPT;

/** Which part of a flight follows the light. */
typedef enum wend_flight_guiding {
    WEND_GUIDE_SCATTERING = 0,             /**< whether it scatters */
    WEND_GUIDE_SCATTERING_AND_DISTANCE = 1 /**< whether it scatters, and where */
} wend_flight_guiding;

/** How flights are guided. */
typedef struct wend_flight_settings {
    float classical_share; /**< in (0,1]: the weight is at most 1 / classical_share times the classical one */
    int guiding;           /**< a wend_flight_guiding */
} wend_flight_settings;

/** A flight in proportion to the light along the ray, as the field of volumes tells it, and to what comes from the
 * segment's end: from a surface as the field of surfaces tells it. Both fields are referred to during the call alone;
 * wend_field_fit_scattered() taught them. Where the field of volumes knows nothing yet the flight is classical. */
WEND_API wend_status wend_flight_guided(const wend_field* surface, const wend_field* volume,
                                        const wend_flight_settings* settings, const wend_medium* medium,
                                        const wend_flight_start* start, float u, wend_flight* flight,
                                        wend_error* error) WEND_NOEXCEPT;

/** Whether a guided flight asks for wend_flight_start::end as soon as the field of volumes knows something, 0 or 1;
 * where it does not, that need not be found. */
WEND_API wend_status wend_flight_looks_ahead(const wend_medium* medium, const wend_flight_start* start, int* looks,
                                             wend_error* error) WEND_NOEXCEPT;

/** The probability, under each colour channel, of a classical flight through so much (0 to 1e30) without a collision:
 * for weights of multiple importance sampling, those of guided flights as well. */
WEND_API wend_status wend_flight_pass_probability(const wend_medium* medium, float length, float probability[3],
                                                  wend_error* error) WEND_NOEXCEPT;

/* ---- For flights of your own: through grids, or media that this library does not know ---- */

/** Light that arrives from everywhere, known by its amount and its mean direction. What it brings to a walk that flies
 * along w, by Henyey and Greenstein's phase function of mean cosine g, is about the fluence times that function of mean
 * cosine g times the length of `mean`, at the cosine of w to `mean`. */
typedef struct wend_arriving_light {
    float fluence;  /**< the integral of the radiance over all directions, in radiance times sr */
    wend_vec3 mean; /**< of the directions towards where light comes from, shorter than 1; zero: from all alike */
} wend_arriving_light;

/** Lights close to a cell, taken for one. What arrives from them grows as 1 / distance² towards them. */
typedef struct wend_near_light {
    wend_vec3 position;   /**< where they are, as a mean */
    float extent_squared; /**< mean of the squared distances of its parts from there */
    float intensity;      /**< fluence times squared distance, a mean over the cell; 0: there is no such light */
    float share;          /**< how much of the connected light is its */
} wend_near_light;

/** What a cell of the field tells a ray that crosses it. */
typedef struct wend_ray_cell {
    float t_in;                    /**< distance along the ray at which it enters */
    float t_out;                   /**< and leaves, farther */
    wend_arriving_light walked;    /**< what walks found on their way */
    wend_arriving_light connected; /**< what their connections to lights found: with `walked` all the light */
    wend_near_light near_light;    /**< part of what was connected */
    float confidence;              /**< how far the cell is to be trusted, 0 to 1 */
} wend_ray_cell;

/** The cells that a ray crosses between the distances t0 and t1, 0 <= t0 < t1 <= 1e30, nearest first and without gaps;
 * the cells at the rim reach on without end. Parts of the way no longer than `finest`, which is not negative, are not
 * divided any more: the cell in the middle stands for all of it. `count` is their number. A null `cells` only asks for
 * it; where there are more than `capacity`, the nearest ones are written, and the answer is WEND_BUFFER_TOO_SMALL. */
WEND_API wend_status wend_field_cells_along_ray(const wend_field* field, wend_vec3 origin, wend_vec3 direction,
                                                float t0, float t1, float finest, wend_ray_cell* cells, size_t capacity,
                                                size_t* count, wend_error* error) WEND_NOEXCEPT;

/** The radiance to be expected to leave a surface, as a scalar, towards the side of its unit normal: what a ray meets
 * at its end. */
WEND_API wend_status wend_field_leaving(const wend_field* field, wend_vec3 position, wend_vec3 normal, float* radiance,
                                        wend_error* error) WEND_NOEXCEPT;

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

/** Choices of lights that learn. Your own first choice knows how strong lights are, and perhaps where; what stands
 * between, connections tell. A quarter of all choices stays with the first one.
 *
 * wend_lights_add() and wend_lights_learn() change it: between passes, while no other thread uses it. All else may be
 * called by any number of threads at once. */
typedef struct wend_lights wend_lights;

/** Knows nothing yet of 1 to 256 lights in a scene of these bounds. It belongs to the caller: wend_lights_destroy(). */
WEND_API wend_status wend_lights_create(wend_bounds bounds, size_t count, wend_lights** lights,
                                        wend_error* error) WEND_NOEXCEPT;

/** Ends choices of lights. Null is allowed. */
WEND_API void wend_lights_destroy(wend_lights* lights) WEND_NOEXCEPT;

/** A vertex that wants light. */
typedef struct wend_light_receiver {
    wend_vec3 position; /**< in scene units */
    wend_vec3 normal;   /**< of a surface, on the side where light arrives, of unit length; zero in a medium */
} wend_light_receiver;

/** Chooses a light for a receiver by a number `u` in [0,1). `first` has the probability with which your first choice
 * takes each light there, in their order, with the sum 1; or all are 0, if none reaches the receiver. It must be the
 * same whenever the receiver is. `light` is -1 where no light reaches the receiver, as far as is known; with
 * `probability` 0. */
WEND_API wend_status wend_lights_sample(const wend_lights* lights, const wend_light_receiver* receiver,
                                        const float* first, float u, int* light, float* probability,
                                        wend_error* error) WEND_NOEXCEPT;

/** The probability with which wend_lights_sample() takes a light, given that of your first choice. */
WEND_API wend_status wend_lights_probability(const wend_lights* lights, const wend_light_receiver* receiver, int light,
                                             float first, float* probability, wend_error* error) WEND_NOEXCEPT;

/** What one connection brought. Made by wend_lights_record(); it may be kept, copied and forgotten. */
typedef struct wend_light_record {
    uint16_t cell;  /**< the library's own */
    uint16_t light; /**< which was chosen */
    float brought;  /**< as wend_lights_record() was told */
} wend_light_record;

/** A record of a connection. `brought` is the estimate of the light of all lights, as a scalar, times the probability
 * of the choice: 0 where something was in the way. It is not negative. One that is not finite is allowed, and teaches
 * nothing. */
WEND_API wend_status wend_lights_record(const wend_lights* lights, const wend_light_receiver* receiver, int light,
                                        float brought, wend_light_record* record, wend_error* error) WEND_NOEXCEPT;

/** Adds records to what is known. Sums depend on their order, so let that depend on no threads. Where one was not made
 * for such lights that is a bad argument, and none is added. */
WEND_API wend_status wend_lights_add(wend_lights* lights, const wend_light_record* records, size_t count,
                                     wend_error* error) WEND_NOEXCEPT;

/** The probability in [0,1] with which your first choice takes a light at a receiver; it must not throw. `user` is what
 * wend_lights_learn() was given. */
typedef float (*wend_first_choice)(void* user, const wend_light_receiver* receiver, int light);

/** Makes choices to come follow all that was added. `first` is asked for every light in the middle of cells: by up to
 * `threads` threads (0, all, to 1024) at once, in no certain order, before the function returns. The result does not
 * depend on the threads, bit for bit. Answers that are not in [0,1] are a bad argument, and nothing is learned. */
WEND_API wend_status wend_lights_learn(wend_lights* lights, wend_first_choice first, void* user, int threads,
                                       wend_error* error) WEND_NOEXCEPT;

/** @} */

#ifdef __cplusplus
}
#endif

#endif
