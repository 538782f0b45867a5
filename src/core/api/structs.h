/* Shared by the functions of the C interface: structs that begin with their size, options, times,
 * statuses, candidates. */
#ifndef ROT_API_STRUCTS_H
#define ROT_API_STRUCTS_H

#include "api/interface.h"
#include "engine/events.h"
#include "scene/choice.h"

/* status of the core => status of the interface */
rotdyn_status rot_api_status(rot_status status);

/* Caller's struct => copy of `size` bytes, with 0 in members that it lacks. Returns 0 for an
 * invalid size, or if a member beyond `size` is not 0. */
int rot_api_take(const void *from, size_t size, void *to);
/* Fills the members that the caller's struct has; its size is unchanged. `to` may be NULL. Returns
 * 0 for an invalid size. */
int rot_api_give(const void *from, size_t size, void *to);

/* 1 if all numbers are finite. */
int rot_api_finite(size_t n, const double x[]);
/* 1 if the times and their span are finite and the times do not decrease. */
int rot_api_times(size_t n, const double t[]);

/* Caller's options (or NULL) => options with defaults for members that are 0. Returns NULL, or the
 * error. */
const char *rot_api_options(const rotdyn_options *from, rotdyn_options *to);

/* candidate => the caller's struct */
rotdyn_status rot_api_candidate(const rot_candidate *candidate, const char *reason,
                                rotdyn_candidate *out);
/* No model fits => status and reason: the accuracy, or no model applies to the scene. */
rotdyn_status rot_api_none_fits(const rot_constraint *constraint, const void *scene,
                                const rot_query *query, size_t size, char text[]);

/* events => the caller's struct (or NULL) */
void rot_api_events(const rot_events *from, rotdyn_events *to);

#endif
