/* One run of the integrator over both sides of the start: its phases, breaks, stretches between
 * events. */
#ifndef ROT_ODE_MARCH_H
#define ROT_ODE_MARCH_H

#include "engine/ode/advance.h"

/* What is asked of a run, and where its results go. */
typedef struct rot_ode_job {
  const rot_ode_params *p;
  rot_ode_output rows; /* of a run with a guide */
  rot_method method;
  double step_s; /* of a method with steps of fixed length, whose rows are wanted without a guide */
  double tolerance;
  size_t budget;
  const rot_ode_trace *guide; /* of both sides, or NULL: the error test rules */
  size_t parts;               /* of its steps */
  rot_ode_trace *trace;       /* of both sides */
  rot_ode_track *track;       /* of both sides, or NULL */
  rot_ode_kinks *kinks;       /* takes those of a run without a guide */
  rot_ode_walls *walls;       /* known; takes more */
  rot_ode_growth *growth;     /* of a run without a guide; NULL: not followed */
  rot_ode_probes *probes;     /* the same; NULL: none */
  double *largest;            /* of each measure */
  rot_ode_errors errors;
  int stiff;      /* in: look for it; out: found */
  int first_mode; /* *p->mode where it sets out */
} rot_ode_job;

rot_status rot_ode_run_once(rot_ode_job *job, const rot_hooks *hooks, rot_info *info);

/* All of a report but its measures, which are the caller's, and the calls of all runs. */
void rot_ode_clear_report(rot_info *info);

#endif
