/* Flows (work, heat, impulses) of a motion on an incline since its start, and its balances: energy,
 * momentum along the slope, angular momentum about the centre of mass. */
#ifndef ROT_INCLINE_LEDGER_H
#define ROT_INCLINE_LEDGER_H

#include "scene/incline/scene.h"

/* From ROT_INCLINE_SUM on: the integrals of an integrated run, in their order. */
enum {
  ROT_INCLINE_WORK,            /* of gravity */
  ROT_INCLINE_GRAVITY_IMPULSE, /* along the slope */
  ROT_INCLINE_SLIP_HEAT,
  ROT_INCLINE_ROLLING_HEAT,
  ROT_INCLINE_SUM,
  ROT_INCLINE_APPLIED_WORK = ROT_INCLINE_SUM,
  ROT_INCLINE_DRAG_HEAT,
  ROT_INCLINE_FRICTION_IMPULSE,
  ROT_INCLINE_DRAG_IMPULSE,
  ROT_INCLINE_APPLIED_IMPULSE,
  ROT_INCLINE_RESISTANCE_IMPULSE, /* about the centre of mass */
  ROT_INCLINE_FLOWS
};
enum { ROT_INCLINE_BALANCES = 3, ROT_INCLINE_KEPT = 4, ROT_INCLINE_TERMS = 14 };

extern const char *const rot_incline_flow_names[ROT_INCLINE_FLOWS];
extern const rot_balance rot_incline_balances[ROT_INCLINE_KEPT];
extern const rot_balance_term rot_incline_terms[ROT_INCLINE_TERMS];

/* Values of a row from which its flows are computed. sum: integrals of an integrated run. */
typedef struct rot_incline_place {
  double time_s, x_m, slip_heat_j, rolling_heat_j;
  double sum[ROT_INCLINE_FLOWS - ROT_INCLINE_SUM];
} rot_incline_place;

/* (row, errors of the measures in *info) => flows, their errors with rounding. exact: flows by the
 * closed form; NaN where it fails. */
void rot_incline_flow(const rot_incline_params *p, const rot_incline_place *at, int exact,
                      const rot_info *info, double value[], double error[]);

/* rot_constraint.audit: (two rows, flows) => terms of the balances. */
void rot_incline_audit(const void *scene, const rot_span *span, double term[]);
/* rot_constraint.conserved: balance => number of reasons against conservation, reasons. */
size_t rot_incline_conserved(const void *scene, size_t balance, const char *why[]);

#endif
