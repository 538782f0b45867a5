/* What the C interface's functions share: structs that begin with their size, times, statuses. */
#ifndef ROT_API_STRUCTS_H
#define ROT_API_STRUCTS_H

#include "api/interface.h"
#include "engine/events.h"

rotdyn_status rot_api_status(rot_status status);

/* A copy of the caller's struct, with 0 in what it lacks. What it has beyond `size` must be 0. */
int rot_api_take(const void *from, size_t size, void *to);
/* The caller's struct, filled as far as it goes; its size stays. NULL: nothing to fill. */
int rot_api_give(const void *from, size_t size, void *to);

int rot_api_finite(size_t n, const double x[]);
/* Finite, not decreasing, and so is their span. */
int rot_api_times(size_t n, const double t[]);

/* `to` may be NULL. */
void rot_api_events(const rot_events *from, rotdyn_events *to);

#endif
