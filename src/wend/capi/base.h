/* Errors and plain values of the interface for C. */
#ifndef WEND_CAPI_BASE_H
#define WEND_CAPI_BASE_H

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

/** @} */

#ifdef __cplusplus
}
#endif

#endif
