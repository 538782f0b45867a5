/* A round body on an incline with what scene/incline/incline.h takes, and air drag and a force
 * besides, integrated. Slip that ends, spin that ends and static friction that is lost are events.
 * */
#ifndef ROT_INCLINE_ODE_H
#define ROT_INCLINE_ODE_H

#include "scene/incline/incline.h"

/* A force along the slope on the centre of mass, positive down. */
typedef rot_status (*rot_incline_force)(double time_s, double x_m, double v_m_per_s,
                                        double *force_n, void *ctx);

/* With air drag -(linear + quadratic |v|) v on the centre of mass, >= 0; and with a force, NULL:
 * none, that may jump or kink at the breaks. */
typedef struct rot_incline_scene {
  rot_incline_params slope;
  double drag_n_s_per_m, drag_n_s2_per_m2;
  rot_incline_force force;
  void *ctx;
  double force_noise_n; /* how far it may be off */
  size_t n_breaks;
  const double *breaks_s;
} rot_incline_scene;

typedef struct rot_incline_ode_options {
  double accuracy; /* largest error wanted of each measure, relative to its largest value */
  size_t max_steps;
  rot_method method; /* ROT_METHOD_NONE: choose */
  double resolution; /* of changes of a law that is called: see engine/ode/ode.h; 0: as there */
  double step_s;     /* of a method with steps of fixed length */
} rot_incline_ode_options;

/* A value for each row. */
typedef struct rot_incline_sums {
#define X(name) double *name;
  ROT_INCLINE_SUMS(X)
#undef X
  /* of the sums, in their order, and of the heat of slip and of rolling; estimates */
  double error[ROT_INCLINE_SUM_ERRORS];
} rot_incline_sums;

/* Rows, columns and events as of rot_incline_run(); errors are estimates. */
rot_status rot_incline_integrate(const rot_incline_scene *scene,
                                 const rot_incline_ode_options *options, size_t n,
                                 const double time_s[], const rot_incline_columns *out,
                                 rot_incline_sums *sums, rot_events *events,
                                 rot_incline_event_rows *at_events, const rot_hooks *hooks,
                                 rot_info *info);

#endif
