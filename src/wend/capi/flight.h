/* How far walks fly, and what rays are told of the light on their way, for C. */
#ifndef WEND_CAPI_FLIGHT_H
#define WEND_CAPI_FLIGHT_H

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

/** Whether a guided flight asks for wend_flight_start::end, 0 or 1; where it does not, that need not be found. */
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

/** @} */

#ifdef __cplusplus
}
#endif

#endif
