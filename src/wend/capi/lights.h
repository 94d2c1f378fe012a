/* Which light a vertex is connected to, learned by place from what connections brought, for C. */
#ifndef WEND_CAPI_LIGHTS_H
#define WEND_CAPI_LIGHTS_H

#include <wend/capi/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/** @addtogroup wend_c
 * @{ */

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
