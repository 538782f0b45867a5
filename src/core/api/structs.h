/* What the C interface's functions share: structs that begin with their size, options, times,
 * statuses, candidates. */
#ifndef ROT_API_STRUCTS_H
#define ROT_API_STRUCTS_H

#include "api/interface.h"
#include "engine/events.h"
#include "scene/choice.h"

rotdyn_status rot_api_status(rot_status status);

/* A copy of the caller's struct, with 0 in what it lacks. What it has beyond `size` must be 0. */
int rot_api_take(const void *from, size_t size, void *to);
/* The caller's struct, filled as far as it goes; its size stays. NULL: nothing to fill. */
int rot_api_give(const void *from, size_t size, void *to);

int rot_api_finite(size_t n, const double x[]);
/* Finite, not decreasing, and so is their span. */
int rot_api_times(size_t n, const double t[]);

/* With the defaults where `from` is NULL or 0. NULL, or what is wrong. */
const char *rot_api_options(const rotdyn_options *from, rotdyn_options *to);

rotdyn_status rot_api_candidate(const rot_constraint *constraint, const rot_candidate *candidate,
                                rotdyn_candidate *out);
/* By the accuracy, or because none takes the scene: the status, and why. */
rotdyn_status rot_api_none_fits(const rot_constraint *constraint, const void *scene,
                                const rot_query *query, size_t size, char text[]);

/* `to` may be NULL. */
void rot_api_events(const rot_events *from, rotdyn_events *to);

#endif
