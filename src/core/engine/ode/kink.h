/* Kinks of the right-hand side in the state, which no break marks, found where the error test of
 * rk8pd fails by far. */
#ifndef ROT_ODE_KINK_H
#define ROT_ODE_KINK_H

#include "engine/ode/probe.h"
#include "engine/ode/step.h"

/* Times just before and just after the kinks of a run. */
typedef struct rot_ode_kinks {
  size_t count, room;
  double *time_s;
  int missed; /* there is one that was not found, or a jump */
} rot_ode_kinks;

typedef struct rot_ode_kink_search {
  const rot_ode_clock *clock;
  const rot_ode_state *state;
  rot_ode_law *law; /* surfaces are added */
  rot_ode_stepper *step;
  rot_ode_kinks *found;  /* takes those that are passed; NULL: none is looked for */
  double before, behind; /* just before and just after the next one; NaN: none is known */
  double looked_t;       /* where one was looked for last, `looks` times */
  int looks;
} rot_ode_kink_search;

/* The step over h was rejected, with this ratio of its error, or diverged; its trial is the result.
 * Where there is a kink within it, `before` and `behind` are so near that a step from one to the
 * other errs by less than the accuracy, and so far apart that the kink of any other run lies
 * between them, too; or a surface is added, whose side is unknown yet. */
rot_status rot_ode_look_for_kink(rot_ode_kink_search *in, double h, double ratio, int diverged);
/* The same for surfaces alone (engine/ode/law.h), of a step that need not have been rejected. */
rot_status rot_ode_look_for_surface(rot_ode_kink_search *in, double h);
/* It is the time before a kink, or behind it. */
rot_status rot_ode_pass_kink(rot_ode_kink_search *in);

/* surfaces where the law changes before or behind the places of sights: at a jump, or through the
 * place itself. break_s[] of each: NaN, or the time of the place where no surface was added. */
rot_status rot_ode_look_at_sights(const rot_ode_params *p, const rot_ode_probes *probes,
                                  rot_ode_surfaces *surfaces, double break_s[], rot_info *info);

#endif
