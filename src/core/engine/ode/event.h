/* Zeros of the event functions, and of the component that a switch watches, within a step. */
#ifndef ROT_ODE_EVENT_H
#define ROT_ODE_EVENT_H

#include "engine/ode/step.h"

/* One event function at the state. */
typedef struct rot_ode_watch {
  double value;
  int side;  /* its sign on the way here; 0: not known yet */
  int fresh; /* the segment begins at its zero */
} rot_ode_watch;

typedef struct rot_ode_search {
  const rot_ode_clock *clock;
  const rot_ode_state *state;
  rot_ode_law *law;      /* its surfaces and their sides; what slides calls it */
  rot_ode_stepper *step; /* takes parts of the trial step */
  rot_ode_watch *watch;  /* the switch first, if there is one, then the events, then the surfaces */
  double *between;       /* dim: a state within the step */
} rot_ode_search;

/* What was seen in a trial step. */
typedef enum rot_ode_passage {
  ROT_ODE_SAME_SIDE,
  ROT_ODE_AT_ZERO,     /* the trial ends at a zero of event *which */
  ROT_ODE_CUT_SHORT,   /* the trial ends where an event seemed near */
  ROT_ODE_TRY_SHORTER, /* the trial is no good */
  ROT_ODE_OTHER_SIDE   /* the same: the motion leaves the zero of *which to the other side */
} rot_ode_passage;

/* Which side of zero each event function is on where a segment begins. The value that `fired` has
 * there, `at`, counts as zero (no event: SIZE_MAX). */
void rot_ode_arm(rot_ode_search *in, size_t fired, double at);
/* The last watch alone: a new surface's. */
void rot_ode_arm_last(rot_ode_search *in);
/* Looks for the first event in the trial step; *h becomes the step that is left. */
rot_status rot_ode_look_for_events(rot_ode_search *in, double *h, rot_ode_passage *what,
                                   size_t *which);
/* After a step was accepted: the values at its end. `passed`: the event it ended at, if the motion
 * goes on through it. */
void rot_ode_watch_on(rot_ode_search *in, size_t passed);

double rot_ode_event_value(rot_ode_search *in, size_t which);
/* Whether the state lies beyond a zero that counts. */
int rot_ode_is_beyond(rot_ode_search *in, size_t which);

/* The surface that is watched as `which`, or NO_SURFACE. */
size_t rot_ode_surface_of(const rot_ode_search *in, size_t which);
/* Whether the trial step ends beyond a surface that the state lies before. */
int rot_ode_passes_surface(const rot_ode_search *in);

#endif
