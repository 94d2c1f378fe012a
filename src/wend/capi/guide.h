/**
 * @defgroup wend_c The decisions of walks for C
 *
 * All that the library decides, for C: the learned field of incident radiance, and the decisions of a walk that follow
 * it. It is C99, and C++ as well; link wend::guide. This header has the others:
 *
 *   - field.h: fields, their fitting, distributions of directions that multiply with what scatters, and records of
 *     walks;
 *   - decisions.h: how far walks fly, roulette and splitting, and which light a vertex is connected to;
 *   - interior.h: walks inside dense media, and how these are best drawn, learned by place.
 *
 * A renderer uses it like this:
 *
 *   1. wend_field_create() once for surfaces and once for volumes: fields that know nothing yet.
 *   2. Render a pass. At every vertex: wend_field_incident(), wend_distribution_product() with the lobes of what
 *      scatters, wend_distribution_sample(). Mix it with your own sampling (wend_field_classical_share() and
 *      wend_least_classical_share() say how) and divide by the density of the mixture, and no field can bias the
 *      picture.
 *   3. Keep the vertices of every walk; wend_records_of_path() makes records of them.
 *   4. Between passes wend_field_fit() makes the next field of the last one and the records. Go on with 2.
 *
 * Each of the other decisions can be taken or left:
 *
 *   - flights: wend_flight_guided(); learn from wend_scatter_records_of_path() by wend_field_fit_scattered();
 *   - lights: wend_lights_sample(); learn by wend_lights_record(), wend_lights_add() and wend_lights_learn();
 *   - survival: wend_survival_before_direction(), wend_survival_after_direction(), and wend_pixel_estimates() between
 *     passes;
 *   - walks inside dense media: wend_interior_enter_with() as wend_technique_mixes_at() says; learn by
 *     wend_technique_mixes_learn().
 *
 * Rules that hold for all functions:
 *
 *   - They return a wend_status, take a wend_error that may be null as their last argument, and throw nothing.
 *     Unless it is said otherwise, results are written only when the status is WEND_OK.
 *   - They remember nothing but what is in their arguments: any number of threads may call them at once. A field and
 *     the guide of a medium never change once they are made. What is not const changes: one thread at a time.
 *   - Pointers are referred to during the call alone, but for those of a walk to its wend_interior_guide and to its
 *     wend_interior_lamps.
 *   - Random numbers are arguments: uniform, each used once. The same arguments give the same bits as the decisions of
 *     the library for C++.
 *   - Directions have unit length (to 1e-3). Distances are in the units of the scene, densities in 1/sr.
 *   - A null pointer where one is needed, a number that is not finite or out of its range, an object that was
 *     not filled by this library: all these are WEND_BAD_ARGUMENT.
 */
#ifndef WEND_CAPI_GUIDE_H
#define WEND_CAPI_GUIDE_H

#include <wend/capi/decisions.h>
#include <wend/capi/field.h>
#include <wend/capi/interior.h>

#endif
