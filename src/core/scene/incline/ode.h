/* Numerical integration of a round body on an incline: the forces of scene/incline/incline.h, air
 * drag, an applied force. Events: slip ends, spin ends, static friction is exceeded. */
#ifndef ROT_INCLINE_ODE_H
#define ROT_INCLINE_ODE_H

#include "scene/incline/incline.h"

/* (time, x, v) => applied force along the slope on the centre of mass, positive down. */
typedef rot_status (*rot_incline_force)(double time_s, double x_m, double v_m_per_s,
                                        double *force_n, void *ctx);

/* Air drag on the centre of mass: -(linear + quadratic |v|) v. */
typedef struct rot_incline_scene {
  rot_incline_params slope;
  double drag_n_s_per_m;   /* >= 0, linear */
  double drag_n_s2_per_m2; /* >= 0, quadratic */
  rot_incline_force force; /* NULL: none */
  void *ctx;               /* of the force */
  int force_is_called;     /* 1: a law, whose values are rounded; 0: exact */
  double force_noise_n;    /* >= 0, error of the force */
  size_t n_breaks;
  const double *breaks_s; /* times at which the force may jump or kink */
} rot_incline_scene;

typedef struct rot_incline_ode_options {
  double accuracy; /* requested error of each measure, relative to its largest value */
  size_t max_steps;
  rot_method method; /* ROT_METHOD_NONE: choose */
  double resolution; /* of changes of a law given as a function; 0: default (engine/ode/ode.h) */
  double step_s;     /* step of a fixed-step method */
} rot_incline_ode_options;

/* Columns of the integrals. */
typedef struct rot_incline_sums {
#define X(name) double *name;
  ROT_INCLINE_SUMS(X)
#undef X
  /* Estimated errors: of the sums in their order, then of the slip heat and the rolling heat. */
  double error[ROT_INCLINE_SUM_ERRORS];
} rot_incline_sums;

/* (scene, options, times) => rows, sums, events, errors, as rot_incline_run(); errors are
 * estimates. */
rot_status rot_incline_integrate(const rot_incline_scene *scene,
                                 const rot_incline_ode_options *options, size_t n,
                                 const double time_s[], const rot_incline_columns *out,
                                 rot_incline_sums *sums, rot_events *events,
                                 rot_incline_event_rows *at_events, const rot_hooks *hooks,
                                 rot_info *info);

#endif
