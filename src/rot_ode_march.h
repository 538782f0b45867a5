/* One run of the integrator from its start outward, as the files of rot_ode_*.c share it. Private
 * to them: the rest of the core knows rot_ode.h alone. */
#ifndef ROT_ODE_MARCH_H
#define ROT_ODE_MARCH_H

#include <gsl/gsl_odeiv2.h>

#include "rot_dense.h"
#include "rot_ode.h"
#include "rot_radau.h"

/* Ends of the steps of one run on one side of the start, outward: t, the error that the test found
 * in the step that ends there (a part of the largest value), y[dim]. */
typedef struct rot_ode_trace {
  size_t dim, count, room;
  double *data;
} rot_ode_trace;

static inline const double *rot_ode_node(const rot_ode_trace *m, size_t i) {
  return m->data + i * (2 + m->dim);
}

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
  double end;            /* of this side */
  int slope_known;       /* slope holds f(t, y) */
  int wild;              /* rhs was not finite in the last trial */
  double stretch_t;      /* where the stretch began */
  int at_rest, may_flip; /* a stretch began at zero; nothing said which way it goes */
  int was_cut;           /* the last step ended at a dip that was none */
  double noise;          /* of a stretch that began at rest: what cancels in its slope there */
  double grace;          /* held up to here whatever drives */
  rot_status status;     /* of the last rhs call */
  double *y, *trial, *trial_error, *slope, *trial_slope, *allowed, *work; /* dim each */
  double *largest;            /* the caller's: size of each component so far */
  double worst;               /* error that the test found in a step, largest so far */
  double unresolved;          /* of steps where halving did not help, the sum of squares */
  const rot_ode_trace *guide; /* steps to be halved; NULL: the error test rules */
  size_t guide_at;            /* t lies from this node of it to the next */
  double limit;               /* no step is longer, after a rejection in a guided run */
  rot_ode_trace *trace;       /* its own steps */
  double stage_t, *stage_y, *stage_f, stiffness; /* Hairer's test, see rot_ode_step.c */
  int watch_stiffness, stiff, stiff_steps, calm_steps;
  /* rows, outward from the start */
  rot_dense dense;
  rot_dense_form *form;
  const double *time_s;
  double *y_rows, *slope_rows, *share; /* y_rows NULL: no rows are wanted of this run */
  size_t first, total, done;
} rot_ode_march;

/* From the start to `end`, all breaks on the way. */
rot_status rot_ode_march_to(rot_ode_march *run, double end, int forward);

#endif
