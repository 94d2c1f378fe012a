/* Walks inside dense media, wax, skin or marble, and how they are best drawn by the place where they enter, for C. */
#ifndef WEND_CAPI_INTERIOR_H
#define WEND_CAPI_INTERIOR_H

#include <wend/capi/decisions.h>

#ifdef __cplusplus
extern "C" {
#endif

/** @addtogroup wend_c
 * @{ */

/** What walks in one dense medium know about it beforehand: the light deep inside. It never changes; any number of
 * threads may walk by it. */
typedef struct wend_interior_guide wend_interior_guide;

/** Solves for the light deep in a medium, which takes milliseconds: once a medium. It must scatter, and the mean
 * cosines of its phase function must be within -0.96 and 0.96. `classical_share` in (0,1] of the walks are classical,
 * so no weight exceeds the classical one by more than 1 / classical_share; 0.25 is good, with 1 none is guided. The
 * guide belongs to the caller and must outlive the walks by it: wend_interior_guide_destroy(). */
WEND_API wend_status wend_interior_guide_create(const wend_medium* medium, float classical_share,
                                                wend_interior_guide** guide, wend_error* error) WEND_NOEXCEPT;

/** The same for walks that head for lamps outside as well: each is to be told of them by wend_interior_aim_lamps()
 * before it heads. `connects`, 0 or 1: wend_interior_sample_lamps() tells where to connect at the boundary, if it is
 * rough. */
WEND_API wend_status wend_interior_guide_create_for_lamps(const wend_medium* medium, float classical_share,
                                                          int connects, wend_interior_guide** guide,
                                                          wend_error* error) WEND_NOEXCEPT;

/** Ends a guide. Null is allowed. */
WEND_API void wend_interior_guide_destroy(wend_interior_guide* guide) WEND_NOEXCEPT;

/** A lamp outside, as it is seen just inside of the boundary. */
typedef struct wend_interior_lamp {
    wend_vec3 direction; /**< the mean of those in which a walk flies out to it, of unit length */
    float concentration; /**< of these about their mean (von Mises-Fisher), 0 to 1e5: 2 / (1 - cosine) for a disk of
                              that angular radius */
    float cosine;        /**< of the direction to the outward normal, in (0,1] */
    float fluence;       /**< its radiance over all directions, just inside; not negative */
} wend_interior_lamp;

/** Lamps that walks may head for. They never change; any number of threads may use them. */
typedef struct wend_interior_lamps wend_interior_lamps;

/** The lamps seen at one place of a boundary: `count`, 0 to 4, the strongest first. They belong to the caller and must
 * outlive the walks that are aimed at them: wend_interior_lamps_destroy(). */
WEND_API wend_status wend_interior_lamps_create(const wend_interior_lamp* lamps, size_t count,
                                                wend_interior_lamps** made, wend_error* error) WEND_NOEXCEPT;

/** Ends lamps. Null is allowed. */
WEND_API void wend_interior_lamps_destroy(wend_interior_lamps* lamps) WEND_NOEXCEPT;

/** A walk inside a dense medium, in the caller's memory, aligned as this type is. It may be copied, where a path
 * splits, and forgotten; it refers to its guide and to lamps. One thread at a time may change it.
 *
 * At the boundary, going in: enter, aim, head. Then fly, and at a collision aim again (if the normal is to change),
 * draw a direction and turn. Where the boundary reflects: head, then fly again. A call that comes too early is a bad
 * argument. */
typedef union wend_interior_walk {
    long double alignment;    /**< for the compiler: never read or written */
    unsigned char bytes[512]; /**< the library's own */
} wend_interior_walk;

/** Begins a walk. `channels` are the probabilities of the colour channels, with the sum 1: in proportion to the
 * throughput. A channel of probability 0 must have throughput 0. */
WEND_API wend_status wend_interior_enter(const wend_interior_guide* guide, const float channels[3],
                                         wend_interior_walk* walk, wend_error* error) WEND_NOEXCEPT;

/** The same with a share of classical sampling of its own, in (0,1]: that of a wend_technique_mix. With 1 the walk is
 * not guided. */
WEND_API wend_status wend_interior_enter_with(const wend_interior_guide* guide, const float channels[3],
                                              float classical_share, wend_interior_walk* walk,
                                              wend_error* error) WEND_NOEXCEPT;

/** From now on light comes from a boundary of this outward unit normal. `steepness` in [0,1] is how steeply it grows
 * that way: 1 as under a wide plane boundary, less where it comes from several sides. The choice is yours, and may
 * depend on all that has happened to the walk. */
WEND_API wend_status wend_interior_aim(wend_interior_walk* walk, wend_vec3 normal, float steepness,
                                       wend_error* error) WEND_NOEXCEPT;

/** What the walk sees of lamps from now on: those of the closest boundary, `depth` below it (0 to 1e30), and the
 * radiance that it may expect that turns away from it, by channel, not negative. Aim first. */
WEND_API wend_status wend_interior_aim_lamps(wend_interior_walk* walk, const wend_interior_lamps* lamps, float depth,
                                             const float diffuse[3], wend_error* error) WEND_NOEXCEPT;

/** Goes on in a unit direction that the walk has not drawn: at the entry, or where the boundary reflects. */
WEND_API wend_status wend_interior_head(wend_interior_walk* walk, wend_vec3 direction, wend_error* error) WEND_NOEXCEPT;

/** How far the next flight goes if nothing is in its way, by a number `u` in [0,1): no ray need be traced further. It
 * may be INFINITY. */
WEND_API wend_status wend_interior_draw_distance(const wend_interior_walk* walk, float u, float* distance,
                                                 wend_error* error) WEND_NOEXCEPT;

/** How far a walk got. */
typedef struct wend_interior_flight {
    int scatters;           /**< whether it ends in a collision, 0 or 1; else it has reached the boundary */
    float distance;         /**< of the collision, or of the boundary */
    float weight[3];        /**< what the throughput is multiplied by, complete: no albedo comes on top */
    float pass_probability; /**< of passing the segment under all ways that the walk is drawn by; 1 if it scatters */
} wend_interior_flight;

/** The flight that was drawn where the medium goes on for `length`, 0 to 1e30. */
WEND_API wend_status wend_interior_fly(wend_interior_walk* walk, float length, float drawn,
                                       wend_interior_flight* flight, wend_error* error) WEND_NOEXCEPT;

/** The probability of flying through `length`, 0 to 1e30; the walk goes on behind it. For connections to lights, ask a
 * copy that has turned to the light. */
WEND_API wend_status wend_interior_pass(wend_interior_walk* walk, float length, float* probability,
                                        wend_error* error) WEND_NOEXCEPT;

/** A direction after a collision. */
typedef struct wend_interior_direction {
    wend_vec3 direction; /**< of unit length */
    float weight;        /**< what the throughput is multiplied by: phase function over density */
    float density;       /**< of the direction, in 1/sr, under all ways that the walk is drawn by */
} wend_interior_direction;

/** A direction after a collision, of a walk that arrived along the unit vector `before`: by a number `choice` in [0,1),
 * which chooses how it is drawn, and a point of the unit square, [0,1)^2. Directions towards the light take further
 * numbers from a generator that `key` is the seed of: draw 64 random bits for it. The walk does not change; tell it by
 * wend_interior_turn(). */
WEND_API wend_status wend_interior_sample(const wend_interior_walk* walk, wend_vec3 before, float choice, float u,
                                          float v, uint64_t key, wend_interior_direction* direction,
                                          wend_error* error) WEND_NOEXCEPT;

/** The density of any direction at that collision, before the walk turns. */
WEND_API wend_status wend_interior_density(const wend_interior_walk* walk, wend_vec3 before, wend_vec3 direction,
                                           float* density, wend_error* error) WEND_NOEXCEPT;

/** Now and then a direction out to a lamp, for a connection to it at the boundary, at that collision: `found` says
 * whether. `key` as for wend_interior_sample(), drawn anew. */
WEND_API wend_status wend_interior_sample_lamps(const wend_interior_walk* walk, wend_vec3 before, uint64_t key,
                                                wend_vec3* direction, int* found, wend_error* error) WEND_NOEXCEPT;

/** The density of such a direction, times the probability that there is one. */
WEND_API wend_status wend_interior_lamps_density(const wend_interior_walk* walk, wend_vec3 before, wend_vec3 direction,
                                                 float* density, wend_error* error) WEND_NOEXCEPT;

/** Goes on in a direction from a collision, of a walk that arrived along `before`. */
WEND_API wend_status wend_interior_turn(wend_interior_walk* walk, wend_vec3 before, wend_vec3 direction,
                                        wend_error* error) WEND_NOEXCEPT;

/** Whether the walk's direction is one that wend_interior_turn() told, 0 or 1: then a connection to a light might have
 * gone the same way. */
WEND_API wend_status wend_interior_has_turned(const wend_interior_walk* walk, int* has_turned,
                                              wend_error* error) WEND_NOEXCEPT;

/** The probability that the walk goes on, in [0,1], given the largest channel of the throughput, which is finite and
 * not negative; divide squared ratios of refractive indices out of it. It is counted in: draw roulette by it and divide
 * the weight. Put no limit on the number of collisions; this ends every walk. */
WEND_API wend_status wend_interior_survival(wend_interior_walk* walk, float throughput, float* probability,
                                            wend_error* error) WEND_NOEXCEPT;

/** Of classical and of guided sampling: its probability of all decisions of the walk so far over that of the mixture; 0
 * without a share. What a wend_technique_record asks for. */
WEND_API wend_status wend_interior_relative_densities(const wend_interior_walk* walk, float relative[2],
                                                      wend_error* error) WEND_NOEXCEPT;

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
