/* The state of one run of the integrator from its start outward, which the files of this folder
 * share. The rest of the core knows engine/ode/ode.h alone. */
#ifndef ROT_ODE_RUN_H
#define ROT_ODE_RUN_H

#include <gsl/gsl_odeiv2.h>

#include "maths/dense.h"
#include "engine/ode/norm.h"
#include "maths/radau.h"

/* Ends of the steps of one run on one side of the start, outward: t, the error that the test found
 * in the step that ends there (a part of the largest value), y[dim]. */
typedef struct rot_ode_trace {
  size_t dim, count, room;
  int ended; /* by an event */
  double *data;
} rot_ode_trace;

static inline const double *rot_ode_node(const rot_ode_trace *m, size_t i) {
  return m->data + i * (2 + m->dim);
}

/* Times just before and just after the kinks of a run. */
typedef struct rot_ode_kinks {
  size_t count, room;
  double *time_s;
  int missed; /* there is one that was not found, or a jump */
} rot_ode_kinks;

/* Where the right-hand side jumps or kinks: see engine/ode/wall.h. */
enum { ROT_ODE_MOST_WALLS = 1024 };
#define NO_WALL ((size_t)-1)

typedef struct rot_ode_wall {
  size_t component; /* dim: time */
  double below, above;
} rot_ode_wall;

typedef struct rot_ode_walls {
  size_t count;
  rot_ode_wall wall[ROT_ODE_MOST_WALLS];
} rot_ode_walls;

typedef struct rot_ode_growth rot_ode_growth;
typedef struct rot_ode_probes rot_ode_probes;

/* All nodes of one run on one side, twins where a stretch begins, and the derivatives of dydt by
 * the controlled components, dim x controlled of each; NaN where a stretch begins. */
typedef struct rot_ode_track {
  rot_dense nodes;
  size_t controlled, room;
  int slid; /* along a wall, somewhere */
  double *derivative;
} rot_ode_track;

/* The state of the march.
 *
 *   MOVING     -> a step -> MOVING, CUT
 *   CUT        -> the last step was cut where an event seemed near; a step -> MOVING
 *   LEAVING    -> a stretch begins at rest, its direction known; a step -> MOVING; none -> HELD
 *   UNDECIDED  -> the same where nothing drives: the direction is a guess, and may flip -> LEAVING
 *   HELD       -> until it breaks loose -> LEAVING
 *   STIFF      -> ended: not for an explicit method
 *   ENDED      -> ended by an event */
typedef enum rot_ode_phase {
  ROT_ODE_MOVING,
  ROT_ODE_CUT,
  ROT_ODE_LEAVING,
  ROT_ODE_UNDECIDED,
  ROT_ODE_HELD,
  ROT_ODE_STIFF,
  ROT_ODE_ENDED
} rot_ode_phase;

/* One event function at run->t. */
typedef struct rot_ode_watch {
  double value;
  int side;  /* its sign on the way here; 0: not known yet */
  int fresh; /* the stretch begins at its zero */
} rot_ode_watch;

/* One run. */
typedef struct rot_ode_march {
  const rot_ode_params *p;
  const rot_hooks *hooks;
  rot_info *info;
  rot_method method;
  gsl_odeiv2_step *rk;
  gsl_odeiv2_system system;
  rot_radau *radau;
  double tolerance;
  size_t budget;
  double t, h;          /* h: the step that the error test would like next */
  double after, before; /* rhs is evaluated strictly inside (break, next break) */
  int forward;
  double end; /* of this side */
  rot_ode_phase phase;
  int first_mode;    /* *p->mode where a run sets out */
  int slope_known;   /* slope holds f(t, y) */
  double stretch_t;  /* where the stretch began */
  double noise;      /* of a stretch that began at rest: what cancels in its slope there */
  double grace;      /* held up to here whatever drives */
  rot_status status; /* of the last rhs call */
  double *y, *trial, *trial_error, *slope, *trial_slope, *allowed, *work, *change; /* dim each */
  rot_ode_walls *walls;                                                            /* of all runs */
  int side[ROT_ODE_MOST_WALLS];   /* of each wall; 0: slides along it */
  size_t slides;                  /* the wall that it slides along, or NO_WALL */
  double *kept, *beside, *beyond; /* dim each: a state on its sides; slopes on both sides */
  double *largest;                /* the caller's: size of each measure so far */
  double *moved;                  /* by the projection, summed, each measure */
  double found;                   /* errors that the test found in the steps, their sum */
  double *missed;                 /* of each integral, likewise: no test weighs them */
  double unresolved;              /* of steps where halving did not help, the sum of squares */
  const rot_ode_trace *guide;     /* steps to be divided into `parts`; NULL: the error test rules */
  size_t parts;
  size_t guide_at;        /* t lies from this node of it to the next */
  double limit;           /* no step is longer, after a rejection in a guided run */
  rot_ode_trace *trace;   /* its own steps */
  rot_ode_growth *growth; /* of its rounding; NULL: not followed */
  rot_ode_track *track;   /* NULL: not kept */
  rot_ode_kinks *kinks;   /* takes those that are found; NULL: none is looked for */
  double kink, over;      /* just before and just after the next one; NaN: none is known */
  double looked_t;        /* where one was looked for last, `looks` times */
  int looks;
  rot_ode_probes *probes; /* NULL: none */
  double *called;         /* t and state of the calls of the last attempt */
  size_t n_called;
  int attempts;         /* calls are those of an attempt */
  double probed_t;      /* up to here */
  rot_ode_watch *watch; /* the switch first, if there is one, then the events, then the walls */
  size_t n_watch;
  double stage_t, *stage_y, *stage_f, stiffness; /* Hairer's test, see engine/ode/step.c */
  int watch_stiffness, stiff_steps, calm_steps;
  /* rows, outward from the start */
  rot_dense dense;
  rot_dense_form *form;
  const double *time_s;
  double *y_rows, *slope_rows, *share; /* y_rows NULL: no rows are wanted of this run */
  size_t first, total, done;
} rot_ode_march;

#endif
