/* What is integrated: the right-hand side, its state in groups, breaks, events, options. */
#ifndef ROT_ODE_PARAMS_H
#define ROT_ODE_PARAMS_H

#include <stddef.h>

#include "engine/events.h"
#include "ground/status.h"

/* dydt = f(t, y). Not finite, or ROT_ERHS: not defined here, the step is tried shorter. Any other
 * status ends the run. */
typedef rot_status (*rot_ode_rhs)(double t, const double y[], double dydt[], void *ctx);

/* Components whose error is measured together. */
typedef enum rot_ode_norm {
  ROT_ODE_SCALAR,    /* count 1; relative to its largest value so far */
  ROT_ODE_VECTOR,    /* 2-norm; relative to the largest norm so far */
  ROT_ODE_QUATERNION /* count 4, near unit length: angle between the attitudes, in rad; q = -q */
} rot_ode_norm;
typedef struct rot_ode_group {
  size_t first, count;
  rot_ode_norm norm;
} rot_ode_group;

/* What follows an event. */
typedef enum rot_ode_then {
  ROT_ODE_GO_ON,       /* the motion is smooth there */
  ROT_ODE_NEW_SEGMENT, /* state, mode or law changed */
  ROT_ODE_END          /* the run ends; later rows are not done */
} rot_ode_then;

/* An event: a zero of g(t, y), found to the rounding of time. Where g changes sign twice within a
 * step it is looked for at seven points of the step's cubic. */
typedef struct rot_ode_event {
  double (*g)(double t, const double y[], void *ctx); /* NULL: y[component] */
  size_t component;
  int direction;  /* 1: rising in time; -1: falling; 0: both */
  rot_event name; /* in the log */
  rot_ode_then (*then)(double t, double y[], int *mode, int forward, void *ctx); /* NULL: go on */
  /* The side of zero to which a segment forward leaves that begins there in this mode; NULL, or 0:
   * by the slope. */
  int (*side)(int mode, size_t component, void *ctx);
  int far; /* where g jumps over zero, the event is on the far side */
} rot_ode_event;

/* A right-hand side with a kink or jump where y[watched] = 0. It is integrated with the sign fixed
 * at *mode = 1 or -1, so that it is smooth, up to the zero itself; there, and wherever a segment
 * begins at zero, dydt[driver] with *mode = 0 decides: up to `holds` in size it is held at rest
 * (*mode = 0: the controlled components stay), else it leaves the way dydt[driver] points. */
typedef struct rot_ode_switch {
  size_t watched, driver;
  double holds; /* >= 0; 0: nothing holds */
} rot_ode_switch;

typedef struct rot_ode_params {
  size_t dim;
  size_t controlled; /* the first so many components are the state: they steer the step */
  size_t n_groups;   /* groups of the state, in order, without gaps; 0: each a scalar */
  const rot_ode_group *groups;
  rot_ode_rhs rhs;
  void *ctx;
  /* Times where rhs may jump or kink, increasing. It is not evaluated there, but for the lower one
   * of two between which there is no double: there it has the value after the jump. */
  size_t n_breaks;
  const double *breaks;
  double start_s;
  int start_breaks;           /* the start counts as a break */
  const double *start;        /* dim values */
  double accuracy;            /* largest error wanted of each group, relative to its size */
  size_t max_steps;           /* a run, rejected steps included */
  rot_method method;          /* ROT_METHOD_NONE: choose */
  int *mode;                  /* read by rhs, changed by events; reset at the start of a run */
  const rot_ode_switch *turn; /* may be NULL; needs mode */
  size_t n_events;
  const rot_ode_event *events;
  rot_events *log;                                                /* of the result; may be NULL */
  void (*at_break)(double t, double y[], int forward, void *ctx); /* may be NULL: y may jump */
  /* May be NULL: puts y back on its manifold after each step and in each row. What it moves the
   * groups beyond rounding counts as error. */
  void (*project)(double t, double y[], void *ctx);
  size_t sloped; /* the component whose slope is wanted at the rows */
  /* What rhs itself leaves uncertain of the slopes of each group, or NULL: a step may be off by so
   * much a second besides, or a motion that begins in rhs's rounding would never be resolved. */
  const double *noise;
  /* What rounding leaves uncertain of the slopes of each group besides, or NULL: a figure has it.
   * Terms that cancel at the start round in all runs alike, so their distance does not show it. */
  const double *rounds;
  int kinks; /* rhs may have kinks in y that no break and no switch marks */
  /* Changes of rhs in an interval of time or of a controlled component at least this wide, in parts
   * of the range visited, are found (engine/ode/probe.h); 0: rhs is not looked at. */
  double resolution;
  /* Integrals are used at all rows: their errors have what rows between steps are off by. Else they
   * are used at the last row alone, a step's end, where an axle's are 1e-4 of that. */
  int integrals_between;
  /* No loss makes the steps longer in less time; Inf: nothing damps or stops the motion; 0: not
   * known. If the budget reaches neither this time nor the end at 1000 times the progress of 10000
   * steps, the run fails after these. */
  double fades_s;
  /* 1: linear vibrations that nothing damps hold the steps short: the progress counts 10 times, not
   * 1000 times. */
  int steady;
  /* After it losses have acted: what is slow then stays slow, and the end of the run counts instead
   * of fades_s. 0: not known. */
  double settles_s;
  int expensive; /* rhs costs more than the arithmetic around it; it reads the state alone */
  /* What rounding grows to is followed to order 4 in the step, and counts at the rows alone; steps
   * of Radau are not looked at by probes. */
  int fine_propagation;
  double step_s; /* > 0: of a method with steps of fixed length (engine/ode/fixed.h) */
  /* For the semi-implicit method: a step of length h to t, from `before`; y has the new rates, and
   * takes the new positions. */
  void (*positions)(double t, double h, const double before[], double y[], void *ctx);
} rot_ode_params;

/* Its steps have one length. */
static inline int rot_ode_is_fixed(rot_method method) {
  return method == ROT_METHOD_EULER || method == ROT_METHOD_SEMI_IMPLICIT ||
         method == ROT_METHOD_RK4;
}

/* Of a law that is called, where 0 is asked; of others 0: they are not looked at. */
#define ROT_ODE_RESOLUTION 0.005
static inline double rot_ode_resolution(int called, double asked) {
  return !called ? 0.0 : asked > 0.0 ? asked : ROT_ODE_RESOLUTION;
}

/* Relative errors below this cannot be shown by a second run: its own rounding. */
#define ROT_ODE_BEST_ACCURACY 1e-13

/* Measures: the groups (or the controlled components), then each component beyond. */
static inline size_t rot_ode_measures(const rot_ode_params *p) {
  return p->n_groups ? p->n_groups + (p->dim - p->controlled) : p->dim;
}

#endif
