/* One run of the integrator over both sides of the start: its phases, breaks, segments between
 * events. */
#ifndef ROT_ODE_STEPPING_H
#define ROT_ODE_STEPPING_H

#include "engine/ode/advance.h"

/* What is asked of a run, and where its results go. */
typedef struct rot_ode_job {
  const rot_ode_params *p;
  rot_ode_output rows; /* of a run with a reference */
  rot_method method;
  double step_s; /* of a method of fixed steps, whose rows are wanted without a reference */
  double tolerance;
  size_t budget;
  const rot_ode_trace *reference;   /* of both sides, or NULL: the error test rules */
  size_t parts;                     /* of its steps; of those of fixed length, of its own */
  rot_ode_trace *trace;             /* of both sides */
  rot_ode_trajectory *trajectory;   /* of both sides, or NULL */
  rot_ode_kinks *kinks;             /* takes those of a run without a reference */
  rot_ode_surfaces *surfaces;       /* known; takes more */
  rot_ode_propagation *propagation; /* of a run without a reference; NULL: not followed */
  rot_ode_probes *probes;           /* the same; NULL: none */
  double *largest;                  /* of each measure */
  rot_ode_errors errors;
  int stiff;         /* in: look for it; out: found */
  int first_mode;    /* *p->mode at the start */
  unsigned rounding; /* > 0: each state is moved by one, other ones for each number */
} rot_ode_job;

rot_status rot_ode_run_once(rot_ode_job *job, const rot_hooks *hooks, rot_info *info);

/* All of a report but its measures, which are the caller's, and the calls of all runs. */
void rot_ode_clear_report(rot_info *info);

#endif
