/* What flowed in a motion on an incline since its start, and its balances: those of energy, of
 * momentum along the slope, and of angular momentum about the centre of mass. */
#ifndef ROT_INCLINE_LEDGER_H
#define ROT_INCLINE_LEDGER_H

#include "scene/incline/scene.h"

/* From ROT_INCLINE_SUM on, the sums of an integrated run in their order. */
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

/* What a row has, of which the flows up to it are made. `sum`: those of an integrated run. */
typedef struct rot_incline_place {
  double time_s, x_m, slip_heat_j, rolling_heat_j;
  double sum[ROT_INCLINE_FLOWS - ROT_INCLINE_SUM];
} rot_incline_place;

/* The flows, and their errors by rounding and by those of the measures in `info`. `exact`: sums and
 * work by the closed form, NaN where that fails. */
void rot_incline_flow(const rot_incline_params *p, const rot_incline_place *at, int exact,
                      const rot_info *info, double value[], double error[]);

/* rot_constraint.audit and .keeps */
void rot_incline_audit(const void *scene, const rot_span *span, double term[]);
size_t rot_incline_conserved(const void *scene, size_t balance, const char *why[]);

#endif
