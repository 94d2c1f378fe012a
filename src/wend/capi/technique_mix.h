/* How walks inside a dense medium are best drawn, learned by the place where they enter, for C. */
#ifndef WEND_CAPI_TECHNIQUE_MIX_H
#define WEND_CAPI_TECHNIQUE_MIX_H

#include <wend/capi/interior.h>

#ifdef __cplusplus
extern "C" {
#endif

/** @addtogroup wend_c
 * @{ */

/** How the collisions of a walk are connected to lights that the walk may run into as well. */
typedef struct wend_next_event {
    float preference;  /**< what multiplies the walk's own density where it is weighed against that of connections */
    float probability; /**< of connecting a collision at all: it divides what a connection brings */
} wend_next_event;

/** How walks are drawn that enter a medium at some place. */
typedef struct wend_technique_mix {
    float classical_share;      /**< of classical sampling in guided walks: for wend_interior_enter_with() */
    float unguided_probability; /**< of a walk that is not guided at all: enters with a classical share of 1 */
    wend_next_event guided;     /**< connections of guided walks */
    wend_next_event unguided;   /**< connections of the others */
} wend_technique_mix;

/** What a walk found, from where it entered until it left. Make it by wend_technique_record_begin(), tell it what light
 * the walk finds, and set `flights`, `relative` (at its end) and `connected`. */
typedef struct wend_technique_record {
    wend_vec3 entry;        /**< where the walk entered */
    int guided;             /**< 0 or 1: whether it was drawn by the guide, whatever its share */
    int flights;            /**< how many were drawn */
    int connected;          /**< 0 or 1: whether a connection to a light succeeded */
    float brought;          /**< the light found: see wend_technique_record_hit() */
    float relative[2];      /**< wend_interior_relative_densities() at its end */
    float slope[2];         /**< how `brought` falls with more of each technique */
    float preference_slope; /**< and rises with the logarithm of the preference */
} wend_technique_record;

/** Begins a record. */
WEND_API wend_status wend_technique_record_begin(wend_vec3 entry, int guided, wend_technique_record* record,
                                                 wend_error* error) WEND_NOEXCEPT;

/** Light that the walk ran into: the mean of its channels, weighted as it counts, over the throughput with which the
 * walk entered; finite, not negative. `before` are wend_interior_relative_densities() at the last collision, `now`
 * those where the light was found. Connections from that collision have the part `by_connections`, in [0,1], of the
 * density that both ways are weighed by: 0 where none could have found the light. */
WEND_API wend_status wend_technique_record_hit(wend_technique_record* record, float light, const float before[2],
                                               const float now[2], float by_connections,
                                               wend_error* error) WEND_NOEXCEPT;

/** Light that a connection found, likewise: `here` are the densities at the collision, `towards` those of a copy that
 * turned to the light and passed to the boundary. */
WEND_API wend_status wend_technique_record_connection(wend_technique_record* record, float light, const float here[2],
                                                      const float towards[2], float by_connections,
                                                      wend_error* error) WEND_NOEXCEPT;

/** Mixes by place for the walks in one medium. Any number of threads may ask; none while it learns. */
typedef struct wend_technique_mixes wend_technique_mixes;

/** Mixes of a medium inside these bounds, to begin with all of this share of classical sampling, in (0,1]. They belong
 * to the caller: wend_technique_mixes_destroy(). */
WEND_API wend_status wend_technique_mixes_create(wend_bounds bounds, float classical_share,
                                                 wend_technique_mixes** mixes, wend_error* error) WEND_NOEXCEPT;

/** Ends mixes. Null is allowed. */
WEND_API void wend_technique_mixes_destroy(wend_technique_mixes* mixes) WEND_NOEXCEPT;

/** How walks are drawn that enter here. */
WEND_API wend_status wend_technique_mixes_at(const wend_technique_mixes* mixes, wend_vec3 entry,
                                             wend_technique_mix* mix, wend_error* error) WEND_NOEXCEPT;

/** Learns from walks that were drawn as wend_technique_mixes_at() said: some thousands at a time, of all threads, in an
 * order that does not depend on these if results shall not. `is_last`, 0 or 1: whether this was the last lesson; until
 * then a few walks are left unguided, to compare. */
WEND_API wend_status wend_technique_mixes_learn(wend_technique_mixes* mixes, const wend_technique_record* records,
                                                size_t count, int is_last, wend_error* error) WEND_NOEXCEPT;

/** @} */

#ifdef __cplusplus
}
#endif

#endif
