/* Errors and plain values of the interface for C; fields, and the records of walks that they learn from. */
#ifndef WEND_CAPI_FIELD_H
#define WEND_CAPI_FIELD_H

#include <wend/core/export.h>
#include <wend/version.h>

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
#define WEND_NOEXCEPT noexcept
#else
/** What C++ is told of every function: it throws nothing. */
#define WEND_NOEXCEPT
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** @addtogroup wend_c
 * @{ */

/** How a function ended. All but the first two are mistakes, of which wend_error::message tells more. */
typedef enum wend_status {
    /** All went well: results are written. */
    WEND_OK = 0,
    /** The field has not been fitted to any usable record: go on without a guide. Not a mistake. */
    WEND_NOTHING_LEARNED = 1,
    /** An argument is null, out of its range or not finite, or an object was not filled by this library. */
    WEND_BAD_ARGUMENT = 2,
    /** Bytes to load are no field, of another version, truncated, or were changed. */
    WEND_BAD_BYTES = 3,
    /** What was asked for is more than the caller's memory holds; the function has said how much. */
    WEND_BUFFER_TOO_SMALL = 4,
    /** Memory could not be had; nothing was made. */
    WEND_OUT_OF_MEMORY = 5,
    /** A mistake of the library. */
    WEND_INTERNAL_ERROR = 6
} wend_status;

/** What went wrong. */
typedef struct wend_error {
    char message[256]; /**< a sentence that ends with a null byte; empty after success */
} wend_error;

/** The library's version, "MAJOR.MINOR.PATCH": that of wend/version.h unless another library was loaded. */
WEND_API const char* wend_version(void) WEND_NOEXCEPT;

/** A point in scene units, or a direction. */
typedef struct wend_vec3 {
    float x; /**< along the first axis */
    float y; /**< along the second */
    float z; /**< along the third */
} wend_vec3;

/** A part of a phase function, of Henyey and Greenstein's kind. */
typedef struct wend_phase_part {
    float weight; /**< relative to the other parts; positive */
    float g;      /**< mean cosine, in (-1, 1) */
} wend_phase_part;

/** A box along the axes, finite. */
typedef struct wend_bounds {
    wend_vec3 min; /**< the corner of least coordinates */
    wend_vec3 max; /**< the opposite one: no coordinate less than that of `min` */
} wend_bounds;

/** An estimate of the radiance that arrives at a point from one direction. Estimates of zero are as informative as
 * others and must not be left out. */
typedef struct wend_record {
    wend_vec3 position;      /**< of the vertex, in scene units */
    wend_vec3 direction;     /**< of unit length, towards where the radiance comes from */
    float radiance;          /**< as a scalar, for instance the mean of the colour channels; not negative */
    float density;           /**< the direction was drawn with, in 1/sr; positive */
    float distance;          /**< to the next vertex along the direction; positive, infinite where there is none */
    float classical_density; /**< of the direction by your own sampling; this and the next two tell how it and the
                                guide's are best mixed, and all three are 0 where there was no choice */
    float guided_density;    /**< of the direction by the guide */
    float scattered;         /**< the scattering function with its cosine, times the radiance */
    float colour[3]; /**< of the radiance, in any scale, of which only ratios count; not negative, and black is grey */
} wend_record;

/** What a vertex tells of the light that is scattered there: flights ask for it (wend_flight_guided()). */
typedef struct wend_scatter_record {
    wend_vec3 position;   /**< of the vertex, in scene units */
    wend_vec3 normal;     /**< of a surface, on the side that the walk came from, of unit length; zero in a volume */
    float leaving;        /**< the radiance that leaves to where the walk came from, as a scalar; not negative */
    float connected;      /**< fluence of the light that a connection found, in radiance times sr; not negative */
    wend_vec3 to_light;   /**< of unit length; means nothing where `connected` is 0 */
    float light_distance; /**< to the light; INFINITY for one that is far */
} wend_scatter_record;

/** How a field is fitted. Start from wend_fit_settings_default(). */
typedef struct wend_fit_settings {
    int lobes;                /**< that a cell begins with, 1 to 16; its records may call for others, at most 16 */
    double leaf_samples;      /**< a cell that holds more records may be split; at least 1 */
    int max_depth;            /**< most splits above a cell, 0 to 64 */
    size_t max_bytes;         /**< memory of a field, at least 64 KiB */
    double decay;             /**< how much the records of earlier fits count, 0 to 1 */
    int max_iterations;       /**< most rounds of expectation maximization, at least 1 */
    double tolerance;         /**< rounds end when lobes move less than this share; not negative */
    double prior_weight;      /**< records that each lobe is believed to have before any; positive */
    double prior_mean_cosine; /**< records of mean cosine 0 that each lobe is believed to have; positive */
    float max_kappa;          /**< concentrations stay below; positive, at most 1e5 */
} wend_fit_settings;

/** What a fit did. */
typedef struct wend_fit_report {
    size_t records;     /**< given */
    size_t ignored;     /**< of these, with numbers out of range: they taught nothing */
    size_t dark;        /**< usable ones with zero radiance */
    size_t cells;       /**< of the field that was made */
    size_t bytes;       /**< its memory */
    int memory_limited; /**< whether cells stayed unsplit for lack of memory, 0 or 1 */
} wend_fit_report;

/** What a field holds. */
typedef struct wend_field_summary {
    wend_bounds bounds; /**< those it was made for */
    size_t cells;       /**< that it divides space into */
    size_t lobes;       /**< of all cells */
    size_t bytes;       /**< in memory */
    double records;     /**< that taught it, those of earlier fits counting less */
    int learned;        /**< whether it can be asked, 0 or 1 */
} wend_field_summary;

/* ---- Fields ---- */

/** What has been learned about where light comes from: made by wend_field_create(), wend_field_fit() and
 * wend_field_load(), never changed afterwards. */
typedef struct wend_field wend_field;

/** A field that knows nothing yet about a scene of these bounds. It belongs to the caller: wend_field_destroy(). */
WEND_API wend_status wend_field_create(wend_bounds bounds, wend_field** field, wend_error* error) WEND_NOEXCEPT;

/** Ends a field; what was made from it stays. Null is allowed. */
WEND_API void wend_field_destroy(wend_field* field) WEND_NOEXCEPT;

/** The settings that wend_field_fit() takes for null. */
WEND_API wend_fit_settings wend_fit_settings_default(void) WEND_NOEXCEPT;

/** Makes the next field of the previous one, which stays as it is, and `count` records (fewer than 2^32 - 1; `records`
 * may be null if there are none). The result depends on the order of the records but not on the number of threads, bit
 * for bit. `settings` may be null for the default, `threads` is 0 (all) to 1024, `report` may be null. The next field
 * belongs to the caller; `next` may be where `previous` is kept, but then destroy the previous one by another pointer.
 */
WEND_API wend_status wend_field_fit(const wend_field* previous, const wend_record* records, size_t count,
                                    const wend_fit_settings* settings, int threads, wend_field** next,
                                    wend_fit_report* report, wend_error* error) WEND_NOEXCEPT;

/** The same cells with the light that is scattered in them learned from the records, on top of what the previous field
 * knew, which counts `decay` (0 to 1) times as much as before. It comes after wend_field_fit() and is for flights
 * alone: who draws none by the field does without. Records that are not finite or out of range teach nothing. Depends
 * on the order of the records, not on `threads` (0, all, to 1024), bit for bit. The next field belongs to the caller.
 */
WEND_API wend_status wend_field_fit_scattered(const wend_field* previous, const wend_scatter_record* records,
                                              size_t count, double decay, int threads, wend_field** next,
                                              wend_error* error) WEND_NOEXCEPT;

/** What the field holds; cost is proportional to the number of cells. */
WEND_API wend_status wend_field_summarize(const wend_field* field, wend_field_summary* summary,
                                          wend_error* error) WEND_NOEXCEPT;

/** The integral of the radiance over all directions, averaged over the position's cell: radiance times sr. */
WEND_API wend_status wend_field_fluence(const wend_field* field, wend_vec3 position, float* fluence,
                                        wend_error* error) WEND_NOEXCEPT;

/** The radiance that arrives at a position from a unit direction, by colour channel (red, green, blue). */
WEND_API wend_status wend_field_radiance(const wend_field* field, wend_vec3 position, wend_vec3 direction,
                                         float radiance[3], wend_error* error) WEND_NOEXCEPT;

/** How much of the directions around a position is best drawn by your own sampling of what scatters, the rest being
 * guided: learned from records that know both densities, 0.1 to 0.9, and 0.3 without them. */
WEND_API wend_status wend_field_classical_share(const wend_field* field, wend_vec3 position, float* share,
                                                wend_error* error) WEND_NOEXCEPT;

/** Writes the field to `buffer` and the number of bytes to `size`. A null buffer only asks for the size; one with a
 * `capacity` that is too small is left alone and answered with WEND_BUFFER_TOO_SMALL and the size. The bytes have a
 * version and a checksum. */
WEND_API wend_status wend_field_save(const wend_field* field, void* buffer, size_t capacity, size_t* size,
                                     wend_error* error) WEND_NOEXCEPT;

/** The field again: it answers the same, bit for bit, and can be fitted further. */
WEND_API wend_status wend_field_load(const void* bytes, size_t size, wend_field** field,
                                     wend_error* error) WEND_NOEXCEPT;

/* ---- Distributions of directions ---- */

/** A distribution in the caller's memory, aligned as this type is. It may be copied and forgotten, and refers to
 * nothing, the field included. */
typedef union wend_distribution {
    long double alignment;     /**< for the compiler: never read or written */
    unsigned char bytes[2304]; /**< the library's own */
} wend_distribution;

/** The shape of what scatters, as lobes around an axis that is given later: make one per material and keep it. */
typedef union wend_lobes {
    long double alignment;    /**< for the compiler: never read or written */
    unsigned char bytes[256]; /**< the library's own */
} wend_lobes;

/** The cosine at a surface that reflects diffusely; its axis is the normal on the side where light arrives. A cosine is
 * not quite a lobe, so the product reaches a little below the horizon: draws from there have the value 0. */
WEND_API wend_status wend_lobes_cosine(wend_lobes* lobes, wend_error* error) WEND_NOEXCEPT;

/** A phase function of 1 to 4 parts; the axis is the direction in which the walk flew before the collision. The lobes
 * stay within 2 % of the function up to |g| = 0.9 and within 25 % up to 0.99; beyond, they are those of 0.99. */
WEND_API wend_status wend_lobes_phase(const wend_phase_part* parts, size_t count, wend_lobes* lobes,
                                      wend_error* error) WEND_NOEXCEPT;

/** A part of any shape: a von Mises-Fisher lobe along the axis. */
typedef struct wend_axial_lobe {
    float weight; /**< relative to the other lobes; not negative */
    float kappa;  /**< concentration, in [-1e5, 1e5]; around the opposite of the axis if negative */
} wend_axial_lobe;

/** A shape of 1 to 24 lobes, one of which at least has a positive weight. */
WEND_API wend_status wend_lobes_custom(const wend_axial_lobe* parts, size_t count, wend_lobes* lobes,
                                       wend_error* error) WEND_NOEXCEPT;

/** Directions in proportion to the incident radiance at a position. */
WEND_API wend_status wend_field_incident(const wend_field* field, wend_vec3 position, wend_distribution* incident,
                                         wend_error* error) WEND_NOEXCEPT;

/** Directions in proportion to the incident radiance times the lobes, normalized. `integral` may be null; it is that of
 * the product of both densities, in 1/sr, so times the fluence it estimates the in-scattered radiance. Where the
 * product is too small to tell, the integral is 0 and the product is the incident distribution. `product` may be
 * `incident`; what is a product already has no further one. */
WEND_API wend_status wend_distribution_product(const wend_distribution* incident, const wend_lobes* lobes,
                                               wend_vec3 axis, wend_distribution* product, float* integral,
                                               wend_error* error) WEND_NOEXCEPT;

/** The integral of the incident radiance at a position times the lobes of a product that was made there, by colour
 * channel (red, green, blue): the radiance that is scattered on to a walk, but for its albedo. */
WEND_API wend_status wend_field_in_scattered(const wend_field* field, wend_vec3 position,
                                             const wend_distribution* product, float in_scattered[3],
                                             wend_error* error) WEND_NOEXCEPT;

/** The direction that belongs to a point of the unit square, [0,1)^2, and its density, which may be null. */
WEND_API wend_status wend_distribution_sample(const wend_distribution* distribution, float u, float v,
                                              wend_vec3* direction, float* density, wend_error* error) WEND_NOEXCEPT;

/** The density of any direction. */
WEND_API wend_status wend_distribution_density(const wend_distribution* distribution, wend_vec3 direction,
                                               float* density, wend_error* error) WEND_NOEXCEPT;

/** A place where a walk drew a direction. A walk that was split is a tree: several vertices name the same parent.
 * Weights and radiances have three colour channels. */
typedef struct wend_path_vertex {
    wend_vec3 position;  /**< in scene units */
    wend_vec3 direction; /**< drawn here, of unit length, towards where the walk went on */
    float density;       /**< of the direction, in 1/sr; 0 for one of a discrete set, a mirror's */
    float distance;      /**< along the direction to what the walk met first; INFINITY where there was nothing */
    float arrival[3];    /**< weight gained since the parent's direction was drawn: flight, survival, 1 / copies */
    float scattering[3]; /**< the scattering function, with its cosine, over the density of the direction */
    float gathered[3];   /**< radiance found after this direction and before the next one was drawn, times the weight
                            gained since: light met and the next vertex's connection to a light, each with its weight
                            of multiple importance sampling */
    float classical_density; /**< of the direction by your own sampling, where you mixed it with the guide's; otherwise
                                0 */
    float guided_density;    /**< of the direction by the guide, likewise */
    int32_t parent;          /**< index of the vertex whose direction led here, lower than this one's; -1 for none */
    float connected[3];      /**< what connections to lights brought at this vertex, the scattering function included,
                                per unit of the walk's weight here; the parent has gathered it as well. This and the rest
                                are for records of scattered light alone */
    float light_fluence;     /**< the connections' estimate of the fluence of lights, in radiance times sr */
    wend_vec3 to_light;      /**< towards the light that outweighs the others, of unit length; zero without one */
    float light_distance;    /**< to that light; INFINITY for one that is far */
    wend_vec3 normal;        /**< of a surface, on the side that the walk came from, of unit length; zero in a volume */
} wend_path_vertex;

/** Makes a record of each vertex, in the same order, in time proportional to their number. Those of mirrors have
 * density 0: leave them out, and give the others to the field of surfaces or of volumes. Nothing is clamped;
 * wend_field_fit() ignores and counts records that are not finite. */
WEND_API wend_status wend_records_of_path(const wend_path_vertex* path, size_t count, wend_record* records,
                                          wend_error* error) WEND_NOEXCEPT;

/** What each vertex tells of the light that is scattered there, in the same order and time, mirrors included: for
 * wend_field_fit_scattered() of surfaces or of volumes. Nothing is clamped. */
WEND_API wend_status wend_scatter_records_of_path(const wend_path_vertex* path, size_t count,
                                                  wend_scatter_record* records, wend_error* error) WEND_NOEXCEPT;

/** @} */

#ifdef __cplusplus
}
#endif

#endif
