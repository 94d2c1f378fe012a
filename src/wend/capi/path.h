/* Records of walks for C: what the field learns from. */
#ifndef WEND_CAPI_PATH_H
#define WEND_CAPI_PATH_H

#include <wend/capi/field.h>

#ifdef __cplusplus
extern "C" {
#endif

/** @addtogroup wend_c
 * @{ */

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
