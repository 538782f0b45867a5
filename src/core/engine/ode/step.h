/* One step of GSL's rk8pd or of Radau, with its error test, or of a method with steps of fixed
 * length. */
#ifndef ROT_ODE_STEP_H
#define ROT_ODE_STEP_H

#include <gsl/gsl_odeiv2.h>

#include "engine/ode/law.h"
#include "maths/radau.h"

typedef struct rot_ode_stepper {
  rot_ode_law *law;
  const rot_ode_state *state; /* its sizes */
  rot_method method;
  double tolerance;
  double fixed_s;     /* > 0: the length of all steps */
  size_t fixed_parts; /* into which each is divided */
  double h;           /* the step that the error test would like next */
  double noise;       /* of a segment that began at rest: what cancels in its slope there */
  double *trial, *trial_error, *trial_slope; /* of the last attempt; dim each, as all below */
  double *allowed;                           /* what Newton's iteration may leave */
  rot_ode_calls calls;                       /* of the last attempt */
  gsl_odeiv2_step *rk;
  gsl_odeiv2_system system;
  rot_radau *radau;
  double *stage; /* of RK4: a state, its slope; where a part of a step begins, the same */
} rot_ode_stepper;

/* The tools of its method; ROT_ENOMEM. */
rot_status rot_ode_stepper_open(rot_ode_stepper *s);
void rot_ode_stepper_close(rot_ode_stepper *s);

/* From (t, y) with its slope to t + h: trial, trial_error, trial_slope. ROT_ERHS (not finite) and
 * ROT_ESTEP (Newton diverged): try shorter; any other status ends the run. */
rot_status rot_ode_attempt(rot_ode_stepper *s, double t, double h, const double y[],
                           const double slope[]);
static inline int rot_ode_may_retry(rot_status status) {
  return status == ROT_ERHS || status == ROT_ESTEP;
}

/* Error of the trial step over what is allowed; NaN if it makes no sense. */
double rot_ode_trial_ratio(const rot_ode_stepper *s, double h);
/* By what the error of a step falls if the step is divided into so many. */
double rot_ode_gain(rot_method method, double parts);

#endif
