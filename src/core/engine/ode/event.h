/* Zeros of the event functions, and of the component that a switch watches, within a step. */
#ifndef ROT_ODE_EVENT_H
#define ROT_ODE_EVENT_H

#include "engine/ode/run.h"

/* What was seen in a trial step. */
typedef enum rot_ode_passage {
  ROT_ODE_SAME_SIDE,
  ROT_ODE_AT_ZERO,    /* the trial ends at a zero of event *which */
  ROT_ODE_CUT_SHORT,  /* the trial ends where an event seemed near */
  ROT_ODE_TRY_SHORTER /* the trial is no good */
} rot_ode_passage;

/* Which side of zero each event function is on where a stretch begins. The value that `fired` has
 * there, `at`, counts as zero (no event: SIZE_MAX). */
void rot_ode_arm(rot_ode_march *run, size_t fired, double at);
/* The last watch alone: a new wall's. */
void rot_ode_arm_last(rot_ode_march *run);

/* Looks for the first event in the trial step; *h becomes the step that is left. */
rot_status rot_ode_look_for_events(rot_ode_march *run, double *h, rot_ode_passage *what,
                                   size_t *which);

/* After a step was accepted: the values at its end. `passed`: the event it ended at, if the motion
 * goes on through it. */
void rot_ode_watch_on(rot_ode_march *run, size_t passed);

double rot_ode_event_value(rot_ode_march *run, size_t which);

/* The wall that is watched as `which`, or NO_WALL. */
size_t rot_ode_wall_of(const rot_ode_march *run, size_t which);

#endif
